/// \file   gps_dr.c
/// \brief  Decentralised GPS and dead reckoning: alignment by a sum of headings, information sharing, switch.
/// SPDX-License-Identifier: MIT
#include "ins/gps_dr.h"
#include "elementary_internal.h"
#include "ins/ins_math.h"

#define STATES      6
#define HALF_CIRCLE INS_C(3.14159265358979323846)
#define SHARE       2            ///< each of the two local filters has 1/2 of the information
#define FREEDOM     4            ///< degrees of freedom of the Student's t of a fix
#define WEIGHT_MIN  INS_C(1e-4)  ///< of a heading, over the best one's
#define HEADING_VAR INS_C(0.09)  ///< below it all headings are one [rad^2]
#define SPEED_VAR   INS_C(100.0) ///< before the first distance [(m/s)^2]
#define STILL_VAR   INS_C(1e-4)  ///< of the speed when it stands [(m/s)^2]
#define PERIOD_MIN  INS_C(1e-3)  ///< between fixes [s]

void ins_gps_dr_config_default(ins_gps_dr_config_t* cfg)
{
    static const ins_gps_dr_config_t car = {{0, INS_C(1e-9), INS_C(1e-8), INS_C(2.5e-5), INS_C(1e-5), 0, 0},
                                            {4, INS_KALMAN_GATE2_99, 4, INS_SWITCH_BACK_GOOD},
                                            INS_C(5e-3),
                                            INS_C(0.02),
                                            20,
                                            100,
                                            INS_C(0.3),
                                            2,
                                            1,
                                            INS_C(2.5),
                                            5};
    *cfg = car;
}

ins_status_t ins_gps_dr_init(ins_gps_dr_t* self, const ins_gps_dr_config_t* cfg)
{
    static const ins_gps_dr_t zero; // all 0
    static const ins_real nothing[STATES] = {0};
    ins_unicycle_t vehicle;
    ins_switch_t choice;
    if (!(cfg->sigma_bias >= 0) || !(cfg->sigma_scale >= 0) || !(cfg->tau_fix >= 0) || !(cfg->gate_gross >= 0) ||
        !(cfg->sigma_velocity >= 0) || !(cfg->course_min >= 0) || !(cfg->still_after >= 0) ||
        !(cfg->fix_max_age >= 0) || ins_unicycle_init(&vehicle, &cfg->vehicle, nothing, nothing) != INS_OK ||
        ins_switch_init(&choice, &cfg->choice) != INS_OK)
    {
        return INS_E_RANGE;
    }
    *self = zero;
    self->cfg = *cfg;
    self->choice = choice;
    return INS_OK;
}

/// Everything that was known about the vehicle is that it is at the fix.
static void start(ins_gps_dr_t* self, const ins_gps_dr_fix_t* fix)
{
    const ins_real spread = HALF_CIRCLE / INS_GPS_DR_HEADINGS;
    const ins_gps_dr_config_t* const c = &self->cfg;
    const ins_real r = fix->sigma * fix->sigma;
    const ins_real var[STATES] = {
        r, r, spread * spread, SPEED_VAR, c->sigma_bias * c->sigma_bias, c->sigma_scale * c->sigma_scale};
    self->count = INS_GPS_DR_HEADINGS;
    self->paired = 0;
    self->gross_run = 0;
    for (unsigned i = 0; i < self->count; i++)
    {
        const ins_real x[STATES] = {fix->east, fix->north, 2 * spread * (ins_real)i, 0, 0, 1};
        (void)ins_unicycle_init(&self->local[i], &c->vehicle, x, var); // figures that have been checked
        self->weight[i] = 1;
    }
}

/// The two local filters: the same state, half of the information each.
static void share(ins_gps_dr_t* self, const ins_real x[STATES], const ins_real P[STATES * STATES])
{
    for (unsigned i = 0; i < SHARE; i++)
    {
        ins_unicycle_t* const local = &self->local[i];
        local->cfg = self->cfg.vehicle;
        local->cfg.q_bias *= SHARE;
        local->cfg.q_scale *= SHARE;
        local->cfg.r_rate *= SHARE;
        local->cfg.r_distance *= SHARE;
        for (unsigned k = 0; k < STATES; k++)
        {
            local->x[k] = x[k];
        }
        (void)ins_fusion_share(STATES, P, (ins_real)1 / SHARE, local->P);
    }
    self->count = SHARE;
    self->paired = 1;
}

/// Mean and covariance of the headings' sum. Headings are counted from the first one's.
static void mixture(const ins_gps_dr_t* self, ins_real x[STATES], ins_real P[STATES * STATES])
{
    const ins_real* const first = self->local[0].x;
    ins_real sum = 0;
    for (unsigned k = 0; k < STATES; k++)
    {
        x[k] = 0;
    }
    for (unsigned k = 0; k < STATES * STATES; k++)
    {
        P[k] = 0;
    }
    for (unsigned pass = 0; pass < 2; pass++)
    {
        for (unsigned i = 0; i < self->count; i++)
        {
            ins_real d[STATES]; // from the first one; in the second pass from the mean
            for (unsigned k = 0; k < STATES; k++)
            {
                d[k] = self->local[i].x[k] - first[k];
            }
            d[INS_UNICYCLE_HEADING] = ins_elementary_wrap(d[INS_UNICYCLE_HEADING]);
            for (unsigned k = 0; pass == 0 && k < STATES; k++)
            {
                x[k] += self->weight[i] * d[k];
            }
            for (unsigned k = 0; pass == 1 && k < STATES * STATES; k++)
            {
                P[k] += self->weight[i] / sum *
                        (self->local[i].P[k] + (d[k / STATES] - x[k / STATES]) * (d[k % STATES] - x[k % STATES]));
            }
            sum += pass == 0 ? self->weight[i] : 0;
        }
        for (unsigned k = 0; pass == 0 && k < STATES; k++)
        {
            x[k] /= sum;
        }
    }
    for (unsigned k = 0; k < STATES; k++)
    {
        x[k] += first[k];
    }
    x[INS_UNICYCLE_HEADING] = ins_elementary_wrap(x[INS_UNICYCLE_HEADING]);
}

ins_status_t ins_gps_dr_step(ins_gps_dr_t* self, ins_real dt, ins_real yaw_rate, ins_real distance)
{
    if (!(dt > 0) || !(ins_fabs(yaw_rate * dt) < 1000) || !(ins_fabs(distance) <= INS_REAL_MAX))
    {
        return INS_E_RANGE;
    }
    self->since_fix += dt;
    const int moves = ins_fabs(distance) > 0;
    self->stood = moves ? 0 : self->stood + dt;
    self->turned = moves ? 0 : self->turned + yaw_rate * dt;
    const int still = self->cfg.still_after > 0 && self->stood >= self->cfg.still_after;
    const ins_real mean = still ? self->turned / self->stood : 0;
    for (unsigned i = 0; i < self->count; i++)
    {
        ins_unicycle_t* const local = &self->local[i];
        if (still)
        {
            (void)ins_unicycle_still(local, mean, self->paired ? SHARE * STILL_VAR : STILL_VAR);
        }
        (void)ins_unicycle_travel(local, dt, yaw_rate,
                                  distance); // its limit is beyond the one above by what a bias can be
    }
    if (still)
    {
        self->stood = 0;
        self->turned = 0;
    }
    if (self->since_fix > self->cfg.fix_max_age)
    {
        (void)ins_switch_epoch(&self->choice, 0, 0, 0, 0);
    }
    return INS_OK;
}

/// Where a fix is now: `age` ago the vehicle was where it says.
static void bring(const ins_unicycle_t* local, const ins_gps_dr_fix_t* fix, ins_real en[2])
{
    ins_real s;
    ins_real c;
    const ins_real way = fix->age * local->x[INS_UNICYCLE_SPEED];
    ins_elementary_turn(local->x[INS_UNICYCLE_HEADING], &s, &c);
    en[0] = fix->east + way * s;
    en[1] = fix->north + way * c;
}

/// \param[in] fresh  how much of a fresh one the fix is. \return its likelihood but for a factor that all local filters share; 0: it
/// cannot be used.
static ins_real take_fix(ins_unicycle_t* local, const ins_gps_dr_fix_t* fix, ins_real fresh)
{
    ins_real en[2];
    ins_real nis;
    ins_real det;
    const ins_real r = fix->sigma * fix->sigma;
    bring(local, fix, en);
    if (ins_unicycle_judge(local, en[0], en[1], r / fresh, &nis, &det) != INS_OK)
    {
        return 0;
    }
    const ins_real t = 1 + nis / FREEDOM; // the likelihood is t^-(FREEDOM + 2)/2 / sqrt(det)
    const ins_real likelihood = 1 / (t * t * t * ins_sqrt(det));
    (void)ins_unicycle_judge(local, en[0], en[1], r, &nis, &det);
    (void)ins_unicycle_gps(local, en[0], en[1], r / fresh * (FREEDOM + nis) / (FREEDOM + 2), 0);
    return likelihood;
}

/// The fix weighs the headings; those that are out are dropped, and all are one when they agree.
static void align(ins_gps_dr_t* self, const ins_gps_dr_fix_t* fix, ins_real fresh)
{
    ins_real x[STATES];
    ins_real P[STATES * STATES];
    ins_real best = 0;
    unsigned kept = 0;
    for (unsigned i = 0; i < self->count; i++)
    {
        self->weight[i] *= take_fix(&self->local[i], fix, fresh);
        best = self->weight[i] > best ? self->weight[i] : best;
    }
    for (unsigned i = 0; best > 0 && i < self->count; i++)
    {
        if (self->weight[i] > WEIGHT_MIN * best)
        {
            self->local[kept] = self->local[i];
            self->weight[kept] = self->weight[i] / best;
            kept++;
        }
    }
    self->count = (uint_least8_t)kept; // 0: the next fix starts anew
    if (kept > 0)
    {
        mixture(self, x, P);
        if (P[(STATES + 1) * INS_UNICYCLE_HEADING] < HEADING_VAR)
        {
            share(self, x, P);
        }
    }
}

/// One state of the two, and back. Where rounding has left too little, the reckoning one stays.
static void fuse(ins_gps_dr_t* self)
{
    ins_real info[STATES * STATES];
    ins_real y[STATES];
    ins_real x[STATES];
    ins_real work[STATES * STATES];
    ins_real P[STATES * STATES];
    const ins_real* const first = self->local[0].x;
    ins_fusion_clear(STATES, info, y);
    for (unsigned i = 0; i < SHARE; i++)
    {
        for (unsigned k = 0; k < STATES; k++)
        {
            x[k] = self->local[i].x[k] - first[k]; // differences: the heading has no seam, and float keeps them
        }
        x[INS_UNICYCLE_HEADING] = ins_elementary_wrap(x[INS_UNICYCLE_HEADING]);
        if (ins_fusion_add(STATES, info, y, x, self->local[i].P, work) != INS_OK)
        {
            return;
        }
    }
    if (ins_fusion_solve(STATES, info, y, x, P) == INS_OK)
    {
        for (unsigned k = 0; k < STATES; k++)
        {
            x[k] += first[k];
        }
        x[INS_UNICYCLE_HEADING] = ins_elementary_wrap(x[INS_UNICYCLE_HEADING]);
        share(self, x, P);
    }
}

/// \return as ins_unicycle_course(); INS_OK when there is none to use.
static ins_status_t steer(ins_gps_dr_t* self, const ins_gps_dr_fix_t* fix)
{
    const ins_gps_dr_config_t* const c = &self->cfg;
    ins_real x[STATES];
    ins_real P[STATES * STATES];
    if (!fix->has_course || !(fix->speed >= c->course_min) || !(fix->speed > 0) || !(c->sigma_velocity > 0) ||
        self->count == 0)
    {
        return INS_OK;
    }
    const ins_real sigma = c->sigma_velocity / fix->speed;
    if (self->paired)
    {
        return ins_unicycle_course(&self->local[1], fix->course, sigma * sigma, INS_KALMAN_GATE_999, 0);
    }
    mixture(self, x, P);
    for (unsigned i = 0; i < STATES; i++) // any heading of the sum is as good
    {
        for (unsigned k = 0; k < STATES; k++)
        {
            P[STATES * i + k] *= i != INS_UNICYCLE_HEADING && k != INS_UNICYCLE_HEADING;
        }
    }
    x[INS_UNICYCLE_HEADING] = ins_elementary_wrap(fix->course);
    P[(STATES + 1) * INS_UNICYCLE_HEADING] = sigma * sigma;
    share(self, x, P);
    return INS_OK;
}

static int usable(const ins_gps_dr_fix_t* fix)
{
    return ins_fabs(fix->east) <= INS_REAL_MAX && ins_fabs(fix->north) <= INS_REAL_MAX && fix->sigma > 0 &&
           fix->sigma <= INS_REAL_MAX && fix->age >= 0 && fix->age <= INS_REAL_MAX &&
           (!fix->has_course || (ins_fabs(fix->course) < 1000 && fix->speed <= INS_REAL_MAX));
}

/// nis of a fix with the deviation that it states, in the filter that takes it. \return INS_E_GATE: gross.
static ins_status_t judge_fix(ins_gps_dr_t* self, const ins_gps_dr_fix_t* fix)
{
    unsigned best = self->paired;
    ins_real en[2];
    ins_real det;
    for (unsigned i = 0; !self->paired && i < self->count; i++)
    {
        best = self->weight[i] > self->weight[best] ? i : best;
    }
    bring(&self->local[best], fix, en);
    if (ins_unicycle_judge(&self->local[best], en[0], en[1], fix->sigma * fix->sigma, &self->nis, &det) != INS_OK)
    {
        return INS_E_RANGE;
    }
    return self->cfg.gate_gross > 0 && self->nis > self->cfg.gate_gross ? INS_E_GATE : INS_OK;
}

ins_status_t ins_gps_dr_fix(ins_gps_dr_t* self, const ins_gps_dr_fix_t* fix)
{
    if (!fix->valid)
    {
        (void)ins_switch_epoch(&self->choice, 0, 0, 0, 0);
        return INS_OK;
    }
    if (!usable(fix))
    {
        return INS_E_RANGE;
    }
    self->nis = 0;
    ins_status_t status = self->count > 0 ? judge_fix(self, fix) : INS_OK;
    if (status < 0)
    {
        self->gross++;
        self->gross_run = (uint_least8_t)(self->gross_run + (self->gross_run < 255));
        (void)ins_switch_epoch(&self->choice, 0, 0, 0, 0);
        if (self->cfg.restart == 0 || self->gross_run < self->cfg.restart)
        {
            return status;
        }
        self->restarts++;
        self->count = 0;
    }
    const ins_real T = self->since_fix > PERIOD_MIN ? self->since_fix : PERIOD_MIN;
    const ins_real fresh = T / (T + 2 * self->cfg.tau_fix);
    (void)ins_switch_epoch(&self->choice, 1, fix->sats, fix->hdop, self->nis);
    self->gross_run = 0;
    self->since_fix = 0;
    self->doubted += !self->choice.good;
    self->used++;
    if (self->count == 0)
    {
        start(self, fix);
    }
    else if (self->paired)
    {
        (void)take_fix(&self->local[1], fix, fresh);
    }
    else
    {
        align(self, fix, fresh);
    }
    status = steer(self, fix);
    if (self->paired && self->choice.mode == INS_SWITCH_GPS)
    {
        fuse(self);
    }
    return status;
}

int ins_gps_dr_source(const ins_gps_dr_t* self)
{
    const int paired = self->choice.mode == INS_SWITCH_GPS ? INS_GPS_DR_GPS : INS_GPS_DR_DR;
    return self->count == 0 ? INS_GPS_DR_NONE : self->paired ? paired : INS_GPS_DR_ALIGN;
}

ins_status_t ins_gps_dr_state(const ins_gps_dr_t* self, ins_real x[STATES], ins_real P[STATES * STATES])
{
    ins_real mixed[STATES * STATES];
    if (self->count == 0)
    {
        return INS_E_STATE;
    }
    if (!self->paired)
    {
        mixture(self, x, P ? P : mixed);
        return INS_OK;
    }
    for (unsigned k = 0; k < STATES; k++)
    {
        x[k] = self->local[0].x[k];
    }
    for (unsigned k = 0; P && k < STATES * STATES; k++)
    {
        P[k] = self->local[0].P[k] / SHARE;
    }
    return INS_OK;
}
