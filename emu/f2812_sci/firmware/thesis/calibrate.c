/// \file   calibrate.c
/// \brief  Nulls of gyros and accelerometers from packets of a GIMU that is level and at rest. Unit: codes.
///
/// An integer null is up to half a code wrong, 6.3 degrees a minute; the mean keeps its fraction (ins/align.h).
/// SPDX-License-Identifier: MIT
#include "navigate.h"

#define DOWN 5 ///< AZ reads -1 g at rest: specific force points up

void calibration_begin(calibration_t* self, null_mode_t mode)
{
    self->mode = mode;
    (void)ins_mean_init(&self->gyro, 1);
    (void)ins_mean_init(&self->accelerometer, 1);
}

int calibration_add(calibration_t* self, const uint16_t* raw, ins_gimu_scale_t* scale)
{
    float sample[6];
    float mean[6];
    float error[3];
    for (int i = 0; i < 6; i++)
    {
        sample[i] = raw[i];
    }
    (void)ins_mean_add(&self->gyro, sample);
    (void)ins_mean_add(&self->accelerometer, sample + 3);
    if (self->gyro.count < THESIS_CALIBRATION_PACKETS)
    {
        return 0;
    }
    (void)ins_mean_get(&self->gyro, mean, error);
    (void)ins_mean_get(&self->accelerometer, mean + 3, error);
    mean[DOWN] += INS_GIMU_G / scale->acceleration;
    for (int i = 0; i < 6 && self->mode != NULL_NONE; i++)
    {
        scale->null[i] = self->mode == NULL_INTEGER ? (float)(int32_t)(mean[i] + 0.5f) : mean[i];
    }
    return 1;
}
