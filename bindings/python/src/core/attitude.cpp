/// \file   attitude.cpp
/// \brief  Attitude from increments, alone, small, by functional iteration and in batches: ins/attitude.h, ins/hist2.h,
///         ins/fiter.h, ins/batch.h.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"

namespace libins
{
using namespace nb::literals;

namespace
{
/// ins_batch_t, and the state that it leaves to its caller.
struct Batch
{
    ins_batch_t steps;
    std::vector<ins_real> state;
    void copy_attitudes(ins_real* to) const
    {
        std::copy(state.begin(), state.begin() + static_cast<ptrdiff_t>(4 * steps.n), to);
    }
};

void bind_step(nb::module_& m)
{
    nb::class_<ins_attitude_t> attitude(m, "Attitude",
                                        "Attitude from angle increments, coning corrected. Frame: b -> n.");
    attitude.def(
        "__init__",
        [](ins_attitude_t* self, int form, const Given& q_nb)
        {
            new (self) ins_attitude_t();
            const Call call("Attitude", "form CONING_ONE or one of CONING_HIST*, q_nb within 1e-3 of unit norm");
            call.check(ins_attitude_init(self, form, call.whole<ins_real>("q_nb", q_nb, {4}).data));
        },
        "form"_a, "q_nb"_a,
        "form: CONING_ONE or CONING_HIST*; CONING_HIST2_OPT is the default of the C library. q_nb: (4,).");
    attitude.def(
        "step",
        [](ins_attitude_t& self, const Given& dtheta_b)
        {
            Call call("Attitude.step", "dtheta_b finite, each |component| <= pi rad");
            const auto in = call.rows<ins_real>("dtheta_b", dtheta_b, {3});
            const auto out = call.out<ins_real>({4});
            call.run(
                [&](size_t k)
                {
                    const ins_status_t status = ins_attitude_step(&self, in[k]);
                    std::copy(self.q_nb, self.q_nb + 4, out[k]);
                    return status;
                });
            return out;
        },
        "dtheta_b"_a, "Increments [rad], (3,) or (N, 3), to q_nb after each, (4,) or (N, 4).");
    attitude.def(
        "turn_frame",
        [](ins_attitude_t& self, const Given& dzeta_n)
        {
            const Call call("Attitude.turn_frame", "dzeta_n finite, |dzeta_n| <= 1000 rad");
            call.check(ins_attitude_turn_frame(&self, call.whole<ins_real>("dzeta_n", dzeta_n, {3}).data));
        },
        "dzeta_n"_a, "Turn of n over the same time [rad], (3,): the integral of Earth rate and transport rate.");
    attitude.def(
        "jump",
        [](ins_attitude_t& self, const Given& phi_b)
        {
            const Call call("Attitude.jump", "phi_b finite, |phi_b| <= 1000 rad");
            call.check(ins_attitude_jump(&self, call.whole<ins_real>("phi_b", phi_b, {3}).data));
        },
        "phi_b"_a, "Add one rotation vector (3,) [rad] that spans a gap; the history restarts.");
    writes(attitude, "q_nb", &ins_attitude_t::q_nb, {4},
           "Attitude now, scalar first, (4,); set it to keep the history alone.");
    attitude.def_ro("count", &ins_attitude_t::count, "Previous increments held.");
    copies(attitude);
}

void bind_lean(nb::module_& m)
{
    nb::class_<ins_hist2_t> lean(
        m, "Hist2",
        "Attitude from angle increments, the small form: the bits of Attitude(CONING_HIST2_OPT). Frame: b -> n.");
    lean.def(
        "__init__",
        [](ins_hist2_t* self, const Given& q_nb)
        {
            new (self) ins_hist2_t();
            const Call call("Hist2", "q_nb within 1e-3 of unit norm");
            call.check(ins_hist2_init(self, call.whole<ins_real>("q_nb", q_nb, {4}).data));
        },
        "q_nb"_a, "q_nb: (4,).");
    lean.def(
        "step",
        [](ins_hist2_t& self, const Given& dtheta_b)
        {
            Call call("Hist2.step", "dtheta_b finite, |dtheta_b| with its coning term <= 0.5 rad");
            const auto in = call.rows<ins_real>("dtheta_b", dtheta_b, {3});
            const auto out = call.out<ins_real>({4});
            call.run(
                [&](size_t k)
                {
                    const ins_status_t status = ins_hist2_step(&self, in[k]);
                    std::copy(self.q_nb, self.q_nb + 4, out[k]);
                    return status;
                });
            return out;
        },
        "dtheta_b"_a, "Increments [rad], (3,) or (N, 3), to q_nb after each, (4,) or (N, 4).");
    writes(lean, "q_nb", &ins_hist2_t::q_nb, {4},
           "Attitude now, scalar first, (4,); set it to keep the history alone.");
    lean.def_ro("count", &ins_hist2_t::count, "Previous increments held.");
    copies(lean);
}

void bind_fiter(nb::module_& m)
{
    m.def("fiter_samples", ins_fiter_samples, "form"_a, "Samples a form reads; 0 if there is no such form.");
    m.def(
        "fiter_turn",
        [](int form, const Given& theta_b)
        {
            Call call("fiter_turn", "form one of FITER_*, increments finite and small enough for the series to end");
            const int samples = ins_fiter_samples(form);
            call.check(samples > 0 ? INS_OK : INS_E_RANGE);
            const auto in = call.rows<ins_real>("theta_b", theta_b, {static_cast<size_t>(samples), 3});
            const auto out = call.out<ins_real>({4});
            call.run([&](size_t k) { return ins_fiter_turn(form, in[k], out[k]); });
            return out;
        },
        "form"_a, "theta_b"_a,
        "Rotation over the form's interval, (4,) or (N, 4), from increments or rates times T [rad], oldest first, (n, "
        "3) or (N, n, 3).");
    nb::class_<ins_fiter_t> fiter(m, "Fiter",
                                  "Attitude by functional iteration on a fitted rate polynomial. Frame: b -> n.");
    fiter.def(
        "__init__",
        [](ins_fiter_t* self, int form, double period_s, const Given& q_nb)
        {
            new (self) ins_fiter_t();
            const Call call("Fiter",
                            "form FITER_HIST* or FITER_RATE*, period_s > 0 for rates, q_nb within 1e-3 of unit norm");
            call.check(ins_fiter_init(self, form, as_real(period_s), call.whole<ins_real>("q_nb", q_nb, {4}).data));
        },
        "form"_a, "period_s"_a, "q_nb"_a, "period_s: of a rate form; not read for increments. q_nb: (4,).");
    fiter.def(
        "step",
        [](ins_fiter_t& self, const Given& sample_b)
        {
            Call call("Fiter.step", "sample_b finite, each angle |component| <= pi rad, the series ending");
            const auto in = call.rows<ins_real>("sample_b", sample_b, {3});
            const auto out = call.out<ins_real>({4});
            call.run(
                [&](size_t k)
                {
                    const ins_status_t status = ins_fiter_step(&self, in[k]);
                    std::copy(self.q_nb, self.q_nb + 4, out[k]);
                    return status;
                });
            return out;
        },
        "sample_b"_a,
        "Increments [rad] or rates [rad/s], (3,) or (N, 3), to q_nb after each, (4,) or (N, 4). The first rate turns "
        "nothing.");
    writes(fiter, "q_nb", &ins_fiter_t::q_nb, {4},
           "Attitude now, scalar first, (4,); set it to keep the history alone.");
    fiter.def_ro("count", &ins_fiter_t::count, "Previous samples held.");
    copies(fiter);
}

void bind_batch(nb::module_& m)
{
    nb::class_<Batch> batch(
        m, "Batch",
        "n trajectories at once, structure of arrays: the bits of Attitude(CONING_HIST2_OPT). Frame: b -> n.");
    batch.def(
        "__init__",
        [](Batch* self, const Given& q_nb)
        {
            const Call call("Batch", "n >= 1, each q_nb within 1e-3 of unit norm");
            const auto in = call.whole<ins_real>("q_nb", q_nb, {4, ANY});
            Batch made = {{}, std::vector<ins_real>(INS_BATCH_ROWS * in.shape[1])};
            call.check(ins_batch_init(&made.steps, in.shape[1], made.state.data(), in.data));
            new (self) Batch(std::move(made));
        },
        "q_nb"_a, "q_nb: (4, n), a column a trajectory.");
    batch.def(
        "step",
        [](Batch& self, const Given& dtheta_b)
        {
            Call call("Batch.step", "dtheta_b finite, each |component| <= pi rad");
            const auto in = call.rows<ins_real>("dtheta_b", dtheta_b, {3, self.steps.n});
            const auto out = call.out<ins_real>({4, self.steps.n});
            call.run(
                [&](size_t k)
                {
                    const ins_status_t status = ins_batch_step(&self.steps, self.state.data(), in[k]);
                    self.copy_attitudes(out[k]);
                    return status;
                });
            return out;
        },
        "dtheta_b"_a, "Increments [rad], (3, n) or (N, 3, n), to q_nb after each, (4, n) or (N, 4, n).");
    batch.def_prop_ro(
        "q_nb",
        [](const Batch& self)
        {
            const auto out = made<ins_real>({4, self.steps.n});
            self.copy_attitudes(out.data);
            return out;
        },
        "Attitudes now, (4, n).");
    copies(batch);
}
} // namespace

void bind_attitude(nb::module_& m)
{
#define LIBINS_CONSTANT(name) m.attr(#name) = static_cast<int>(INS_##name);
    LIBINS_CONSTANT(FITER_HIST0)
    LIBINS_CONSTANT(FITER_HIST1)
    LIBINS_CONSTANT(FITER_HIST2)
    LIBINS_CONSTANT(FITER_HIST3)
    LIBINS_CONSTANT(FITER_HIST4)
    LIBINS_CONSTANT(FITER_RATE2)
    LIBINS_CONSTANT(FITER_RATE3)
    LIBINS_CONSTANT(FITER_RATE4)
    LIBINS_CONSTANT(FITER_RATE5)
    LIBINS_CONSTANT(FITER_BLOCK3)
    LIBINS_CONSTANT(FITER_FORM_COUNT)
    bind_step(m);
    bind_lean(m);
    bind_fiter(m);
    bind_batch(m);
}

} // namespace libins
