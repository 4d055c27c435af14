/// \file   fuzz_nmea.c
/// \brief  libFuzzer: the input is the body of a sentence, to which a right checksum is given, so that its fields are read.
/// SPDX-License-Identifier: MIT
#include "sound.h"
#include <stddef.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size);

int LLVMFuzzerTestOneInput(const unsigned char* data, size_t size)
{
    static const char digits[] = "0123456789ABCDEF";
    ins_nmea_t n;
    unsigned sum = 0;
    ins_nmea_init(&n);
    (void)ins_nmea_rx(&n, '$');
    for (size_t i = 0; i < size; i++)
    {
        (void)ins_nmea_rx(&n, data[i]);
        sum ^= data[i];
    }
    (void)ins_nmea_rx(&n, '*');
    (void)ins_nmea_rx(&n, (ins_octet_t)digits[sum >> 4]);
    (void)ins_nmea_rx(&n, (ins_octet_t)digits[sum & 0x0Fu]);
    const int type = ins_nmea_rx(&n, '\r');
    if (!sound_nmea(&n) || (type != INS_NMEA_NOTHING && !sound_fix(&n.fix)))
    {
        abort();
    }
    return 0;
}
