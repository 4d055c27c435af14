/// \file   dds_module.hpp
/// \brief  Shared by the sources of the Python module libins._dds. SPDX-License-Identifier: MIT
#ifndef INS_DDS_MODULE_HPP_INCLUDED
#define INS_DDS_MODULE_HPP_INCLUDED
#include "ins_dds/dds.h"
#include <algorithm>
#include <array>
#include <nanobind/nanobind.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

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

template <size_t n> uint32_t number(const std::array<const char*, n>& names, const std::string& name)
{
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
    {
        throw std::invalid_argument("of these names it is none: " + name);
    }
    return static_cast<uint32_t>(found - names.begin());
}

#define INS_DDS_TEXT(name, value, text) text,
inline const std::array<const char*, 3> clocks = {INS_NAVIGATION_CLOCK_LIST(INS_DDS_TEXT)};

/// What a handle carries, by name.
inline const std::array<const char*, INS_DDS_KINDS> kinds = {"state",       "solution", "status",
                                                             "innovations", "raw_imu",  "state_decimated"};

/// A writer or a reader of one kind of messages, and of others on their usual topics.
class Handle
{
  public:
    Handle(uint32_t domain, const std::string& topic, const OptionalText& xml, bool publishes, bool exclusive,
           const OptionalText& security, const std::string& kind, const OptionalText& interface,
           const OptionalText& peers, const std::vector<std::string>& also, const std::vector<std::string>& qos,
           uint32_t decimate);
    ~Handle() { close(); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    void close()
    {
        ins_dds_close(self_);
        self_ = nullptr;
    }
    ins_dds_t* get() const
    {
        if (self_ == nullptr)
        {
            throw std::runtime_error("this DDS handle is closed");
        }
        return self_;
    }

  private:
    ins_dds_t* self_ = nullptr;
};

/// Status, innovations, raw IMU.
void bind_messages(nanobind::class_<Handle>& handle);
/// Messages as octets, ins_dds/raw.h.
void bind_raw(nanobind::module_& m);

#endif // INS_DDS_MODULE_HPP_INCLUDED
