/// \file   faults_module.cpp
/// \brief  Faults for Python; libins/faults.py checks what it gives. SPDX-License-Identifier: MIT
#include "board_module.hpp"
#include <nanobind/stl/string.h>
#include <stdexcept>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

FaultKind kind_of(const std::string& name)
{
    for (size_t i = 0; i < fault_kinds.size(); i++)
    {
        if (name == fault_kinds[i])
        {
            return static_cast<FaultKind>(i);
        }
    }
    throw std::invalid_argument(name + ": no kind of fault");
}

nb::list hits(Run& run)
{
    nb::list list;
    for (const auto& [kind, count] : run.faults().hits())
    {
        list.append(nb::make_tuple(kind, count));
    }
    return list;
}

/// First and last instant at which each may act.
nb::list windows(Run& run)
{
    nb::list list;
    for (const auto& [from, to] : run.faults().windows())
    {
        list.append(nb::make_tuple(from, to));
    }
    return list;
}

} // namespace

void bind_faults(nb::module_& module, nb::class_<Run>& run)
{
    nb::class_<Fault>(module, "Fault", "See faults.hpp.")
        .def(
            "__init__",
            [](Fault* self, const std::string& kind)
            {
                new (self) Fault();
                self->kind = kind_of(kind);
            },
            "kind"_a)
        .def_rw("from_ps", &Fault::from)
        .def_rw("to_ps", &Fault::to)
        .def_rw("rate_hz", &Fault::rate_hz)
        .def_rw("lasts_ps", &Fault::lasts)
        .def_rw("probability", &Fault::probability)
        .def_rw("value", &Fault::value)
        .def_rw("drift", &Fault::drift)
        .def_rw("channel", &Fault::channel)
        .def_rw("address", &Fault::address)
        .def_rw("bit", &Fault::bit)
        .def_rw("net", &Fault::net)
        .def_rw("other", &Fault::other)
        .def_rw("seed", &Fault::seed);
    run.def(
           "add_fault", [](Run& self, const Fault& fault) { self.faults().add(fault); }, "fault"_a)
        .def("fault_hits", hits)
        .def(
            "end_fault", [](Run& self, size_t place, emu_time_t at_ps) { self.faults().end_at(place, at_ps); },
            "place"_a, "at_ps"_a)
        .def("fault_windows", windows);
}

} // namespace libins
