/// \file   rotation.c
/// \brief  Quaternions and ZYX angles.
/// SPDX-License-Identifier: MIT
#include "ins_truth/elementary.h"
#include "rotation_internal.h"

void ins_rotation_product(const double p[4], const double q[4], double out[4])
{
    out[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    out[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    out[2] = p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1];
    out[3] = p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0];
}

void ins_rotation_into_b(const double q_nb[4], const double v_n[3], double v_b[3])
{
    const double v[4] = {0.0, v_n[0], v_n[1], v_n[2]};
    const double back[4] = {q_nb[0], -q_nb[1], -q_nb[2], -q_nb[3]};
    double half[4];
    double out[4];
    ins_rotation_product(back, v, half);
    ins_rotation_product(half, q_nb, out);
    for (int i = 0; i < 3; i++)
    {
        v_b[i] = out[i + 1];
    }
}

void ins_rotation_of_angles(const double ypr[3], double q_nb[4])
{
    double s[3];
    double c[3];
    for (int i = 0; i < 3; i++)
    {
        ins_truth_sincos(0.5 * ypr[i], &s[i], &c[i]);
    }
    q_nb[0] = c[0] * c[1] * c[2] + s[0] * s[1] * s[2];
    q_nb[1] = c[0] * c[1] * s[2] - s[0] * s[1] * c[2];
    q_nb[2] = c[0] * s[1] * c[2] + s[0] * c[1] * s[2];
    q_nb[3] = s[0] * c[1] * c[2] - c[0] * s[1] * s[2];
}

void ins_rotation_rate(const double ypr[3], const double speed[3], double w_nb_b[3])
{
    double sp;
    double cp;
    double sr;
    double cr;
    ins_truth_sincos(ypr[1], &sp, &cp);
    ins_truth_sincos(ypr[2], &sr, &cr);
    w_nb_b[0] = speed[2] - speed[0] * sp;
    w_nb_b[1] = speed[1] * cr + speed[0] * sr * cp;
    w_nb_b[2] = speed[0] * cr * cp - speed[1] * sr;
}
