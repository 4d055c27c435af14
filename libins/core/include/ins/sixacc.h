/// \file   ins/sixacc.h
/// \brief  Motion from six or more accelerometers without gyros: angular acceleration, rate, specific force. Frame: b. SI.
///
///     ins_accel_t a[6];
///     ins_sixacc_t s;
///     ins_sixacc_paper(INS_C(0.1), a);                      // or any N >= 6 of your own
///     ins_sixacc_init(&s, 6, a, period_s);
///     for (;;) { ins_sixacc_step(&s, readings, &increment); }   // increment goes to ins_strapdown_step
///
/// Accelerometer j reads bias_j + axis_j . (f + wd x r_j + w x (w x r_j)), f the raw specific force at the origin: gravity is not in
/// it, and is added after resolving, by the strapdown. axis_j need not be of unit length: scale factor and misalignment are in it,
/// so the linear map of a calibration (ins_linfit_t) is applied by putting its rows here. The inverse is by least squares.
/// Source: C.-Y. Hung, C.-M. Fang, C.-Y. Wang, S.-C. Lee, The Research of Six-Accelerometers Schemes and Orientation Calibration
/// Method for Navigation Application, tables 1 and 2, equations 7 to 12, with the corrections of docs/sixacc.md.
/// SPDX-License-Identifier: MIT
#ifndef INS_SIXACC_H_INCLUDED
#define INS_SIXACC_H_INCLUDED
#include "ins/config.h"
#include "ins/sculling.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_SIXACC_MAX 12 ///< accelerometers

typedef struct ins_accel_t
{
    ins_real bias;    ///< in units of the reading
    ins_real axis[3]; ///< reading per m/s^2, in b
    ins_real r[3];    ///< place [m], in b
} ins_accel_t;

/// Geometry, and the state of the rate's integration. Owned by the caller.
typedef struct ins_sixacc_t
{
    uint_least8_t count;
    uint_least8_t started;
    ins_real period_s;
    ins_real bias[INS_SIXACC_MAX];
    ins_real inverse[6][INS_SIXACC_MAX]; ///< readings less biases -> wd, f
    ins_real product[6][6];              ///< wx wx, wy wy, wz wz, wx wy, wx wz, wy wz -> what they add to wd, f
    ins_real w_ib_b[3];                  ///< rate at the last sample [rad/s]; set it to start with a known one
    ins_real linear[6];                  ///< inverse times the last sample
    ins_real wd_ib_b[3];                 ///< angular acceleration at the last sample [rad/s^2]
} ins_sixacc_t;

/// The paper's six, arm rho [m]. \param[out] accels  [6].
INS_API void ins_sixacc_paper(ins_real rho, ins_accel_t accels[6]);
/// A reading without its accelerometer's quadratic term, which `ins calib` finds: for bias + s (x + k2 x^2) it is bias + s x, with s
/// the length of the axis. Where k2 matters, each reading goes through it before the rest of this header; it is one square root.
/// \param[in] k2  [s^2/m]. \return of a reading beyond the parabola's turn, that of the turn.
INS_API ins_real ins_accel_linear(const ins_accel_t* accel, ins_real k2, ins_real reading);
/// Rate 0. \return INS_OK; INS_E_RANGE unless 6 <= count <= INS_SIXACC_MAX, period_s > 0, all numbers finite and the six unknowns
/// observable.
INS_API ins_status_t ins_sixacc_init(ins_sixacc_t* self, unsigned count, const ins_accel_t* accels, ins_real period_s);
/// One instant, for a known rate. \param[in] readings  [count]. \param[out] wd_ib_b  [3] [rad/s^2]. \param[out] f_b  [3] [m/s^2].
INS_API void ins_sixacc_resolve(const ins_sixacc_t* self, const ins_real* readings, const ins_real w_ib_b[3],
                                ins_real wd_ib_b[3], ins_real f_b[3]);
/// Next sample: rate by the trapezoid of the angular acceleration, products of the rate taken at mid-interval.
/// \param[in] readings  [count]. \param[out] increment  over the last period; zero for the first sample.
/// \return INS_OK; INS_S_START for the first sample; INS_E_RANGE for NaN or infinity, and then self is unchanged.
INS_API ins_status_t ins_sixacc_step(ins_sixacc_t* self, const ins_real* readings, ins_increment_t* increment);

/// Linear map of accelerometers from readings in known attitudes: P = map[0] + map[1..3] . a, by least squares on [1, a], taken in
/// row by row with Givens rotations (no normal equations: float keeps its digits). The memory is the caller's, whatever the rows.
typedef struct ins_linfit_t
{
    uint_least8_t count;                ///< accelerometers
    ins_real R[4 * 4];                  ///< upper triangle
    ins_real z[INS_SIXACC_MAX * 4];     ///< right-hand sides
    ins_real residual2[INS_SIXACC_MAX]; ///< sum of squared residuals
} ins_linfit_t;

/// \return INS_OK; INS_E_RANGE unless 1 <= count <= INS_SIXACC_MAX.
INS_API ins_status_t ins_linfit_init(ins_linfit_t* self, unsigned count);
/// \param[in] f_b  [3] specific force [m/s^2]. \param[in] readings  [count]. \return INS_OK; INS_E_RANGE for NaN, unchanged.
INS_API ins_status_t ins_linfit_add(ins_linfit_t* self, const ins_real f_b[3], const ins_real* readings);
/// \param[out] map  [4] of accelerometer `index`: bias, axis. \return INS_OK; INS_E_STATE while the attitudes seen do not fix it;
/// INS_E_RANGE for a wrong index.
INS_API ins_status_t ins_linfit_solve(const ins_linfit_t* self, unsigned index, ins_real map[4]);

#ifdef __cplusplus
}
#endif
#endif // INS_SIXACC_H_INCLUDED
