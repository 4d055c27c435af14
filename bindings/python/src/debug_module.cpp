/// \file   debug_module.cpp
/// \brief  See debug_module.hpp. SPDX-License-Identifier: MIT
#include "debug_module.hpp"
#include "board_module.hpp"
#include <cstring>
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

constexpr std::array<const char*, 8> goals = {"none", "instructions", "cycle",  "line",
                                              "over", "out",          "before", "record"};
constexpr std::array<const char*, 4> watches = {"read", "write", "access", "change"};
constexpr std::array<const char*, 4> memories = {"iram", "sfr", "xdata", "code"}; // by mcs51_space_t

template <size_t n> unsigned index_of(const std::array<const char*, n>& names, const std::string& name)
{
    for (unsigned i = 0; i < n; i++)
    {
        if (name == names[i])
        {
            return i;
        }
    }
    throw std::invalid_argument(name + ": no such word here");
}

void watch(Watcher& self, unsigned id, const std::string& kind, const std::string& space, unsigned address,
           unsigned length)
{
    self.watch(id, static_cast<Watcher::Watch>(index_of(watches, kind)),
               static_cast<mcs51_space_t>(index_of(memories, space)), address, length);
}

nb::list take_hits(Watcher& self)
{
    nb::list list;
    for (const Watcher::Hit& hit : self.take_hits())
    {
        list.append(nb::make_tuple(hit.id, hit.write, hit.address, hit.value, hit.cycle));
    }
    return list;
}

void set_lines(Watcher& self, const nb::bytes& octets)
{
    std::vector<uint32_t> lines(Watcher::addresses);
    if (octets.size() != lines.size() * sizeof lines[0])
    {
        throw std::invalid_argument("set_lines: 65536 numbers of 32 bits are needed");
    }
    std::memcpy(lines.data(), octets.c_str(), octets.size());
    self.set_lines(std::move(lines));
}

nb::list places(const Watcher& self)
{
    nb::list list;
    for (const Watcher::Place& place : self.places())
    {
        list.append(nb::make_tuple(place.cycle, place.pc, place.frame));
    }
    return list;
}

nb::list frames(const Watcher& self)
{
    nb::list list;
    for (const Watcher::Frame& frame : self.frames())
    {
        list.append(nb::make_tuple(frame.parent, frame.interrupt, frame.left));
    }
    return list;
}

} // namespace

void bind_debug(nb::module_& m, nb::class_<Run>& run)
{
    nb::class_<Watcher>(m, "Watcher", "See debug.hpp.")
        .def("watch", watch, "id"_a, "kind"_a, "space"_a, "address"_a, "length"_a)
        .def("edge", &Watcher::edge, "id"_a, "wire"_a, "rising"_a, "falling"_a)
        .def("clear", &Watcher::clear)
        .def("arm", &Watcher::arm, "on"_a)
        .def("take_hits", take_hits)
        .def("set_lines", set_lines, "lines"_a)
        .def(
            "begin",
            [](Watcher& self, const std::string& goal, uint64_t n)
            { self.begin(static_cast<Watcher::Goal>(index_of(goals, goal)), n); },
            "goal"_a, "n"_a)
        .def("end", &Watcher::end)
        .def("settle", &Watcher::settle)
        .def_prop_ro("reached", &Watcher::reached)
        .def_prop_ro("last_before", &Watcher::last_before, "Cycle; 2^64 - 1: none.")
        .def("places", places)
        .def("frames", frames);
    run.def_prop_ro("watcher", &Run::watcher, nb::rv_policy::reference_internal)
        .def_prop_ro("cycle", [](const Run& self) { return mcs51_cycle(self.cpu()); })
        .def(
            "set_pc", [](Run& self, uint16_t pc) { mcs51_set_pc(self.cpu(), pc); }, "pc"_a)
        .def(
            "level",
            [](const Run& self, const std::string& wire) -> std::optional<bool>
            {
                const emu_wire_t* const found = acq_board_wire(self.board(), wire.c_str());
                return found != nullptr ? std::optional<bool>(found->level) : std::nullopt;
            },
            "wire"_a, "By name; None where there is no such wire.");
}

} // namespace libins
