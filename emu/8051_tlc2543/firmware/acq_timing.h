/// \file   acq_timing.h
/// \brief  When acq.c samples, in machine cycles of 12 / 11.0592 us. tests/emu_8051/board measures each of these on the image.
///
/// A sample's instant is that of its X: the last falling I/O CLOCK edge of the scan's first transfer, a fixed count after timer 0's
/// overflow, one period after the X before, to the cycle. The other channels follow; ins_skew_init() takes their delays.
/// SPDX-License-Identifier: MIT
#ifndef ACQ_TIMING_H_INCLUDED
#define ACQ_TIMING_H_INCLUDED

#define ACQ_CYCLES_PER_S  921600
#define ACQ_SKEW_Y_CYCLES 116 ///< X to Y, 125.868 us
#define ACQ_SKEW_Z_CYCLES 240 ///< X to Z, 260.417 us
#define ACQ_SKEW_3_CYCLES 364 ///< of six channels, AIN0 to AIN3, 394.965 us
#define ACQ_SKEW_4_CYCLES 488 ///< to AIN4, 529.514 us
#define ACQ_SKEW_5_CYCLES 612 ///< to AIN5, 664.063 us

#endif // ACQ_TIMING_H_INCLUDED
