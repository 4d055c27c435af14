/// \file   navigate.c
/// \brief  Packets of the GIMU to attitude, velocity and position. Frames: b -> n, grid. Units: rad, m, s.
///
/// Attitude: K (code - null) / 6 to the thesis's second-order quaternion update. Acceleration: the specific force turned into n, gravity
/// added. Position: P-V-A of east and north apart, whose acceleration is measured by the accelerometers six times a second and whose
/// position by GPS once. A car's heading is its course, once it moves.
/// SPDX-License-Identifier: MIT
#include "navigate.h"
#include "ins/ins_math.h"
#include "ins/quat.h"

#define RAD_E7    1.74532925e-9f ///< 1e-7 degree
#define PI        3.14159265f
#define NORTH     1
#define QUARTERS  4.0f
#define MIDDLE_E7 1200000000 ///< between the zones 119 and 121 of TWD97

void navigation_begin(navigation_t* self, null_mode_t mode)
{
    static const float upright[4] = {1, 0, 0, 0};
    static const navigation_t zero = {0};
    const uint16_t filter = self->filter;
    const uint16_t levels = self->level;
    *self = zero;
    self->filter = filter;
    self->level = levels;
    self->fix_age = UINT16_MAX;
    ins_gimu_scale_thesis(&self->scale);
    calibration_begin(&self->calibration, mode);
    (void)ins_thesis_init(&self->attitude, upright);
    (void)ins_tm_init(&self->grid, &ins_grs80, 0, 0.9999f, 250000, 0);
}

/// Longitudes are taken from the central meridian: in float those from Greenwich have steps of 1.5 m.
static ins_status_t grid_of(const navigation_t* self, int32_t zone, const ins_gimu_packet_t* packet, float en[2])
{
    const int32_t from_meridian = packet->lon_e7 - zone * 10000000;
    return ins_tm_forward(&self->grid, (float)packet->lat_e7 * RAD_E7, (float)from_meridian * RAD_E7, en, 0);
}

static void begin_filter(navigation_t* self, const float en[2])
{
    static const float variance[3] = {THESIS_FIX_VARIANCE, 25, 1};
    for (int i = 0; i < 2; i++)
    {
        (void)ins_pva_init(&self->axis[i], variance);
        self->axis[i].x[INS_PVA_POSITION] = en[i] - self->origin[i];
    }
    self->gated = 0;
    self->fix_age = 0;
}

static float within_pi(float angle)
{
    return angle > PI ? angle - 2 * PI : angle < -PI ? angle + 2 * PI : angle;
}

static float heading(const navigation_t* self)
{
    float euler[3];
    ins_quat_to_euler(self->attitude.q_nb, euler);
    return euler[2];
}

/// \param[in] turn  [3] rotation vector in n.
static void turn_frame(navigation_t* self, const float turn[3])
{
    float q[4];
    (void)ins_quat_from_rotvec(turn, q);
    ins_quat_mul(q, self->attitude.q_nb, self->attitude.q_nb);
}

static void drop_anchor(navigation_t* self, const float p[2])
{
    self->anchor[0] = p[0];
    self->anchor[1] = p[1];
    self->anchor_heading = heading(self);
    self->anchor_fixes = 0;
}

/// The first fix is the origin, at a quarter of a metre: what float has of a northing.
static void begin_position(navigation_t* self, int32_t zone, const float en[2])
{
    self->zone = (uint16_t)zone;
    for (int i = 0; i < 2; i++)
    {
        self->origin[i] = (float)(int32_t)(en[i] * QUARTERS) / QUARTERS;
        self->dead_p[i] = en[i] - self->origin[i];
    }
    begin_filter(self, en);
    drop_anchor(self, self->dead_p);
}

/// A car's course between two fixes is its heading halfway. \param[in] p  this fix, from the origin.
static void take_course(navigation_t* self, const float p[2])
{
    const float east = p[0] - self->anchor[0];
    const float north = p[1] - self->anchor[1];
    const int away = east * east + north * north > THESIS_COURSE_M * THESIS_COURSE_M;
    self->anchor_fixes++;
    if (away)
    {
        const float now = heading(self);
        const float halfway = now + within_pi(self->anchor_heading - now) / 2;
        const float off = within_pi(within_pi(ins_atan2(east, north) - halfway));
        const float turn[3] = {0, 0, self->course_known ? THESIS_COURSE_GAIN * off : off};
        turn_frame(self, turn);
        self->course_known = 1;
    }
    if (away || self->anchor_fixes >= THESIS_COURSE_FIXES)
    {
        drop_anchor(self, p);
    }
}

/// A fix is of THESIS_FIX_DELAY_S ago: h says where the axis was then. \param[out] off  what it is off [m].
static ins_status_t update(ins_pva_t* axis, float fix, float* off)
{
    static const float h[3] = {1, -THESIS_FIX_DELAY_S, THESIS_FIX_DELAY_S * THESIS_FIX_DELAY_S / 2};
    float work[6];
    *off = fix - h[0] * axis->x[0] - h[1] * axis->x[1] - h[2] * axis->x[2];
    ins_innovation_t z = {*off, THESIS_FIX_VARIANCE, INS_KALMAN_GATE_999, 0};
    return ins_kalman_update(3, axis->x, axis->P, h, &z, work);
}

/// Both axes take the fix, or neither does.
static ins_status_t update_both(navigation_t* self, const float p[2], float off[2])
{
    ins_pva_t east = self->axis[0];
    ins_pva_t north = self->axis[NORTH];
    if (update(&east, p[0], &off[0]) != INS_OK || update(&north, p[NORTH], &off[NORTH]) != INS_OK)
    {
        return INS_E_GATE;
    }
    self->axis[0] = east;
    self->axis[NORTH] = north;
    return INS_OK;
}

/// A tilt lets gravity pull the position away: what a fix is off turns it back. \param[in] off  east, north [m].
static void level_by(navigation_t* self, const float off[2])
{
    const float turn[3] = {THESIS_LEVEL_GAIN / INS_GIMU_G * off[0], -THESIS_LEVEL_GAIN / INS_GIMU_G * off[1], 0};
    turn_frame(self, turn);
}

static void take_fix(navigation_t* self, const ins_gimu_packet_t* packet)
{
    float en[2];
    float off[2];
    const int32_t zone = self->zone != 0 ? self->zone : packet->lon_e7 < MIDDLE_E7 ? 119 : 121;
    self->sats = packet->sats;
    if (packet->sats < THESIS_SATS_MIN || !packet->has_position || grid_of(self, zone, packet, en) != INS_OK)
    {
        return;
    }
    if (self->zone == 0)
    {
        begin_position(self, zone, en);
        return;
    }
    float p[2] = {en[0] - self->origin[0], en[1] - self->origin[1]};
    if (update_both(self, p, off) != INS_OK)
    {
        self->status |= INS_NAV_BLOCK_GATED;
        if (++self->gated >= THESIS_GATED_MAX)
        {
            begin_filter(self, en);
        }
        return;
    }
    if (self->level)
    {
        level_by(self, off);
    }
    for (int i = 0; i < 2; i++)
    {
        p[i] += THESIS_FIX_DELAY_S * self->axis[i].x[INS_PVA_VELOCITY];
    }
    self->gated = 0;
    self->fix_age = 0;
    take_course(self, p);
}

/// A packet's time on by what its sample says.
static void integrate(navigation_t* self, const uint16_t* raw)
{
    float dtheta_b[3];
    float dv_b[3];
    float dv_n[3];
    ins_gimu_increments(&self->scale, raw, THESIS_DT_S, dtheta_b, dv_b);
    (void)ins_thesis_step(&self->attitude, dtheta_b);
    ins_quat_rotate(self->attitude.q_nb, dv_b, dv_n);
    for (int i = 0; i < 3; i++)
    {
        self->angle[i] += dtheta_b[i];
    }
    for (int i = 0; i < 2; i++)
    {
        const float a = dv_n[1 - i] / THESIS_DT_S; // n is north, east; the grid is east, north
        (void)ins_pva_predict(&self->axis[i], THESIS_DT_S, THESIS_JERK);
        ins_innovation_t z = {a - self->axis[i].x[INS_PVA_ACCELERATION], THESIS_F_VARIANCE, 0, 0};
        (void)ins_pva_update(&self->axis[i], INS_PVA_ACCELERATION, &z);
        self->dead_p[i] += (self->dead_v[i] + 0.5f * a * THESIS_DT_S) * THESIS_DT_S;
        self->dead_v[i] += a * THESIS_DT_S;
    }
}

/// Packets' times since the last one, at least 1.
static uint32_t periods_since(const navigation_t* self, uint32_t time_ms)
{
    const uint32_t sixths = ((time_ms - self->time_ms) * INS_GIMU_RATE_HZ + 500) / 1000;
    return self->time_ms == 0 || sixths < 1 ? 1 : sixths;
}

void navigation_packet(navigation_t* self, const ins_gimu_packet_t* packet, int type, uint32_t time_ms)
{
    const uint32_t periods = periods_since(self, time_ms);
    self->time_ms = time_ms;
    self->status = periods > 1 ? INS_NAV_BLOCK_GAP : 0;
    for (int i = 0; i < 3; i++)
    {
        self->status |= packet->raw[i] == 0 || packet->raw[i] >= 4095 ? INS_NAV_BLOCK_CLIPPED : 0;
    }
    self->fix_age = self->fix_age + periods < UINT16_MAX ? (uint16_t)(self->fix_age + periods) : UINT16_MAX;
    if (!self->aligned)
    {
        self->aligned = (uint16_t)calibration_add(&self->calibration, packet->raw, &self->scale);
    }
    else
    {
        for (uint32_t i = 0; i < periods && periods <= THESIS_GAP_PACKETS_MAX; i++)
        {
            integrate(self, packet->raw);
        }
    }
    if (type == INS_GIMU_T2 && self->aligned)
    {
        take_fix(self, packet);
    }
}

void navigation_block(const navigation_t* self, ins_nav_block_t* block)
{
    const uint32_t age = (uint32_t)self->fix_age * 10u / INS_GIMU_RATE_HZ + (uint32_t)(THESIS_FIX_DELAY_S * 10);
    block->time_ms = self->time_ms;
    block->status = self->status;
    block->status |= self->aligned ? INS_NAV_BLOCK_ALIGNED : 0;
    block->status |= self->calibration.mode == NULL_INTEGER ? INS_NAV_BLOCK_INTEGER : 0;
    block->status |= self->calibration.mode == NULL_FRACTION ? INS_NAV_BLOCK_FRACTION : 0;
    block->status |= self->zone != 0 ? INS_NAV_BLOCK_POSITION : 0;
    block->status |= self->zone == 119 ? INS_NAV_BLOCK_ZONE_119 : 0;
    block->status |= self->filter ? INS_NAV_BLOCK_FILTER : 0;
    block->sats = (uint_least8_t)self->sats;
    block->fix_age = (uint_least8_t)(age < INS_NAV_BLOCK_OLD ? age : INS_NAV_BLOCK_OLD);
    for (int i = 0; i < 2; i++)
    {
        const float p = self->filter ? self->axis[i].x[INS_PVA_POSITION] : self->dead_p[i];
        block->v_en[i] = self->filter ? self->axis[i].x[INS_PVA_VELOCITY] : self->dead_v[i];
        block->en_cm[i] = (int32_t)(self->origin[i] * QUARTERS) * 25 + (int32_t)(p * 100);
    }
    for (int i = 0; i < 4; i++)
    {
        block->q_nb[i] = self->attitude.q_nb[i];
    }
}
