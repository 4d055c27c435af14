/// \file   kf15.cpp
/// \brief  Covariance of the 15 errors of a strapdown, and its model: ins/kf15.h.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"

namespace libins
{
using namespace nb::literals;

namespace
{
constexpr size_t N = INS_KF15_N;

struct Symmetric
{
    using State = ins_kf15_t;
    static constexpr const char* name = "Kf15";
    static constexpr const char* update_name = "Kf15.update";
    static constexpr const char* state_name = "Kf15.update_state";
    static constexpr auto init = ins_kf15_init;
    static constexpr auto propagate = ins_kf15_propagate;
    static constexpr auto update = ins_kf15_update;
    static constexpr auto update_state = ins_kf15_update_state;
    static void covariance(const State& self, ins_real* P)
    {
        for (size_t i = 0; i < N; i++)
        {
            std::copy(self.P + INS_KF15_ROW * i, self.P + INS_KF15_ROW * i + N, P + N * i);
        }
    }
};

struct Factors
{
    using State = ins_kf15_ud_t;
    static constexpr const char* name = "Kf15Ud";
    static constexpr const char* update_name = "Kf15Ud.update";
    static constexpr const char* state_name = "Kf15Ud.update_state";
    static constexpr auto init = ins_kf15_ud_init;
    static constexpr auto propagate = ins_kf15_ud_propagate;
    static constexpr auto update = ins_kf15_ud_update;
    static constexpr auto update_state = ins_kf15_ud_update_state;
    static void covariance(const State& self, ins_real* P)
    {
        ins_kf15_t full;
        ins_kf15_ud_covariance(&self, full.P);
        Symmetric::covariance(full, P);
    }
};

void judge(const Call& call, ins_status_t status, const ins_innovation_t& z)
{
    const auto text = [&] { return "nis " + std::to_string(z.nis) + ", gate " + std::to_string(z.gate) + ": "; };
    call.check(status, status == INS_E_GATE ? text() : "");
}

template <typename Form> void bind_form(nb::module_& m, const char* doc)
{
    using State = typename Form::State;
    static const char* const wants = "index 0 to 14, finite v and P, r > 0, nis within the gate";
    nb::class_<State> filter(m, Form::name, doc);
    filter.def(
        "__init__",
        [](State* self, const Given& sigma)
        {
            new (self) State();
            const Call call(Form::name, "sigma finite, >= 0");
            call.check(Form::init(self, call.whole<ins_real>("sigma", sigma, {N}).data));
        },
        "sigma"_a, "sigma: (15,) standard deviations of the start.");
    filter.def(
        "propagate", [](State& self, const ins_kf15_model_t& model) { Form::propagate(&self, &model); }, "model"_a,
        "P = (I + F dt) P (I + F dt)' + Q over one step.");
    filter.def(
        "update",
        [](State& self, const Given& h, double v, double r, double gate)
        {
            const Call call(Form::update_name, wants);
            ins_innovation_t z = {as_real(v), as_real(r), as_real(gate), 0};
            judge(call, Form::update(&self, call.whole<ins_real>("h", h, {N}).data, &z), z);
            return static_cast<double>(z.nis);
        },
        "h"_a, "v"_a, "r"_a, "gate"_a = 0.0,
        "One scalar measurement: row h (15,), innovation v, variance r. Returns its nis, the gain is in K; GateError "
        "when nis is above the gate (0: no gate).");
    filter.def(
        "update_state",
        [](State& self, unsigned index, double v, double r, double gate)
        {
            ins_innovation_t z = {as_real(v), as_real(r), as_real(gate), 0};
            judge(Call(Form::state_name, wants), Form::update_state(&self, index, &z), z);
            return static_cast<double>(z.nis);
        },
        "index"_a, "v"_a, "r"_a, "gate"_a = 0.0, "The same for a row that is 1 at index and 0 elsewhere: cheaper.");
    filter.def_prop_ro(
        "P",
        [](const State& self)
        {
            const auto P = made<ins_real>({N, N});
            Form::covariance(self, P.data);
            return P;
        },
        "Covariance, (15, 15).");
    filter.def_prop_ro(
        "K", [](const State& self) { return copy_of(self.K, {N}); },
        "Gain of the last update, (15,): K v is what to add.");
    copies(filter);
}

void bind_model(nb::module_& m)
{
    nb::class_<ins_kf15_model_t> model(m, "Kf15Model",
                                       "F dt and Q of one step of the 15 errors. Frames: b -> n (NED).");
    model.def(
        "__init__",
        [](ins_kf15_model_t* self, double dt, double arw, double vrw, double bg_sigma, double bg_tau, double ba_sigma,
           double ba_tau)
        {
            new (self) ins_kf15_model_t();
            const ins_kf15_sensors_t sensors = {as_real(arw),    as_real(vrw),      as_real(bg_sigma),
                                                as_real(bg_tau), as_real(ba_sigma), as_real(ba_tau)};
            const Call call("Kf15Model", "0 < dt <= 1, finite noises >= 0, time constants > 0");
            call.check(ins_kf15_model_init(self, as_real(dt), &sensors));
        },
        "dt"_a, "arw"_a, "vrw"_a, "bg_sigma"_a, "bg_tau"_a, "ba_sigma"_a, "ba_tau"_a,
        "dt [s]; angle and velocity random walk [rad/sqrt(s), m/s/sqrt(s)]; deviation and time constant of the gyros' "
        "[rad/s, s] and the accelerometers' bias [m/s^2, s].");
    model.def(
        "set",
        [](ins_kf15_model_t& self, const ins_strapdown_t& at, const Given& v_b)
        { ins_kf15_model(&self, &at, Call("Kf15Model.set").whole<ins_real>("v_b", v_b, {3}).data); },
        "at"_a, "v_b"_a, "The step that ended at a Strapdown; v_b: its velocity increment [m/s], (3,).");
    model.def_prop_ro(
        "Phi",
        [](const ins_kf15_model_t& self)
        {
            const auto Phi = made<ins_real>({N, N});
            ins_kf15_transition(&self, Phi.data);
            return Phi;
        },
        "I + F dt, (15, 15).");
    copies(model);
}
} // namespace

void bind_kf15(nb::module_& m)
{
#define LIBINS_INDEX(name) m.attr(#name) = static_cast<int>(INS_##name);
    LIBINS_INDEX(KF15_N)
    LIBINS_INDEX(KF15_PHI)
    LIBINS_INDEX(KF15_V)
    LIBINS_INDEX(KF15_P)
    LIBINS_INDEX(KF15_BG)
    LIBINS_INDEX(KF15_BA)
    bind_model(m);
    bind_form<Symmetric>(m, "Covariance of the 15 errors of a strapdown: attitude, velocity, position, gyro and "
                            "accelerometer bias.");
    bind_form<Factors>(m, "The same as U D U': for float, and large ranges of variance.");
}

} // namespace libins
