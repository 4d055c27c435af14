/// \file   dds_module.cpp
/// \brief  The Python module libins._dds: publisher and subscriber over libins_dds, ROS 2 topics. SPDX-License-Identifier: MIT
#include "dds_module.hpp"
#include "ins_dds/dds.h"
#include "ins_dds/ros.h"
#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <nanobind/nanobind.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nb = nanobind;
using namespace nb::literals;

namespace
{

class Handle
{
  public:
    Handle(uint32_t domain, const std::string& topic, const OptionalText& xml, bool publishes, bool exclusive,
           const OptionalText& security, bool solution, const OptionalText& interface, const OptionalText& peers)
        : solution_(solution)
    {
        const Security files(security);
        ins_dds_config_t cfg;
        ins_dds_config_default(&cfg);
        cfg.domain = domain;
        cfg.topic = topic.c_str();
        cfg.kind = solution ? INS_DDS_SOLUTION : INS_DDS_STATE;
        choose_network(cfg, xml, interface, peers);
        cfg.publishes = publishes ? 1 : 0;
        cfg.subscribes = publishes ? 0 : 1;
        cfg.history = publishes ? cfg.history : 256;
        cfg.strength = exclusive ? 1 : 0;
        cfg.security = files.get();
        if (ins_dds_open(&cfg, &self_) != INS_DDS_OK)
        {
            throw std::runtime_error(ins_dds_error_text());
        }
    }
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

    bool solution() const { return solution_; }

  private:
    ins_dds_t* self_ = nullptr;
    bool solution_;
};

/// A ROS 2 node "libins". It joins the domain if a Handle of this process has it; then it must be closed first.
class Node
{
  public:
    Node(const std::string& name_space, const std::optional<uint32_t>& domain, const OptionalText& xml,
         const OptionalText& security, const OptionalText& interface, const OptionalText& peers)
    {
        const Security files(security);
        ins_ros_config_t cfg;
        ins_ros_config_default(&cfg);
        cfg.dds.domain = domain.value_or(INS_ROS_DOMAIN_ENV);
        cfg.name_space = name_space.c_str();
        choose_network(cfg.dds, xml, interface, peers);
        cfg.dds.security = files.get();
        int status = ins_ros_open(&cfg, &self_);
        if (status == INS_DDS_E_DOMAIN)
        {
            cfg.dds.network = INS_DDS_JOIN;
            status = ins_ros_open(&cfg, &self_);
        }
        if (status != INS_DDS_OK)
        {
            throw std::runtime_error(ins_dds_error_text());
        }
    }
    ~Node() { close(); }
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    void close()
    {
        ins_ros_close(self_);
        self_ = nullptr;
    }
    ins_ros_t* get() const
    {
        if (self_ == nullptr)
        {
            throw std::runtime_error("this ROS node is closed");
        }
        return self_;
    }

  private:
    ins_ros_t* self_ = nullptr;
};

/// raw: the octets of an ins_nav_state_t, as Run.take_states() gives them.
ins_nav_state_t state_of(const nb::bytes& raw)
{
    ins_nav_state_t state;
    if (raw.size() != sizeof state)
    {
        throw std::invalid_argument("a navigation state of another size: _run and _dds are of different builds");
    }
    std::memcpy(&state, raw.c_str(), sizeof state);
    return state;
}

void publish(Handle& handle, const nb::bytes& raw, const std::string& source, int64_t published_ns)
{
    const ins_nav_state_t state = state_of(raw);
    checked(ins_dds_publish(handle.get(), &state, source.c_str(), published_ns));
}

void publish_ros(Node& node, const nb::bytes& raw, int64_t time_ns)
{
    const ins_nav_state_t state = state_of(raw);
    ins_navigation_t navigation;
    ins_navigation_from_state(&state, time_ns, &navigation);
    checked(ins_ros_publish(node.get(), &navigation));
}

/// A solution that no board sent: without a grid.
void publish_solution(Handle& handle, uint64_t index, double t_s, const std::array<double, 4>& q_nb,
                      const std::array<double, 3>& euler, const std::array<double, 2>& lat_lon,
                      const std::array<double, 2>& v_en, double fix_age_s, const std::string& source,
                      int64_t published_ns)
{
    ins_nav_solution_t solution{};
    solution.index = index;
    solution.t_s = t_s;
    std::copy(q_nb.begin(), q_nb.end(), solution.q_nb);
    std::copy(euler.begin(), euler.end(), solution.euler_rad);
    std::copy(lat_lon.begin(), lat_lon.end(), solution.lat_lon_rad);
    std::copy(v_en.begin(), v_en.end(), solution.v_en_m_s);
    solution.fix_age_s = fix_age_s;
    solution.status = INS_NAV_BLOCK_ALIGNED | INS_NAV_BLOCK_POSITION | INS_NAV_BLOCK_FILTER;
    checked(ins_dds_publish_solution(handle.get(), &solution, source.c_str(), published_ns));
}

/// Samples as dictionaries: source, published_ns, gone, and the state as its line of JSON.
nb::list take(Handle& handle, double timeout_s)
{
    std::vector<ins_dds_sample_t> samples(64);
    int count = 0;
    {
        const nb::gil_scoped_release release;
        count = ins_dds_take(handle.get(), timeout_s, samples.data(), static_cast<int>(samples.size()));
    }
    checked(count);
    nb::list list;
    for (size_t i = 0; i < static_cast<size_t>(count); i++)
    {
        std::array<char, INS_NAV_JSON_MAX> json{};
        nb::dict d;
        d["source"] = samples[i].source;
        d["published_ns"] = samples[i].published_ns;
        d["gone"] = samples[i].gone != 0;
        if (samples[i].valid != 0)
        {
            if (handle.solution())
            {
                ins_nav_solution_json(&samples[i].solution, json.data(), json.size());
            }
            else
            {
                ins_nav_state_json(&samples[i].state, json.data(), json.size());
            }
            d["json"] = json.data();
        }
        list.append(d);
    }
    return list;
}

} // namespace

NB_MODULE(_dds, m)
{
    m.doc() = "Navigation states over DDS; see ins_dds/dds.h.";
    m.attr("TOPIC") = INS_DDS_TOPIC;
    m.attr("SOLUTION_TOPIC") = INS_DDS_SOLUTION_TOPIC;
    bind_raw(m);
    nb::class_<Handle>(m, "Handle")
        .def(nb::init<uint32_t, const std::string&, const OptionalText&, bool, bool, const OptionalText&, bool,
                      const OptionalText&, const OptionalText&>(),
             "domain"_a, "topic"_a, "xml"_a.none(), "publishes"_a, "exclusive"_a = false, "security"_a = nb::none(),
             "solution"_a = false, "interface"_a = nb::none(), "peers"_a = nb::none())
        .def("publish", publish, "state"_a, "source"_a, "published_ns"_a)
        .def("publish_solution", publish_solution, "index"_a, "t_s"_a, "q_nb"_a, "euler_rad"_a, "lat_lon_rad"_a,
             "v_en_m_s"_a, "fix_age_s"_a, "source"_a, "published_ns"_a)
        .def("take", take, "timeout_s"_a)
        .def("matched", [](const Handle& self) { return checked(ins_dds_matched(self.get())); })
        .def("close", &Handle::close);
    nb::class_<Node>(m, "Node")
        .def(nb::init<const std::string&, const std::optional<uint32_t>&, const OptionalText&, const OptionalText&,
                      const OptionalText&, const OptionalText&>(),
             "name_space"_a, "domain"_a.none(), "xml"_a.none(), "security"_a = nb::none(), "interface"_a = nb::none(),
             "peers"_a = nb::none())
        .def("publish", publish_ros, "state"_a, "time_ns"_a)
        .def("close", &Node::close);
}
