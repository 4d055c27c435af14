/// \file   board_module.cpp
/// \brief  See board_module.hpp. SPDX-License-Identifier: MIT
#include "board_module.hpp"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <optional>
#include <stdexcept>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

constexpr std::array<const char*, 2> parts = {"at89s51", "at89s52"};

struct Space
{
    const char* name;
    uint8_t (*get)(mcs51_t* cpu, uint16_t address);
    void (*set)(mcs51_t* cpu, uint16_t address, uint8_t value);
};

constexpr std::array<Space, 4> spaces = {{
    {"iram", [](mcs51_t* cpu, uint16_t a) { return mcs51_iram(cpu, static_cast<uint8_t>(a)); },
     [](mcs51_t* cpu, uint16_t a, uint8_t value) { mcs51_set_iram(cpu, static_cast<uint8_t>(a), value); }},
    {"sfr", [](mcs51_t* cpu, uint16_t a) { return mcs51_sfr(cpu, static_cast<uint8_t>(a)); },
     [](mcs51_t* cpu, uint16_t a, uint8_t value) { mcs51_set_sfr(cpu, static_cast<uint8_t>(a), value); }},
    {"xdata", [](mcs51_t* cpu, uint16_t a) { return mcs51_xdata(cpu, a); }, mcs51_set_xdata},
    {"code", [](mcs51_t* cpu, uint16_t a) { return mcs51_code(cpu, a); }, mcs51_set_code},
}};

const Space& space_of(const std::string& name)
{
    for (const Space& space : spaces)
    {
        if (space.name == name)
        {
            return space;
        }
    }
    throw std::invalid_argument(name + ": no address space; iram, sfr, xdata and code are");
}

nb::bytes read(Run& run, const std::string& name, unsigned address, unsigned count)
{
    const Space& space = space_of(name);
    std::string octets;
    for (unsigned i = 0; i < count; i++)
    {
        octets.push_back(static_cast<char>(space.get(run.cpu(), static_cast<uint16_t>(address + i))));
    }
    return nb::bytes(octets.data(), octets.size());
}

void write(Run& run, const std::string& name, unsigned address, const nb::bytes& octets)
{
    const Space& space = space_of(name);
    for (size_t i = 0; i < octets.size(); i++)
    {
        space.set(run.cpu(), static_cast<uint16_t>(address + i), static_cast<uint8_t>(octets.c_str()[i]));
    }
}

void drive_pin(Run& run, unsigned port, unsigned bit, std::optional<bool> level)
{
    acq_board_drive_pin(run.board(), port, bit, !level ? EMU_Z : *level ? EMU_STRONG1 : EMU_STRONG0);
}

nb::bytes take_output(Run& run)
{
    const std::string octets = run.program() ? run.program()->take_output() : std::string();
    return nb::bytes(octets.data(), octets.size());
}

nb::list octets_list(const std::vector<Octet>& octets)
{
    nb::list list;
    for (const Octet& octet : octets)
    {
        list.append(nb::make_tuple(octet.at, octet.value, octet.framing_ok));
    }
    return list;
}

} // namespace

const char* part_name(mcs51_part_t part)
{
    return parts[part];
}

mcs51_part_t part_of(const std::string& name)
{
    for (size_t i = 0; i < parts.size(); i++)
    {
        if (name == parts[i])
        {
            return static_cast<mcs51_part_t>(i);
        }
    }
    throw std::invalid_argument(name + ": no part that is known");
}

void bind_board(nb::class_<Run>& run)
{
    run.def("until_octet", &Run::until_octet, "t_ps"_a, nb::call_guard<nb::gil_scoped_release>())
        .def("take_received", [](Run& self) { return octets_list(self.take_octets()); })
        .def("take_sent", [](Run& self) { return octets_list(self.take_sent()); })
        .def("save",
             [](Run& self)
             {
                 const std::string octets = self.save();
                 return nb::bytes(octets.data(), octets.size());
             })
        .def(
            "restore",
            [](Run& self, const nb::bytes& octets) { self.restore(std::string(octets.c_str(), octets.size())); },
            "octets"_a)
        .def("set_volts", &Run::set_volts, "channel"_a, "volts"_a)
        .def("clear_volts", &Run::clear_volts, "channel"_a)
        .def("read", read, "space"_a, "address"_a, "count"_a)
        .def("write", write, "space"_a, "address"_a, "octets"_a)
        .def("pin", [](const Run& self, unsigned port, unsigned bit) { return acq_board_pin(self.board(), port, bit); })
        .def("drive_pin", drive_pin, "port"_a, "bit"_a, "level"_a.none())
        .def("watch_program", &Run::watch_program, "console"_a, "end"_a.none())
        .def("take_output", take_output)
        .def_prop_ro("ended", [](Run& self) { return self.program() && self.program()->ended(); })
        .def_prop_ro("halted", &Run::halted)
        .def_prop_ro("pc", [](const Run& self) { return mcs51_pc(self.cpu()); })
        .def(
            "set_break", [](Run& self, uint16_t pc, bool on) { mcs51_set_break(self.cpu(), pc, on); }, "pc"_a, "on"_a)
        .def(
            "reset", [](Run& self, bool power_on) { mcs51_reset(self.cpu(), power_on); }, "power_on"_a)
        .def(
            "set_motion", [](Run& self, const Motion& motion, bool keep) { self.set_motion(motion.handle, keep); },
            "motion"_a, "keep"_a = false);
}

} // namespace libins
