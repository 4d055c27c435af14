/// \file   sixacc.c
/// \brief  Angular acceleration, rate and specific force from accelerometers alone. Frame: b. SI.
/// SPDX-License-Identifier: MIT
#include "ins/sixacc.h"
#include "ins/ins_math.h"
#include "ins/vec.h"

#define HALF_SQRT2 INS_C(0.70710678118654752)
#define PIVOT_MIN  (1000 * INS_EPSILON) ///< of a column's square: what is left when it is not independent

void ins_sixacc_paper(ins_real rho, ins_accel_t accels[6])
{
    static const signed char axis[6][3] = {{1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {0, -1, 1}, {-1, 0, 1}, {-1, 1, 0}};
    static const signed char place[6][3] = {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int j = 0; j < 6; j++)
    {
        accels[j].bias = 0;
        for (int i = 0; i < 3; i++)
        {
            accels[j].axis[i] = HALF_SQRT2 * axis[j][i];
            accels[j].r[i] = rho * place[j][i];
        }
    }
}

ins_real ins_accel_linear(const ins_accel_t* accel, ins_real k2, ins_real reading)
{
    // y = x + k2 x^2, y = (reading - bias) / s; as 2 y / (1 + root) nothing cancels, and k2 = 0 is no case of its own.
    const ins_real over = reading - accel->bias;
    const ins_real radicand = 1 + 4 * k2 * over / ins_sqrt(ins_vec_dot(accel->axis, accel->axis));
    return accel->bias + 2 * over / (1 + (radicand > 0 ? ins_sqrt(radicand) : 0));
}

/// x := N^-1 x with N = L L^T, L in the lower triangle.
static void solve(ins_real L[6][6], ins_real x[6])
{
    for (int i = 0; i < 6; i++)
    {
        for (int k = 0; k < i; k++)
        {
            x[i] -= L[i][k] * x[k];
        }
        x[i] /= L[i][i];
    }
    for (int i = 5; i >= 0; i--)
    {
        for (int k = i + 1; k < 6; k++)
        {
            x[i] -= L[k][i] * x[k];
        }
        x[i] /= L[i][i];
    }
}

/// Cholesky in place. \return 0 if a column is not independent of those before, or not finite: infinity is not above its share.
static int factor(ins_real N[6][6])
{
    for (int i = 0; i < 6; i++)
    {
        const ins_real square = N[i][i];
        for (int k = 0; k <= i; k++)
        {
            ins_real sum = N[i][k];
            for (int m = 0; m < k; m++)
            {
                sum -= N[i][m] * N[k][m];
            }
            N[i][k] = k < i ? sum / N[k][k] : sum;
        }
        if (!(N[i][i] > PIVOT_MIN * square))
        {
            return 0;
        }
        N[i][i] = ins_sqrt(N[i][i]);
    }
    return 1;
}

ins_status_t ins_sixacc_init(ins_sixacc_t* self, unsigned count, const ins_accel_t* accels, ins_real period_s)
{
    if (count < 6 || count > INS_SIXACC_MAX || !(period_s > 0) || !(period_s - period_s == 0))
    {
        return INS_E_RANGE;
    }
    // Rows [r x u, u]: u . (wd x r) = wd . (r x u). The arms are far from 1, so each column is judged by its own size.
    ins_sixacc_t s = {.count = (uint_least8_t)count, .period_s = period_s};
    ins_real rows[INS_SIXACC_MAX][6];
    ins_real N[6][6] = {{0}};
    for (unsigned j = 0; j < count; j++)
    {
        const ins_accel_t* a = &accels[j];
        s.bias[j] = a->bias;
        ins_vec_cross(a->r, a->axis, rows[j]);
        ins_vec_copy(a->axis, rows[j] + 3);
        for (int i = 0; i < 6; i++)
        {
            for (int k = 0; k < 6; k++)
            {
                N[i][k] += rows[j][i] * rows[j][k];
            }
        }
        if (!(a->bias - a->bias == 0))
        {
            return INS_E_RANGE;
        }
    }
    if (!factor(N))
    {
        return INS_E_RANGE;
    }
    for (unsigned j = 0; j < count; j++)
    {
        // u . (w x (w x r)) = (u . w)(r . w) - (u . r)(w . w)
        const ins_real* u = accels[j].axis;
        const ins_real* r = accels[j].r;
        const ins_real ur = ins_vec_dot(u, r);
        const ins_real squares[6] = {u[0] * r[0] - ur,          u[1] * r[1] - ur,          u[2] * r[2] - ur,
                                     u[0] * r[1] + u[1] * r[0], u[0] * r[2] + u[2] * r[0], u[1] * r[2] + u[2] * r[1]};
        solve(N, rows[j]);
        for (int i = 0; i < 6; i++)
        {
            s.inverse[i][j] = rows[j][i];
            for (int k = 0; k < 6; k++)
            {
                s.product[i][k] -= rows[j][i] * squares[k];
            }
        }
    }
    *self = s;
    return INS_OK;
}

static void linear_part(const ins_sixacc_t* self, const ins_real* readings, ins_real out[6])
{
    for (int i = 0; i < 6; i++)
    {
        out[i] = 0;
        for (unsigned j = 0; j < self->count; j++)
        {
            out[i] += self->inverse[i][j] * (readings[j] - self->bias[j]);
        }
    }
}

/// out[k] = linear[first + k] + products of w.
static void add_products(const ins_sixacc_t* self, int first, const ins_real linear[6], const ins_real w[3],
                         ins_real out[3])
{
    const ins_real ww[6] = {w[0] * w[0], w[1] * w[1], w[2] * w[2], w[0] * w[1], w[0] * w[2], w[1] * w[2]};
    for (int i = 0; i < 3; i++)
    {
        out[i] = linear[first + i];
        for (int k = 0; k < 6; k++)
        {
            out[i] += self->product[first + i][k] * ww[k];
        }
    }
}

void ins_sixacc_resolve(const ins_sixacc_t* self, const ins_real* readings, const ins_real w_ib_b[3],
                        ins_real wd_ib_b[3], ins_real f_b[3])
{
    ins_real linear[6];
    linear_part(self, readings, linear);
    add_products(self, 0, linear, w_ib_b, wd_ib_b);
    add_products(self, 3, linear, w_ib_b, f_b);
}

ins_status_t ins_sixacc_step(ins_sixacc_t* self, const ins_real* readings, ins_increment_t* increment)
{
    const ins_real T = self->period_s;
    ins_real linear[6];
    ins_real wd[3];
    ins_real w[3];
    linear_part(self, readings, linear);
    if (!ins_vec_is_finite(linear) || !ins_vec_is_finite(linear + 3))
    {
        return INS_E_RANGE;
    }
    if (!self->started)
    {
        const ins_increment_t none = {{0, 0, 0}, {0, 0, 0}};
        *increment = none;
        ins_vec_copy(self->w_ib_b, w);
        add_products(self, 0, linear, w, wd);
    }
    else
    {
        // Predictor and trapezoid: where wd holds products of the rate, they need the rate at the sample.
        ins_real mean[6];
        ins_real middle[3];
        ins_real f[3];
        ins_vec_copy(self->w_ib_b, w);
        ins_vec_add_scaled(w, T, self->wd_ib_b);
        add_products(self, 0, linear, w, wd);
        for (int i = 0; i < 3; i++)
        {
            const ins_real turn = T * INS_C(0.5) * (self->wd_ib_b[i] + wd[i]);
            w[i] = self->w_ib_b[i] + turn;
            // Hermite's cubic through both rates and accelerations: its mean over the interval, and its middle.
            const ins_real bend = T * (self->wd_ib_b[i] - wd[i]);
            const ins_real centre = self->w_ib_b[i] + INS_C(0.5) * turn;
            increment->theta_b[i] = T * (centre + bend / 12);
            middle[i] = centre + bend / 8;
        }
        for (int i = 0; i < 6; i++)
        {
            mean[i] = INS_C(0.5) * (self->linear[i] + linear[i]);
        }
        add_products(self, 3, mean, middle, f);
        for (int i = 0; i < 3; i++)
        {
            increment->v_b[i] = T * f[i];
        }
    }
    ins_vec_copy(w, self->w_ib_b);
    ins_vec_copy(wd, self->wd_ib_b);
    for (int i = 0; i < 6; i++)
    {
        self->linear[i] = linear[i];
    }
    const int first = !self->started;
    self->started = 1;
    return first ? INS_S_START : INS_OK;
}
