/// \file   test_nmea.cpp
/// \brief  NMEA sentences: worked examples, random ones against strtod, every state with every octet, random octets.
/// SPDX-License-Identifier: MIT
#include "core_test.h"
#include <random>
using namespace core_test;

namespace
{
constexpr int RANDOM_SENTENCES = 20000;
constexpr long RANDOM_OCTETS = 1000000;
constexpr long RANDOM_OCTETS_BENCH = 100000000; ///< with INS_BENCH set

std::string with_sum(const std::string& body)
{
    unsigned sum = 0;
    for (const char c : body)
    {
        sum ^= static_cast<unsigned char>(c);
    }
    char tail[8];
    std::snprintf(tail, sizeof tail, "*%02X\r\n", sum);
    return "$" + body + tail;
}

int feed(ins_nmea_t& n, const std::string& text)
{
    int last = INS_NMEA_NOTHING;
    for (const char c : text)
    {
        const int type = ins_nmea_rx(&n, static_cast<ins_octet_t>(static_cast<unsigned char>(c)));
        last = type != INS_NMEA_NOTHING ? type : last;
    }
    return last;
}

/// Type of one sentence, its fix in `fix`.
int read(const std::string& body, ins_nmea_fix_t* fix)
{
    ins_nmea_t n;
    ins_nmea_init(&n);
    const int type = feed(n, with_sum(body));
    *fix = n.fix;
    EXPECT_EQ(n.taken + n.malformed + n.other + n.cut, 1u) << body;
    return type;
}

void expect_sound(const ins_nmea_t& n)
{
    ASSERT_LE(n.state, 4);
    ASSERT_LE(n.count, INS_NMEA_BODY_MAX);
    ASSERT_LE(std::abs(n.fix.lat_e7), 900000000);
    ASSERT_LE(std::abs(n.fix.lon_e7), 1800000000);
    ASSERT_LT(n.fix.time_ms, 86401000u);
}

const std::vector<std::string>& bodies()
{
    static const std::vector<std::string> list = {
        "GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,",
        "GNRMC,235959.995,A,2458.99999,S,12112.345678,W,022.4,084.4,230394,003.1,W,A",
        "GPVTG,054.7,T,034.4,M,005.5,N,010.2,K,A"};
    return list;
}
} // namespace

TEST(nmea, gga)
{
    ins_nmea_fix_t f;
    ASSERT_EQ(read(bodies()[0], &f), INS_NMEA_GGA);
    EXPECT_EQ(f.has,
              INS_NMEA_TIME | INS_NMEA_POSITION | INS_NMEA_SATS | INS_NMEA_HDOP | INS_NMEA_ALTITUDE | INS_NMEA_GEOID);
    EXPECT_EQ(f.time_ms, ((12u * 60 + 35) * 60 + 19) * 1000);
    EXPECT_EQ(f.lat_e7, 481173000);
    EXPECT_EQ(f.lon_e7, 115166667);
    EXPECT_EQ(f.valid, 1);
    EXPECT_EQ(f.quality, 1);
    EXPECT_EQ(f.sats, 8);
    EXPECT_EQ(f.hdop_milli, 900);
    EXPECT_EQ(f.altitude_mm, 545400);
    EXPECT_EQ(f.geoid_mm, 46900);
}

TEST(nmea, rmc_and_vtg)
{
    ins_nmea_fix_t f;
    ASSERT_EQ(read(bodies()[1], &f), INS_NMEA_RMC);
    EXPECT_EQ(f.time_ms, 86399995u);
    EXPECT_EQ(f.valid, 1);
    EXPECT_EQ(f.lat_e7, -249833332); // 24 deg 58.99999'
    EXPECT_EQ(f.lon_e7, -1212057613);
    EXPECT_EQ(f.speed_milliknot, 22400);
    EXPECT_EQ(f.course_mdeg, 84400);
    EXPECT_EQ(f.date[0], 23);
    EXPECT_EQ(f.date[1], 3);
    EXPECT_EQ(f.date[2], 94);
    ASSERT_EQ(read(bodies()[2], &f), INS_NMEA_VTG);
    EXPECT_EQ(f.has, INS_NMEA_COURSE | INS_NMEA_SPEED);
    EXPECT_EQ(f.course_mdeg, 54700);
    EXPECT_EQ(f.speed_milliknot, 5500);
    EXPECT_EQ(f.valid, 1);
    ASSERT_EQ(read("GPVTG,,T,,M,0.0,N,0.0,K,N", &f), INS_NMEA_VTG);
    EXPECT_EQ(f.valid, 0);
    EXPECT_EQ(f.has, INS_NMEA_SPEED);
}

TEST(nmea, empty_fields)
{
    ins_nmea_fix_t f;
    ASSERT_EQ(read("GPGGA,,,,,,0,,,,M,,M,,", &f), INS_NMEA_GGA);
    EXPECT_EQ(f.has, 0);
    EXPECT_EQ(f.valid, 0);
    ASSERT_EQ(read("GPGGA", &f), INS_NMEA_GGA);
    EXPECT_EQ(f.has, 0);
    ASSERT_EQ(read("GPRMC,,V,,,,,,,,,,N", &f), INS_NMEA_RMC);
    EXPECT_EQ(f.has, 0);
    EXPECT_EQ(f.valid, 0);
    for (const char* const sides : {",N,,E", ",S,,W", ",S,,E", ",,,"}) // hemispheres without digits
    {
        ASSERT_EQ(read("GPGGA,," + std::string(sides) + ",0,,,,M,,M,,", &f), INS_NMEA_GGA) << sides;
        EXPECT_EQ(f.has, 0);
    }
    EXPECT_EQ(read("GPGGA,,,X,,E,0,,,,M,,M,,", &f), INS_NMEA_NOTHING);
    EXPECT_EQ(read("GPGGA,,,N,,N,0,,,,M,,M,,", &f), INS_NMEA_NOTHING);
    ASSERT_EQ(read("GPVTG,054.7,T,,M,,N,,K,A", &f), INS_NMEA_VTG);
    EXPECT_EQ(f.valid, 0) << "no speed";
    EXPECT_EQ(f.has, INS_NMEA_COURSE);
    ASSERT_EQ(read("GPRMC,120000,A,,N,,E,,,010170,,,A", &f), INS_NMEA_RMC);
    EXPECT_EQ(f.has, INS_NMEA_TIME | INS_NMEA_DATE);
}

TEST(nmea, limits_and_what_cannot_be_read)
{
    struct Case
    {
        const char* body;
        int type;
    };
    const Case cases[] = {{"GPGGA,235960.999,9000.0000,N,18000.0000,E,1,32,1.0,-5.25,M,-10,M,,", INS_NMEA_GGA},
                          {"GPGGA,000000,0000,N,00000,W,1,0,1.,.5,M,0,M,,", INS_NMEA_NOTHING}, // .5 has no whole part
                          {"GPGGA,000000,0000,N,00000,W,1,0,1.,0.5,M,0,M,,", INS_NMEA_GGA},
                          {"GPGGA,240000,,,,,0,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,006000,,,,,0,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,000061,,,,,0,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,12345,,,,,0,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,123456x,,,,,0,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,9000.0001,N,00000.0,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,9100.0,N,00000.0,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,4860.0,N,00000.0,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,4800.0,N,18000.0000001,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,4800.0,N,99999.9999999,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,4800.0,E,00000.0,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,4800.0,,00000.0,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,4800.0,N,,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,4800.0,NN,00000.0,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,48,N,00000.0,E,1,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,,,,,256,,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,,,,,1,-1,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,,,,,1,4.5,,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,,,,,1,4,1.5.5,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,,,,,1,4,-,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,,,,,1,4,1999999.999,,,,,,", INS_NMEA_GGA},
                          {"GPGGA,,,,,,1,4,2000000,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,,,,,1,4,99999999999999999999,,,,,,", INS_NMEA_NOTHING},
                          {"GPGGA,,,,,,1,4,1,5,F,,,,", INS_NMEA_NOTHING},
                          {"GPRMC,,A,,,,,,,320194,,,A", INS_NMEA_NOTHING},
                          {"GPRMC,,A,,,,,,,311394,,,A", INS_NMEA_NOTHING},
                          {"GPRMC,,A,,,,,,,000194,,,A", INS_NMEA_NOTHING},
                          {"GPRMC,,A,,,,,,,010094,,,A", INS_NMEA_NOTHING},
                          {"GPRMC,,A,,,,,,,0101945,,,A", INS_NMEA_NOTHING},
                          {"GPVTG,054.7,034.4,005.5,010.2", INS_NMEA_NOTHING},
                          {"GPGSV,3,1,11", INS_NMEA_NOTHING},
                          {"GPGG", INS_NMEA_NOTHING},
                          {"", INS_NMEA_NOTHING}};
    for (const Case& c : cases)
    {
        ins_nmea_fix_t f;
        EXPECT_EQ(read(c.body, &f), c.type) << c.body;
    }
    ins_nmea_fix_t f;
    read(cases[0].body, &f);
    EXPECT_EQ(f.time_ms, 86400999u);
    EXPECT_EQ(f.lat_e7, 900000000);
    EXPECT_EQ(f.lon_e7, 1800000000);
    EXPECT_EQ(f.altitude_mm, -5250);
    EXPECT_EQ(f.geoid_mm, -10000);
}

TEST(nmea, framing_and_counters)
{
    ins_nmea_t n;
    ins_nmea_init(&n);
    EXPECT_EQ(feed(n, "noise\xFF\x80*00"), INS_NMEA_NOTHING);
    std::string bad = with_sum(bodies()[0]);
    bad[10] = '9';
    EXPECT_EQ(feed(n, bad), INS_NMEA_NOTHING);
    EXPECT_EQ(n.bad_checksum, 1u);
    EXPECT_EQ(feed(n, "$GPGGA*5G\r\n"), INS_NMEA_NOTHING);
    EXPECT_EQ(feed(n, "$GPGGA*G6\r\n"), INS_NMEA_NOTHING);
    EXPECT_EQ(n.bad_checksum, 3u);
    std::string unended = with_sum(bodies()[0]);
    unended.replace(unended.size() - 2, 2, ",");
    EXPECT_EQ(feed(n, unended), INS_NMEA_NOTHING);
    EXPECT_EQ(n.bad_checksum, 4u);
    EXPECT_EQ(feed(n, "$GPGGA,12\r\n"), INS_NMEA_NOTHING);
    EXPECT_EQ(n.cut, 1u);
    EXPECT_EQ(feed(n, "$GPGGA,$GP" + with_sum(bodies()[0])), INS_NMEA_GGA) << "a $ begins anew";
    EXPECT_EQ(n.cut, 3u);
    EXPECT_EQ(feed(n, "$" + std::string(INS_NMEA_BODY_MAX + 1, 'x')), INS_NMEA_NOTHING);
    EXPECT_EQ(n.cut, 4u);
    EXPECT_EQ(feed(n, with_sum(std::string(INS_NMEA_BODY_MAX, 'x'))), INS_NMEA_NOTHING);
    EXPECT_EQ(n.other, 1u);
    std::string small = with_sum(bodies()[1]);
    for (size_t i = small.size() - 5; i < small.size(); i++)
    {
        small[i] = static_cast<char>(std::tolower(small[i]));
    }
    EXPECT_EQ(feed(n, small), INS_NMEA_RMC);
    EXPECT_EQ(n.taken, 2u);
    EXPECT_EQ(n.malformed, 0u);
    const ins_nmea_fix_t before = n.fix;
    EXPECT_EQ(feed(n, with_sum("GPGGA,9")), INS_NMEA_NOTHING);
    EXPECT_EQ(n.malformed, 1u);
    EXPECT_EQ(n.fix.lat_e7, before.lat_e7) << "a refused sentence leaves the fix alone";
}

TEST(nmea, random_sentences_against_strtod)
{
    const unsigned seed = 183;
    std::printf("seed %u, %d sentences\n", seed, RANDOM_SENTENCES);
    std::mt19937 random(seed);
    for (int k = 0; k < RANDOM_SENTENCES; k++)
    {
        const unsigned lat = static_cast<unsigned>(random() % 90);
        const unsigned lon = static_cast<unsigned>(random() % 180);
        const int places = static_cast<int>(random() % 8);
        const double scale = std::pow(10.0, places);
        const double minutes = std::floor(std::uniform_real_distribution<double>(0, 60)(random) * scale) / scale;
        const bool south = random() % 2;
        const bool west = random() % 2;
        const double altitude = static_cast<double>(random() % 20000000) / 1000 - 500;
        char minute_text[16];
        std::snprintf(minute_text, sizeof minute_text, "%0*.*f", places ? places + 3 : 2, places, minutes);
        char body[128];
        std::snprintf(body, sizeof body, "GPGGA,000000,%02u%s,%c,%03u%s,%c,1,4,1.0,%.3f,M,,M,,", lat, minute_text,
                      south ? 'S' : 'N', lon, minute_text, west ? 'W' : 'E', altitude);
        ins_nmea_fix_t f;
        ASSERT_EQ(read(body, &f), INS_NMEA_GGA) << body;
        const double m = std::strtod(minute_text, nullptr) / 60;
        EXPECT_NEAR(f.lat_e7, (south ? -1 : 1) * (lat + m) * 1e7, 0.500001) << body;
        EXPECT_NEAR(f.lon_e7, (west ? -1 : 1) * (lon + m) * 1e7, 0.500001) << body;
        EXPECT_EQ(f.altitude_mm, std::lround(altitude * 1000)) << body;
    }
}

/// Each octet of each sentence replaced by every other: refused by the checksum; and with the checksum made right, read or refused.
TEST(nmea, every_octet_at_every_place)
{
    long cases = 0;
    long read_all_the_same = 0;
    for (const std::string& body : bodies())
    {
        const std::string good = with_sum(body);
        for (size_t at = 0; at < body.size(); at++)
        {
            for (unsigned octet = 0; octet < 256; octet++)
            {
                std::string text = good;
                text[1 + at] = static_cast<char>(octet);
                ins_nmea_t n;
                ins_nmea_init(&n);
                const bool same = text == good;
                ASSERT_EQ(feed(n, text) != INS_NMEA_NOTHING, same) << text;
                ASSERT_EQ(feed(n, good), feed(n, good)) << "a good one after it is read";
                ASSERT_EQ(n.taken, same ? 3u : 2u);
                std::string repaired = body;
                repaired[at] = static_cast<char>(octet);
                ins_nmea_init(&n);
                read_all_the_same += feed(n, with_sum(repaired)) != INS_NMEA_NOTHING;
                expect_sound(n);
                cases++;
            }
        }
    }
    std::printf("[ figure   ] %ld cases, %ld of them readable with their own checksum\n", cases, read_all_the_same);
}

/// Every state and every length of body, with every octet.
TEST(nmea, every_state_with_every_octet)
{
    long cases = 0;
    for (uint_least8_t state = 0; state <= 4; state++)
    {
        for (unsigned count = 0; count <= INS_NMEA_BODY_MAX; count++)
        {
            for (unsigned octet = 0; octet < 256; octet++)
            {
                ins_nmea_t n;
                ins_nmea_init(&n);
                n.state = state;
                n.count = static_cast<uint_least8_t>(count);
                n.sum = static_cast<uint_least8_t>(count);
                n.sent = static_cast<uint_least8_t>(count % 17);
                std::copy_n(bodies()[count % 3].begin(), std::min<size_t>(count, bodies()[count % 3].size()), n.body);
                ins_nmea_rx(&n, static_cast<ins_octet_t>(octet));
                expect_sound(n);
                cases++;
                ASSERT_EQ(feed(n, with_sum(bodies()[0])), INS_NMEA_GGA);
            }
        }
    }
    std::printf("[ figure   ] %ld states with an octet\n", cases);
}

TEST(nmea, random_octets)
{
    const unsigned seed = 4800;
    const long count = std::getenv("INS_BENCH") ? RANDOM_OCTETS_BENCH : RANDOM_OCTETS;
    std::printf("seed %u, %ld octets\n", seed, count);
    std::mt19937 random(seed);
    const std::string likely = "$*,.-0123456789NSEWMTKAVGPGGARMCVTG";
    ins_nmea_t n;
    ins_nmea_init(&n);
    std::string line;
    for (long k = 0; k < count; k++)
    {
        if (line.empty()) // a sentence with some octets replaced, removed or inserted, its checksum made right
        {
            std::string body = bodies()[random() % 3];
            for (unsigned changes = static_cast<unsigned>(random() % 4); changes > 0 && !body.empty(); changes--)
            {
                const size_t at = random() % body.size();
                const char c = random() % 8 ? likely[random() % likely.size()] : static_cast<char>(random() % 256);
                switch (random() % 3)
                {
                case 0:
                    body[at] = c;
                    break;
                case 1:
                    body.erase(at, 1 + random() % 3);
                    break;
                default:
                    body.insert(at, 1 + random() % 3, c);
                    break;
                }
            }
            line = with_sum(body);
        }
        ins_nmea_rx(&n, static_cast<ins_octet_t>(static_cast<unsigned char>(line.front())));
        line.erase(0, 1);
        expect_sound(n);
        if (testing::Test::HasFatalFailure())
        {
            FAIL() << "at octet " << k;
        }
    }
    std::printf("taken %u, malformed %u, other %u, cut %u, checksum %u\n", n.taken, n.malformed, n.other, n.cut,
                n.bad_checksum);
    EXPECT_GT(n.taken, 0u);
    EXPECT_GT(n.malformed, 0u);
    EXPECT_GT(n.other, 0u);
    EXPECT_GT(n.cut, 0u);
}
