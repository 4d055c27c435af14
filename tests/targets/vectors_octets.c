/// \file   vectors_octets.c
/// \brief  handshake.json and gimu.json on the target: octets in, the same octets and packets out.
/// SPDX-License-Identifier: MIT
#include "tape.h"

#define FRAME_LEN 7 // the paper's block and its sum
#define NO_FAULT  99u
#define SWAP      8u // a fault that is no bit
#define STREAM    300u

static uint32_t tape_long(void)
{
    const uint32_t high = tape_integer();
    return high << 16 | tape_integer();
}

/// A frame on its way may be damaged; what the host and the board answer must be the transcript.
static void handshake(void)
{
    const ins_hs_config_t config = {6, 0, 2, 50, 20};
    for (unsigned cases = tape_section("handshake", 0); cases > 0; cases--)
    {
        ins_hs_board_t board;
        ins_hs_host_t host;
        uint16_t codes[3];
        ins_octet_t block[6];
        check_true(ins_hs_board_init(&board, &config) == INS_OK);
        check_true(ins_hs_host_init(&host, &config) == INS_OK);
        for (int i = 0; i < 3; i++)
        {
            codes[i] = (uint16_t)tape_integer();
        }
        ins_hs_block_put(codes, block);
        check_true(ins_hs_board_offer(&board, block, 0, 0) == INS_OK);
        for (unsigned frames = (unsigned)tape_integer(); frames > 0; frames--)
        {
            const unsigned length = (unsigned)tape_integer();
            const unsigned fault_at = (unsigned)tape_integer();
            const unsigned fault = (unsigned)tape_integer();
            ins_octet_t sent[FRAME_LEN + 1] = {0};
            for (unsigned i = 0; i < length && i < FRAME_LEN; i++)
            {
                sent[i] = (ins_octet_t)ins_hs_board_tx(&board, 0);
            }
            if (fault_at != NO_FAULT && fault == SWAP)
            {
                const ins_octet_t first = sent[fault_at];
                sent[fault_at] = sent[fault_at + 1];
                sent[fault_at + 1] = first;
            }
            else if (fault_at != NO_FAULT)
            {
                sent[fault_at] = (ins_octet_t)(sent[fault_at] ^ (1u << fault));
            }
            int16_t reply = -1;
            for (unsigned i = 0; i < length && i < FRAME_LEN; i++)
            {
                check_true(sent[i] == tape_integer());
                (void)ins_hs_host_rx(&host, sent[i], 0, &reply);
            }
            check_true(reply == (int16_t)tape_integer());
            ins_hs_board_rx(&board, (ins_octet_t)reply, 0);
        }
        check_true(ins_hs_board_tx(&board, 0) == -1);
        check_true(host.accepted == tape_integer());
        for (unsigned i = 0; host.accepted > 0 && i < 6; i++)
        {
            check_true(host.block[i] == tape_integer());
        }
    }
    check_end();
}

/// The file's degrees are rounded differently: one unit of 1e-7 degree.
static void check_e7(int32_t got)
{
    const int32_t off = got - (int32_t)tape_long();
    check_true(off >= -1 && off <= 1);
}

static void check_packet(const ins_gimu_t* self, int type)
{
    check_true((uint32_t)type == tape_integer());
    for (int i = 0; i < 6; i++)
    {
        check_true(self->packet.raw[i] == tape_integer());
    }
    if (type == INS_GIMU_T2)
    {
        check_true(self->packet.coordinate[0] == tape_long());
        check_true(self->packet.coordinate[1] == tape_long());
        check_true(self->packet.sats == tape_integer());
        check_e7(self->packet.lat_e7);
        check_e7(self->packet.lon_e7);
    }
}

static void gimu(void)
{
    static ins_octet_t stream[STREAM];
    for (unsigned cases = tape_section("gimu.streams", 0); cases > 0; cases--)
    {
        ins_gimu_t self;
        unsigned found = 0;
        ins_gimu_init(&self, (int)tape_integer());
        const unsigned packets = (unsigned)tape_integer();
        const unsigned octets = (unsigned)tape_integer();
        check_true(octets <= STREAM);
        for (unsigned i = 0; i < octets; i++)
        {
            stream[i % STREAM] = (ins_octet_t)tape_integer();
        }
        for (unsigned i = 0; i < octets; i++)
        {
            const int type = ins_gimu_rx(&self, stream[i % STREAM]);
            if (type != INS_GIMU_NOTHING)
            {
                check_packet(&self, type);
                found++;
            }
        }
        for (int type; (type = ins_gimu_flush(&self)) != INS_GIMU_NOTHING; found++)
        {
            check_packet(&self, type);
        }
        check_true(found == packets);
    }
    check_end();
}

static void scaling(void)
{
    for (unsigned cases = tape_section("gimu.conversions", INS_TOL(INS_C(1e-15), INS_C(3e-7))); cases > 0; cases--)
    {
        ins_gimu_scale_t scale;
        ins_real dtheta[3];
        ins_real dv[3];
        ins_gimu_scale_thesis(&scale);
        const uint16_t units = (uint16_t)tape_integer();
        const uint16_t raw[6] = {units, units, units, units, units, units};
        const ins_real null = tape_real();
        for (int i = 0; i < 6; i++)
        {
            scale.null[i] = null;
        }
        ins_gimu_increments(&scale, raw, 1, dtheta, dv);
        for (int i = 0; i < 3; i++)
        {
            check(dtheta[i], tape_real(), 9); // 500 deg/s
        }
    }
    check_end();
}

void check_octets(void)
{
    handshake();
    gimu();
    scaling();
}
