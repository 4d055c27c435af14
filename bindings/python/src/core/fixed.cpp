/// \file   fixed.cpp
/// \brief  Attitude in integers: ins/q31.h. SPDX-License-Identifier: MIT
#include "arrays.hpp"

namespace libins
{
using namespace nb::literals;

namespace
{
void get(const ins_q31_t& self, int32_t* q_nb)
{
    std::copy(self.q_nb, self.q_nb + 4, q_nb);
}
void get(const ins_q31w_t& self, int32_t* q_nb)
{
    ins_q31w_get(&self, q_nb);
}

template <typename T>
void bind(nb::class_<T>& c, const char* name, const char* step_name, ins_status_t (*init)(T*, const int32_t*),
          ins_status_t (*step)(T*, const int32_t*))
{
    c.def(
        "__init__",
        [name, init](T* self, const Given& q_nb)
        {
            new (self) T();
            const Call call(name, "the norm of q_nb / 2^30 within 1e-3 of 1");
            call.check(init(self, call.whole<int32_t>("q_nb", q_nb, {4}).data));
        },
        "q_nb"_a, "q_nb: (4,) in Q30, 1.0 is Q31_ONE = 2^30.");
    c.def(
        "step",
        [step_name, step](T& self, const Given& dtheta_b)
        {
            Call call(step_name, "|dtheta_b| <= 0.5 rad, 1 rad is 2^31");
            const auto in = call.rows<int32_t>("dtheta_b", dtheta_b, {3});
            const auto out = call.out<int32_t>({4});
            call.run(
                [&](size_t k)
                {
                    const ins_status_t status = step(&self, in[k]);
                    get(self, out[k]);
                    return status;
                });
            return out;
        },
        "dtheta_b"_a, "Increments in Q31, int32 (3,) or (N, 3), to q_nb after each in Q30, (4,) or (N, 4).");
    c.def_prop_ro(
        "q_nb",
        [](const T& self)
        {
            const auto out = made<int32_t>({4});
            get(self, out.data);
            return out;
        },
        "Attitude now in Q30, (4,).");
    c.def_ro("count", &T::count, "Previous increments held.");
    copies(c);
}
} // namespace

void bind_fixed(nb::module_& m)
{
    m.attr("Q31_ONE") = INS_Q31_ONE;
    nb::class_<ins_q31_t> q31(m, "Q31", "Attitude from angle increments in integers, 32-bit state. Frame: b -> n.");
    bind(q31, "Q31", "Q31.step", ins_q31_init, ins_q31_step);
    nb::class_<ins_q31w_t> q31w(m, "Q31w", "Attitude from angle increments in integers, 64-bit state. Frame: b -> n.");
    bind(q31w, "Q31w", "Q31w.step", ins_q31w_init, ins_q31w_step);
}

} // namespace libins
