/// \file   rotvec.c
/// \brief  Rotation vector to quaternion at any angle. Unit: rad.
/// SPDX-License-Identifier: MIT
#include "ins/ins_math.h"
#include "ins/quat.h"
#include "ins/vec.h"
#include "rotvec_internal.h"

void ins_half_angle(ins_real u, ins_real* half_cos, ins_real* half_sinc_out)
{
    int halvings = 0;
    while (u > HALF_U_MAX)
    {
        u *= INS_C(0.25);
        halvings++;
    }
    // Cosines from sines throughout: each squaring doubles an error in angle, and a small angle's cosine hardly knows it.
    ins_real s = half_sinc(u);
    ins_real c = ins_sqrt(1 - s * s * u);
    for (; halvings > 0; halvings--)
    {
        // {c, s phi}^2 = {1 - 2 s^2 u, 2 c s phi}, and 2 phi is the next angle.
        const ins_real square = 1 - 2 * s * s * u;
        s = c * s;
        c = square;
        u *= 4;
    }
    *half_cos = c;
    *half_sinc_out = s;
}

ins_status_t ins_quat_from_rotvec(const ins_real phi[3], ins_real q[4])
{
    const ins_real u = ins_vec_dot(phi, phi);
    if (!(u <= (ins_real)INS_ROTVEC_MAX * INS_ROTVEC_MAX))
    {
        return INS_E_RANGE;
    }
    ins_real c;
    ins_real s;
    ins_half_angle(u, &c, &s);
    q[3] = s * phi[2];
    q[2] = s * phi[1];
    q[1] = s * phi[0];
    q[0] = c;
    return INS_OK;
}
