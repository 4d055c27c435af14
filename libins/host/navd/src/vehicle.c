/// \file   vehicle.c
/// \brief  Sentences of a receiver and of an odometer board to position and heading.
/// SPDX-License-Identifier: MIT
#include "ins_nav/vehicle.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PI           3.14159265358979323846
#define KNOT_M_S     (1852.0 / 3600.0)
#define DEGREES_E7   (PI / 180.0 * 1e-7)
#define FIX_AGE_NONE 25.5 ///< as ins_nav_solution_t has it [s]

#define HDOP_UNKNOWN 4.0 ///< of a receiver that does not say

void ins_vehicle_config_default(ins_vehicle_config_t* cfg)
{
    memset(cfg, 0, sizeof *cfg);
    ins_gps_dr_config_default(&cfg->car);
    cfg->filter = INS_VEHICLE_OURS;
    cfg->metres_per_count = 1.0;
    cfg->lsb_rad_s = 180.0 / 4096.0 * PI / 180.0;
    cfg->null_code = 2048.0;
    cfg->code_max = 4095;
    cfg->uere_m = 5.0;
}

const char* ins_vehicle_config_problem(const ins_vehicle_config_t* cfg)
{
    ins_gps_dr_t ours;
    if (cfg->filter != INS_VEHICLE_OURS && cfg->filter != INS_VEHICLE_PRINTED && cfg->filter != INS_VEHICLE_CORRECTED)
    {
        return "filter: is none of ours, the paper's as printed, the paper's as corrected";
    }
    if (!(cfg->metres_per_count > 0.0 && cfg->metres_per_count <= 1e3))
    {
        return "metres per count: must be above 0, up to 1000";
    }
    if (!(fabs(cfg->lsb_rad_s) > 0.0 && fabs(cfg->lsb_rad_s) < 1.0))
    {
        return "yaw rate per code: must not be 0, and below 57 deg/s";
    }
    if (!(fabs(cfg->null_code) <= (double)cfg->code_max))
    {
        return "code at rest: must be within full scale";
    }
    if (!(cfg->uere_m > 0.0 && cfg->uere_m <= 1e4) || !(cfg->latency_s >= 0.0 && cfg->latency_s <= 10.0))
    {
        return "deviation of a fix must be above 0, up to 10000 m; its latency 0 to 10 s";
    }
    return ins_gps_dr_init(&ours, &cfg->car) == INS_OK ? NULL : "noise of the vehicle: a figure is negative or 0";
}

ins_status_t ins_vehicle_init(ins_vehicle_t* self, const ins_vehicle_config_t* cfg)
{
    if (ins_vehicle_config_problem(cfg) != NULL)
    {
        return INS_E_RANGE;
    }
    ins_gps_dr_paper_config_t paper;
    memset(self, 0, sizeof *self);
    self->cfg = *cfg;
    ins_gps_dr_paper_config_default(&paper, cfg->filter == INS_VEHICLE_PRINTED ? INS_GPS_DR_PAPER_PRINTED
                                                                               : INS_GPS_DR_PAPER_CORRECTED);
    ins_gps_dr_config_t car = cfg->car;
    car.vehicle.r_distance += (ins_real)(cfg->metres_per_count * cfg->metres_per_count / 6.0); // of counts at both ends
    (void)ins_gps_dr_init(&self->ours, &car);                                                  // has been tried
    for (unsigned i = 0; i < INS_VEHICLE_PORTS; i++)
    {
        ins_nmea_init(&self->nmea[i]);
    }
    return ins_gps_dr_paper_init(&self->paper, &paper);
}

static int is_ours(const ins_vehicle_t* self)
{
    return self->cfg.filter == INS_VEHICLE_OURS;
}

int ins_vehicle_source(const ins_vehicle_t* self)
{
    return is_ours(self) ? ins_gps_dr_source(&self->ours) : ins_gps_dr_paper_source(&self->paper);
}

/// East, north, heading, speed. \return 0: none yet.
static int state(const ins_vehicle_t* self, double x[4], double* sigma)
{
    ins_real own[6];
    ins_real P[36];
    if (is_ours(self))
    {
        if (ins_gps_dr_state(&self->ours, own, P) != INS_OK)
        {
            return 0;
        }
        for (unsigned i = 0; i < 4; i++)
        {
            x[i] = (double)own[i];
        }
        *sigma = sqrt((double)(P[0] + P[7]));
        return 1;
    }
    if (ins_gps_dr_paper_state(&self->paper, own, P) != INS_OK)
    {
        return 0;
    }
    x[0] = (double)own[0];
    x[1] = (double)own[1];
    x[2] = atan2((double)own[2], (double)own[3]);
    x[3] = hypot((double)own[2], (double)own[3]);
    *sigma = sqrt((double)(P[0] + P[1]));
    return 1;
}

double ins_vehicle_sigma(const ins_vehicle_t* self)
{
    double x[4];
    double sigma = 0.0;
    return state(self, x, &sigma) ? sigma : 0.0;
}

/// A fix on the plane. The first one places it.
static int place(ins_vehicle_t* self, ins_real en[2])
{
    const ins_real llh[3] = {(ins_real)(self->fix.lat_e7 * DEGREES_E7), (ins_real)(self->fix.lon_e7 * DEGREES_E7), 0};
    ins_real xyz[3];
    ins_real ned[3];
    if (ins_geodesy_to_ecef(&ins_wgs84, llh, xyz) != INS_OK)
    {
        return 0;
    }
    if (!self->placed)
    {
        self->placed = ins_local_init(&self->plane, &ins_wgs84, llh) == INS_OK;
    }
    ins_local_from_ecef(&self->plane, xyz, ned);
    en[0] = ned[1];
    en[1] = ned[0];
    return 1;
}

/// The paper's task of 1 s.
static void fix_task(ins_vehicle_t* self)
{
    ins_gps_dr_fix_t f;
    ins_real en[2];
    memset(&f, 0, sizeof f);
    if (self->fresh && self->fix.valid && (self->fix.has & INS_NMEA_POSITION) && place(self, en))
    {
        const double hdop = self->fix.has & INS_NMEA_HDOP ? self->fix.hdop_milli * 1e-3 : HDOP_UNKNOWN;
        const int moving = self->moving && self->motion.valid;
        f.valid = 1;
        f.east = en[0];
        f.north = en[1];
        f.hdop = (ins_real)hdop;
        f.sigma = (ins_real)(hdop * self->cfg.uere_m);
        f.age = (ins_real)((double)(uint32_t)(self->last_ms - self->fix_ms) * 1e-3 + self->cfg.latency_s);
        f.sats = self->fix.sats;
        f.has_course = moving && (self->motion.has & INS_NMEA_COURSE) && (self->motion.has & INS_NMEA_SPEED);
        f.course = (ins_real)(self->motion.course_mdeg * 1e-3 * PI / 180.0);
        f.speed = (ins_real)(self->motion.speed_milliknot * 1e-3 * KNOT_M_S);
    }
    const ins_status_t status =
        is_ours(self) ? ins_gps_dr_fix(&self->ours, &f) : ins_gps_dr_paper_fix(&self->paper, &f);
    self->counts.fixes += f.valid;
    self->counts.no_fixes += !f.valid;
    self->counts.refused += status != INS_OK;
    self->since_fix_ms = f.valid ? 0 : self->since_fix_ms;
    self->fresh = 0;
    self->moving = 0;
}

/// \return 1: there is a position.
static int tell(ins_vehicle_t* self, ins_nav_solution_t* s)
{
    double x[4];
    double sigma;
    ins_real xyz[3];
    ins_real llh[3];
    memset(s, 0, sizeof *s);
    s->index = self->index;
    s->t_s = self->t_s;
    s->seq = (uint32_t)self->index;
    s->q_nb[0] = 1.0;
    s->sats = self->fix.has & INS_NMEA_SATS ? self->fix.sats : 0;
    s->fix_age_s = self->counts.fixes > 0 ? fmin(self->since_fix_ms * 1e-3, FIX_AGE_NONE) : FIX_AGE_NONE;
    s->counts.accepted = self->counts.samples;
    s->counts.invalid = self->counts.invalid;
    s->counts.corrupt = self->counts.corrupt;
    s->counts.duplicates = self->counts.repeated;
    if (!state(self, x, &sigma))
    {
        return 0;
    }
    const int source = ins_vehicle_source(self);
    const ins_real ned[3] = {(ins_real)x[1], (ins_real)x[0], 0};
    ins_local_to_ecef(&self->plane, ned, xyz);
    (void)ins_geodesy_from_ecef(&ins_wgs84, xyz, llh);
    s->en_m[0] = x[0];
    s->en_m[1] = x[1];
    s->lat_lon_rad[0] = (double)llh[0];
    s->lat_lon_rad[1] = (double)llh[1];
    s->status = INS_NAV_BLOCK_POSITION;
    if (source == INS_GPS_DR_ALIGN) // the headings' mean is none
    {
        return 1;
    }
    s->euler_rad[2] = x[2];
    s->q_nb[0] = cos(x[2] / 2.0);
    s->q_nb[3] = sin(x[2] / 2.0);
    s->v_en_m_s[0] = x[3] * sin(x[2]);
    s->v_en_m_s[1] = x[3] * cos(x[2]);
    s->status |= (uint32_t)INS_NAV_BLOCK_ALIGNED | (source == INS_GPS_DR_GPS ? (uint32_t)INS_NAV_BLOCK_FILTER : 0u);
    return 1;
}

/// The paper's task of 100 ms. \return 1: *s is new.
static int board_task(ins_vehicle_t* self, uint32_t ms, uint32_t count, uint32_t code, ins_nav_solution_t* s)
{
    const uint32_t passed_ms = ms - self->last_ms;
    const double rate = (code - self->cfg.null_code) * self->cfg.lsb_rad_s;
    const double distance = (double)(int32_t)(count - self->last_count) * self->cfg.metres_per_count;
    const int first = !self->started;
    const int repeated = self->started && passed_ms == 0;
    const int restart = self->started && passed_ms > INS_VEHICLE_GAP_MS;
    uint32_t gap = 0;
    self->counts.repeated += (unsigned)repeated;
    self->counts.restarts += (unsigned)restart;
    if (repeated)
    {
        return 0;
    }
    self->started = 1;
    self->last_ms = ms;
    self->last_count = count;
    if (first || restart) // from here on
    {
        self->rate = rate;
        return 0;
    }
    gap = passed_ms >= INS_VEHICLE_PERIOD_MS * 3 / 2;
    self->counts.gaps += gap;
    self->counts.samples++;
    self->since_fix_ms += passed_ms;
    self->t_s += passed_ms * 1e-3;
    const ins_real dt = (ins_real)(passed_ms * 1e-3);
    if (is_ours(self))
    {
        (void)ins_gps_dr_step(&self->ours, dt, (ins_real)((rate + self->rate) / 2.0), (ins_real)distance);
    }
    else
    {
        const uint32_t steps = (passed_ms + INS_VEHICLE_PERIOD_MS / 2) / INS_VEHICLE_PERIOD_MS; // it has a fixed period
        for (uint32_t k = 0; k < steps; k++)
        {
            (void)ins_gps_dr_paper_step(&self->paper, (ins_real)rate, (ins_real)(distance / steps));
        }
    }
    self->rate = rate;
    self->index++;
    const uint64_t refused = self->counts.refused;
    if (ms / INS_VEHICLE_FIX_MS != (ms - passed_ms) / INS_VEHICLE_FIX_MS)
    {
        fix_task(self);
    }
    (void)tell(self, s);
    s->status |= gap ? (uint32_t)INS_NAV_BLOCK_GAP : 0u;
    s->status |= self->counts.refused != refused ? (uint32_t)INS_NAV_BLOCK_GATED : 0u;
    return 1;
}

/// Decimal digits up to `end`. \return what follows `end`, or NULL.
static const char* number(const char* text, char end, uint32_t* value)
{
    uint64_t n = 0;
    const char* at = text;
    for (; *at >= '0' && *at <= '9' && n <= UINT32_MAX; at++)
    {
        n = 10 * n + (uint64_t)(*at - '0');
    }
    *value = (uint32_t)n;
    return at != text && *at == end && n <= UINT32_MAX ? at + 1 : NULL;
}

/// A whole line without its end. \return as board_task().
static int sentence(ins_vehicle_t* self, const char* text, ins_nav_solution_t* s)
{
    static const char head[] = "PINSD,";
    uint32_t value[3];
    uint8_t sum = 0;
    const char* at = text;
    if (strncmp(text, head, sizeof head - 1) != 0)
    {
        return 0; // the receiver's
    }
    for (; *at != '*' && *at != '\0'; at++)
    {
        sum ^= (uint8_t)*at;
    }
    char* end = NULL;
    if (*at != '*' || strlen(at) != 3 || strtoul(at + 1, &end, 16) != sum || *end != '\0')
    {
        self->counts.corrupt++;
        return 0;
    }
    at = number(text + sizeof head - 1, ',', &value[0]);
    at = at != NULL ? number(at, ',', &value[1]) : NULL;
    at = at != NULL ? number(at, '*', &value[2]) : NULL;
    if (at == NULL || value[2] > self->cfg.code_max)
    {
        self->counts.invalid++;
        return 0;
    }
    return board_task(self, value[0], value[1], value[2], s);
}

static int line_octet(ins_vehicle_t* self, ins_vehicle_line_t* line, ins_octet_t octet, ins_nav_solution_t* s)
{
    if (octet == '$')
    {
        line->inside = 1;
        line->length = 0;
    }
    else if (line->inside && (octet == '\r' || octet == '\n'))
    {
        line->inside = 0;
        line->text[line->length] = '\0';
        return sentence(self, line->text, s);
    }
    else if (line->inside)
    {
        line->inside = octet != '\0' && line->length < INS_VEHICLE_LINE_MAX + 3;
        line->text[line->length] = (char)octet;
        line->length = (uint8_t)(line->length + line->inside);
    }
    return 0;
}

int ins_vehicle_octet(ins_vehicle_t* self, unsigned port, ins_octet_t octet, ins_nav_solution_t* solution)
{
    const int kind = ins_nmea_rx(&self->nmea[port], octet);
    if (kind == INS_NMEA_GGA)
    {
        self->fix = self->nmea[port].fix;
        self->fix_ms = self->last_ms;
        self->fresh = 1;
    }
    else if (kind != INS_NMEA_NOTHING)
    {
        self->motion = self->nmea[port].fix;
        self->moving = 1;
    }
    return line_octet(self, &self->line[port], octet, solution);
}
