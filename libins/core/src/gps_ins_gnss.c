/// \file   gps_ins_gnss.c
/// \brief  Fixes of a GNSS receiver, as late as they come: the antenna then, the rows, the gates. Frames: b, n (NED). SI, rad.
///
/// Of the antenna at t - T, with l = C l_b, u = C (w_ib_b x l_b), D = the change of velocity since less that of gravity:
///     dp_a = dp - T dv + phi x (l - T u)        dv_a = dv + phi x (u - D) + C (l_b x dbg)
/// SPDX-License-Identifier: MIT
#include "earth_internal.h"
#include "gps_ins_internal.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"
#include "strapdown_internal.h"

#define KEEP_NS   (INT64_C(500000000) / (INS_GPS_INS_PAST - 1)) ///< between two instants kept
#define AHEAD     2          ///< periods that a fix may be ahead of the newest sample
#define SIGMA_MAX INS_C(1e6) ///< of a fix [m], [m/s]
#define GRAVITY   INS_C(9.8) ///< of the rows [m/s^2]

/// The antenna of now. \param[out] l, u  [3] as above.
static void antenna(const ins_gps_ins_t* self, ins_real l[3], ins_real u[3], ins_gps_ins_past_t* now)
{
    ins_real turning[3];
    ins_quat_rotate(self->nav.sculling.q_nb, self->cfg.antenna_b, l);
    ins_vec_cross(self->w_ib_b, self->cfg.antenna_b, turning);
    ins_quat_rotate(self->nav.sculling.q_nb, turning, u);
    now->t_ns = self->t_ns;
    for (unsigned i = 0; i < 3; i++)
    {
        now->u_n[i] = self->way_n[i] + l[i];
        now->v_n[i] = self->nav.v_n[i] + u[i];
    }
}

void ins_gps_ins_keep_past(ins_gps_ins_t* self)
{
    ins_real l[3];
    ins_real u[3];
    if (self->held > 0 && self->t_ns - self->past[self->newest].t_ns < KEEP_NS)
    {
        return;
    }
    for (unsigned k = 0; k < INS_GPS_INS_PAST; k++)
    {
        ins_vec_add_scaled(self->past[k].u_n, -1,
                           self->way_n); // the common point is here now, so that float stays fine
    }
    self->way_n[0] = 0;
    self->way_n[1] = 0;
    self->way_n[2] = 0;
    self->newest = (uint_least8_t)((self->newest + 1u) % INS_GPS_INS_PAST);
    self->held = (uint_least8_t)(self->held < INS_GPS_INS_PAST ? self->held + 1 : self->held);
    antenna(self, l, u, &self->past[self->newest]);
}

/// Between two instants, or just after b: cubic in place, linear in velocity.
static void between(const ins_gps_ins_past_t* a, const ins_gps_ins_past_t* b, int64_t t_ns, ins_gps_ins_past_t* out)
{
    const ins_real T = (ins_real)(b->t_ns - a->t_ns) * NS_TO_S;
    const ins_real late = (ins_real)(b->t_ns - t_ns) * NS_TO_S;
    const ins_real s = T > 0 && late > 0 ? late / T : 0; // back from b
    out->t_ns = t_ns;
    for (unsigned i = 0; i < 3; i++)
    {
        const ins_real d = b->u_n[i] - a->u_n[i] - T * b->v_n[i];
        const ins_real bend = T * (b->v_n[i] - a->v_n[i]);
        out->u_n[i] = b->u_n[i] - late * b->v_n[i] - s * s * (3 * d + bend - s * (2 * d + bend));
        out->v_n[i] = b->v_n[i] - s * (b->v_n[i] - a->v_n[i]);
    }
}

/// The antenna at t. \return 0 if the past does not reach it.
static int recall(const ins_gps_ins_t* self, int64_t t_ns, const ins_gps_ins_past_t* now, ins_gps_ins_past_t* then)
{
    const ins_gps_ins_past_t* b = now;
    if (t_ns >= now->t_ns)
    {
        between(now, now, t_ns, then);
        ins_vec_add_scaled(then->v_n, (ins_real)(t_ns - now->t_ns) * NS_TO_S / self->nav.half_period,
                           self->nav.half_dv);
        return (ins_real)(t_ns - now->t_ns) * NS_TO_S <= AHEAD * self->dt;
    }
    for (unsigned k = 0; k < self->held; k++)
    {
        const ins_gps_ins_past_t* a = &self->past[(self->newest + INS_GPS_INS_PAST - k) % INS_GPS_INS_PAST];
        if (t_ns >= a->t_ns)
        {
            between(a, b, t_ns, then);
            return 1;
        }
        b = a;
    }
    return 0;
}

typedef struct epoch_t
{
    const ins_gnss_fix_t* fix;
    ins_real C[9], l[3], u[3];
    ins_real late;        ///< T [s]
    ins_real position[3]; ///< fix less antenna [m]
    ins_real back[3];     ///< velocity of the antenna then less that of the IMU now [m/s]
} epoch_t;

static void position_row(const epoch_t* e, unsigned i, ins_real h[INS_KF15_N])
{
    ins_real arm[3] = {e->l[0], e->l[1], e->l[2]};
    ins_vec_add_scaled(arm, -e->late, e->u);
    gps_ins_cross_row(arm, i, h + INS_KF15_PHI);
    h[INS_KF15_V + i] = -e->late;
    h[INS_KF15_P + i] = 1;
}

static void velocity_row(const ins_gps_ins_t* self, const epoch_t* e, unsigned i, ins_real h[INS_KF15_N])
{
    // u - D; D is u less back, less gravity's part.
    const ins_real turned[3] = {e->back[0], e->back[1], e->back[2] + GRAVITY * e->late};
    gps_ins_cross_row(turned, i, h + INS_KF15_PHI);
    h[INS_KF15_V + i] = 1;
    ins_vec_cross(e->C + 3 * i, self->cfg.antenna_b, h + INS_KF15_BG);
}

/// Judges and uses the components that are known. \param[in] first  0 for position, 3 for velocity. \return 1 if they were used or
/// there were none.
static int use_part(ins_gps_ins_t* self, const epoch_t* e, unsigned first, ins_real gate, ins_real* joint,
                    unsigned* used)
{
    const ins_real* sigma = first == 0 ? e->fix->sigma_p : e->fix->sigma_v;
    gps_ins_rows_t rows = {.n = 0};
    unsigned axis[3];
    for (unsigned i = 0; i < 3; i++)
    {
        if (sigma[i] > 0)
        {
            const unsigned k = rows.n++;
            axis[k] = i;
            rows.r[k] = sigma[i] * sigma[i];
            if (first == 0)
            {
                position_row(e, i, rows.h[k]);
                rows.v[k] = e->position[i];
            }
            else
            {
                velocity_row(self, e, i, rows.h[k]);
                rows.v[k] = e->fix->v_n[i] - (self->nav.v_n[i] + e->back[i]);
            }
        }
    }
    if (rows.n == 0)
    {
        return 1;
    }
    const ins_status_t status = ins_gps_ins_measure(self, &rows, gate);
    for (unsigned k = 0; k < rows.n; k++)
    {
        self->check.innovation[first + axis[k]] = rows.v[k];
        self->check.nis[first + axis[k]] = rows.nis[k];
    }
    *joint = rows.joint;
    *used += status == INS_OK;
    return status == INS_OK;
}

static int is_known(const ins_real value[3], const ins_real sigma[3])
{
    int any = 0;
    for (unsigned i = 0; i < 3; i++)
    {
        if (!(sigma[i] >= 0 && sigma[i] <= SIGMA_MAX) || (sigma[i] > 0 && !(ins_fabs(value[i]) <= INS_REAL_MAX)))
        {
            return -1;
        }
        any |= sigma[i] > 0;
    }
    return any;
}

/// The fixes agree among themselves and not with the filter: its velocity and position are as far off as they say.
static void doubt(ins_gps_ins_t* self, const ins_gnss_fix_t* fix)
{
    ins_real sigma[INS_KF15_N];
    for (unsigned i = 0; i < INS_KF15_N; i++)
    {
        sigma[i] = ins_sqrt(ins_gps_ins_covariance(self, i, i));
    }
    for (unsigned i = 0; i < 3; i++)
    {
        sigma[INS_KF15_V + i] += ins_fabs(self->check.innovation[3 + i]) + fix->sigma_v[i];
        sigma[INS_KF15_P + i] += ins_fabs(self->check.innovation[i]) + fix->sigma_p[i];
    }
    ins_gps_ins_restart(self, sigma);
    self->count.fix_doubts++;
    self->refused = 0;
}

ins_status_t ins_gps_ins_gnss(ins_gps_ins_t* self, const ins_gnss_fix_t* fix)
{
    static const ins_gps_ins_check_t nothing; // all 0
    ins_gps_ins_past_t now;
    ins_gps_ins_past_t then;
    epoch_t e = {.fix = fix};
    ins_real ned[3];
    if (self->lost)
    {
        return INS_E_STATE;
    }
    self->check = nothing;
    ins_position_difference(&self->nav.position, &fix->position, ned);
    const int position = is_known(ned, fix->sigma_p);
    const int velocity = is_known(fix->v_n, fix->sigma_v);
    if (position < 0 || velocity < 0 || !(position || velocity))
    {
        self->count.fix_refused++;
        return INS_E_RANGE;
    }
    antenna(self, e.l, e.u, &now);
    const int64_t t_ns = fix->t_ns + (int64_t)(self->cfg.gnss_late / NS_TO_S);
    if (fix->t_ns > INS_GNSS_TIME_MAX_NS || fix->t_ns < -INS_GNSS_TIME_MAX_NS || !recall(self, t_ns, &now, &then))
    {
        self->count.fix_time++;
        return INS_E_RANGE;
    }
    ins_gps_ins_settle(self);
    ins_quat_to_dcm(self->nav.sculling.q_nb, e.C);
    e.late = (ins_real)(self->t_ns - t_ns) * NS_TO_S;
    for (unsigned i = 0; i < 3; i++)
    {
        e.position[i] = ned[i] + self->way_n[i] - then.u_n[i];
        e.back[i] = then.v_n[i] - self->nav.v_n[i];
    }
    unsigned used = 0;
    const ins_gps_ins_config_t* c = &self->cfg;
    const int good = use_part(self, &e, 0, c->gate_position, &self->check.nis_position, &used);
    const int moves = use_part(self, &e, 3, c->gate_velocity, &self->check.nis_velocity, &used);
    self->count.fix_position += !good;
    self->count.fix_velocity += !moves;
    self->count.fixes += used > 0;
    self->refused = (uint16_t)(good && moves ? 0 : self->refused + 1);
    if (c->refused_max > 0 && self->refused > c->refused_max)
    {
        doubt(self, fix);
    }
    return used > 0 ? INS_OK : INS_E_GATE;
}
