// Pin R: sentences to the letter, and as the core reads them.
// SPDX-License-Identifier: MIT
#include "gimu_rig.hpp"
#include "ins/nmea.h"

namespace
{
Fix somewhere(bool known = true)
{
    return [known](std::int64_t t_ps, gimu_fix_t* fix)
    {
        *fix = {t_ps - t_ps % second,
                (24.0 + 45.4205 / 60.0) * deg,
                (120.0 + 57.06 / 60.0) * deg,
                81.5,
                10.0,
                123.456 * deg,
                1.24,
                known ? 7u : 2u};
        return known;
    };
}

std::vector<ins_nmea_fix_t> decoded(const std::string& text, ins_nmea_t* n)
{
    std::vector<ins_nmea_fix_t> out;
    ins_nmea_init(n);
    for (char c : text)
    {
        if (ins_nmea_rx(n, static_cast<ins_octet_t>(c)) != INS_NMEA_NOTHING)
        {
            out.push_back(n->fix);
        }
    }
    return out;
}

/// The date that RMC gives at an instant.
std::string date_at(std::int64_t utc_s)
{
    gimu_config_t config = default_config();
    config.utc_s = utc_s;
    Rig rig(config, nullptr, somewhere());
    rig.run_until(second);
    const std::size_t at = rig.text.find(",,,A*");
    return at == std::string::npos ? rig.text : rig.text.substr(at - 6, 6);
}
} // namespace

TEST(gimu_nmea, sentences_to_the_letter)
{
    gimu_config_t config = default_config();
    config.geoid_m = 19.2;
    config.utc_s += 13 * 3600 + 5 * 60 + 9;
    Rig rig(config, nullptr, somewhere());
    rig.run_until(second);
    EXPECT_EQ(rig.text, "$GPGGA,130509.000,2445.4205,N,12057.0600,E,1,07,1.2,62.3,M,19.2,M,,0000*68\r\n"
                        "$GPRMC,130509.000,A,2445.4205,N,12057.0600,E,19.44,123.46,010606,,,A*58\r\n");
    // The first start bit falls at 0.3 s; the decision of its octet comes 9 9/16 bits later.
    EXPECT_NEAR(static_cast<double>(rig.text_at[0]), 0.3e12 + 9.5625e12 / 4800.0, 200.0);
}

TEST(gimu_nmea, the_core_reads_them)
{
    for (double baud : {4800.0, 9600.0})
    {
        gimu_config_t config = default_config();
        config.nmea_baud = baud;
        config.geoid_m = -12.34;
        Rig rig(config, nullptr, somewhere());
        rig.run_until(10 * second);
        ins_nmea_t n;
        const std::vector<ins_nmea_fix_t> all = decoded(rig.text, &n);
        ASSERT_EQ(all.size(), 20u) << baud;
        EXPECT_EQ(n.bad_checksum + n.malformed + n.cut + n.other, 0u);
        EXPECT_EQ(rig.gimu.sentences, 20u);
        for (unsigned k = 0; k < 10; k++)
        {
            const ins_nmea_fix_t& gga = all[2 * k];
            const ins_nmea_fix_t& rmc = all[2 * k + 1];
            for (const ins_nmea_fix_t* f : {&gga, &rmc})
            {
                EXPECT_EQ(f->valid, 1);
                EXPECT_EQ(f->time_ms, 1000u * k);
                EXPECT_NEAR(f->lat_e7, 247570083, 1);
                EXPECT_NEAR(f->lon_e7, 1209510000, 1);
            }
            EXPECT_EQ(gga.quality, 1);
            EXPECT_EQ(gga.sats, 7);
            EXPECT_EQ(gga.hdop_milli, 1200);
            EXPECT_EQ(gga.altitude_mm, 93800) << "81.5 + 12.34";
            EXPECT_EQ(gga.geoid_mm, -12300);
            EXPECT_EQ(rmc.speed_milliknot, 19440);
            EXPECT_EQ(rmc.course_mdeg, 123460);
            EXPECT_EQ(rmc.date[0], 1);
            EXPECT_EQ(rmc.date[1], 6);
            EXPECT_EQ(rmc.date[2], 6);
        }
    }
}

TEST(gimu_nmea, without_a_fix_fields_are_empty)
{
    for (const Fix& fix : {somewhere(false), Fix(nullptr)})
    {
        Rig rig(default_config(), nullptr, fix);
        rig.run_until(2 * second);
        ins_nmea_t n;
        const std::vector<ins_nmea_fix_t> all = decoded(rig.text, &n);
        ASSERT_EQ(all.size(), 4u) << rig.text;
        EXPECT_EQ(all[0].valid, 0);
        EXPECT_EQ(all[0].has & (INS_NMEA_POSITION | INS_NMEA_ALTITUDE | INS_NMEA_HDOP), 0);
        EXPECT_EQ(all[0].sats, fix ? 2 : 0);
        EXPECT_EQ(all[3].valid, 0);
        EXPECT_EQ(all[3].has & (INS_NMEA_POSITION | INS_NMEA_SPEED | INS_NMEA_COURSE), 0);
        EXPECT_EQ(all[3].time_ms, 1000u) << "the clock goes on";
    }
}

TEST(gimu_nmea, southern_and_western)
{
    Rig rig(default_config(), nullptr, fixed(-33.5 * deg, -151.25 * deg, 5));
    rig.run_until(second);
    EXPECT_NE(rig.text.find(",3330.0000,S,15115.0000,W,1,05,"), std::string::npos) << rig.text;
}

TEST(gimu_nmea, dates_follow_the_calendar)
{
    EXPECT_EQ(date_at(946684800), "010100"); // 2000-01-01
    EXPECT_EQ(date_at(951782400), "290200"); // leap day of 2000
    EXPECT_EQ(date_at(951868800), "010300");
    EXPECT_EQ(date_at(1172620799), "270207"); // 23:59:59
    EXPECT_EQ(date_at(1204243200), "290208");
    EXPECT_EQ(date_at(1230768000 - 1), "311208");
    EXPECT_EQ(date_at(1230768000), "010109");
    EXPECT_EQ(date_at(4070908800), "010199");
}

TEST(gimu_nmea, midnight_turns_the_date)
{
    gimu_config_t config = default_config();
    config.utc_s = 1149120000 - 2;
    Rig rig(config, nullptr, somewhere());
    rig.run_until(4 * second);
    ins_nmea_t n;
    const std::vector<ins_nmea_fix_t> all = decoded(rig.text, &n);
    ASSERT_GE(all.size(), 6u);
    EXPECT_EQ(all[3].time_ms, 86399000u);
    EXPECT_EQ(all[3].date[0], 31);
    EXPECT_EQ(all[5].time_ms, 0u);
    EXPECT_EQ(all[5].date[0], 1);
}
