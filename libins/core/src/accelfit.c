/// \file   accelfit.c
/// \brief  Gauss-Newton fit of one accelerometer's eight parameters, row by row. Frame: b. SI.
/// SPDX-License-Identifier: MIT
#include "ins/accelfit.h"
#include "givens_internal.h"
#include "ins/ins_math.h"
#include "ins/vec.h"

ins_status_t ins_accelfit_init(ins_accelfit_t* self, const ins_real u0[3], const ins_real e1[3], const ins_real e2[3],
                               const ins_real p[INS_ACCELFIT_N])
{
    int finite = ins_vec_is_finite(u0) && ins_vec_is_finite(e1) && ins_vec_is_finite(e2);
    for (int i = 0; i < INS_ACCELFIT_N; i++)
    {
        finite = finite && p[i] - p[i] == 0;
    }
    if (!finite || !(ins_vec_dot(u0, u0) > 0) || p[1] == 0)
    {
        return INS_E_RANGE;
    }
    const ins_accelfit_t start = {.rows = 0};
    *self = start;
    ins_vec_copy(u0, self->u0);
    ins_vec_copy(e1, self->e1);
    ins_vec_copy(e2, self->e2);
    for (int i = 0; i < INS_ACCELFIT_N; i++)
    {
        self->p[i] = p[i];
    }
    return INS_OK;
}

ins_real ins_accelfit_predict(const ins_accelfit_t* self, const ins_accelfit_motion_t* motion, ins_real* jacobian)
{
    const ins_real b = self->p[0];
    const ins_real sf = self->p[1];
    const ins_real k2 = self->p[4];
    const ins_real* const w = motion->w_ib_b;
    const ins_real* const wd = motion->wd_ib_b;
    const ins_real* const r = self->p + 5;
    ins_real u[3];
    ins_vec_copy(self->u0, u);
    ins_vec_add_scaled(u, self->p[2], self->e1);
    ins_vec_add_scaled(u, self->p[3], self->e2);
    const ins_real length = ins_sqrt(ins_vec_dot(u, u));
    u[0] /= length;
    u[1] /= length;
    u[2] /= length;
    // a = f + M r, M = [wd x] + [w x][w x] = [wd x] + w w^T - w.w 1
    const ins_real w2 = ins_vec_dot(w, w);
    ins_real tangential[3];
    ins_real a[3];
    ins_vec_cross(wd, r, tangential);
    ins_vec_copy(motion->f_b, a);
    ins_vec_add_scaled(a, 1, tangential);
    ins_vec_add_scaled(a, ins_vec_dot(w, r), w);
    ins_vec_add_scaled(a, -w2, r);
    const ins_real x = ins_vec_dot(u, a);
    if (jacobian)
    {
        const ins_real by_x = sf * (1 + 2 * k2 * x);
        ins_real uM[3];
        ins_vec_cross(u, wd, uM);
        ins_vec_add_scaled(uM, ins_vec_dot(u, w), w);
        ins_vec_add_scaled(uM, -w2, u);
        jacobian[0] = sf;
        jacobian[1] = b + x + k2 * x * x;
        jacobian[2] = by_x * (ins_vec_dot(self->e1, a) - ins_vec_dot(self->e1, u) * x) / length;
        jacobian[3] = by_x * (ins_vec_dot(self->e2, a) - ins_vec_dot(self->e2, u) * x) / length;
        jacobian[4] = sf * x * x;
        jacobian[5] = by_x * uM[0];
        jacobian[6] = by_x * uM[1];
        jacobian[7] = by_x * uM[2];
    }
    return sf * (b + x + k2 * x * x);
}

ins_status_t ins_accelfit_add(ins_accelfit_t* self, const ins_accelfit_motion_t* motion, ins_real reading)
{
    ins_real row[INS_ACCELFIT_N];
    ins_real residual = reading - ins_accelfit_predict(self, motion, row);
    int finite = residual - residual == 0;
    for (int i = 0; i < INS_ACCELFIT_N; i++)
    {
        finite = finite && row[i] - row[i] == 0;
    }
    if (!finite)
    {
        return INS_E_RANGE;
    }
    self->rows++;
    self->residual2 += residual * residual;
    ins_givens_add(INS_ACCELFIT_N, self->R, row, 1, self->z, &residual);
    return INS_OK;
}

ins_status_t ins_accelfit_step(ins_accelfit_t* self, ins_real* largest)
{
    ins_real dp[INS_ACCELFIT_N];
    const ins_status_t status = ins_givens_solve(INS_ACCELFIT_N, self->R, self->z, dp);
    if (status != INS_OK)
    {
        return status;
    }
    *largest = 0;
    for (int i = 0; i < INS_ACCELFIT_N; i++)
    {
        self->p[i] += dp[i];
        *largest = ins_fabs(dp[i]) > *largest ? ins_fabs(dp[i]) : *largest;
        self->z[i] = 0;
    }
    for (int i = 0; i < INS_ACCELFIT_N * INS_ACCELFIT_N; i++)
    {
        self->R[i] = 0;
    }
    self->residual2 = 0;
    self->rows = 0;
    return INS_OK;
}

ins_status_t ins_accelfit_deviation(const ins_accelfit_t* self, ins_real sigma, ins_real deviation[INS_ACCELFIT_N])
{
    if (!(sigma >= 0) || sigma - sigma != 0)
    {
        return INS_E_RANGE;
    }
    // Columns of the inverse triangle: their rows' squares add up to the diagonal of (J^T J)^-1.
    ins_real sum[INS_ACCELFIT_N] = {0};
    for (int i = 0; i < INS_ACCELFIT_N; i++)
    {
        ins_real column[INS_ACCELFIT_N] = {0};
        column[i] = 1;
        const ins_status_t status = ins_givens_solve(INS_ACCELFIT_N, self->R, column, column);
        if (status != INS_OK)
        {
            return status;
        }
        for (int k = 0; k < INS_ACCELFIT_N; k++)
        {
            sum[k] += column[k] * column[k];
        }
    }
    for (int k = 0; k < INS_ACCELFIT_N; k++)
    {
        deviation[k] = sigma * ins_sqrt(sum[k]);
    }
    return INS_OK;
}
