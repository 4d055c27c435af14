/// \file   body.c
/// \brief  Integration of a body's motion with CVODE; its steps' polynomials become a track. Frames b and n; SI, rad.
/// SPDX-License-Identifier: MIT
#include "ins_truth/body.h"
#include "rotation_internal.h"
#include "track_internal.h"
#include <cvode/cvode.h>
#include <float.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <stdlib.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#define STEPS_MAX 2000000 ///< of one track: 1 GB of polynomials

typedef struct
{
    const ins_body_config_t* config;
    ins_track_t* track;
    const ins_body_event_t* events;
    size_t count;
    int* found; ///< [count], of CVodeGetRootInfo
    const ins_why_t* why;
    bool refused; ///< a drive or an event could not say
    SUNContext context;
    N_Vector y, scratch;
    SUNNonlinearSolver solver;
    void* cvode;
} job_t;

static int slope(realtype t, N_Vector y, N_Vector out, void* ctx)
{
    job_t* const job = ctx;
    const ins_track_t* const track = job->track;
    const double* const x = N_VGetArrayPointer(y);
    double* const d = N_VGetArrayPointer(out);
    ins_track_state_t state;
    double w[3];
    double f_b[3];
    double f_n[3];
    double g_n[3];
    double w_ie_b[3];
    ins_track_state_of(x, &state);
    if (!track->body.input.at(track->body.input.ctx, t, &state, w, f_b))
    {
        job->refused = true;
        return -1;
    }
    ins_rotation_into_b(state.q_nb, track->w_ie_n, w_ie_b);
    const double turn[4] = {0.0, 0.5 * (w[0] - w_ie_b[0]), 0.5 * (w[1] - w_ie_b[1]), 0.5 * (w[2] - w_ie_b[2])};
    ins_rotation_product(x, turn, d);
    const double back[4] = {state.q_nb[0], -state.q_nb[1], -state.q_nb[2], -state.q_nb[3]};
    ins_rotation_into_b(back, f_b, f_n);
    ins_track_gravity(track, state.p_n, g_n);
    const double* const e = track->w_ie_n;
    const double* const v = state.v_n;
    d[4] = f_n[0] + g_n[0] - 2.0 * (e[1] * v[2] - e[2] * v[1]);
    d[5] = f_n[1] + g_n[1] - 2.0 * (e[2] * v[0] - e[0] * v[2]);
    d[6] = f_n[2] + g_n[2] - 2.0 * (e[0] * v[1] - e[1] * v[0]);
    d[7] = v[0];
    d[8] = v[1];
    d[9] = v[2];
    double sum = 0.0; // CVODE would go on with what is not a number
    for (int i = 0; i < INS_DENSE_SIZE; i++)
    {
        sum += d[i];
    }
    job->refused = job->refused || !(fabs(sum) <= DBL_MAX);
    return job->refused ? -1 : 0;
}

static int event_values(realtype t, N_Vector y, realtype* out, void* ctx)
{
    job_t* const job = ctx;
    ins_track_state_t state;
    ins_track_state_of(N_VGetArrayPointer(y), &state);
    for (size_t k = 0; k < job->count; k++)
    {
        if (!job->events[k].value(job->events[k].ctx, t, &state, &out[k]))
        {
            job->refused = true;
            return -1;
        }
    }
    return 0;
}

static bool failed(const job_t* job, int flag, double t)
{
    if (flag >= 0 && !job->refused)
    {
        return false;
    }
    if (job->refused) // the solver of a step may take it for a step too long
    {
        ins_why_say(job->why, "at %.9g s: a drive or an event refused, or is not a finite number", t);
        return true;
    }
    char* const name = CVodeGetReturnFlagName(flag);
    ins_why_say(job->why, "at %.9g s: CVODE gives %s; is what drives the body smooth between its breaks?", t, name);
    free(name);
    return true;
}

/// Room for one more of `size` octets. \return false: no memory.
static bool grow(void** items, size_t count, size_t* room, size_t more, size_t size)
{
    if (count + more <= *room)
    {
        return true;
    }
    const size_t wanted = 2 * (count + more);
    void* const moved = realloc(*items, wanted * size);
    if (moved != NULL)
    {
        *items = moved;
        *room = wanted;
    }
    return moved != NULL;
}

/// The polynomial of the step just taken: y at its end and its derivatives there.
static bool record_step(job_t* job)
{
    ins_dense_t* const motion = &job->track->body.motion;
    int order;
    double length;
    double end;
    CVodeGetLastOrder(job->cvode, &order);
    CVodeGetLastStep(job->cvode, &length);
    CVodeGetCurrentTime(job->cvode, &end);
    void* steps = motion->step;
    void* values = motion->value;
    const size_t numbers = (size_t)(order + 1) * INS_DENSE_SIZE;
    if (motion->steps == STEPS_MAX)
    {
        ins_why_say(
            job->why,
            "at %.9g s: %d steps and no end; give a looser tolerance, a shorter time, or next_break where it jumps",
            end, STEPS_MAX);
        return false;
    }
    const bool room = grow(&steps, motion->steps, &motion->steps_room, 1, sizeof *motion->step) &&
                      grow(&values, motion->values, &motion->values_room, numbers, sizeof *motion->value);
    motion->step = steps;
    motion->value = values;
    if (!room)
    {
        ins_why_say(job->why, "no memory for step %zu", motion->steps + 1);
        return false;
    }
    motion->step[motion->steps++] = (ins_dense_step_t){end, length, order, motion->values};
    double scale = 1.0; // length^j / j!
    for (int j = 0; j <= order; j++)
    {
        CVodeGetDky(job->cvode, end, j, job->scratch);
        const double* const derivative = N_VGetArrayPointer(job->scratch);
        for (int i = 0; i < INS_DENSE_SIZE; i++)
        {
            motion->value[motion->values++] = scale * derivative[i];
        }
        scale *= length / (double)(j + 1);
    }
    return true;
}

/// \return whether one that stops is among them.
static bool record_events(job_t* job, double t)
{
    ins_track_body_t* const body = &job->track->body;
    bool stops = false;
    CVodeGetRootInfo(job->cvode, job->found);
    for (size_t k = 0; k < job->count; k++)
    {
        void* items = body->happening;
        size_t room = body->happenings;
        if (job->found[k] != 0 && grow(&items, body->happenings, &room, 1, sizeof *body->happening))
        {
            body->happening = items;
            body->happening[body->happenings++] = (ins_body_happening_t){t, k, job->found[k]};
            stops = stops || job->events[k].stops;
        }
    }
    return stops;
}

/// From t to the next break. \return the instant reached; it lies before `stop` when an event stopped it, NaN: failed.
static double integrate_piece(job_t* job, double t, double stop)
{
    long taken = 0;
    double reached = t;
    if (failed(job, CVodeReInit(job->cvode, t, job->y), t) || failed(job, CVodeSetStopTime(job->cvode, stop), t))
    {
        return (double)NAN;
    }
    for (;;)
    {
        long steps;
        const int flag = CVode(job->cvode, stop, job->y, &reached, CV_ONE_STEP);
        CVodeGetNumSteps(job->cvode, &steps);
        if (failed(job, flag, reached) || (steps != taken && !record_step(job)))
        {
            return (double)NAN;
        }
        taken = steps;
        if (flag == CV_ROOT_RETURN && record_events(job, reached))
        {
            return reached;
        }
        if (flag == CV_TSTOP_RETURN || reached >= stop)
        {
            return stop;
        }
    }
}

static bool integrate(job_t* job)
{
    const ins_body_config_t* const c = job->config;
    const ins_body_input_t* const input = &job->track->body.input;
    ins_dense_t* const motion = &job->track->body.motion;
    motion->start = motion->end = c->start_s;
    while (motion->end < c->end_s)
    {
        const double next = input->next_break != NULL ? input->next_break(input->ctx, motion->end) : c->end_s;
        const double stop = next < c->end_s ? next : c->end_s;
        const double reached = integrate_piece(job, motion->end, stop);
        if (!(reached == reached))
        {
            return false;
        }
        motion->end = reached;
        if (reached < stop)
        {
            break;
        }
    }
    return true;
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

static bool open_solver(job_t* job)
{
    const ins_body_config_t* const c = job->config;
    if (SUNContext_Create(NULL, &job->context) != 0)
    {
        return false;
    }
    job->y = N_VNew_Serial(INS_DENSE_SIZE, job->context);
    job->scratch = N_VNew_Serial(INS_DENSE_SIZE, job->context);
    job->cvode = CVodeCreate(CV_ADAMS, job->context);
    job->found = calloc(job->count + 1, sizeof *job->found);
    if (job->y == NULL || job->scratch == NULL || job->cvode == NULL || job->found == NULL)
    {
        return false;
    }
    double* const y = N_VGetArrayPointer(job->y);
    double length = 0.0;
    for (int i = 0; i < 4; i++)
    {
        length += c->q_nb[i] * c->q_nb[i];
    }
    for (int i = 0; i < 4; i++)
    {
        y[i] = c->q_nb[i] / sqrt(length);
    }
    for (int i = 0; i < 3; i++)
    {
        y[i + 4] = c->v_n[i];
        y[i + 7] = c->p_n[i];
    }
    for (size_t k = 0; k < job->count; k++)
    {
        job->found[k] = job->events[k].direction;
    }
    job->solver = SUNNonlinSol_FixedPoint(job->y, 0, job->context);
    return job->solver != NULL && CVodeSetErrHandlerFn(job->cvode, silent, NULL) == CV_SUCCESS &&
           CVodeInit(job->cvode, slope, c->start_s, job->y) == CV_SUCCESS &&
           CVodeSStolerances(job->cvode, c->tolerance, c->tolerance) == CV_SUCCESS &&
           CVodeSetNonlinearSolver(job->cvode, job->solver) == CV_SUCCESS &&
           CVodeSetUserData(job->cvode, job) == CV_SUCCESS &&
           (job->count == 0 || (CVodeRootInit(job->cvode, (int)job->count, event_values) == CV_SUCCESS &&
                                CVodeSetRootDirection(job->cvode, job->found) == CV_SUCCESS));
}

static void close_solver(job_t* job)
{
    if (job->solver != NULL)
    {
        SUNNonlinSolFree(job->solver);
    }
    CVodeFree(&job->cvode);
    if (job->y != NULL)
    {
        N_VDestroy(job->y);
    }
    if (job->scratch != NULL)
    {
        N_VDestroy(job->scratch);
    }
    SUNContext_Free(&job->context);
    free(job->found);
}

static bool check(const ins_body_config_t* c, const ins_why_t* why)
{
    const double* const q = c->q_nb;
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 3; i++)
    {
        if (!ins_why_range(why, "", "a component of p_n", c->p_n[i], -1e7, 1e7) ||
            !ins_why_range(why, "", "a component of v_n", c->v_n[i], -1e4, 1e4))
        {
            return false;
        }
    }
    return ins_why_range(why, "", "the length of q_nb", length, 1.0 - 1e-6, 1.0 + 1e-6) &&
           ins_why_range(why, "", "start_s", c->start_s, -INS_TRACK_TIME_MAX_S, INS_TRACK_TIME_MAX_S) &&
           ins_why_range(why, "", "end_s (after start_s)", c->end_s, nextafter(c->start_s, (double)INFINITY),
                         INS_TRACK_TIME_MAX_S) &&
           ins_why_range(why, "", "tolerance", c->tolerance, INS_BODY_TIGHTEST, 1e-3);
}

ins_track_t* ins_track_create_body(const ins_body_config_t* config, const ins_body_input_t* input,
                                   const ins_body_event_t* events, size_t count, char* text, size_t size)
{
    const ins_why_t why = {text, size};
    if (!check(config, &why))
    {
        return NULL;
    }
    job_t job = {.config = config,
                 .track = ins_track_create_at(INS_TRACK_BODY, &config->site, &why),
                 .events = events,
                 .count = count,
                 .why = &why};
    if (job.track == NULL)
    {
        return NULL;
    }
    job.track->body.input = *input;
    const bool opened = open_solver(&job);
    if (!opened)
    {
        ins_why_say(&why, "no memory for the integrator");
    }
    const bool done = opened && integrate(&job);
    close_solver(&job);
    if (!done)
    {
        ins_track_destroy(job.track);
        return NULL;
    }
    return job.track;
}
