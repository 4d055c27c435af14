/// \file   coning.cpp
/// \brief  Coning rotation vectors, rates to increments, skew: ins/coning.h, ins/reuse.h, ins/rates.h. SPDX-License-Identifier: MIT
#include "arrays.hpp"

namespace libins
{
using namespace nb::literals;

namespace
{
Made<ins_real> coning_phi(int form, const Given& theta_b)
{
    Call call("coning_phi", "form one of CONING_*");
    const int samples = ins_coning_samples(form);
    call.check(samples > 0 ? INS_OK : INS_E_RANGE);
    const auto in = call.rows<ins_real>("theta_b", theta_b, {static_cast<size_t>(samples), 3});
    const auto out = call.out<ins_real>({3});
    call.run([&](size_t k) { return ins_coning_phi(form, in[k], out[k]); });
    return out;
}

void bind_reuse(nb::module_& m)
{
    nb::class_<ins_reuse_t> reuse(m, "Reuse",
                                  "Attitude at every sample from three-sample blocks, as three interleaved chains.");
    reuse.def(
        "__init__",
        [](ins_reuse_t* self, int form, const Given& q_nb)
        {
            new (self) ins_reuse_t();
            const Call call("Reuse", "form CONING_BLOCK3_FIT or CONING_BLOCK3_OPT, each q_nb within 1e-3 of unit norm");
            call.check(ins_reuse_init(self, form, call.whole<ins_real>("q_nb", q_nb, {3, 4}).data));
        },
        "form"_a, "q_nb"_a, "q_nb: (3, 4), attitudes at the first three instants.");
    reuse.def(
        "step",
        [](ins_reuse_t& self, const Given& dtheta_b)
        {
            Call call("Reuse.step", "dtheta_b finite, each |component| <= pi rad");
            const auto in = call.rows<ins_real>("dtheta_b", dtheta_b, {3});
            const auto out = call.out<ins_real>({4});
            call.run([&](size_t k) { return ins_reuse_step(&self, in[k], out[k]); });
            return out;
        },
        "dtheta_b"_a, "Increments [rad], (3,) or (N, 3), to q_nb after each, (4,) or (N, 4).");
    copies(reuse);
}

void bind_rates(nb::module_& m)
{
    m.attr("RATES_ORDER_MAX") = INS_RATES_ORDER_MAX;
    nb::class_<ins_rates_t> rates(m, "Rates",
                                  "Point samples of the angular rate to angle increments, by Adams-Moulton formulas.");
    rates.def(
        "__init__",
        [](ins_rates_t* self, uint_least8_t order, double period_s)
        {
            new (self) ins_rates_t();
            Call("Rates", "order 2..5, period_s > 0").check(ins_rates_init(self, order, as_real(period_s)));
        },
        "order"_a, "period_s"_a, "order: samples a formula reads, 2 (trapezoid) to 5.");
    rates.def(
        "add",
        [](ins_rates_t& self, const Given& w_ib_b)
        {
            Call call("Rates.add", "w_ib_b finite");
            const auto in = call.rows<ins_real>("w_ib_b", w_ib_b, {3});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { return ins_rates_add(&self, in[k], out[k]); });
            return out;
        },
        "w_ib_b"_a,
        "Rates [rad/s], (3,) or (N, 3), to the increments [rad] over the period before each; the very first is zero.");
    rates.def(
        "bridge",
        [](ins_rates_t& self, uint32_t missing, const Given& w_ib_b)
        {
            const Call call("Rates.bridge", "missing >= 1, w_ib_b finite");
            const auto in = call.whole<ins_real>("w_ib_b", w_ib_b, {3});
            const auto out = made<ins_real>({3});
            call.check(ins_rates_bridge(&self, missing, in.data, out.data));
            return out;
        },
        "missing"_a, "w_ib_b"_a,
        "The sample (3,) after lost ones, to the increment (3,) over all of them; the history restarts.");
    rates.def_ro("count", &ins_rates_t::count, "Samples held; the formula has its order once this is it.");
    copies(rates);

    nb::class_<ins_skew_t> skew(m, "Skew",
                                "Brings channels that were sampled one after the other to the instant of the scan.");
    skew.def(
        "__init__",
        [](ins_skew_t* self, uint_least8_t order, const Given& delay_s, double period_s)
        {
            new (self) ins_skew_t();
            const Call call("Skew", "order 1..3, period_s > 0, 0 <= delay_s < period_s");
            call.check(
                ins_skew_init(self, order, call.whole<ins_real>("delay_s", delay_s, {3}).data, as_real(period_s)));
        },
        "order"_a, "delay_s"_a, "period_s"_a, "delay_s: (3,), of each channel after the scan's instant.");
    skew.def(
        "add",
        [](ins_skew_t& self, const Given& raw)
        {
            Call call("Skew.add", "raw finite");
            const auto in = call.rows<ins_real>("raw", raw, {3});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { return ins_skew_add(&self, in[k], out[k]); });
            return out;
        },
        "raw"_a, "Samples as taken, (3,) or (N, 3), to samples at the scan's instant, in their unit.");
    skew.def(
        "restart", [](ins_skew_t& self) { ins_skew_restart(&self); }, "After lost samples: keep only what comes next.");
    copies(skew);
}
} // namespace

void bind_coning(nb::module_& m)
{
#define LIBINS_CONSTANT(name) m.attr(#name) = static_cast<int>(INS_##name);
    LIBINS_CONSTANT(CONING_ONE)
    LIBINS_CONSTANT(CONING_HIST1)
    LIBINS_CONSTANT(CONING_HIST2_FIT)
    LIBINS_CONSTANT(CONING_HIST2_OPT)
    LIBINS_CONSTANT(CONING_HIST3_FIT)
    LIBINS_CONSTANT(CONING_HIST3_OPT)
    LIBINS_CONSTANT(CONING_BLOCK2)
    LIBINS_CONSTANT(CONING_BLOCK3_FIT)
    LIBINS_CONSTANT(CONING_BLOCK3_OPT)
    LIBINS_CONSTANT(CONING_BLOCK4_FIT)
    LIBINS_CONSTANT(CONING_BLOCK4_OPT)
    LIBINS_CONSTANT(CONING_HIST2_MU03)
    LIBINS_CONSTANT(CONING_HIST2_MU06)
    LIBINS_CONSTANT(CONING_HIST2_MU10)
    LIBINS_CONSTANT(CONING_FORM_COUNT)
    m.def("coning_samples", ins_coning_samples, "form"_a, "Increments a form reads; 0 if there is no such form.");
    m.def(
        "coning_is_block", [](int form) { return ins_coning_is_block(form) != 0; }, "form"_a,
        "True if the form spans all its increments, False if only the last.");
    m.def("coning_phi", coning_phi, "form"_a, "theta_b"_a,
          "Rotation vector [rad], (3,) or (N, 3), from the increments a form reads [rad], oldest first, (n, 3) or (N, "
          "n, 3) with "
          "n = coning_samples(form).");
    bind_reuse(m);
    bind_rates(m);
}

} // namespace libins
