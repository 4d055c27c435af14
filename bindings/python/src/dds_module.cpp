/// \file   dds_module.cpp
/// \brief  The Python module libins._dds: publisher and subscriber over libins_dds, ROS 2 topics. SPDX-License-Identifier: MIT
#include "dds_module.hpp"
#include "ins/quat.h"
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
#include <nanobind/stl/vector.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace nb = nanobind;
using namespace nb::literals;

Handle::Handle(uint32_t domain, const std::string& topic, const OptionalText& xml, bool publishes, bool exclusive,
               const OptionalText& security, const std::string& kind, const OptionalText& interface,
               const OptionalText& peers, const std::vector<std::string>& also, const std::vector<std::string>& qos,
               uint32_t decimate)
{
    const uint32_t waiting = 256; // samples, for a reader in Python
    const Security files(security);
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    cfg.domain = domain;
    cfg.topic[INS_DDS_STATE].name = nullptr;
    for (const std::string& name : also)
    {
        ins_dds_config_carry(&cfg, static_cast<ins_dds_kind_t>(number(kinds, name)));
    }
    for (const std::string& choice : qos)
    {
        checked(ins_dds_config_qos(&cfg, choice.c_str()));
    }
    cfg.topic[number(kinds, kind)].name = topic.c_str();
    if (decimate > 0)
    {
        ins_dds_config_carry(&cfg, INS_DDS_STATE_DECIMATED);
        cfg.topic[INS_DDS_STATE_DECIMATED].decimate = decimate;
    }
    for (ins_dds_topic_config_t& each : cfg.topic)
    {
        each.qos.history = publishes ? each.qos.history : std::max(each.qos.history, waiting);
    }
    choose_network(cfg, xml, interface, peers);
    cfg.publishes = publishes ? 1 : 0;
    cfg.subscribes = publishes ? 0 : 1;
    cfg.strength = exclusive ? 1 : 0;
    cfg.security = files.get();
    checked(ins_dds_open(&cfg, &self_));
}

namespace
{

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

template <size_t n> using Reals = std::optional<std::array<double, n>>;

template <size_t n> uint32_t put(const Reals<n>& from, double* to, uint32_t bits)
{
    if (!from)
    {
        return 0;
    }
    std::copy(from->begin(), from->end(), to);
    return bits;
}

/// What is given is valid. P: the upper triangle, row by row.
ins_navigation_t navigation(int64_t time_ns, const std::string& clock, const Reals<4>& q_nb, const Reals<3>& w_ib_b,
                            const Reals<3>& f_b, const Reals<3>& v_n, const Reals<3>& llh, const Reals<45>& P)
{
    ins_navigation_t to{};
    to.time_ns = time_ns;
    to.time_base = number(clocks, clock);
    to.valid = put(q_nb, to.q_nb, INS_NAVIGATION_ATTITUDE) | put(w_ib_b, to.w_ib_b, INS_NAVIGATION_RATE) |
               put(f_b, to.f_b, INS_NAVIGATION_FORCE) |
               put(v_n, to.v_n, INS_NAVIGATION_VELOCITY | INS_NAVIGATION_VELOCITY_UP) |
               put(llh, to.llh, INS_NAVIGATION_POSITION | INS_NAVIGATION_HEIGHT);
    if (P)
    {
        to.valid |= INS_NAVIGATION_COVARIANCE;
        const double* at = P->data();
        for (size_t i = 0; i < INS_NAVIGATION_P; i++)
        {
            for (size_t j = i; j < INS_NAVIGATION_P; j++)
            {
                to.P[INS_NAVIGATION_P * i + j] = to.P[INS_NAVIGATION_P * j + i] = *at++;
            }
        }
    }
    return to;
}

void publish_navigation(Handle& handle, const ins_navigation_t& from, uint64_t index, double t_s,
                        const std::string& source, int64_t published_ns)
{
    ins_nav_state_t state{};
    state.index = index;
    state.t_s = t_s;
    ins_quat_to_euler(from.q_nb, state.euler_rad);
    checked(ins_dds_publish_navigation(handle.get(), &state, &from, source.c_str(), published_ns));
}

/// What came over the network need not be UTF-8.
nb::object text(const char* octets, size_t length)
{
    return nb::steal(PyUnicode_DecodeUTF8(octets, static_cast<Py_ssize_t>(length), "replace"));
}

/// Samples as dictionaries: source, kind, published_ns, gone, and the sample as its line of JSON.
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
        std::array<char, INS_DDS_JSON_MAX> json{};
        nb::dict d;
        d["source"] = text(samples[i].source, std::strlen(samples[i].source));
        d["published_ns"] = samples[i].published_ns;
        d["kind"] = kinds.at(samples[i].kind);
        d["gone"] = samples[i].gone != 0;
        if (samples[i].valid != 0)
        {
            d["json"] = text(json.data(), ins_dds_sample_json(&samples[i], json.data(), json.size()));
        }
        list.append(d);
    }
    return list;
}

} // namespace

NB_MODULE(_dds, m)
{
    m.doc() = "Navigation states over DDS; see ins_dds/dds.h.";
    bind_raw(m);
    nb::dict topics;
#define TOPIC(name, topic, type) topics[kinds[name]] = topic;
    INS_DDS_KIND_LIST(TOPIC)
#undef TOPIC
    m.attr("TOPICS") = topics;
    nb::class_<ins_navigation_t>(m, "Navigation", "An instant; what is None is not known. See ins_nav/navigation.h.")
        .def(nb::new_(&navigation), "time_ns"_a, "clock"_a = "host", "q_nb"_a = nb::none(), "w_ib_b"_a = nb::none(),
             "f_b"_a = nb::none(), "v_n"_a = nb::none(), "llh"_a = nb::none(), "P"_a = nb::none());
    nb::class_<Handle> handle(m, "Handle");
    bind_messages(handle);
    handle
        .def(nb::init<uint32_t, const std::string&, const OptionalText&, bool, bool, const OptionalText&,
                      const std::string&, const OptionalText&, const OptionalText&, const std::vector<std::string>&,
                      const std::vector<std::string>&, uint32_t>(),
             "domain"_a, "topic"_a, "xml"_a.none(), "publishes"_a, "exclusive"_a = false, "security"_a = nb::none(),
             "kind"_a = "state", "interface"_a = nb::none(), "peers"_a = nb::none(),
             "also"_a = std::vector<std::string>(), "qos"_a = std::vector<std::string>(), "decimate"_a = 0)
        .def("publish", publish, "state"_a, "source"_a, "published_ns"_a)
        .def("publish_navigation", publish_navigation, "navigation"_a, "index"_a, "t_s"_a, "source"_a, "published_ns"_a)
        .def("take", take, "timeout_s"_a)
        .def("matched", [](const Handle& self) { return checked(ins_dds_matched(self.get())); })
        .def("close", &Handle::close);
    nb::class_<Node>(m, "Node")
        .def(nb::init<const std::string&, const std::optional<uint32_t>&, const OptionalText&, const OptionalText&,
                      const OptionalText&, const OptionalText&>(),
             "name_space"_a, "domain"_a.none(), "xml"_a.none(), "security"_a = nb::none(), "interface"_a = nb::none(),
             "peers"_a = nb::none())
        .def("publish", publish_ros, "state"_a, "time_ns"_a)
        .def("publish_navigation",
             [](const Node& self, const ins_navigation_t& from) { checked(ins_ros_publish(self.get(), &from)); })
        .def("close", &Node::close);
}
