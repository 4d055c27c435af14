/// \file   test_reachable_parsers.cpp
/// \brief  GIMU and NMEA: every state they can reach, with every octet.
///
/// GIMU's key: how many octets wait, where a header is among them, whether the coordinates and satellites can be such. NMEA's: the
/// state, the body's length, its name as far as it has come, how the first digit of the checksum compares.
/// SPDX-License-Identifier: MIT
#include "reachable.h"
using namespace core_test;

TEST(reachable, gimu)
{
    // Windows without a header inside, and with one; with two they are checked and not followed.
    const auto headers = [](const ins_gimu_t& g)
    {
        unsigned first = 0;
        unsigned count = 0;
        for (unsigned i = 1; i + 1 < g.count; i++)
        {
            const bool here = g.wait[i] == 0xAA && g.wait[i + 1] == 0x55;
            first = here && count == 0 ? i : first;
            count += here;
        }
        return std::make_pair(first, count);
    };
    const auto coordinate = [](const ins_gimu_t& g, unsigned at) -> unsigned
    {
        uint32_t value = 0;
        for (unsigned i = at; i < at + 4 && i < g.count; i++)
        {
            value |= static_cast<uint32_t>(g.wait[i]) << (24 - 8 * (i - at));
        }
        return value < 181000000u && (g.count < at + 4 || value % 1000000u < 600000u);
    };
    const std::vector<ins_octet_t> packet = {0xAA, 0x55, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
    std::set<int> results;
    Search<ins_gimu_t> search = {OCTETS + 1,
                                 [&](ins_gimu_t& g, int n)
                                 { results.insert(n < OCTETS ? ins_gimu_rx(&g, octet_of(n)) : ins_gimu_flush(&g)); },
                                 [&](const ins_gimu_t& g) -> Key
                                 {
                                     const auto inside = headers(g);
                                     return {g.count,
                                             inside.first,
                                             std::min(inside.second, 2u),
                                             g.count > 1 && g.wait[g.count - 1] == 0xAA,
                                             coordinate(g, 14),
                                             coordinate(g, 18),
                                             g.count > 22 && g.wait[22] <= 32};
                                 },
                                 [](const ins_gimu_t& g) { return sound_gimu(&g) && sound_packet(&g.packet); },
                                 [&](ins_gimu_t g)
                                 {
                                     const uint32_t before = g.t1;
                                     for (int n = 0; n < 3; n++)
                                     {
                                         for (const ins_octet_t o : packet)
                                         {
                                             ins_gimu_rx(&g, o);
                                         }
                                     }
                                     while (ins_gimu_flush(&g) != INS_GIMU_NOTHING)
                                     {
                                     }
                                     return g.t1 >= before + 2 && g.packet.raw[0] == 0x102 && g.packet.raw[5] == 0xB0C;
                                 },
                                 [&](const ins_gimu_t& g) { return headers(g).second < 2; }};
    for (const int strict : {0, 1})
    {
        ins_gimu_t start;
        ins_gimu_init(&start, strict);
        const auto seen = search.from(start);
        EXPECT_EQ(column(seen, 0), up_to(INS_GIMU_LOOK - 1));
        EXPECT_EQ(column(seen, 4), up_to(1));
        EXPECT_EQ(column(seen, 5), up_to(1));
    }
    EXPECT_EQ(results, (std::set<int>{INS_GIMU_NOTHING, INS_GIMU_T1, INS_GIMU_T2}));
}

TEST(reachable, nmea)
{
    // The fields are one class: test_nmea.cpp, the fuzzer and the proof have them.
    const auto name = [](const ins_nmea_t& n) -> unsigned
    {
        const std::string is(n.body + std::min<unsigned>(n.count, 2), n.body + std::min<unsigned>(n.count, 6));
        unsigned found = 0;
        for (const char* known : {"GGA,", "RMC,", "VTG,"})
        {
            found++;
            if (!is.empty() && std::string(known).compare(0, is.size(), is) == 0)
            {
                return found;
            }
        }
        return is.empty() ? 0 : 4;
    };
    const std::string sentence = "$GPVTG,,T,,M,,N,,K*4E\r\n";
    std::set<int> results;
    const Search<ins_nmea_t> search = {
        OCTETS, [&](ins_nmea_t& n, int octet) { results.insert(ins_nmea_rx(&n, octet_of(octet))); },
        [&](const ins_nmea_t& n) -> Key
        {
            const unsigned digit = n.state != NMEA_SUM_2 ? 0u : n.sent == 16 ? 1u : n.sent == n.sum >> 4 ? 2u : 3u;
            const bool open = n.state != NMEA_IDLE;
            return {n.state, open ? n.count : 0u, open ? name(n) : 0u, digit, n.state == NMEA_END ? n.sent : 0u};
        },
        [](const ins_nmea_t& n) { return sound_nmea(&n) && sound_fix(&n.fix); },
        [&](ins_nmea_t n)
        {
            int last = INS_NMEA_NOTHING;
            for (const char c : sentence)
            {
                const int type = ins_nmea_rx(&n, octet_of(c));
                last = type != INS_NMEA_NOTHING ? type : last;
            }
            return last == INS_NMEA_VTG;
        }};
    ins_nmea_t start;
    ins_nmea_init(&start);
    const auto seen = search.from(start);
    EXPECT_EQ(column(seen, 0), up_to(NMEA_END));
    EXPECT_EQ(column(seen, 1), up_to(INS_NMEA_BODY_MAX));
    EXPECT_EQ(column(seen, 2), up_to(4));
    EXPECT_EQ(column(seen, 3), up_to(3));
    EXPECT_EQ(results, (std::set<int>{INS_NMEA_NOTHING, INS_NMEA_GGA, INS_NMEA_RMC, INS_NMEA_VTG}));
}
