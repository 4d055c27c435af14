/// \file   align.c
/// \brief  Means with standard error, levelling, TRIAD. Frames: b -> n (NED).
/// SPDX-License-Identifier: MIT
#include "ins/align.h"
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"

#define SIN_MIN     INS_C(1e-3)
#define NOISE_MIN   (INS_C(1.) / 3) ///< of a quantum: with less, the mean of codes is biased by more than 5 % of a code
#define SQRT12      INS_C(3.46410161513775459)
#define HEADING_MAX INS_C(6.28318530717958648)
#define LENGTH2_MIN INS_C(1e-30)

ins_status_t ins_mean_init(ins_mean_t* self, ins_real quantum)
{
    if (!(quantum >= 0) || !(quantum - quantum == 0))
    {
        return INS_E_RANGE;
    }
    const ins_mean_t start = {0, quantum, {0, 0, 0}, {0, 0, 0}};
    *self = start;
    return INS_OK;
}

ins_status_t ins_mean_add(ins_mean_t* self, const ins_real sample[3])
{
    if (!ins_vec_is_finite(sample))
    {
        return INS_E_RANGE;
    }
    self->count++;
    for (int i = 0; i < 3; i++)
    {
        const ins_real before = sample[i] - self->mean[i];
        self->mean[i] += before / (ins_real)self->count;
        self->m2[i] += before * (sample[i] - self->mean[i]);
    }
    return INS_OK;
}

ins_status_t ins_mean_get(const ins_mean_t* self, ins_real mean[3], ins_real error[3])
{
    if (self->count < 2)
    {
        return INS_E_STATE;
    }
    const ins_real n = (ins_real)self->count;
    for (int i = 0; i < 3; i++)
    {
        const ins_real deviation = ins_sqrt(self->m2[i] / (n - 1));
        mean[i] = self->mean[i];
        error[i] = deviation < NOISE_MIN * self->quantum ? self->quantum / SQRT12 : deviation / ins_sqrt(n);
    }
    return INS_OK;
}

/// \return 0 if it has no length, or one that is not a number. One too long for ins_real gives zeros or no numbers.
static int unit(const ins_real v[3], ins_real out[3])
{
    const ins_real n2 = ins_vec_dot(v, v);
    if (!(n2 >= LENGTH2_MIN))
    {
        return 0;
    }
    const ins_real k = 1 / ins_sqrt(n2);
    out[0] = k * v[0];
    out[1] = k * v[1];
    out[2] = k * v[2];
    return 1;
}

/// Rows: first, first x second, and their cross product, all of unit length.
static int triad(const ins_real first[3], const ins_real second[3], ins_real rows[9])
{
    ins_real s[3];
    ins_real across[3];
    if (!unit(first, rows) || !unit(second, s))
    {
        return 0;
    }
    ins_vec_cross(rows, s, across);
    if (!(ins_vec_dot(across, across) >= SIN_MIN * SIN_MIN) || !unit(across, rows + 3))
    {
        return 0;
    }
    ins_vec_cross(rows, rows + 3, rows + 6);
    return 1;
}

ins_status_t ins_align_triad(const ins_real first_b[3], const ins_real second_b[3], const ins_real first_n[3],
                             const ins_real second_n[3], ins_real q_nb[4])
{
    ins_real b[9];
    ins_real n[9];
    if (!triad(first_b, second_b, b) || !triad(first_n, second_n, n))
    {
        return INS_E_RANGE;
    }
    ins_real C_nb[9];
    for (int i = 0; i < 3; i++)
    {
        for (int k = 0; k < 3; k++)
        {
            C_nb[3 * i + k] = n[i] * b[k] + n[3 + i] * b[3 + k] + n[6 + i] * b[6 + k];
        }
    }
    return ins_quat_from_dcm(C_nb, q_nb);
}

ins_status_t ins_align_level(const ins_real f_b[3], ins_real heading, ins_real q_nb[4])
{
    // Down in b, and the nose; or, where the nose is (within SIN_MIN) up or down, the right wing, which is then level.
    static const ins_real nose[3] = {1, 0, 0};
    static const ins_real wing[3] = {0, 1, 0};
    static const ins_real down_n[3] = {0, 0, 1};
    const ins_real down_b[3] = {-f_b[0], -f_b[1], -f_b[2]};
    const ins_real turn[3] = {0, 0, heading};
    ins_real level[4];
    ins_real yaw[4];
    if (!(ins_fabs(heading) <= HEADING_MAX) || (ins_align_triad(down_b, nose, down_n, nose, level) != INS_OK &&
                                                ins_align_triad(down_b, wing, down_n, wing, level) != INS_OK))
    {
        return INS_E_RANGE;
    }
    (void)ins_quat_from_rotvec(turn, yaw);
    ins_quat_mul(yaw, level, q_nb);
    return INS_OK;
}
