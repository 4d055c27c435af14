/// \file   front_end.c
/// \brief  Analogue stages before a converter, with CVODE. V, s.
/// SPDX-License-Identifier: MIT
#include "ins_truth/front_end.h"
#include "ins_truth/elementary.h"
#include "why_internal.h"
#include <cvode/cvode.h>
#include <float.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#define PS_PER_S  1e12
#define STEPS_MAX 100000L ///< from one sample or jump to the next

struct ins_front_end_t
{
    ins_front_end_config_t config;
    ins_front_end_state_t state[INS_FRONT_END_CHANNELS];
    uint64_t failures;
    unsigned channel; ///< being advanced
    int64_t from_ps;  ///< the solver's 0
    int64_t to_ps;    ///< and where it stops
    SUNContext context;
    N_Vector y;
    SUNMatrix matrix;
    SUNLinearSolver linear;
    void* cvode;
};

enum
{
    SENSOR,
    SENSOR_SLOPE, // by w: volts too
    AMPLIFIER,
    RC
};

static double clip(double x, double low, double high)
{
    const double below = x > high ? high : x;
    return below < low ? low : below;
}

/// What leaves the chain: the last stage that is no wire.
static double output(const ins_front_end_channel_t* c, const double x[INS_FRONT_END_STATES], double source)
{
    const double sensed = c->sensor_hz > 0.0 ? x[SENSOR] : source;
    const double amplified = c->amplifier_hz > 0.0 ? x[AMPLIFIER] : clip(sensed, c->rail_low_v, c->rail_high_v);
    return c->rc_s > 0.0 ? x[RC] : amplified;
}

/// The source t seconds after from_ps; at the end of a hold its value before the jump.
static double source_at(const ins_front_end_t* self, double t)
{
    const int64_t at = self->from_ps + (int64_t)floor(t * PS_PER_S + 0.5);
    const int64_t last = self->config.hold_ps > 0 ? self->to_ps - 1 : self->to_ps;
    return self->config.source(self->config.ctx, self->channel, at < last ? at : last);
}

static int slope(realtype t, N_Vector y, N_Vector out, void* ctx)
{
    const ins_front_end_t* const self = ctx;
    const ins_front_end_channel_t* const c = &self->config.channel[self->channel];
    const double* const x = N_VGetArrayPointer(y);
    double* const d = N_VGetArrayPointer(out);
    const double source = source_at(self, t);
    const double w_sensor = 2.0 * INS_TRUTH_PI * c->sensor_hz;
    const bool second = c->sensor_damping > 0.0;
    const double pull = w_sensor * (source - x[SENSOR]);
    d[SENSOR] = second ? w_sensor * x[SENSOR_SLOPE] : pull;
    d[SENSOR_SLOPE] = second ? pull - 2.0 * c->sensor_damping * w_sensor * x[SENSOR_SLOPE] : 0.0;
    const double sensed = clip(c->sensor_hz > 0.0 ? x[SENSOR] : source, c->rail_low_v, c->rail_high_v);
    const double climb = 2.0 * INS_TRUTH_PI * c->amplifier_hz * (sensed - x[AMPLIFIER]);
    d[AMPLIFIER] = c->slew_v_s > 0.0 ? clip(climb, -c->slew_v_s, c->slew_v_s) : climb;
    const double amplified = c->amplifier_hz > 0.0 ? x[AMPLIFIER] : sensed;
    d[RC] = c->rc_s > 0.0 ? (amplified - x[RC]) / c->rc_s : 0.0;
    return fabs(source) <= DBL_MAX ? 0 : -1;
}

/// Everything as if the source had been there for ever.
static void rest(ins_front_end_t* self, unsigned channel, int64_t t_ps)
{
    const ins_front_end_channel_t* const c = &self->config.channel[channel];
    const double source = self->config.source(self->config.ctx, channel, t_ps);
    const double inside = clip(source, c->rail_low_v, c->rail_high_v);
    self->state[channel] = (ins_front_end_state_t){t_ps, {source, 0.0, inside, inside}};
}

/// Errors come back as return values.
static void silent(int code, const char* module, const char* function, char* text, void* ctx)
{
    (void)code;
    (void)module;
    (void)function;
    (void)text;
    (void)ctx;
}

static bool open_solver(ins_front_end_t* self)
{
    if (SUNContext_Create(NULL, &self->context) != 0)
    {
        return false;
    }
    self->y = N_VNew_Serial(INS_FRONT_END_STATES, self->context);
    self->matrix = SUNDenseMatrix(INS_FRONT_END_STATES, INS_FRONT_END_STATES, self->context);
    self->cvode = CVodeCreate(CV_BDF, self->context);
    if (self->y == NULL || self->matrix == NULL || self->cvode == NULL)
    {
        return false;
    }
    N_VConst(0.0, self->y);
    self->linear = SUNLinSol_Dense(self->y, self->matrix, self->context);
    return self->linear != NULL && CVodeSetErrHandlerFn(self->cvode, silent, NULL) == CV_SUCCESS &&
           CVodeInit(self->cvode, slope, 0.0, self->y) == CV_SUCCESS &&
           CVodeSStolerances(self->cvode, 0.0, self->config.tolerance_v) == CV_SUCCESS &&
           CVodeSetLinearSolver(self->cvode, self->linear, self->matrix) == CV_SUCCESS &&
           CVodeSetUserData(self->cvode, self) == CV_SUCCESS &&
           CVodeSetMaxNumSteps(self->cvode, STEPS_MAX) == CV_SUCCESS;
}

static bool is_stage(const ins_why_t* why, const char* where, const char* name, double x, double low, double high)
{
    return x == 0.0 || ins_why_range(why, where, name, x, low, high);
}

static bool check(const ins_front_end_config_t* config, const ins_why_t* why)
{
    if (!ins_why_range(why, "", "channels", config->channels, 1.0, INS_FRONT_END_CHANNELS) ||
        !ins_why_range(why, "", "hold_ps", (double)config->hold_ps, 0.0, 1e15) ||
        !ins_why_range(why, "", "tolerance_v", config->tolerance_v, 1e-12, 1e-2))
    {
        return false;
    }
    for (unsigned k = 0; k < config->channels; k++)
    {
        const ins_front_end_channel_t* const c = &config->channel[k];
        char where[32];
        snprintf(where, sizeof where, "channel %u: ", k);
        if (!is_stage(why, where, "sensor_hz (0: none)", c->sensor_hz, 1e-2, 1e6) ||
            !is_stage(why, where, "sensor_damping (0: first order)", c->sensor_damping, 0.05, 20.0) ||
            !is_stage(why, where, "amplifier_hz (0: at once)", c->amplifier_hz, 1.0, 1e8) ||
            !is_stage(why, where, "slew_v_s (0: unlimited)", c->slew_v_s, 1e-3, 1e9) ||
            !is_stage(why, where, "rc_s (0: none)", c->rc_s, 1e-9, 10.0) ||
            !ins_why_range(why, where, "rail_low_v", c->rail_low_v, -1e3, 1e3) ||
            !ins_why_range(why, where, "rail_high_v (above rail_low_v)", c->rail_high_v,
                           nextafter(c->rail_low_v, (double)INFINITY), 1e3))
        {
            return false;
        }
        if (c->slew_v_s > 0.0 && c->amplifier_hz == 0.0)
        {
            ins_why_say(why, "%sslew_v_s is %.9g and amplifier_hz 0: give the amplifier a bandwidth too", where,
                        c->slew_v_s);
            return false;
        }
    }
    return true;
}

ins_front_end_t* ins_front_end_create(const ins_front_end_config_t* config, char* text, size_t size)
{
    const ins_why_t why = {text, size};
    if (!check(config, &why))
    {
        return NULL;
    }
    ins_front_end_t* const self = calloc(1, sizeof *self);
    if (self == NULL)
    {
        ins_why_say(&why, "no memory for a front end");
        return NULL;
    }
    self->config = *config;
    if (!open_solver(self))
    {
        ins_why_say(&why, "no memory for a front end's solver");
        ins_front_end_destroy(self);
        return NULL;
    }
    for (unsigned k = 0; k < config->channels; k++)
    {
        rest(self, k, 0);
    }
    return self;
}

void ins_front_end_destroy(ins_front_end_t* self)
{
    if (self != NULL)
    {
        CVodeFree(&self->cvode);
        if (self->linear != NULL)
        {
            SUNLinSolFree(self->linear);
        }
        if (self->matrix != NULL)
        {
            SUNMatDestroy(self->matrix);
        }
        if (self->y != NULL)
        {
            N_VDestroy(self->y);
        }
        SUNContext_Free(&self->context);
    }
    free(self);
}

/// To self->to_ps, over which the source is smooth. \return false: the solver gave up.
static bool advance(ins_front_end_t* self, ins_front_end_state_t* state)
{
    double* const y = N_VGetArrayPointer(self->y);
    const double end = (double)(self->to_ps - self->from_ps) / PS_PER_S;
    double reached;
    for (int i = 0; i < INS_FRONT_END_STATES; i++)
    {
        y[i] = state->x[i];
    }
    if (CVodeReInit(self->cvode, 0.0, self->y) != CV_SUCCESS || CVodeSetStopTime(self->cvode, end) != CV_SUCCESS ||
        CVode(self->cvode, end, self->y, &reached, CV_NORMAL) < 0)
    {
        return false;
    }
    for (int i = 0; i < INS_FRONT_END_STATES; i++)
    {
        state->x[i] = y[i];
    }
    state->t_ps = self->to_ps;
    return true;
}

double ins_front_end_volts(void* front_end, unsigned channel, int64_t t_ps)
{
    ins_front_end_t* const self = front_end;
    if (channel >= self->config.channels)
    {
        return self->config.source(self->config.ctx, channel, t_ps);
    }
    const ins_front_end_channel_t* const c = &self->config.channel[channel];
    ins_front_end_state_t* const state = &self->state[channel];
    const int64_t hold = self->config.hold_ps;
    if (t_ps < state->t_ps)
    {
        rest(self, channel, t_ps);
    }
    self->channel = channel;
    while (state->t_ps < t_ps)
    {
        const int64_t jump = hold > 0 ? (state->t_ps / hold + (state->t_ps < 0 ? 0 : 1)) * hold : t_ps;
        self->from_ps = state->t_ps;
        self->to_ps = jump < t_ps ? jump : t_ps;
        if (!advance(self, state))
        {
            self->failures++;
            state->t_ps = t_ps;
            for (int i = 0; i < INS_FRONT_END_STATES; i++)
            {
                state->x[i] = i == SENSOR_SLOPE ? 0.0 : c->rail_low_v;
            }
        }
    }
    return output(c, state->x, self->config.source(self->config.ctx, channel, t_ps));
}

uint64_t ins_front_end_failures(const ins_front_end_t* self)
{
    return self->failures;
}

void ins_front_end_get(const ins_front_end_t* self, unsigned channel, ins_front_end_state_t* state)
{
    *state = self->state[channel];
}

void ins_front_end_set(ins_front_end_t* self, unsigned channel, const ins_front_end_state_t* state)
{
    self->state[channel] = *state;
}
