/// \file   spline.c
/// \brief  Natural cubic spline: second derivatives from the tridiagonal system of continuous slopes, zero at both
///         ends (de Boor, A Practical Guide to Splines, 1978, chapter IV).
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "spline_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROWS_MIN    4
#define ROWS_MAX    ((size_t)1 << 28)
#define TIME_MAX_S  1e9
#define TIME_STEP_S 1e-9 ///< the least time between rows

const ins_spline_kind_t ins_spline_angles = {{"yaw", "pitch", "roll"}, "radians", 1e6, INS_TRUTH_PI};
const ins_spline_kind_t ins_spline_metres = {{"north", "east", "up"}, "metres", 1e6, 2e6};

static bool check(const ins_spline_kind_t* kind, size_t rows, const double* t, const double* const y[3],
                  const ins_why_t* why)
{
    if (rows < ROWS_MIN || rows > ROWS_MAX)
    {
        ins_why_say(why, "%zu rows, give %d to %zu", rows, ROWS_MIN, ROWS_MAX);
        return false;
    }
    for (size_t k = 0; k < rows; k++)
    {
        if (!(fabs(t[k]) <= TIME_MAX_S))
        {
            ins_why_say(why, "row %zu: t is %.9g, give seconds within +-%g", k + 1, t[k], TIME_MAX_S);
            return false;
        }
        if (k > 0 && !(t[k] - t[k - 1] >= TIME_STEP_S))
        {
            ins_why_say(why, "row %zu: t is %.9g s after %.9g s in the row before, give increasing times", k + 1, t[k],
                        t[k - 1]);
            return false;
        }
        for (int i = 0; i < 3; i++)
        {
            if (!(fabs(y[i][k]) <= kind->most))
            {
                ins_why_say(why, "row %zu: %s is %.9g, give %s within +-%g", k + 1, kind->column[i], y[i][k],
                            kind->unit, kind->most);
                return false;
            }
            if (k > 0 && !(fabs(y[i][k] - y[i][k - 1]) <= kind->step))
            {
                ins_why_say(
                    why, "row %zu: %s steps by %.9g rad, more than pi: give unwrapped angles, or rows closer in time",
                    k + 1, kind->column[i], y[i][k] - y[i][k - 1]);
                return false;
            }
        }
    }
    return true;
}

/// Thomas algorithm; scratch[rows].
static void solve(size_t rows, const double* t, const double* y, double* y2, double* scratch)
{
    y2[0] = 0.0;
    scratch[0] = 0.0;
    for (size_t k = 1; k + 1 < rows; k++)
    {
        const double before = t[k] - t[k - 1];
        const double after = t[k + 1] - t[k];
        const double right = 6.0 * ((y[k + 1] - y[k]) / after - (y[k] - y[k - 1]) / before);
        const double pivot = 2.0 * (before + after) - before * scratch[k - 1];
        scratch[k] = after / pivot;
        y2[k] = (right - before * y2[k - 1]) / pivot;
    }
    y2[rows - 1] = 0.0;
    for (size_t k = rows - 1; k-- > 1;)
    {
        y2[k] -= scratch[k] * y2[k + 1];
    }
}

static double speed_bound(const ins_spline_t* self)
{
    double bound = 0.0;
    for (size_t k = 0; k + 1 < self->rows; k++)
    {
        const double h = self->t[k + 1] - self->t[k];
        double speed = 0.0;
        for (int i = 0; i < 3; i++)
        {
            speed += fabs(self->y[i][k + 1] - self->y[i][k]) / h;
            speed += 0.5 * h * (fabs(self->y2[i][k]) + fabs(self->y2[i][k + 1]));
        }
        bound = speed > bound ? speed : bound;
    }
    return bound;
}

static double excursion(const ins_spline_t* self)
{
    double sum = 0.0;
    for (int i = 0; i < 3; i++)
    {
        double most = 0.0;
        for (size_t k = 1; k < self->rows; k++)
        {
            const double deviation = fabs(self->y[i][k] - self->y[i][0]);
            most = deviation > most ? deviation : most;
        }
        sum += most;
    }
    return sum;
}

bool ins_spline_init(ins_spline_t* self, const ins_spline_kind_t* kind, size_t rows, const double* t,
                     const double* const y[3], const ins_why_t* why)
{
    if (!check(kind, rows, t, y, why))
    {
        return false;
    }
    double* const block = malloc(8 * rows * sizeof *block);
    if (block == NULL)
    {
        ins_why_say(why, "no memory for %zu rows", rows);
        return false;
    }
    self->rows = rows;
    self->t = block;
    memcpy(self->t, t, rows * sizeof *block);
    for (size_t i = 0; i < 3; i++)
    {
        self->y[i] = block + (1 + i) * rows;
        self->y2[i] = block + (4 + i) * rows;
        memcpy(self->y[i], y[i], rows * sizeof *block);
        solve(rows, t, y[i], self->y2[i], block + 7 * rows);
    }
    self->excursion = excursion(self);
    self->speed_bound = speed_bound(self);
    return true;
}

void ins_spline_free(ins_spline_t* self)
{
    free(self->t);
}

/// Number of knots at or before t.
static size_t knots_until(const ins_spline_t* self, double t)
{
    size_t low = 0;
    size_t high = self->rows;
    while (low < high)
    {
        const size_t middle = low + (high - low) / 2;
        if (self->t[middle] <= t)
        {
            low = middle + 1;
        }
        else
        {
            high = middle;
        }
    }
    return low;
}

void ins_spline_at(const ins_spline_t* self, double t, double value[3], double slope[3])
{
    const size_t last = self->rows - 1;
    const size_t until = knots_until(self, t);
    const size_t k = until == 0 ? 0 : (until > last ? last - 1 : until - 1);
    const double h = self->t[k + 1] - self->t[k];
    const double inside = t < self->t[0] ? self->t[0] : (t > self->t[last] ? self->t[last] : t);
    const double b = (inside - self->t[k]) / h;
    const double a = (self->t[k + 1] - inside) / h;
    for (int i = 0; i < 3; i++)
    {
        const double ya = self->y[i][k];
        const double yb = self->y[i][k + 1];
        const double ma = self->y2[i][k] * h / 6.0;
        const double mb = self->y2[i][k + 1] * h / 6.0;
        slope[i] = (yb - ya) / h - (3.0 * a * a - 1.0) * ma + (3.0 * b * b - 1.0) * mb;
        value[i] = a * ya + b * yb + h * ((a * a * a - a) * ma + (b * b * b - b) * mb) + slope[i] * (t - inside);
    }
}

void ins_spline_bend(const ins_spline_t* self, double t, double bend[3])
{
    const size_t until = knots_until(self, t);
    for (int i = 0; i < 3; i++)
    {
        bend[i] = 0.0;
        if (until > 0 && until < self->rows)
        {
            const double* const y2 = self->y2[i] + until - 1;
            const double b = (t - self->t[until - 1]) / (self->t[until] - self->t[until - 1]);
            bend[i] = y2[0] + b * (y2[1] - y2[0]);
        }
    }
}

double ins_spline_next_knot(const ins_spline_t* self, double t)
{
    const size_t k = knots_until(self, t);
    return k < self->rows ? self->t[k] : (double)INFINITY;
}
