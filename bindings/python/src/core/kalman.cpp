/// \file   kalman.cpp
/// \brief  The generic filter in Joseph and UD form, the P-V-A filter, Gauss-Markov states, fusion: ins/kalman.h, pva.h, markov.h, fusion.h.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <cmath>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>

namespace libins
{
using namespace nb::literals;

namespace
{
std::string nis_text(const ins_innovation_t& z)
{
    return "nis " + std::to_string(z.nis) + ", gate " + std::to_string(z.gate) + ": ";
}

/// The covariance as it is.
struct Joseph
{
    static constexpr const char* name = "Kalman";
    static constexpr const char* update_name = "Kalman.update";
    static constexpr const char* predict_name = "Kalman.predict";
    static constexpr const char* run_name = "Kalman.run";
    static size_t work(size_t n) { return INS_KALMAN_WORK(n); }
    static ins_status_t load(unsigned n, const ins_real* P, ins_real* held, ins_real*)
    {
        std::copy(P, P + n * n, held);
        return INS_OK;
    }
    static void covariance(unsigned n, const ins_real* held, ins_real* P) { std::copy(held, held + n * n, P); }
    static constexpr auto predict = ins_kalman_predict;
    static constexpr auto update = ins_kalman_update;
};

/// The covariance, and Q, as U D U'.
struct Bierman
{
    static constexpr const char* name = "Ud";
    static constexpr const char* update_name = "Ud.update";
    static constexpr const char* predict_name = "Ud.predict";
    static constexpr const char* run_name = "Ud.run";
    static size_t work(size_t n) { return INS_UD_WORK(n); }
    static constexpr auto load = ins_ud_factor;
    static constexpr auto covariance = ins_ud_covariance;
    static constexpr auto predict = ins_ud_predict;
    static constexpr auto update = ins_ud_update;
};

template <typename Form> struct Filter
{
    unsigned n;
    std::vector<ins_real> x, P, work;

    ins_status_t update(const ins_real* h, ins_innovation_t& z)
    {
        return Form::update(n, x.data(), P.data(), h, &z, work.data());
    }
};

const char* const FILTER_WANTS = "finite v and P, r > 0, nis within the gate";

template <typename Form> void init(Filter<Form>* self, const Given& x, const Given& P)
{
    const Call call(Form::name, "n >= 1, P positive semidefinite");
    const auto state = call.whole<ins_real>("x", x, {ANY});
    const size_t n = state.shape[0];
    const auto covariance = call.whole<ins_real>("P", P, {n, n});
    call.check(n > 0 ? INS_OK : INS_E_RANGE);
    Filter<Form> made = {static_cast<unsigned>(n),
                         {state.data, state.data + n},
                         std::vector<ins_real>(n * n),
                         std::vector<ins_real>(Form::work(n))};
    call.check(Form::load(made.n, covariance.data, made.P.data(), made.work.data()));
    new (self) Filter<Form>(std::move(made));
}

template <typename Form> void predict(Filter<Form>& self, const Given& Phi, const Given& Q, bool covariance_only)
{
    const Call call(Form::predict_name, "Q positive semidefinite");
    const auto phi = call.whole<ins_real>("Phi", Phi, {self.n, self.n});
    const auto q = call.whole<ins_real>("Q", Q, {self.n, self.n});
    std::vector<ins_real> held(self.P.size());
    call.check(Form::load(self.n, q.data, held.data(), self.work.data()));
    Form::predict(self.n, covariance_only ? nullptr : self.x.data(), self.P.data(), phi.data, held.data(),
                  self.work.data());
}

template <typename Form>
std::pair<Made<ins_real>, double> update(Filter<Form>& self, const Given& h, double v, double r, double gate)
{
    const Call call(Form::update_name, FILTER_WANTS);
    const auto row = call.whole<ins_real>("h", h, {self.n});
    ins_innovation_t z = {as_real(v), as_real(r), as_real(gate), 0};
    const ins_status_t status = self.update(row.data, z);
    call.check(status, status == INS_E_GATE ? nis_text(z) : "");
    return {copy_of(self.work.data(), {self.n}), static_cast<double>(z.nis)};
}

template <typename Form>
std::tuple<Made<ins_real>, Made<ins_real>, Made<ins_real>>
run(Filter<Form>& self, const Given& Phi, const Given& Q, const Given& H, const Given& r, const Given& z, double gate)
{
    Call call(Form::run_name, "finite z and P, r > 0, Q positive semidefinite");
    const unsigned n = self.n;
    const auto phi = call.whole<ins_real>("Phi", Phi, {n, n});
    const auto q = call.whole<ins_real>("Q", Q, {n, n});
    const auto h = call.whole<ins_real>("H", H, {ANY, n});
    const size_t measured = h.shape[0];
    const auto variance = call.whole<ins_real>("r", r, {measured});
    const auto in = call.rows<ins_real>("z", z, {measured});
    const auto x = call.out<ins_real>({n});
    const auto P = call.out<ins_real>({n, n});
    const auto nis = call.out<ins_real>({measured});
    std::vector<ins_real> held(self.P.size());
    call.check(Form::load(n, q.data, held.data(), self.work.data()));
    call.run(
        [&](size_t k)
        {
            ins_status_t status = INS_OK;
            Form::predict(n, self.x.data(), self.P.data(), phi.data, held.data(), self.work.data());
            for (size_t i = 0; i < measured; i++)
            {
                nis[k][i] = 0;
                if (std::isnan(in[k][i]))
                {
                    continue;
                }
                const ins_real* const row = h.data + i * n;
                ins_innovation_t innovation = {in[k][i], variance.data[i], as_real(gate), 0};
                for (size_t j = 0; j < n; j++)
                {
                    innovation.v -= row[j] * self.x[j];
                }
                status = self.update(row, innovation) == INS_E_RANGE ? INS_E_RANGE : status;
                nis[k][i] = innovation.nis;
            }
            std::copy(self.x.begin(), self.x.end(), x[k]);
            Form::covariance(n, self.P.data(), P[k]);
            return status;
        });
    return {x, P, nis};
}

template <typename Form> void bind_filter(nb::module_& m, const char* doc)
{
    nb::class_<Filter<Form>> filter(m, Form::name, doc);
    filter.def("__init__", init<Form>, "x"_a, "P"_a, "x: (n,), P: (n, n), the start and its covariance.");
    filter.def("predict", predict<Form>, "Phi"_a, "Q"_a, "covariance_only"_a = false,
               "x = Phi x, P = Phi P Phi' + Q, (n, n) each. covariance_only: you have moved x by your own model.");
    filter.def("update", update<Form>, "h"_a, "v"_a, "r"_a, "gate"_a = 0.0,
               "One scalar measurement: row h (n,), innovation v = z - h(x), variance r. Returns (gain (n,), nis); "
               "GateError when nis is "
               "above the gate (0: no gate).");
    filter.def("run", run<Form>, "Phi"_a, "Q"_a, "H"_a, "r"_a, "z"_a, "gate"_a = 0.0,
               "For each row of z, (m,) or (N, m): predict, then update with each number that is not NaN; H: (m, n), "
               "r: (m,). Returns "
               "(x, P, nis) after each, (N, n), (N, n, n), (N, m). A nis above the gate: that number was refused; 0: "
               "there was none.");
    filter.def_prop_rw(
        "x", [](const Filter<Form>& self) { return copy_of(self.x.data(), {self.n}); },
        [](Filter<Form>& self, const Given& x)
        {
            const auto in = Call("setting").whole<ins_real>("x", x, {self.n});
            std::copy(in.data, in.data + self.n, self.x.begin());
        },
        "State, (n,).");
    filter.def_prop_ro(
        "P",
        [](const Filter<Form>& self)
        {
            const auto out = made<ins_real>({self.n, self.n});
            Form::covariance(self.n, self.P.data(), out.data);
            return out;
        },
        "Covariance, (n, n).");
    copies(filter);
}

void bind_pva(nb::module_& m)
{
    m.attr("PVA_POSITION") = static_cast<int>(INS_PVA_POSITION);
    m.attr("PVA_VELOCITY") = static_cast<int>(INS_PVA_VELOCITY);
    m.attr("PVA_ACCELERATION") = static_cast<int>(INS_PVA_ACCELERATION);
    nb::class_<ins_pva_t> pva(m, "Pva", "Position, velocity and acceleration of one axis. Units: m, s.");
    pva.def(
        "__init__",
        [](ins_pva_t* self, const Given& var)
        {
            new (self) ins_pva_t();
            const Call call("Pva", "var finite, >= 0");
            call.check(ins_pva_init(self, call.whole<ins_real>("var", var, {3}).data));
        },
        "var"_a, "var: (3,) variances of the start; x is 0, set it if it is known.");
    pva.def(
        "predict",
        [](ins_pva_t& self, double dt, double q)
        { Call("Pva.predict", "dt >= 0, q >= 0").check(ins_pva_predict(&self, as_real(dt), as_real(q))); },
        "dt"_a, "q"_a, "dt [s]; q: spectral density of the jerk [m^2/s^5].");
    pva.def(
        "update",
        [](ins_pva_t& self, int what, double z, double r, double gate)
        {
            const Call call("Pva.update", "what one of PVA_*, finite z, r > 0, nis within the gate");
            call.check(what >= INS_PVA_POSITION && what <= INS_PVA_ACCELERATION ? INS_OK : INS_E_RANGE);
            ins_innovation_t innovation = {as_real(z) - self.x[what], as_real(r), as_real(gate), 0};
            const ins_status_t status = ins_pva_update(&self, what, &innovation);
            call.check(status, status == INS_E_GATE ? nis_text(innovation) : "");
            return static_cast<double>(innovation.nis);
        },
        "what"_a, "z"_a, "r"_a, "gate"_a = 0.0,
        "A measurement z of variance r. Returns its nis; GateError when that is above the gate (0: none).");
    writes(pva, "x", &ins_pva_t::x, {3}, "Position, velocity, acceleration, (3,).");
    reads(pva, "P", &ins_pva_t::P, {3, 3}, "Covariance, (3, 3).");
    reads(pva, "K", &ins_pva_t::K, {3}, "Gain of the last update, (3,).");
    copies(pva);
}

std::pair<Made<ins_real>, Made<ins_real>> markov(const Given& dt, const Given& tau, const Given& sigma)
{
    Call call("markov", "dt >= 0, tau > 0, sigma >= 0");
    const auto step = call.rows<ins_real>("dt", dt, {});
    const auto constant = call.rows<ins_real>("tau", tau, {});
    const auto deviation = call.rows<ins_real>("sigma", sigma, {});
    const auto phi = call.out<ins_real>({});
    const auto q = call.out<ins_real>({});
    call.run(
        [&](size_t k)
        {
            ins_markov_t state = {0, 0};
            const ins_status_t status = ins_markov_init(&state, *step[k], *constant[k], *deviation[k]);
            *phi[k] = state.phi;
            *q[k] = state.q;
            return status;
        });
    return {phi, q};
}

std::pair<Made<ins_real>, Made<ins_real>> fusion(const Given& x, const Given& P)
{
    const Call call("fusion", "each P positive definite, and at least one");
    const auto states = call.whole<ins_real>("x", x, {ANY, ANY});
    const size_t n = states.shape[1];
    const auto covariances = call.whole<ins_real>("P", P, {states.shape[0], n, n});
    std::vector<ins_real> info(n * n);
    std::vector<ins_real> y(n);
    std::vector<ins_real> work(n * n);
    const unsigned size = static_cast<unsigned>(n);
    ins_fusion_clear(size, info.data(), y.data());
    for (size_t i = 0; i < states.shape[0]; i++)
    {
        call.check(
            ins_fusion_add(size, info.data(), y.data(), states.data + i * n, covariances.data + i * n * n, work.data()),
            "estimate " + std::to_string(i) + ": ");
    }
    const auto fused = made<ins_real>({n});
    const auto covariance = made<ins_real>({n, n});
    call.check(ins_fusion_solve(size, info.data(), y.data(), fused.data, covariance.data));
    return {fused, covariance};
}

Made<ins_real> fusion_share(const Given& P, double beta)
{
    const Call call("fusion_share", "beta in (0, 1]");
    const auto in = call.whole<ins_real>("P", P, {ANY, ANY});
    const auto out = made<ins_real>(in.shape);
    call.whole<ins_real>("P", P, {in.shape[0], in.shape[0]});
    call.check(ins_fusion_share(static_cast<unsigned>(in.shape[0]), in.data, as_real(beta), out.data));
    return out;
}
} // namespace

void bind_kalman(nb::module_& m)
{
#define LIBINS_CONSTANT(name) m.attr(#name) = static_cast<double>(INS_##name);
    LIBINS_CONSTANT(KALMAN_GATE_99)
    LIBINS_CONSTANT(KALMAN_GATE2_99)
    LIBINS_CONSTANT(KALMAN_GATE_999)
    LIBINS_CONSTANT(MARKOV_DEG_PER_HOUR)
    LIBINS_CONSTANT(MARKOV_GIMBAL_SIGMA)
    LIBINS_CONSTANT(MARKOV_GIMBAL_TAU_S)
    LIBINS_CONSTANT(MARKOV_STRAPDOWN_SIGMA)
    LIBINS_CONSTANT(MARKOV_STRAPDOWN_TAU_S)
    bind_filter<Joseph>(m, "Kalman filter of n states, covariance in Joseph form.");
    bind_filter<Bierman>(m,
                         "Kalman filter of n states, covariance as U D U': for float, and large ranges of variance.");
    bind_pva(m);
    m.def("markov", markov, "dt"_a, "tau"_a, "sigma"_a,
          "First-order Gauss-Markov state over a step dt [s], time constant tau [s], deviation sigma: (phi, q), () or "
          "(N,) each.");
    m.def("fusion", fusion, "x"_a, "P"_a,
          "Uncorrelated estimates x (k, n) with P (k, n, n) as one: (x (n,), P (n, n)).");
    m.def("fusion_share", fusion_share, "P"_a, "beta"_a, "P / beta, (n, n): the share of one of several filters.");
}

} // namespace libins
