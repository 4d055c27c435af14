/// \file   ins_calib/calib.h
/// \brief  Accelerometers from readings in known attitudes: the linear map, and the paper's estimator. Frame: b. SI.
///
///     P_j = map[0] + map[1..3] . f          f = g times the upward vertical in b, at rest
///
/// The linear map is exact whatever the angles, and is what core takes: map[0] is ins_accel_t.bias, map[1..3] its axis.
/// The paper's estimator (three accelerometers, six attitudes) also gives scale factors, biases and angles; put back into the
/// trigonometric model they cost 1e-3 m/s^2, so use its map, not its angles.
/// Source: C.-Y. Hung, C.-M. Fang, C.-Y. Wang, S.-C. Lee, The Research of Six-Accelerometers Schemes and Orientation Calibration
/// Method for Navigation Application: (13) to (20) the model, (21) to (25) the estimator, tables 3 and 4 the attitudes.
/// SPDX-License-Identifier: MIT
#ifndef INS_CALIB_CALIB_H_INCLUDED
#define INS_CALIB_CALIB_H_INCLUDED
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif

#define INS_CALIB_API __attribute__((visibility("default")))

// Every function that can refuse writes the place, the value found and what would be right into why[why_size] (why may be NULL).
enum
{
    INS_CALIB_OK = 0,
    INS_CALIB_E_INPUT = -1,      ///< a value that cannot be: NaN, wrong size, not positive
    INS_CALIB_E_RANK = -2,       ///< these poses do not fix all that is asked for; why says what, and which poses would
    INS_CALIB_E_CONVERGENCE = -3 ///< no minimum found
};

typedef struct ins_calib_map_t
{
    double map[4]; ///< bias in units of the reading, axis [reading per m/s^2]
    double deviation
        [4];    ///< standard deviations of map, by the residuals; 0 where there are no more readings than unknowns
    double rms; ///< of the residuals, in units of the reading
} ins_calib_map_t;

/// Least squares on [1, f], one accelerometer at a time.
/// \param[in] f_b  [poses][3] specific force. \param[in] readings  [poses][sensors]. \param[out] maps  [sensors].
/// \param[out] residuals  [poses][sensors] reading less map, or NULL.
INS_CALIB_API int ins_calib_linear(size_t sensors, size_t poses, const double* f_b, const double* readings,
                                   ins_calib_map_t* maps, double* residuals, char* why, size_t why_size);

/// The paper's two groups of three accelerometers.
typedef enum ins_calib_group_t
{
    INS_CALIB_235, ///< #2, #3, #5: angles Delta beta, attitudes of table 3
    INS_CALIB_146  ///< #1, #4, #6: angles Delta alpha, attitudes of table 4
} ins_calib_group_t;

#define INS_CALIB_PAPER_ROWS 18 ///< three accelerometers in six attitudes, accelerometer by accelerometer

typedef struct ins_calib_paper_t
{
    double sf[3];                          ///< (21), (23): not the physical scale, which is |axis| of the map
    double bias[3];                        ///< [m/s^2]
    double angle[6];                       ///< xy, xz, yx, yz, zx, zy [rad]
    double H[INS_CALIB_PAPER_ROWS * 9];    ///< (22), columns: biases, angles
    double map[3][4];                      ///< SF b and SF row: what reproduces the readings
    double residual[INS_CALIB_PAPER_ROWS]; ///< reading / T less map [m/s^2 times SF]
} ins_calib_paper_t;

/// Specific force in the group's six attitudes, tables 3 and 4. \param[out] f_b  [6][3].
INS_CALIB_API void ins_calib_paper_attitudes(ins_calib_group_t group, double g, double f_b[18]);
/// The three axes of sense under the six angles xy, xz, yx, yz, zx, zy [rad]: C_a^a' C_b^a.
/// \param[in] exact  not 0: the printed product (13), which reproduces table 7; 0: to first order, (14). \param[out] axes  [3][3].
INS_CALIB_API void ins_calib_paper_axes(ins_calib_group_t group, const double angle[6], int exact, double axes[9]);
/// Equations (21) to (25). \param[in] T  time of accumulation: readings are P = SF T (b + axis . f).
/// \param[in] readings  [3][6], in the order of the group's numbers and attitudes.
INS_CALIB_API int ins_calib_paper(ins_calib_group_t group, double g, double T,
                                  const double readings[INS_CALIB_PAPER_ROWS], ins_calib_paper_t* out, char* why,
                                  size_t why_size);

#ifdef __cplusplus
}
#endif
#endif // INS_CALIB_CALIB_H_INCLUDED
