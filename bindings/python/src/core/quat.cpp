/// \file   quat.cpp
/// \brief  Quaternions, Euler angles, direction cosines: ins/quat.h, ins/align.h. SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <nanobind/stl/pair.h>

namespace libins
{
using namespace nb::literals;

namespace
{
Made<ins_real> quat_mul(const Given& p, const Given& q)
{
    Call call("quat_mul");
    const auto left = call.rows<ins_real>("p", p, {4});
    const auto right = call.rows<ins_real>("q", q, {4});
    const auto out = call.out<ins_real>({4});
    call.run([&](size_t k) { ins_quat_mul(left[k], right[k], out[k]); });
    return out;
}

Made<ins_real> quat_rotate(const Given& q_nb, const Given& v_b)
{
    Call call("quat_rotate");
    const auto q = call.rows<ins_real>("q_nb", q_nb, {4});
    const auto v = call.rows<ins_real>("v_b", v_b, {3});
    const auto out = call.out<ins_real>({3});
    call.run([&](size_t k) { ins_quat_rotate(q[k], v[k], out[k]); });
    return out;
}

/// A function of one argument, row by row.
template <typename F>
Made<ins_real> each(Call call, const char* name, const Given& given, const Shape& from, const Shape& to, F function)
{
    const auto in = call.rows<ins_real>(name, given, from);
    const auto out = call.out<ins_real>(to);
    call.run([&](size_t k) { return function(in[k], out[k]); });
    return out;
}

Made<ins_real> align_level(const Given& f_b, const Given& heading)
{
    Call call("align_level", "f_b finite and not zero, |heading| <= 2 pi rad");
    const auto f = call.rows<ins_real>("f_b", f_b, {3});
    const auto h = call.rows<ins_real>("heading", heading, {});
    const auto out = call.out<ins_real>({4});
    call.run([&](size_t k) { return ins_align_level(f[k], *h[k], out[k]); });
    return out;
}

Made<ins_real> align_triad(const Given& first_b, const Given& second_b, const Given& first_n, const Given& second_n)
{
    Call call("align_triad", "finite vectors, first and second not within 1e-3 rad of a line, in b and in n");
    const auto b1 = call.rows<ins_real>("first_b", first_b, {3});
    const auto b2 = call.rows<ins_real>("second_b", second_b, {3});
    const auto n1 = call.rows<ins_real>("first_n", first_n, {3});
    const auto n2 = call.rows<ins_real>("second_n", second_n, {3});
    const auto out = call.out<ins_real>({4});
    call.run([&](size_t k) { return ins_align_triad(b1[k], b2[k], n1[k], n2[k], out[k]); });
    return out;
}

void bind_mean(nb::module_& m)
{
    nb::class_<ins_mean_t> mean(m, "Mean",
                                "Mean of three channels and its standard error: a gyro's null, a force at rest.");
    mean.def(
        "__init__",
        [](ins_mean_t* self, double quantum)
        {
            new (self) ins_mean_t();
            Call("Mean", "quantum >= 0").check(ins_mean_init(self, as_real(quantum)));
        },
        "quantum"_a = 0.0, "quantum: step of a sample, 0 if it has none.");
    mean.def(
        "add",
        [](ins_mean_t& self, const Given& samples)
        {
            Call call("Mean.add", "finite samples");
            const auto in = call.rows<ins_real>("samples", samples, {3});
            call.run([&](size_t k) { return ins_mean_add(&self, in[k]); });
        },
        "samples"_a, "samples: (3,) or (N, 3).");
    mean.def(
        "get",
        [](const ins_mean_t& self)
        {
            const Call call("Mean.get", "two samples or more before");
            const auto value = made<ins_real>({3});
            const auto error = made<ins_real>({3});
            call.check(ins_mean_get(&self, value.data, error.data));
            return std::make_pair(value, error);
        },
        "(mean (3,), standard error (3,)). A channel that is stiller than a third of a quantum has the error quantum / "
        "sqrt(12).");
    mean.def_ro("count", &ins_mean_t::count, "Samples taken.");
    copies(mean);
}
} // namespace

void bind_quat(nb::module_& m)
{
    m.attr("ROTVEC_MAX") = INS_ROTVEC_MAX;
    m.def("quat_mul", quat_mul, "p"_a, "q"_a, "Hamilton product p q, scalar first: (4,) or (N, 4).");
    m.def("quat_rotate", quat_rotate, "q_nb"_a, "v_b"_a, "v_n = q_nb v_b q_nb*: (3,) or (N, 3).");
    m.def(
        "quat_conj",
        [](const Given& q) {
            return each(Call("quat_conj"), "q", q, {4}, {4}, [](const auto* in, auto* out) { ins_quat_conj(in, out); });
        },
        "q"_a, "q*, the inverse rotation of a unit quaternion: (4,) or (N, 4).");
    m.def(
        "quat_normalise",
        [](const Given& q)
        {
            return each(Call("quat_normalise", "q finite, |q| in 1e-15 .. 1e15"), "q", q, {4}, {4},
                        [](const auto* in, auto* out)
                        {
                            std::copy(in, in + 4, out);
                            return ins_quat_normalise(out);
                        });
        },
        "q"_a, "q / |q|: (4,) or (N, 4).");
    m.def(
        "quat_normalise_approx",
        [](const Given& q)
        {
            return each(Call("quat_normalise_approx"), "q", q, {4}, {4},
                        [](const auto* in, auto* out)
                        {
                            std::copy(in, in + 4, out);
                            ins_quat_normalise_approx(out);
                        });
        },
        "q"_a, "First order, q (3/2 - |q|^2 / 2), for norms within 5e-4 of 1: (4,) or (N, 4).");
    m.def(
        "quat_from_rotvec",
        [](const Given& phi)
        {
            return each(Call("quat_from_rotvec", "phi finite, |phi| <= 1000 rad"), "phi", phi, {3}, {4},
                        [](const auto* in, auto* out) { return ins_quat_from_rotvec(in, out); });
        },
        "phi"_a, "Rotation vector [rad], (3,) or (N, 3), to quaternion, (4,) or (N, 4).");
    m.def(
        "quat_from_euler",
        [](const Given& euler)
        {
            return each(Call("quat_from_euler"), "euler", euler, {3}, {4},
                        [](const auto* in, auto* out) { ins_quat_from_euler(in, out); });
        },
        "euler"_a, "Roll, pitch, yaw [rad] of the ZYX sequence, (3,) or (N, 3), to q_nb, (4,) or (N, 4).");
    m.def(
        "quat_to_euler",
        [](const Given& q_nb)
        {
            return each(Call("quat_to_euler"), "q_nb", q_nb, {4}, {3},
                        [](const auto* in, auto* out) { ins_quat_to_euler(in, out); });
        },
        "q_nb"_a, "q_nb, (4,) or (N, 4), to roll, pitch, yaw [rad], (3,) or (N, 3). At a pole of pitch roll is 0.");
    m.def(
        "quat_to_dcm",
        [](const Given& q_nb)
        {
            return each(Call("quat_to_dcm"), "q_nb", q_nb, {4}, {3, 3},
                        [](const auto* in, auto* out) { ins_quat_to_dcm(in, out); });
        },
        "q_nb"_a, "q_nb, (4,) or (N, 4), to C_nb, (3, 3) or (N, 3, 3): v_n = C_nb v_b.");
    m.def(
        "quat_from_dcm",
        [](const Given& C_nb)
        {
            return each(Call("quat_from_dcm", "C_nb a rotation to 1e-3"), "C_nb", C_nb, {3, 3}, {4},
                        [](const auto* in, auto* out) { return ins_quat_from_dcm(in, out); });
        },
        "C_nb"_a, "C_nb, (3, 3) or (N, 3, 3), to q_nb, (4,) or (N, 4).");
    m.def("align_level", align_level, "f_b"_a, "heading"_a,
          "q_nb (NED), (4,) or (N, 4), from the specific force at rest, (3,) or (N, 3), and the heading from north to "
          "east [rad].");
    m.def("align_triad", align_triad, "first_b"_a, "second_b"_a, "first_n"_a, "second_n"_a,
          "q_nb, (4,) or (N, 4), from two directions known in b and in n, (3,) or (N, 3); the first is met exactly.");
    bind_mean(m);
}

} // namespace libins
