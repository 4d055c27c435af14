/// \file   bits.c
/// \brief  Runs the modules over a made-up motion and prints a hash of the bits of each answer, by the library or the amalgamation.
/// SPDX-License-Identifier: MIT
#ifdef AMALGAMATED
#include "ins_all.h"
#else
#include "ins/ins.h"
#endif
#include <stdio.h>
#include <string.h>

#define STEPS    500
#define PERIOD_S INS_C(0.02)

/// FNV-1a over the octets of an answer.
static void print_hash(const char* name, const void* answer, size_t size)
{
    unsigned char octets[512];
    uint32_t hash = 2166136261u;
    memcpy(octets, answer, size);
    for (size_t i = 0; i < size; i++)
    {
        hash = (hash ^ octets[i]) * 16777619u;
    }
    printf("%s:%08lx\n", name, (unsigned long)hash);
}

/// A motion without libm: a triangle wave of the step, of another period on each axis.
static ins_real wave(int k, int period)
{
    const int at = k % period;
    return (ins_real)(at < period / 2 ? at : period - at) / (ins_real)period - INS_C(0.25);
}

int main(void)
{
    const ins_real level[4] = {1, 0, 0, 0};
    const ins_real at_rest[3] = {0, 0, 0};
    const int32_t level_q30[4] = {INS_Q31_ONE, 0, 0, 0};
    const ins_position_t start = {{INS_C(0.4), INS_C(2.1), INS_C(30.)}, {0, 0, 0}};
    const char sentence[] = "$GPGGA,000001.00,2501.5000000,N,12133.6000000,E,4,12,0.8,30.000,M,15.000,M,,*53\r\n";
    const ins_real llh[3] = {INS_C(0.43), INS_C(2.11), INS_C(100.)};
    ins_attitude_t attitude;
    ins_strapdown_t strapdown;
    ins_hist2_t lean;
    ins_fiter_t fiter;
    ins_q31_t fixed;
    ins_rates_t rates;
    ins_nmea_t nmea;
    ins_tm_t tm;
    ins_real sum[3] = {0, 0, 0};
    ins_real xyz[3];
    ins_real east_north[2];
    ins_attitude_init(&attitude, INS_CONING_HIST3_OPT, level);
    ins_strapdown_init(&strapdown, INS_CONING_HIST2_OPT, PERIOD_S, level, at_rest, &start);
    ins_hist2_init(&lean, level);
    ins_fiter_init(&fiter, INS_FITER_HIST3, PERIOD_S, level);
    ins_q31_init(&fixed, level_q30);
    ins_rates_init(&rates, 4, PERIOD_S);
    ins_nmea_init(&nmea);
    for (int k = 0; k < STEPS; k++)
    {
        const ins_real theta[3] = {wave(k, 31) / 4, wave(k, 47) / 3, wave(k, 23) / 5};
        const ins_increment_t increment = {{theta[0], theta[1], theta[2]},
                                           {wave(k, 17), wave(k, 29), -PERIOD_S * INS_C(9.8)}};
        const int32_t counts[3] = {k % 31 * 1000003 - 15000000, k % 47 * 1000033, 20000000 - k % 23 * 1000037};
        ins_real integral[3];
        ins_attitude_step(&attitude, theta);
        ins_hist2_step(&lean, theta);
        ins_fiter_step(&fiter, theta);
        ins_strapdown_step(&strapdown, &increment);
        ins_q31_step(&fixed, counts);
        ins_rates_add(&rates, theta, integral);
        ins_vec_add_scaled(sum, 1, integral);
    }
    for (const char* c = sentence; *c != 0; c++)
    {
        ins_nmea_rx(&nmea, (ins_octet_t)*c);
    }
    ins_geodesy_to_ecef(&ins_wgs84, llh, xyz);
    const int made =
        ins_tm_init_twd97(&tm, 121) == INS_OK && ins_tm_forward(&tm, llh[0], llh[1], east_north, NULL) == INS_OK;
    print_hash("attitude", attitude.q_nb, sizeof attitude.q_nb);
    print_hash("hist2", lean.q_nb, sizeof lean.q_nb);
    print_hash("fiter", fiter.q_nb, sizeof fiter.q_nb);
    print_hash("strapdown", strapdown.v_n, sizeof strapdown.v_n);
    print_hash("fixed", fixed.q_nb, sizeof fixed.q_nb);
    print_hash("rates", sum, sizeof sum);
    print_hash("nmea", &nmea.fix.lat_e7, sizeof nmea.fix.lat_e7);
    print_hash("ecef", xyz, sizeof xyz);
    print_hash("tm", east_north, sizeof east_north);
    printf("selftest:%u\n", ins_selftest());
    return made && nmea.taken == 1 ? 0 : 1;
}
