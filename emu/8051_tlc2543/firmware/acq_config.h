/// \file   acq_config.h
/// \brief  The build options of the acquisition firmware, checked. CMake's add_acq_firmware() gives the ACQ_* values on the command line.
///
/// 11.0592 MHz: 921,600 machine cycles a second, so a period is a whole number of cycles when it is a multiple of 625/576 us.
/// SPDX-License-Identifier: MIT
#ifndef ACQ_CONFIG_H_INCLUDED
#define ACQ_CONFIG_H_INCLUDED

// ACQ_PERIOD_US     sampling period [us]
// ACQ_TICKS         timer 0 ticks in a period, 1..255
// ACQ_TICK_CYCLES   machine cycles in a tick; period = ACQ_TICKS * ACQ_TICK_CYCLES
// ACQ_BAUD          8N1
// ACQ_CHANNELS      3: X, Y, Z; 6: AIN0 to AIN5, six accelerometers
// ACQ_BLOCK_LEN     octets in a block: two a channel (XH XL YH YL ZH ZL ...), or up to 14, zeros after the last
// ACQ_SEQ           1: sequence number in the spare high nibbles
// ACQ_REPLY_TICKS   longest wait for the host's BB, 00 or FF
// ACQ_RETRIES       resends before a sample is given up

#if ACQ_CHANNELS == 3
#define ACQ_SCAN_CYCLES_MAX 700 ///< T0 interrupt with a scan; the next tick must find it done
#elif ACQ_CHANNELS == 6
#define ACQ_SCAN_CYCLES_MAX 1100
#else
#error "ACQ_CHANNELS: 3 or 6"
#endif

#if ACQ_TICKS < 1 || ACQ_TICKS > 255 || ACQ_TICK_CYCLES < ACQ_SCAN_CYCLES_MAX || ACQ_TICK_CYCLES > 65536
#error                                                                                                                 \
    "a tick is 700 (three channels) or 1100 (six) to 65536 machine cycles, and a period 1 to 255 ticks: choose another ACQ_PERIOD_US"
#endif
#if ACQ_TICKS * ACQ_TICK_CYCLES * 625 != ACQ_PERIOD_US * 576
#error "ACQ_PERIOD_US is not ACQ_TICKS * ACQ_TICK_CYCLES machine cycles of 12 / 11.0592 us: sampling would drift"
#endif
#if ACQ_BLOCK_LEN < 2 * ACQ_CHANNELS || ACQ_BLOCK_LEN > 14
#error "ACQ_BLOCK_LEN: two octets a channel, 16-bit codes, to 14, which is what 128 octets of RAM hold"
#endif

/// Timer 1, mode 2, SMOD = 1: 57,600 Bd / (256 - TH1).
#define ACQ_BAUD_DIVISOR ((57600 + ACQ_BAUD / 2) / ACQ_BAUD)
#if ACQ_BAUD_DIVISOR < 1 || ACQ_BAUD_DIVISOR > 256
#error "ACQ_BAUD: timer 1 reaches 225 to 57600 Bd"
#elif 57600 * 40 > ACQ_BAUD * ACQ_BAUD_DIVISOR * 41 || 57600 * 40 < ACQ_BAUD * ACQ_BAUD_DIVISOR * 39
#error "ACQ_BAUD: timer 1 misses it by more than 2.5 %; 57600 / n is exact"
#endif

#endif // ACQ_CONFIG_H_INCLUDED
