/// \file   dds_raw.cpp
/// \brief  Of libins._dds: messages as octets, for `ins record` and `ins play`. SPDX-License-Identifier: MIT
#include "dds_module.hpp"
#include "ins_dds/raw.h"
#include <array>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <stdexcept>
#include <string>
#include <vector>

namespace nb = nanobind;
using namespace nb::literals;

namespace
{
using Topic = ins_dds_raw_topic_t;
using Text = char[INS_DDS_RAW_NAME + 1];

class Raw
{
  public:
    Raw(uint32_t domain, const OptionalText& xml, const OptionalText& security, const OptionalText& interface,
        const OptionalText& peers)
    {
        const Security files(security);
        ins_dds_config_t cfg;
        ins_dds_config_default(&cfg);
        cfg.domain = domain;
        choose_network(cfg, xml, interface, peers);
        cfg.security = files.get();
        checked(ins_dds_raw_open(&cfg, &self_));
    }
    ~Raw() { close(); }
    Raw(const Raw&) = delete;
    Raw& operator=(const Raw&) = delete;

    void close()
    {
        ins_dds_raw_close(self_);
        self_ = nullptr;
    }
    ins_dds_raw_t* get() const
    {
        if (self_ == nullptr)
        {
            throw std::runtime_error("this DDS handle is closed");
        }
        return self_;
    }

  private:
    ins_dds_raw_t* self_ = nullptr;
};

void copy(const std::string& text, Text& to)
{
    if (text.size() > INS_DDS_RAW_NAME)
    {
        throw std::invalid_argument("a name of DDS has at most " + std::to_string(INS_DDS_RAW_NAME) +
                                    " octets: " + text);
    }
    text.copy(to, text.size());
    to[text.size()] = '\0';
}

Topic topic(const std::string& name, const std::string& type, const std::string& partition, const std::string& user,
            bool latched, bool exclusive, int32_t strength, double deadline_s, bool best_effort)
{
    Topic t{};
    copy(name, t.name);
    copy(type, t.type);
    copy(partition, t.partition);
    copy(user, t.user);
    t.latched = latched ? 1 : 0;
    t.exclusive = exclusive ? 1 : 0;
    t.strength = strength;
    t.deadline_s = deadline_s;
    t.best_effort = best_effort ? 1 : 0;
    return t;
}

std::vector<Topic> found(Raw& raw)
{
    std::vector<Topic> all;
    for (Topic t; checked(ins_dds_raw_found(raw.get(), &t, 1)) == 1;)
    {
        all.push_back(t);
    }
    return all;
}

/// Tuples: topic, instant of publication, octets.
nb::list take(Raw& raw, double timeout_s)
{
    std::array<ins_dds_raw_message_t, 64> messages{};
    int count = 0;
    {
        const nb::gil_scoped_release release;
        count = ins_dds_raw_take(raw.get(), timeout_s, messages.data(), static_cast<int>(messages.size()));
    }
    checked(count);
    nb::list list;
    for (size_t i = 0; i < static_cast<size_t>(count); i++)
    {
        const ins_dds_raw_message_t& m = messages.at(i);
        list.append(nb::make_tuple(m.topic, m.published_ns, nb::bytes(m.octets, m.size)));
    }
    return list;
}

void put(Raw& raw, int topic, const nb::bytes& octets)
{
    int status = 0;
    {
        const nb::gil_scoped_release release;
        status = ins_dds_raw_write(raw.get(), topic, static_cast<const uint8_t*>(octets.data()), octets.size());
    }
    checked(status);
}

std::vector<std::string> types()
{
    std::vector<std::string> names;
    for (int i = 0; ins_dds_raw_type(i) != nullptr; i++)
    {
        names.emplace_back(ins_dds_raw_type(i));
    }
    return names;
}
} // namespace

void bind_raw(nb::module_& m)
{
    nb::class_<Topic>(m, "RawTopic")
        .def_prop_ro("name", [](const Topic& t) { return std::string(t.name); })
        .def_prop_ro("type", [](const Topic& t) { return std::string(t.type); })
        .def_prop_ro("partition", [](const Topic& t) { return std::string(t.partition); })
        .def_prop_ro("user", [](const Topic& t) { return std::string(t.user); })
        .def_prop_ro("best_effort", [](const Topic& t) { return t.best_effort != 0; })
        .def_prop_ro("latched", [](const Topic& t) { return t.latched != 0; })
        .def_prop_ro("exclusive", [](const Topic& t) { return t.exclusive != 0; })
        .def_ro("strength", &Topic::strength)
        .def_ro("deadline_s", &Topic::deadline_s);
    m.def("raw_topic", topic, "name"_a, "type"_a, "partition"_a = "", "user"_a = "", "latched"_a = false,
          "exclusive"_a = false, "strength"_a = 0, "deadline_s"_a = 0.0, "best_effort"_a = false);
    m.def("raw_types", types);
    nb::class_<Raw>(m, "Raw")
        .def(nb::init<uint32_t, const OptionalText&, const OptionalText&, const OptionalText&, const OptionalText&>(),
             "domain"_a, "xml"_a.none(), "security"_a = nb::none(), "interface"_a = nb::none(), "peers"_a = nb::none())
        .def("found", found)
        .def("subscribe", [](Raw& self, const Topic& t) { return checked(ins_dds_raw_subscribe(self.get(), &t)); })
        .def("publish", [](Raw& self, const Topic& t) { return checked(ins_dds_raw_publish(self.get(), &t)); })
        .def("take", take, "timeout_s"_a)
        .def("write", put, "topic"_a, "octets"_a)
        .def(
            "delivered",
            [](Raw& self, double timeout_s)
            {
                int status = 0;
                {
                    const nb::gil_scoped_release release;
                    status = ins_dds_raw_delivered(self.get(), timeout_s);
                }
                checked(status);
            },
            "timeout_s"_a)
        .def("matched", [](Raw& self, int index) { return checked(ins_dds_raw_matched(self.get(), index)); })
        .def("close", &Raw::close);
}
