/// \file   gps_ins_internal.h
/// \brief  What the parts of the GPS/INS filter share. Frames: b, n (NED). SI, rad.
/// SPDX-License-Identifier: MIT
#ifndef INS_GPS_INS_INTERNAL_H_INCLUDED
#define INS_GPS_INS_INTERNAL_H_INCLUDED
#include "ins/gps_ins.h"

#define NS_TO_S        INS_C(1e-9)
#define GPS_INS_GYROS  0x07u ///< bits of stuck
#define GPS_INS_ACCELS 0x38u

/// Some scalars that are judged together and then used one after the other.
typedef struct gps_ins_rows_t
{
    unsigned n; ///< up to 3
    ins_real h[3][INS_KF15_N];
    ins_real v[3]; ///< measured less estimated
    ins_real r[3];
    ins_real nis[3]; ///< out: of each, given those before it
    ins_real joint;  ///< out
} gps_ins_rows_t;

/// P(i,j).
ins_real ins_gps_ins_covariance(const ins_gps_ins_t* self, unsigned i, unsigned j);
/// What self is the base of.
enum
{
    GPS_INS_P,    ///< nothing
    GPS_INS_UD,   ///< an ins_gps_ins_ud_t
    GPS_INS_SCALE ///< an ins_gps_ins_scale_t
};
/// The factors, of GPS_INS_UD.
static inline ins_kf15_ud_t* gps_ins_ud(ins_gps_ins_t* self)
{
    return &((ins_gps_ins_ud_t*)self)->ud; // self is its first member
}
/// Of GPS_INS_SCALE; so are the functions ins_gps_ins_scale_* that follow.
static inline ins_gps_ins_scale_t* gps_ins_scale(ins_gps_ins_t* self)
{
    return (ins_gps_ins_scale_t*)self;
}
/// P begins anew: what goes with it.
void ins_gps_ins_scale_part(ins_gps_ins_t* base);
/// Scale factors out of a sample without its biases, and their decay over it.
void ins_gps_ins_scale_take_off(ins_gps_ins_t* base, ins_real dt, ins_increment_t* x);
/// Angle that the next step of the covariance is over.
void ins_gps_ins_scale_pend(ins_gps_ins_t* base, const ins_real theta_b[3]);
/// That step, by base->model.
void ins_gps_ins_scale_propagate(ins_gps_ins_t* base, const ins_real v_b[3]);
/// What the scale factors add to a P b' of two rows.
ins_real ins_gps_ins_scale_product(ins_gps_ins_t* base, const ins_real a[INS_KF15_N], const ins_real b[INS_KF15_N]);
/// ins_kf15_update() of all; those before it since the last correction are taken off z->v.
ins_status_t ins_gps_ins_scale_update(ins_gps_ins_t* base, const ins_real h[INS_KF15_N], ins_innovation_t* z);
/// What updates found goes into the scale factors.
void ins_gps_ins_scale_correct(ins_gps_ins_t* base);
/// Begins P anew.
void ins_gps_ins_restart(ins_gps_ins_t* self, const ins_real sigma[INS_KF15_N]);
/// Brings the covariance up to the last sample.
void ins_gps_ins_settle(ins_gps_ins_t* self);
/// Judges by the joint NIS, then corrects. \return INS_OK; INS_E_GATE; INS_E_RANGE. Refused: nothing is changed.
ins_status_t ins_gps_ins_measure(ins_gps_ins_t* self, gps_ins_rows_t* rows, ins_real gate);
/// How the time of a sample follows the last one's. \param[out] gap  time between them that no sample covers [s].
ins_status_t ins_gps_ins_follow(ins_gps_ins_t* self, int64_t t_ns, ins_real dt, ins_real* gap);
/// Keeps the antenna of now, if it is time to.
void ins_gps_ins_keep_past(ins_gps_ins_t* self);
/// What detectors see in the last sample: dead axes, rest. \param[in] raw  as it came. \param[in] x  biases taken off.
void ins_gps_ins_watch(ins_gps_ins_t* self, const ins_increment_t* raw, const ins_increment_t* x);

/// Row of a x b = -[b x] a for an a that is estimated: element i, over the three columns of a.
static inline void gps_ins_cross_row(const ins_real b[3], unsigned i, ins_real columns[3])
{
    const unsigned j = (i + 1) % 3;
    const unsigned k = (i + 2) % 3;
    columns[i] = 0;
    columns[j] = b[k];
    columns[k] = -b[j];
}

#endif // INS_GPS_INS_INTERNAL_H_INCLUDED
