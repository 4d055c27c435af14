/// \file   knobs_module.cpp
/// \brief  What is done by hand, for Python; libins/knobs.py checks what it gives. SPDX-License-Identifier: MIT
#include "board_module.hpp"
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <stdexcept>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

KnobKind kind_of(const std::string& name)
{
    for (size_t i = 0; i < knob_kinds.size(); i++)
    {
        if (name == knob_kinds[i])
        {
            return static_cast<KnobKind>(i);
        }
    }
    throw std::invalid_argument(name + ": no kind of knob");
}

/// What a hand has set: rate, by input volts, bias and noise.
nb::dict hand(const Run& run)
{
    nb::dict d, volts;
    for (const auto& [channel, value] : run.held_volts())
    {
        volts[nb::int_(channel)] = value;
    }
    const std::array<double, 3>* const rate = run.hand_rate();
    std::array<double, 3> bias{}, noise{};
    for (unsigned i = 0; i < INS_GYRO_CHANNELS; i++)
    {
        bias[i] = run.gyro().channel[i].bias;
        noise[i] = run.gyro().channel[i].noise_density;
    }
    d["rate"] = rate != nullptr ? nb::cast(*rate) : nb::none();
    d["volts"] = volts;
    d["bias"] = bias;
    d["noise"] = noise;
    return d;
}

} // namespace

void bind_knobs(nb::module_& module, nb::class_<Run>& run)
{
    nb::class_<Knob>(module, "Knob", "See knobs.hpp.")
        .def(
            "__init__",
            [](Knob* self, const std::string& kind, emu_time_t at_ps)
            {
                new (self) Knob();
                self->kind = kind_of(kind);
                self->at = at_ps;
            },
            "kind"_a, "at_ps"_a)
        .def_ro("at_ps", &Knob::at)
        .def_rw("lasts_ps", &Knob::lasts)
        .def_rw("values", &Knob::values)
        .def_rw("channel", &Knob::channel)
        .def_prop_rw(
            "octets", [](const Knob& self) { return nb::bytes(self.octets.data(), self.octets.size()); },
            [](Knob& self, const nb::bytes& octets) { self.octets.assign(octets.c_str(), octets.size()); });
    run.def("add_knob", &Run::add_knob, "knob"_a)
        .def("hand", hand)
        .def_prop_ro(
            "send_room", [](const Run& self) { return EMU_SERIAL_FIFO - self.host_end().fifo_count; },
            "Octets that the host's transmitter can take.");
}

} // namespace libins
