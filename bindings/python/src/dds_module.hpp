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

/// The files of a folder that `ins keys` made.
class Security
{
  public:
    explicit Security(const std::optional<std::string>& folder) : used(folder.has_value())
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
