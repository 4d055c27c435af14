/// \file   net_module.cpp
/// \brief  Nets for Python; see net.hpp. SPDX-License-Identifier: MIT
#include "net_module.hpp"
#include "board_module.hpp"
#include "emu_f2812/registers.h"
#include "gimu_module.hpp"
#include "net.hpp"
#include "net_listeners.hpp"
#include "states.hpp"
#include <cmath>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>
#include <optional>
#include <stdexcept>
#include <variant>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

using Register = std::variant<int, std::string>; ///< word address or name
template <typename T> using Rows = nb::ndarray<nb::numpy, T, nb::ndim<2>>;

constexpr std::array<const char*, 4> access_names = {"", "read", "write", "any"}; ///< by F2812_ACCESS_...

uint16_t address_of(const Register& reg)
{
    if (const auto* const name = std::get_if<std::string>(&reg))
    {
        const int address = f2812_register_address(name->c_str());
        if (address < 0)
        {
            throw std::invalid_argument(*name + ": no register of the F2812 that is modelled");
        }
        return static_cast<uint16_t>(address);
    }
    const int address = std::get<int>(reg);
    if (address < 0 || address > UINT16_MAX)
    {
        throw std::invalid_argument(std::to_string(address) + ": no address of a register, 0 .. 65535");
    }
    return static_cast<uint16_t>(address);
}

template <typename T> Rows<T> rows(size_t columns, std::vector<T>&& values)
{
    auto* kept = new std::vector<T>(std::move(values));
    const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return {kept->data(), {kept->size() / columns, columns}, owner};
}

emu_time_t picoseconds(double seconds)
{
    return static_cast<emu_time_t>(std::floor(seconds * 1e12 + 0.5));
}

size_t line(Net& net, const std::string& a, const std::string& b, double baud, double delay_s, double bit_error,
            double octet_loss, const std::vector<std::array<double, 2>>& cuts_s)
{
    LineConfig config;
    config.baud = baud;
    constexpr double delay_most_s = 1.0;
    if (!(delay_s >= 0.0 && delay_s <= delay_most_s))
    {
        throw std::invalid_argument("delay_s: 0 (one bit) to 1 s is needed");
    }
    config.delay = picoseconds(delay_s);
    config.bit_error = bit_error;
    config.octet_loss = octet_loss;
    for (const auto& [from, to] : cuts_s)
    {
        config.cuts.push_back({picoseconds(from), picoseconds(to)});
    }
    return net.line(a, b, config);
}

nb::bytes take_octets(Net& net, const std::string& host)
{
    std::string octets;
    for (const Octet& octet : net.get<HostStation>(host).take_octets())
    {
        octets.push_back(static_cast<char>(octet.value));
    }
    return nb::bytes(octets.data(), octets.size());
}

nb::list take_received(Net& net, const std::string& host)
{
    nb::list list;
    for (const Octet& octet : net.get<HostStation>(host).take_octets())
    {
        list.append(nb::make_tuple(octet.at, octet.value, octet.framing_ok));
    }
    return list;
}

nb::dict host_counters(Net& net, const std::string& host)
{
    const emu_serial_end_t& end = net.get<HostStation>(host).end();
    nb::dict d;
    d["octets_sent"] = end.octets_sent;
    d["octets_received"] = end.octets_received;
    d["framing_errors"] = end.framing_errors;
    d["false_starts"] = end.false_starts;
    d["overflow"] = end.overflow;
    Listener* const listener = net.get<HostStation>(host).listener();
    if (const auto* const codes = dynamic_cast<const CodesListener*>(listener))
    {
        put_counts(d, codes->navigator.link.counts);
        d["corrupt_accepted"] = codes->navigator.corrupt_accepted;
    }
    if (const auto* const blocks = dynamic_cast<const BlocksListener*>(listener))
    {
        put_counts(d, blocks->counts());
    }
    return d;
}

template <typename T> T& listener_of(Net& net, const std::string& host, const char* what)
{
    T* const listener = dynamic_cast<T*>(net.get<HostStation>(host).listener());
    if (listener == nullptr)
    {
        throw std::invalid_argument(host + ": it has no " + what + "; see host_codes() and host_nav()");
    }
    return *listener;
}

nb::tuple take_states(Net& net, const std::string& host)
{
    return states_table(listener_of<CodesListener>(net, host, "states").navigator.take_states());
}

constexpr size_t solution_columns = 25;

/// A row each (SOLUTION_COLUMNS), and each as the octets of an ins_nav_solution_t.
nb::tuple take_solutions(Net& net, const std::string& host)
{
    std::vector<double> values;
    nb::list raw;
    for (const auto& [at, s] : listener_of<BlocksListener>(net, host, "solutions").take_solutions())
    {
        values.insert(values.end(), {static_cast<double>(at) * 1e-12, static_cast<double>(s.index), s.t_s});
        values.insert(values.end(), std::begin(s.q_nb), std::end(s.q_nb));
        values.insert(values.end(), std::begin(s.euler_rad), std::end(s.euler_rad));
        values.insert(values.end(), std::begin(s.en_m), std::end(s.en_m));
        values.insert(values.end(), std::begin(s.lat_lon_rad), std::end(s.lat_lon_rad));
        values.insert(values.end(), std::begin(s.v_en_m_s), std::end(s.v_en_m_s));
        values.push_back(s.fix_age_s);
        for (const uint64_t v : {uint64_t{s.sats}, uint64_t{s.zone}, uint64_t{s.seq}, uint64_t{s.lost},
                                 uint64_t{s.status}, s.counts.accepted, s.counts.lost, s.counts.corrupt})
        {
            values.push_back(static_cast<double>(v));
        }
        raw.append(nb::bytes(&s, sizeof s));
    }
    return nb::make_tuple(rows<double>(solution_columns, std::move(values)), raw);
}

Rows<int64_t> take_edges(Net& net)
{
    std::vector<int64_t> values;
    for (const TracedEdge& edge : net.take_edges())
    {
        values.insert(values.end(), {edge.at, edge.wire, edge.level});
    }
    return rows(3, std::move(values));
}

Rows<int64_t> take_records(Net& net, const std::string& station)
{
    std::vector<int64_t> values;
    for (const f2812_link_record_t& record : net.get<F2812Station>(station).take_records())
    {
        values.insert(values.end(), {record.at, record.what, record.address, record.value});
    }
    return rows(4, std::move(values));
}

void set_break(Net& net, const std::string& station, const Register& reg, const std::string& access,
               std::optional<uint16_t> value, uint16_t mask)
{
    f2812_link_access_t wanted{address_of(reg), value.value_or(0), value ? mask : uint16_t{0}, 0};
    for (size_t i = 1; i < access_names.size(); i++)
    {
        wanted.access = access == access_names[i] ? static_cast<uint8_t>(i) : wanted.access;
    }
    if (wanted.access == 0)
    {
        throw std::invalid_argument("access: found '" + access + "', but read, write or any is needed");
    }
    net.get<F2812Station>(station).set_break(wanted);
}

nb::object stopped(Net& net)
{
    const Station* const station = net.stopped();
    if (station == nullptr)
    {
        return nb::none();
    }
    nb::dict d;
    d["station"] = station->name();
    d["t_ps"] = station->now();
    if (const auto* const board = dynamic_cast<const F2812Station*>(station))
    {
        const f2812_link_access_t& access = board->broken_at();
        const char* const name = f2812_register_name(access.address);
        d["address"] = access.address;
        d["register"] = name != nullptr ? nb::cast(name) : nb::none();
        d["access"] = access_names.at(access.access);
        d["value"] = access.value;
    }
    return d;
}

nb::dict statistics(Net& net, const std::string& station)
{
    nb::dict d;
    for (const auto& [name, value] : net.get<F2812Station>(station).statistics())
    {
        d[name.c_str()] = value;
    }
    return d;
}

nb::list reports(Net& net, const std::string& name)
{
    auto* const acq = dynamic_cast<AcqStation*>(&net.station(name));
    return reports_list(acq != nullptr ? acq->run().reports : net.get<F2812Station>(name).reports());
}

nb::list fault_hits(Net& net, const std::string& station)
{
    nb::list list;
    for (const auto& [kind, count] : net.fault_hits(station))
    {
        list.append(nb::make_tuple(kind, count));
    }
    return list;
}

void bind_stations(nb::class_<Net>& net)
{
    net.def(
           "f2812",
           [](Net& self, const std::string& name, const std::string& program, uint64_t oscclk_hz,
              const F2812Station::Switches& switches)
           {
               const nb::gil_scoped_release others;
               self.add(std::make_unique<F2812Station>(name, program, oscclk_hz, switches));
           },
           "name"_a, "program"_a, "oscclk_hz"_a = 30000000, "switches"_a = F2812Station::Switches())
        .def(
            "acq",
            [](Net& self, const std::string& name, const RunConfig& config, const Motion& motion,
               const ins_gyro_config_t& gyro) -> Run&
            { return self.add(std::make_unique<AcqStation>(name, config, motion.handle, gyro)).run(); },
            "name"_a, "config"_a, "motion"_a, "gyro"_a, nb::rv_policy::reference_internal)
        .def(
            "host",
            [](Net& self, const std::string& name, double baud)
            { self.add(std::make_unique<HostStation>(name, baud, nullptr)); },
            "name"_a, "baud"_a, "Octets for somebody outside.")
        .def(
            "host_codes",
            [](Net& self, const std::string& name, double baud, const std::string& board, const ins_nav_config_t& nav,
               bool start_at_truth)
            {
                auto listener = std::make_unique<CodesListener>(nav, start_at_truth, self.get<AcqStation>(board));
                self.add(std::make_unique<HostStation>(name, baud, std::move(listener)));
            },
            "name"_a, "baud"_a, "board"_a, "nav"_a, "start_at_truth"_a = true,
            "The host and navigator of an acquisition board, as in Run.")
        .def(
            "host_nav",
            [](Net& self, const std::string& name, double baud)
            { self.add(std::make_unique<HostStation>(name, baud, std::make_unique<BlocksListener>())); },
            "name"_a, "baud"_a, "The host of a navigating board (ins_nav/nav_input.h).")
        .def("line", line, "a"_a, "b"_a, "baud"_a, "delay_s"_a = 0.0, "bit_error"_a = 0.0, "octet_loss"_a = 0.0,
             "cuts_s"_a = std::vector<std::array<double, 2>>())
        .def(
            "line_counters",
            [](const Net& self, size_t number)
            {
                const auto counts = self.line_counts(number);
                nb::dict d;
                d["slots_inverted"] = counts[0];
                d["octets_swallowed"] = counts[1];
                return d;
            },
            "line"_a);
}

void bind_boards(nb::class_<Net>& net)
{
    net.def(
           "peek",
           [](Net& self, const std::string& station, const Register& reg, unsigned count)
           { return self.get<F2812Station>(station).peek(address_of(reg), count); },
           "station"_a, "register"_a, "count"_a = 1)
        .def("set_break", set_break, "station"_a, "register"_a, "access"_a = "any", "value"_a.none() = nb::none(),
             "mask"_a = 0xFFFF)
        .def(
            "clear_break",
            [](Net& self, const std::string& station, const Register& reg) {
                self.get<F2812Station>(station).set_break({address_of(reg), 0, 0, 0});
            },
            "station"_a, "register"_a)
        .def(
            "record",
            [](Net& self, const std::string& station, bool accesses, bool interrupts)
            { self.get<F2812Station>(station).record(accesses, interrupts); },
            "station"_a, "accesses"_a, "interrupts"_a)
        .def("take_records", take_records, "station"_a)
        .def("statistics", statistics, "station"_a)
        .def("reports", reports, "station"_a)
        .def(
            "ended", [](Net& self, const std::string& station) { return self.get<F2812Station>(station).end(); },
            "station"_a, "How the firmware ended; empty: it has not.")
        .def(
            "firmware",
            [](Net& self, const std::string& station)
            {
                const Process& process = self.get<F2812Station>(station).process();
                return nb::make_tuple(process.name(), process.bits(), process.pid());
            },
            "station"_a, "Name, bits of a pointer, process.")
        .def("set_patience", &Net::set_patience, "wall_s"_a);
}

} // namespace

void bind_net(nb::module_& module)
{
    nb::exception<ProgramError>(module, "ProgramError", PyExc_RuntimeError);
    module.attr("SOLUTION_COLUMNS") =
        nb::make_tuple("at_s", "index", "t_s", "q_w", "q_x", "q_y", "q_z", "roll_rad", "pitch_rad", "heading_rad",
                       "easting_m", "northing_m", "lat_rad", "lon_rad", "v_e_m_s", "v_n_m_s", "fix_age_s", "sats",
                       "zone", "seq", "lost", "status", "accepted_total", "lost_total", "corrupt_total");
    module.attr("RECORD_COLUMNS") = nb::make_tuple("t_ps", "what", "address", "value");
    module.attr("RECORD_WHAT") = nb::make_tuple("read", "write", "interrupt", "return");
    module.def(
        "f2812_register",
        [](const Register& reg)
        {
            const uint16_t address = address_of(reg);
            const char* const name = f2812_register_name(address);
            return nb::make_tuple(address, name != nullptr ? nb::cast(name) : nb::none());
        },
        "register"_a, "Address and name of a register, from either.");
    nb::class_<Net> net(module, "Net", "See net.hpp.");
    net.def(nb::init<uint64_t>(), "seed"_a);
    bind_truth(module);
    bind_stations(net);
    bind_gimu(net);
    bind_boards(net);
    net.def("until", &Net::until, "t_ps"_a, nb::call_guard<nb::gil_scoped_release>())
        .def("until_octet", &Net::until_octet, "host"_a, "t_ps"_a, nb::call_guard<nb::gil_scoped_release>())
        .def("stopped", stopped)
        .def_prop_ro("now_ps", &Net::now)
        .def(
            "station_ps", [](Net& self, const std::string& station) { return self.station(station).now(); },
            "station"_a)
        .def(
            "send",
            [](Net& self, const std::string& host, const nb::bytes& octets)
            { return self.get<HostStation>(host).send(std::string(octets.c_str(), octets.size())); },
            "host"_a, "octets"_a)
        .def("take_octets", take_octets, "host"_a)
        .def("take_received", take_received, "host"_a)
        .def("host_counters", host_counters, "host"_a)
        .def("take_states", take_states, "host"_a)
        .def("take_solutions", take_solutions, "host"_a)
        .def("trace", &Net::trace, "station"_a, "wire"_a)
        .def("take_edges", take_edges)
        .def("add_fault", &Net::add_fault, "station"_a, "fault"_a)
        .def("fault_hits", fault_hits, "station"_a = "",
             "In the order in which they were added; of one station, or of all.")
        .def_ro("rounds", &Net::rounds)
        .def_ro("windows", &Net::windows);
}

} // namespace libins
