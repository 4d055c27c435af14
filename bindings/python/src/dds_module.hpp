/// \file   dds_module.hpp
/// \brief  Shared by the sources of the Python module libins._dds. SPDX-License-Identifier: MIT
#ifndef INS_DDS_MODULE_HPP_INCLUDED
#define INS_DDS_MODULE_HPP_INCLUDED
#include "ins_dds/dds.h"
#include <array>
#include <nanobind/nanobind.h>
#include <optional>
#include <stdexcept>
#include <string>

using OptionalText = std::optional<std::string>;

inline const char* c_text(const OptionalText& text)
{
    return text ? text->c_str() : nullptr;
}

/// Which network, of the texts given at most one of xml and interface.
inline void choose_network(ins_dds_config_t& cfg, const OptionalText& xml, const OptionalText& interface,
                           const OptionalText& peers)
{
    cfg.network = xml ? INS_DDS_XML : interface ? INS_DDS_INTERFACE : INS_DDS_LOOPBACK;
    cfg.xml = c_text(xml);
    cfg.interface = c_text(interface);
    cfg.peers = c_text(peers);
}

/// The files of a folder that `ins keys` made.
class Security
{
  public:
    explicit Security(const OptionalText& folder) : used(folder.has_value())
    {
        if (folder && ins_dds_security_folder(folder->c_str(), &files, memory.data()) != INS_DDS_OK)
        {
            throw std::runtime_error(ins_dds_error_text());
        }
    }
    const ins_dds_security_t* get() const { return used ? &files : nullptr; }

  private:
    bool used;
    std::array<char, INS_DDS_SECURITY_MEMORY> memory{};
    ins_dds_security_t files{};
};

/// The result of a call, or its error text as an exception.
inline int checked(int result)
{
    if (result < 0)
    {
        throw std::runtime_error(ins_dds_error_text());
    }
    return result;
}

/// Messages as octets, ins_dds/raw.h.
void bind_raw(nanobind::module_& m);

#endif // INS_DDS_MODULE_HPP_INCLUDED
