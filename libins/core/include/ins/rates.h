/// \file   ins/rates.h
/// \brief  Point-sampled angular rates -> angle increments (an ADC gives samples, not integrals). Frame: b. Units: rad/s -> rad.
///
/// Two steps, in this order: the channels of one scan are brought to one instant (ins_skew_t), then the rate is integrated over the
/// sampling interval with an Adams-Moulton formula (ins_rates_t). Never a rectangle: it lags by half a sample.
/// Source: Adams-Moulton coefficients in standard form, e.g. Hairer, Norsett, Wanner, Solving ODEs I, III.1.
/// SPDX-License-Identifier: MIT
#ifndef INS_RATES_H_INCLUDED
#define INS_RATES_H_INCLUDED
#include "ins/config.h"
#ifdef __cplusplus
extern "C" {
#endif

#define INS_RATES_ORDER_MAX 5

/// Integrator. order 2 = trapezoid (2 samples), 3 = AM3, 4 = AM4, 5 = AM5. Start-up uses what samples there are.
typedef struct ins_rates_t
{
    uint_least8_t order;
    uint_least8_t count;                ///< samples held, 0..order
    ins_real T;                         ///< sampling period [s]
    ins_real w[INS_RATES_ORDER_MAX][3]; ///< newest first [rad/s]
} ins_rates_t;

/// \return INS_OK; INS_E_RANGE unless order is 2..5 and period_s > 0.
INS_API ins_status_t ins_rates_init(ins_rates_t* self, uint_least8_t order, ins_real period_s);
/// Next sample. \param[out] dtheta_b [3] increment over the last period [rad]; zero for the very first sample.
/// \return INS_OK; INS_S_START with fewer than `order` samples; INS_E_RANGE for NaN or infinity, self unchanged.
INS_API ins_status_t ins_rates_add(ins_rates_t* self, const ins_real w_ib_b[3], ins_real dtheta_b[3]);
/// Next sample after `missing` lost ones (>= 1): trapezoid over (missing + 1) periods; the history restarts here.
INS_API ins_status_t ins_rates_bridge(ins_rates_t* self, uint32_t missing, const ins_real w_ib_b[3],
                                      ins_real dtheta_b[3]);

/// Channel-skew compensation: channel i is sampled delay_s[i] after the scan's instant; each is interpolated back to it with a
/// polynomial through its last samples (order 1 linear, 2 parabola, 3 cubic).
typedef struct ins_skew_t
{
    uint_least8_t order;
    uint_least8_t count;
    ins_real fraction[3]; ///< delay / period, 0 <= . < 1
    ins_real x[4][3];     ///< newest first
} ins_skew_t;

/// \param[in] delay_s [3], 0 <= delay < period. \return INS_OK or INS_E_RANGE.
INS_API ins_status_t ins_skew_init(ins_skew_t* self, uint_least8_t order, const ins_real delay_s[3], ins_real period_s);
/// \param[in] raw [3] as sampled; \param[out] out [3] at the scan's instant; may be the same array.
INS_API ins_status_t ins_skew_add(ins_skew_t* self, const ins_real raw[3], ins_real out[3]);
/// After lost samples: keep only what comes next.
INS_API void ins_skew_restart(ins_skew_t* self);

#ifdef __cplusplus
}
#endif
#endif // INS_RATES_H_INCLUDED
