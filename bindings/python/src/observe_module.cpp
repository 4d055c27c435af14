/// \file   observe_module.cpp
/// \brief  See observe_module.hpp. Tables go out as NumPy arrays. SPDX-License-Identifier: MIT
#include "observe_module.hpp"
#include "observe.hpp"
#include "run.hpp"
#include <initializer_list>
#include <nanobind/ndarray.h>
#include <nanobind/stl/vector.h>
#include <utility>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

constexpr size_t code_size = 0x10000;

/// Of any shape, owned by the array.
template <typename T> nb::ndarray<nb::numpy, T> array(std::vector<T>&& values, std::initializer_list<size_t> shape)
{
    auto* const kept = new std::vector<T>(std::move(values));
    const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return {kept->data(), shape, owner};
}

nb::ndarray<nb::numpy, uint64_t> by_address(std::vector<uint64_t> values)
{
    const size_t count = values.size();
    return array(std::move(values), {count});
}

/// (instant [ps], index into watch or -1, value): what the program and the peripherals changed.
nb::ndarray<nb::numpy, int64_t> take_changes(Observer& self)
{
    std::vector<int64_t> rows;
    for (const Change& c : std::exchange(self.changes, {}))
    {
        const bool interrupt = c.what == Observer::interrupt_signal;
        rows.insert(rows.end(), {c.at, interrupt ? -1 : static_cast<int64_t>(c.what), c.value});
    }
    const size_t count = rows.size() / 3;
    return array(std::move(rows), {count, 3});
}

/// (instant [ps], 8 * port + bit, level) of each edge of each pin.
nb::ndarray<nb::numpy, int64_t> take_pin_edges(Run& run)
{
    std::vector<int64_t> rows;
    for (const Edge& edge : run.take_pin_edges())
    {
        rows.insert(rows.end(), {edge.at, edge.wire, edge.level ? 1 : 0});
    }
    const size_t count = rows.size() / 3;
    return array(std::move(rows), {count, 3});
}

/// (cycles, addresses, registers before: A, B, PSW, SP, DPL, DPH, R0 to R7) of each instruction.
nb::tuple take_trace(Observer& self)
{
    std::vector<uint64_t> cycles;
    std::vector<uint16_t> addresses;
    std::vector<uint8_t> registers;
    for (const Executed& e : std::exchange(self.trace, {}))
    {
        cycles.push_back(e.cycle);
        addresses.push_back(e.pc);
        registers.insert(registers.end(), e.registers.begin(), e.registers.end());
    }
    const size_t count = cycles.size();
    return nb::make_tuple(array(std::move(cycles), {count}), array(std::move(addresses), {count}),
                          array(std::move(registers), {count, Executed{}.registers.size()}));
}

nb::dict calls(const Observer& self)
{
    nb::dict d;
    for (const auto& [entry, called] : self.calls())
    {
        d[nb::int_(entry)] = nb::make_tuple(called.calls, called.cycles);
    }
    return d;
}

nb::dict interrupts(const Observer& self)
{
    nb::dict d;
    for (const auto& [irq, i] : self.interrupts())
    {
        nb::dict one;
        one["count"] = i.count;
        one["cycles"] = i.cycles;
        one["worst"] = i.worst;
        one["worst_alone"] = i.worst_alone;
        d[nb::int_(irq)] = one;
    }
    return d;
}

nb::dict sfrs(const Observer& self)
{
    nb::dict d;
    for (size_t address = 0x80; address < self.sfrs().size(); address++)
    {
        const Observer::Touched& touched = self.sfrs()[address];
        if (touched.reads + touched.writes != 0)
        {
            d[nb::int_(address)] = nb::make_tuple(touched.reads, touched.writes);
        }
    }
    return d;
}

/// (instant [ps], channel, code, volts) of each sample.
nb::list take_samples(Run& run)
{
    nb::list list;
    for (const Sample& sample : run.take_samples())
    {
        list.append(nb::make_tuple(sample.at, sample.channel, sample.code, sample.volts));
    }
    return list;
}

/// By address: bit 0: executed; bit 1, 2: a conditional branch was not taken, was taken.
nb::ndarray<nb::numpy, uint8_t> coverage(const Run& run)
{
    std::vector<uint8_t> marks(code_size);
    for (size_t pc = 0; pc < code_size; pc++)
    {
        const auto address = static_cast<uint16_t>(pc);
        marks[pc] = static_cast<uint8_t>((mcs51_covered(run.cpu(), address) ? 1u : 0u) |
                                         mcs51_branches(run.cpu(), address) << 1);
    }
    return array(std::move(marks), {code_size});
}

} // namespace

void bind_observer(nb::module_& m)
{
    m.def(
        "cover", [](Run& run) { mcs51_cover(run.cpu(), true); }, "run"_a, "Note what is executed, from here.");
    m.def("coverage", coverage, "run"_a);
    m.def("take_samples", take_samples, "run"_a);
    m.def("take_pin_edges", take_pin_edges, "run"_a);
    m.def(
        "volts", [](Run& run, unsigned channel, emu_time_t t) { return run.volts(channel, t); }, "run"_a, "channel"_a,
        "t_ps"_a);
    nb::class_<Observer>(m, "Observer", "See observe.hpp.")
        .def(
            "__init__",
            [](Observer* self, Run& run, std::vector<uint16_t> entries, std::vector<uint8_t> watch, bool trace) {
                new (self) Observer(run.board(), run.observers(), {std::move(entries), std::move(watch), trace});
            },
            "run"_a, "entries"_a, "watch"_a, "trace"_a, nb::keep_alive<1, 2>())
        .def("settle", &Observer::settle)
        .def("cycles", [](const Observer& self) { return by_address(self.cycles()); })
        .def("executions", [](const Observer& self) { return by_address(self.executions()); })
        .def_prop_ro("asleep", &Observer::asleep)
        .def("calls", calls)
        .def("interrupts", interrupts)
        .def("sfrs", sfrs)
        .def_prop_ro("stack_base", &Observer::stack_base)
        .def_prop_ro("stack_top", &Observer::stack_top)
        .def_prop_ro("stack_top_pc", &Observer::stack_top_pc)
        .def("take_changes", take_changes)
        .def("take_trace", take_trace);
}

} // namespace libins
