/// \file   thesis.cpp
/// \brief  The thesis's attitude formulas, for comparison: ins/thesis.h. SPDX-License-Identifier: MIT
#include "arrays.hpp"

namespace libins
{
using namespace nb::literals;

namespace
{
Made<ins_real> thesis_p(const Given& theta_b, const Given& prev_b)
{
    Call call("thesis_p");
    const auto theta = call.rows<ins_real>("theta_b", theta_b, {3});
    const auto prev = call.rows<ins_real>("prev_b", prev_b, {3});
    const auto out = call.out<ins_real>({4});
    call.run([&](size_t k) { ins_thesis_p(theta[k], prev[k], out[k]); });
    return out;
}

Made<ins_real> thesis_zxz(const Given& angles)
{
    Call call("thesis_zxz");
    const auto in = call.rows<ins_real>("angles", angles, {3});
    const auto out = call.out<ins_real>({3, 3});
    call.run([&](size_t k) { ins_thesis_zxz(in[k], out[k]); });
    return out;
}

void bind_rk4(nb::module_& m)
{
    nb::class_<ins_thesis_rk4_t> rk4(m, "ThesisRk4",
                                     "Runge-Kutta of fourth order with norm feedback, from sampled rates.");
    rk4.def(
        "__init__",
        [](ins_thesis_rk4_t* self, double feedback, double step_s, const Given& q_nb, const Given& w_ib_b)
        {
            new (self) ins_thesis_rk4_t();
            const Call call("ThesisRk4",
                            "step_s > 0, feedback >= 0, 2 feedback step_s < 2.785, q_nb within 1e-3 of unit norm");
            const auto q = call.whole<ins_real>("q_nb", q_nb, {4});
            const auto w = call.whole<ins_real>("w_ib_b", w_ib_b, {3});
            call.check(ins_thesis_rk4_init(self, as_real(feedback), as_real(step_s), q.data, w.data));
        },
        "feedback"_a, "step_s"_a, "q_nb"_a, "w_ib_b"_a,
        "feedback: k [1/s]; 0 leaves the norm to you. step_s: twice the sampling period. w_ib_b: (3,) at the start "
        "[rad/s].");
    rk4.def(
        "step",
        [](ins_thesis_rk4_t& self, const Given& w_mid_b, const Given& w_end_b)
        {
            Call call("ThesisRk4.step", "rates finite, each |component| step_s <= pi");
            const auto mid = call.rows<ins_real>("w_mid_b", w_mid_b, {3});
            const auto end = call.rows<ins_real>("w_end_b", w_end_b, {3});
            const auto out = call.out<ins_real>({4});
            call.run(
                [&](size_t k)
                {
                    const ins_status_t status = ins_thesis_rk4_step(&self, mid[k], end[k]);
                    std::copy(self.q_nb, self.q_nb + 4, out[k]);
                    return status;
                });
            return out;
        },
        "w_mid_b"_a, "w_end_b"_a,
        "Rates [rad/s] at the middle and the end of each step, (3,) or (N, 3), to q_nb, (4,) or (N, 4).");
    writes(rk4, "q_nb", &ins_thesis_rk4_t::q_nb, {4}, "Attitude now, (4,).");
    copies(rk4);
}
} // namespace

void bind_thesis(nb::module_& m)
{
    m.attr("THESIS_RK4_LIMIT") = static_cast<double>(INS_THESIS_RK4_LIMIT);
    m.def("thesis_p", thesis_p, "theta_b"_a, "prev_b"_a,
          "Quaternion of one interval, not normalised, (4,) or (N, 4), from its increment and the one before [rad].");
    m.def("thesis_zxz", thesis_zxz, "angles"_a,
          "Passive ZXZ rotation of alpha, beta, gamma [rad], (3,) or (N, 3), to (3, 3) or (N, 3, 3).");
    nb::class_<ins_thesis_t> thesis(m, "Thesis",
                                    "The thesis's second-order update with the increment before. Frame: b -> n.");
    thesis.def(
        "__init__",
        [](ins_thesis_t* self, const Given& q_nb)
        {
            new (self) ins_thesis_t();
            const Call call("Thesis", "q_nb within 1e-3 of unit norm");
            call.check(ins_thesis_init(self, call.whole<ins_real>("q_nb", q_nb, {4}).data));
        },
        "q_nb"_a, "q_nb: (4,).");
    thesis.def(
        "step",
        [](ins_thesis_t& self, const Given& dtheta_b)
        {
            Call call("Thesis.step", "dtheta_b finite, each |component| <= 1 rad");
            const auto in = call.rows<ins_real>("dtheta_b", dtheta_b, {3});
            const auto out = call.out<ins_real>({4});
            call.run(
                [&](size_t k)
                {
                    const ins_status_t status = ins_thesis_step(&self, in[k]);
                    std::copy(self.q_nb, self.q_nb + 4, out[k]);
                    return status;
                });
            return out;
        },
        "dtheta_b"_a, "Increments [rad], (3,) or (N, 3), to q_nb after each, (4,) or (N, 4).");
    writes(thesis, "q_nb", &ins_thesis_t::q_nb, {4}, "Attitude now, (4,); set it to keep the history alone.");
    copies(thesis);
    bind_rk4(m);
}

} // namespace libins
