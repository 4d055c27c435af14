/// \file   quat.c
/// \brief  Quaternion algebra and the other forms of an attitude. Scalar first, b -> n.
/// SPDX-License-Identifier: MIT
#include "ins/quat.h"
#include "ins/ins_math.h"
#include "ins/vec.h"
#include "quat_internal.h"

#define NORM2_MIN INS_C(1e-30)
#define NORM2_MAX INS_C(1e30)
#define DCM_TOL   INS_C(1e-3)
#define POLE_TOL  (4 * INS_EPSILON) ///< of sqrt(2): here one of yaw + roll, yaw - roll is rounding noise
#define HALF_TURN INS_C(3.14159265358979324)

static void scale(ins_real q[4], ins_real k)
{
    q[0] *= k;
    q[1] *= k;
    q[2] *= k;
    q[3] *= k;
}

void ins_quat_mul(const ins_real p[4], const ins_real q[4], ins_real out[4])
{
    quat_mul(p, q, out);
}

void ins_quat_conj(const ins_real q[4], ins_real out[4])
{
    out[0] = q[0];
    out[1] = -q[1];
    out[2] = -q[2];
    out[3] = -q[3];
}

void ins_quat_rotate(const ins_real q_nb[4], const ins_real v_b[3], ins_real v_n[3])
{
    quat_rotate(q_nb, v_b, v_n);
}

ins_status_t ins_quat_normalise(ins_real q[4])
{
    const ins_real n2 = quat_norm2(q);
    if (!(n2 >= NORM2_MIN && n2 <= NORM2_MAX))
    {
        return INS_E_RANGE;
    }
    scale(q, 1 / ins_sqrt(n2));
    return INS_OK;
}

void ins_quat_normalise_approx(ins_real q[4])
{
    scale(q, INS_C(1.5) - INS_C(0.5) * quat_norm2(q));
}

void ins_quat_from_euler(const ins_real euler[3], ins_real q_nb[4])
{
    const ins_real cr = ins_cos(euler[0] / 2);
    const ins_real sr = ins_sin(euler[0] / 2);
    const ins_real cp = ins_cos(euler[1] / 2);
    const ins_real sp = ins_sin(euler[1] / 2);
    const ins_real cy = ins_cos(euler[2] / 2);
    const ins_real sy = ins_sin(euler[2] / 2);
    q_nb[0] = cy * cp * cr + sy * sp * sr;
    q_nb[1] = cy * cp * sr - sy * sp * cr;
    q_nb[2] = cy * sp * cr + sy * cp * sr;
    q_nb[3] = sy * cp * cr - cy * sp * sr;
}

static ins_real wrap(ins_real angle)
{
    return angle > HALF_TURN ? angle - 2 * HALF_TURN : angle < -HALF_TURN ? angle + 2 * HALF_TURN : angle;
}

void ins_quat_to_euler(const ins_real q_nb[4], ins_real euler[3])
{
    // With c, s = cos, sin of half the pitch:
    //   w + y, z - x = (c + s) cos, sin of half (yaw - roll);   w - y, z + x = (c - s) cos, sin of half (yaw + roll)
    // so nothing cancels near the poles, where an arc sine of the direction cosines loses half of the digits.
    const ins_real up[2] = {q_nb[0] + q_nb[2], q_nb[3] - q_nb[1]};
    const ins_real down[2] = {q_nb[0] - q_nb[2], q_nb[3] + q_nb[1]};
    const ins_real up_norm = ins_sqrt(up[0] * up[0] + up[1] * up[1]);
    const ins_real down_norm = ins_sqrt(down[0] * down[0] + down[1] * down[1]);
    ins_real half_difference = ins_atan2(up[1], up[0]);
    ins_real half_sum = ins_atan2(down[1], down[0]);
    if (down_norm <= POLE_TOL)
    {
        half_sum = half_difference;
    }
    if (up_norm <= POLE_TOL)
    {
        half_difference = half_sum;
    }
    euler[0] = wrap(half_sum - half_difference);
    euler[1] = 2 * ins_atan2(up_norm - down_norm, up_norm + down_norm);
    euler[2] = wrap(half_sum + half_difference);
}

void ins_quat_to_dcm(const ins_real q_nb[4], ins_real C_nb[9])
{
    const ins_real w = q_nb[0];
    const ins_real x = q_nb[1];
    const ins_real y = q_nb[2];
    const ins_real z = q_nb[3];
    C_nb[0] = w * w + x * x - y * y - z * z;
    C_nb[1] = 2 * (x * y - w * z);
    C_nb[2] = 2 * (x * z + w * y);
    C_nb[3] = 2 * (x * y + w * z);
    C_nb[4] = w * w - x * x + y * y - z * z;
    C_nb[5] = 2 * (y * z - w * x);
    C_nb[6] = 2 * (x * z - w * y);
    C_nb[7] = 2 * (y * z + w * x);
    C_nb[8] = w * w - x * x - y * y + z * z;
}

ins_status_t ins_quat_from_dcm(const ins_real C_nb[9], ins_real q_nb[4])
{
    // 4 q q^T; the row with the largest diagonal is q times its largest element (Shepperd 1978).
    const ins_real* c = C_nb;
    const ins_real qq[4][4] = {{1 + c[0] + c[4] + c[8], c[7] - c[5], c[2] - c[6], c[3] - c[1]},
                               {c[7] - c[5], 1 + c[0] - c[4] - c[8], c[1] + c[3], c[2] + c[6]},
                               {c[2] - c[6], c[1] + c[3], 1 - c[0] + c[4] - c[8], c[5] + c[7]},
                               {c[3] - c[1], c[2] + c[6], c[5] + c[7], 1 - c[0] - c[4] + c[8]}};
    int row = 0;
    for (int i = 1; i < 4; i++)
    {
        row = qq[i][i] > qq[row][row] ? i : row;
    }
    ins_real q[4] = {qq[row][0], qq[row][1], qq[row][2], qq[row][3]};
    if (ins_quat_normalise(q) != INS_OK)
    {
        return INS_E_RANGE;
    }
    ins_real back[9];
    ins_quat_to_dcm(q, back);
    for (int i = 0; i < 9; i++)
    {
        if (!(ins_fabs(back[i] - C_nb[i]) <= DCM_TOL))
        {
            return INS_E_RANGE;
        }
    }
    for (int i = 0; i < 4; i++)
    {
        q_nb[i] = q[i];
    }
    return INS_OK;
}
