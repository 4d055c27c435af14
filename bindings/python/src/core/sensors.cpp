/// \file   sensors.cpp
/// \brief  Six or more accelerometers, their linear and their full calibration: ins/sixacc.h, ins/accelfit.h.
/// SPDX-License-Identifier: MIT
#include "accels.hpp"
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>

namespace libins
{
using namespace nb::literals;

std::vector<ins_accel_t> accels_of(const Call& call, const Given& bias, const Given& axis, const Given& r)
{
    const auto biases = call.whole<ins_real>("bias", bias, {ANY});
    const size_t n = biases.shape[0];
    const auto axes = call.whole<ins_real>("axis", axis, {n, 3});
    const auto places = call.whole<ins_real>("r", r, {n, 3});
    std::vector<ins_accel_t> accels(n);
    for (size_t j = 0; j < n; j++)
    {
        accels[j].bias = biases.data[j];
        std::copy(axes.data + 3 * j, axes.data + 3 * j + 3, accels[j].axis);
        std::copy(places.data + 3 * j, places.data + 3 * j + 3, accels[j].r);
    }
    return accels;
}

namespace
{
constexpr size_t PAPER = 6; ///< accelerometers of the paper's geometry

std::tuple<Made<ins_real>, Made<ins_real>, Made<ins_real>> sixacc_paper(double rho)
{
    ins_accel_t accels[PAPER];
    ins_sixacc_paper(as_real(rho), accels);
    const auto bias = made<ins_real>({PAPER});
    const auto axis = made<ins_real>({PAPER, 3});
    const auto r = made<ins_real>({PAPER, 3});
    for (size_t j = 0; j < PAPER; j++)
    {
        bias.data[j] = accels[j].bias;
        std::copy(accels[j].axis, accels[j].axis + 3, axis.data + 3 * j);
        std::copy(accels[j].r, accels[j].r + 3, r.data + 3 * j);
    }
    return {bias, axis, r};
}

Made<ins_real> accel_linear(const Given& bias, const Given& axis, const Given& k2, const Given& readings)
{
    Call call("accel_linear");
    const auto biases = call.whole<ins_real>("bias", bias, {ANY});
    const size_t n = biases.shape[0];
    const auto axes = call.whole<ins_real>("axis", axis, {n, 3});
    const auto terms = call.whole<ins_real>("k2", k2, {n});
    const auto in = call.rows<ins_real>("readings", readings, {n});
    const auto out = call.out<ins_real>({n});
    call.run(
        [&](size_t k)
        {
            for (size_t j = 0; j < n; j++)
            {
                const ins_real* u = axes.data + 3 * j;
                const ins_accel_t accel = {biases.data[j], {u[0], u[1], u[2]}, {0, 0, 0}};
                out[k][j] = ins_accel_linear(&accel, terms.data[j], in[k][j]);
            }
        });
    return out;
}

void init(ins_sixacc_t* self, const Given& bias, const Given& axis, const Given& r, double period_s)
{
    new (self) ins_sixacc_t();
    const Call call("Sixacc", "6 to 12 accelerometers, finite, that see all six unknowns; period_s > 0");
    const auto accels = accels_of(call, bias, axis, r);
    call.check(ins_sixacc_init(self, static_cast<unsigned>(accels.size()), accels.data(), as_real(period_s)));
}

void bind_sixacc(nb::module_& m)
{
    m.attr("SIXACC_MAX") = INS_SIXACC_MAX;
    m.def("sixacc_paper", sixacc_paper, "rho"_a,
          "(bias (6,), axis (6, 3), r (6, 3)) of the paper's six on an arm of rho [m].");
    m.def("accel_linear", accel_linear, "bias"_a, "axis"_a, "k2"_a, "readings"_a,
          "Readings (n,) or (N, n) without the quadratic terms k2 (n,) [s^2/m] of accelerometers as Sixacc has them.");
    nb::class_<ins_sixacc_t> sixacc(
        m, "Sixacc", "Angular acceleration, rate and specific force from accelerometers alone. Frame: b.");
    sixacc.def("__init__", init, "bias"_a, "axis"_a, "r"_a, "period_s"_a,
               "bias: (n,) in units of the reading. axis: (n, 3) reading per m/s^2. r: (n, 3) place [m].");
    sixacc.def(
        "resolve",
        [](const ins_sixacc_t& self, const Given& readings, const Given& w_ib_b)
        {
            Call call("Sixacc.resolve");
            const auto in = call.rows<ins_real>("readings", readings, {self.count});
            const auto w = call.rows<ins_real>("w_ib_b", w_ib_b, {3});
            const auto wd = call.out<ins_real>({3});
            const auto f = call.out<ins_real>({3});
            call.run([&](size_t k) { ins_sixacc_resolve(&self, in[k], w[k], wd[k], f[k]); });
            return std::make_pair(wd, f);
        },
        "readings"_a, "w_ib_b"_a,
        "Readings (n,) or (N, n) at known rates [rad/s], (3,) or (N, 3), to (angular acceleration [rad/s^2], specific "
        "force [m/s^2]).");
    sixacc.def(
        "step",
        [](ins_sixacc_t& self, const Given& readings)
        {
            Call call("Sixacc.step", "finite readings");
            const auto in = call.rows<ins_real>("readings", readings, {self.count});
            const auto theta = call.out<ins_real>({3});
            const auto v = call.out<ins_real>({3});
            call.run(
                [&](size_t k)
                {
                    ins_increment_t x;
                    const ins_status_t status = ins_sixacc_step(&self, in[k], &x);
                    std::copy(x.theta_b, x.theta_b + 3, theta[k]);
                    std::copy(x.v_b, x.v_b + 3, v[k]);
                    return status;
                });
            return std::make_pair(theta, v);
        },
        "readings"_a,
        "Readings (n,) or (N, n) to increments of angle [rad] and velocity [m/s] over the period before each; zero for "
        "the first.");
    writes(sixacc, "w_ib_b", &ins_sixacc_t::w_ib_b, {3},
           "Rate at the last sample, (3,) [rad/s]; set it to start with a known one.");
    reads(sixacc, "wd_ib_b", &ins_sixacc_t::wd_ib_b, {3}, "Angular acceleration at the last sample, (3,) [rad/s^2].");
    copies(sixacc);
}

void bind_linfit(nb::module_& m)
{
    nb::class_<ins_linfit_t> linfit(m, "Linfit",
                                    "Linear maps of accelerometers, bias and axis, from readings in known attitudes.");
    linfit.def(
        "__init__",
        [](ins_linfit_t* self, unsigned count)
        {
            new (self) ins_linfit_t();
            Call("Linfit", "count 1..12").check(ins_linfit_init(self, count));
        },
        "count"_a, "count: accelerometers.");
    linfit.def(
        "add",
        [](ins_linfit_t& self, const Given& f_b, const Given& readings)
        {
            Call call("Linfit.add", "finite numbers");
            const auto f = call.rows<ins_real>("f_b", f_b, {3});
            const auto in = call.rows<ins_real>("readings", readings, {self.count});
            call.run([&](size_t k) { return ins_linfit_add(&self, f[k], in[k]); });
        },
        "f_b"_a, "readings"_a, "Specific force [m/s^2], (3,) or (N, 3), and what was read, (count,) or (N, count).");
    linfit.def(
        "solve",
        [](const ins_linfit_t& self)
        {
            const Call call("Linfit.solve", "attitudes that fix four unknowns");
            const auto map = made<ins_real>({self.count, 4});
            for (unsigned j = 0; j < self.count; j++)
            {
                call.check(ins_linfit_solve(&self, j, map.data + 4 * j));
            }
            return map;
        },
        "(count, 4), a row an accelerometer: bias, then its axis [reading per m/s^2].");
    linfit.def_prop_ro(
        "residual2", [](const ins_linfit_t& self) { return copy_of(self.residual2, {self.count}); },
        "Sum of squared residuals, (count,).");
    copies(linfit);
}

/// Rows of f_b, w_ib_b and wd_ib_b as the core takes them.
class Motions
{
  public:
    Motions(Call& call, const Given& f_b, const Given& w_ib_b, const Given& wd_ib_b)
        : f_(call.rows<ins_real>("f_b", f_b, {3})), w_(call.rows<ins_real>("w_ib_b", w_ib_b, {3})),
          wd_(call.rows<ins_real>("wd_ib_b", wd_ib_b, {3}))
    {
    }
    ins_accelfit_motion_t operator[](size_t k) const
    {
        ins_accelfit_motion_t motion;
        std::copy(f_[k], f_[k] + 3, motion.f_b);
        std::copy(w_[k], w_[k] + 3, motion.w_ib_b);
        std::copy(wd_[k], wd_[k] + 3, motion.wd_ib_b);
        return motion;
    }

  private:
    Taken<ins_real> f_, w_, wd_;
};

void bind_accelfit(nb::module_& m)
{
    nb::class_<ins_accelfit_t> fit(
        m, "Accelfit", "One accelerometer in full, by least squares over known motions: b, SF, m1, m2, k2, r.");
    fit.def(
        "__init__",
        [](ins_accelfit_t* self, const Given& u0, const Given& e1, const Given& e2, const Given& p)
        {
            new (self) ins_accelfit_t();
            const Call call("Accelfit", "finite numbers, u0 not zero, SF not zero");
            const auto nominal = call.whole<ins_real>("u0", u0, {3});
            const auto first = call.whole<ins_real>("e1", e1, {3});
            const auto second = call.whole<ins_real>("e2", e2, {3});
            const auto guess = call.whole<ins_real>("p", p, {INS_ACCELFIT_N});
            call.check(ins_accelfit_init(self, nominal.data, first.data, second.data, guess.data));
        },
        "u0"_a, "e1"_a, "e2"_a, "p"_a,
        "u0, e1, e2: (3,), nominal axis and the directions of m1 and m2. p: (8,), first guess.");
    fit.def(
        "predict",
        [](const ins_accelfit_t& self, const Given& f_b, const Given& w_ib_b, const Given& wd_ib_b)
        {
            Call call("Accelfit.predict");
            const Motions motions(call, f_b, w_ib_b, wd_ib_b);
            const auto reading = call.out<ins_real>({});
            const auto jacobian = call.out<ins_real>({INS_ACCELFIT_N});
            call.run(
                [&](size_t k)
                {
                    const ins_accelfit_motion_t motion = motions[k];
                    *reading[k] = ins_accelfit_predict(&self, &motion, jacobian[k]);
                });
            return std::make_pair(reading, jacobian);
        },
        "f_b"_a, "w_ib_b"_a, "wd_ib_b"_a,
        "Specific force [m/s^2], rate [rad/s], angular acceleration [rad/s^2] of the body, (3,) or (N, 3), to (what p "
        "reads, () or "
        "(N,); its derivatives by p, (8,) or (N, 8)).");
    fit.def(
        "add",
        [](ins_accelfit_t& self, const Given& f_b, const Given& w_ib_b, const Given& wd_ib_b, const Given& readings)
        {
            Call call("Accelfit.add", "finite numbers");
            const Motions motions(call, f_b, w_ib_b, wd_ib_b);
            const auto read = call.rows<ins_real>("readings", readings, {});
            call.run(
                [&](size_t k)
                {
                    const ins_accelfit_motion_t motion = motions[k];
                    return ins_accelfit_add(&self, &motion, *read[k]);
                });
        },
        "f_b"_a, "w_ib_b"_a, "wd_ib_b"_a, "readings"_a, "Measurements: motions as in predict, readings () or (N,).");
    fit.def(
        "step",
        [](ins_accelfit_t& self)
        {
            ins_real largest = 0;
            Call("Accelfit.step", "rows that fix all eight parameters").check(ins_accelfit_step(&self, &largest));
            return static_cast<double>(largest);
        },
        "End a pass: move p by the least-squares step, begin the next. Returns the largest component of the step.");
    fit.def(
        "deviation",
        [](const ins_accelfit_t& self, double sigma)
        {
            const auto out = made<ins_real>({INS_ACCELFIT_N});
            Call("Accelfit.deviation", "sigma >= 0, rows that fix all eight parameters")
                .check(ins_accelfit_deviation(&self, as_real(sigma), out.data));
            return out;
        },
        "sigma"_a, "Standard deviations of p, (8,), by the rows of this pass, for a sigma of one reading.");
    reads(fit, "p", &ins_accelfit_t::p, {INS_ACCELFIT_N}, "b [m/s^2], SF, m1, m2, k2 [s^2/m], r [m], (8,).");
    fit.def_ro("residual2", &ins_accelfit_t::residual2, "Sum of squared residuals about p of this pass.");
    fit.def_ro("rows", &ins_accelfit_t::rows, "Rows of this pass.");
    copies(fit);
}
} // namespace

void bind_sensors(nb::module_& m)
{
    bind_accelfit(m);
    bind_sixacc(m);
    bind_linfit(m);
}

} // namespace libins
