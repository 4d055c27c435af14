/// The board by wiring: every pin a net, converters where the configuration puts them, a crystal that is off.
/// SPDX-License-Identifier: MIT
#include "acq_rig.hpp"
#include <array>

namespace
{
/// Six different volts, each rising.
double volts_of(unsigned channel, int64_t t)
{
    return 0.5 + 0.7 * channel + 0.3e-12 * static_cast<double>(t);
}

/// scan_six.c on a board, with nothing else.
struct six_t
{
    six_t(const char* image, void (*wiring)(acq_board_config_t*))
    {
        emu_sched_init(&sched);
        wiring(&config);
        config.adc.analog = {[](void*, unsigned channel, int64_t t) { return volts_of(channel, t); }, nullptr};
        config.adc.sampled = [](void* ctx, unsigned channel, uint16_t code, double, emu_time_t at) {
            static_cast<six_t*>(ctx)->samples.push_back({channel, code, at});
        };
        config.adc.sampled_ctx = this;
        config.adc.report = config.report = {[](void*, emu_report_kind_t, const char* text, uint32_t detail, emu_time_t)
                                             { ADD_FAILURE() << text << " (" << detail << ")"; },
                                             nullptr};
        board = acq_board_create(&config, &sched);
        load_hex(acq_board_cpu(board), std::string(INS_FIRMWARE_DIR "/") + image + ".ihx");
        symbols = load_map(std::string(INS_FIRMWARE_DIR "/") + image + ".map");
    }
    ~six_t() { acq_board_destroy(board); }
    six_t(const six_t&) = delete;
    six_t& operator=(const six_t&) = delete;
    unsigned u8(unsigned address) { return mcs51_iram(acq_board_cpu(board), static_cast<uint8_t>(address)); }
    unsigned scans() { return u8(symbols.at("_scans")); }
    unsigned code(unsigned channel)
    {
        const unsigned at = symbols.at("_codes") + 2 * channel;
        return u8(at) | u8(at + 1) << 8;
    }
    /// Run to the end of the scan of that number. \return the samples since the scan before.
    std::vector<sample_t> scan(unsigned number)
    {
        while (scans() != number)
        {
            samples.clear();
            const unsigned now = scans();
            while (scans() == now)
            {
                acq_board_run(board, sched.now + 10 * EMU_PS_PER_US);
            }
        }
        return samples;
    }
    acq_board_config_t config{};
    emu_sched_t sched;
    acq_board_t* board;
    std::map<std::string, unsigned> symbols;
    std::vector<sample_t> samples;
};

/// The newest sample of each channel before the last: that one is of the transfer that fetched the scan's last code.
std::array<sample_t, 6> by_channel(const std::vector<sample_t>& samples, size_t last)
{
    std::array<sample_t, 6> of{};
    for (size_t i = 0; i + last < samples.size(); i++)
    {
        of.at(samples[i].channel) = samples[i];
    }
    return of;
}

TEST(acq_wiring, six_channels_of_one_converter)
{
    six_t six("scan_one", acq_board_default_config);
    for (const unsigned number : {2u, 5u, 9u})
    {
        const auto of = by_channel(six.scan(number), 1);
        for (unsigned channel = 0; channel < 6; channel++)
        {
            EXPECT_EQ(of[channel].code, six.code(channel)) << "channel " << channel;
            EXPECT_NEAR(six.code(channel), volts_of(channel, of[channel].at) / kLsb, 0.5) << "channel " << channel;
            EXPECT_EQ(channel == 0 || of[channel].at > of[channel - 1].at, true);
        }
    }
}

TEST(acq_wiring, six_channels_of_two_converters_are_sampled_in_pairs)
{
    six_t six("scan_two", acq_board_six_config);
    for (const unsigned number : {2u, 5u, 9u})
    {
        const auto of = by_channel(six.scan(number), 2);
        for (unsigned channel = 0; channel < 6; channel++)
        {
            EXPECT_EQ(of[channel].code, six.code(channel)) << "channel " << channel;
            EXPECT_NEAR(six.code(channel), volts_of(channel, of[channel].at) / kLsb, 0.5) << "channel " << channel;
            EXPECT_EQ(of[channel].at, of[channel % 3].at) << "both converters in the same instant";
        }
    }
    EXPECT_EQ(acq_board_wire(six.board, "/CS 2"), acq_board_wire(six.board, "/CS")) << "shared";
    EXPECT_EQ(acq_board_wire(six.board, "DATA OUT 2"), acq_board_wire(six.board, "P1.6"));
    EXPECT_STREQ(acq_board_wire(six.board, "P1.6")->name, "DATA OUT 2");
    EXPECT_EQ(acq_board_wire(six.board, "/CS 3"), nullptr);
}

TEST(acq_wiring, converters_on_one_data_out_take_turns)
{
    acq_board_config_t config;
    acq_board_default_config(&config);
    config.adc_count = ACQ_ADCS_MAX;
    for (uint8_t n = 1; n < ACQ_ADCS_MAX; n++)
    {
        config.adcs[n] = config.adcs[0];
        config.adcs[n].eoc = {2, n};
        config.adcs[n].cs_n = {3, static_cast<uint8_t>(n + 2)};
    }
    emu_sched_t sched;
    emu_sched_init(&sched);
    acq_board_t* const board = acq_board_create(&config, &sched);
    ASSERT_NE(board, nullptr);
    const emu_wire_t* const out = acq_board_wire(board, "DATA OUT 4");
    EXPECT_EQ(out, acq_board_wire(board, "DATA OUT"));
    for (const auto& [port, bit] : {std::pair{1u, 4u}, {3u, 3u}, {3u, 4u}, {3u, 5u}})
    {
        acq_board_drive_pin(board, port, bit, EMU_STRONG0);
        emu_sched_advance(&sched, sched.now + EMU_PS_PER_US);
        EXPECT_TRUE(out->level) << "first bit of the power-up word, driven by the one that is selected";
        acq_board_drive_pin(board, port, bit, EMU_Z);
        emu_sched_advance(&sched, sched.now + EMU_PS_PER_US);
    }
    EXPECT_EQ(out->contentions, 0u);
    acq_board_destroy(board);
    for (unsigned n = 0; n < ACQ_ADCS_MAX; n++)
    {
        acq_board_config_t bad = config;
        bad.adcs[n].data_in = {4, 0};
        EXPECT_EQ(acq_board_create(&bad, &sched), nullptr) << "no port 4, converter " << n;
        bad.adcs[n].data_in = {0, 8};
        EXPECT_EQ(acq_board_create(&bad, &sched), nullptr) << "no bit 8, converter " << n;
    }
    config.adc_count = ACQ_ADCS_MAX + 1;
    EXPECT_EQ(acq_board_create(&config, &sched), nullptr);
}

/// What the CPU reads of a pin that the outside pulls low while the CPU does, before and after: MOV 30h,P2 with P2.0 toggled.
TEST(acq_wiring, a_pin_is_low_while_anybody_pulls_it)
{
    const uint8_t code[] = {0x85, 0xA0, 0x30, // loop: MOV 30h,P2
                            0xB2, 0xA0,       // CPL P2.0
                            0x85, 0xA0, 0x31, // MOV 31h,P2
                            0xB2, 0xA0,       // CPL P2.0
                            0x80, 0xF4};      // SJMP loop
    acq_board_config_t config;
    acq_board_default_config(&config);
    emu_sched_t sched;
    emu_sched_init(&sched);
    acq_board_t* const board = acq_board_create(&config, &sched);
    ASSERT_NE(board, nullptr);
    mcs51_t* const cpu = acq_board_cpu(board);
    ASSERT_EQ(mcs51_load(cpu, 0, code, sizeof code), 0);
    // Probe, at instants of every phase of the loop of 10 cycles: 31h has P2.0 low in any case, 30h follows the probe.
    for (unsigned n = 0; n < 100; n++)
    {
        const bool low = n % 2 == 0;
        acq_board_drive_pin(board, 2, 0, low ? EMU_STRONG0 : EMU_Z);
        acq_board_run(board, sched.now + (30 + n % 11) * EMU_PS_PER_US);
        EXPECT_EQ(mcs51_iram(cpu, 0x30), low ? 0xFE : 0xFF) << n;
        EXPECT_EQ(mcs51_iram(cpu, 0x31), 0xFE) << n;
        EXPECT_EQ(acq_board_pin(board, 2, 0), !low && (mcs51_port_out(cpu, 2) & 1u) != 0) << n;
    }
    acq_board_destroy(board);
}

TEST(acq_wiring, a_crystal_that_is_off_moves_every_sample)
{
    std::array<std::vector<emu_time_t>, 3> at;
    const int32_t ppb[3] = {0, 50000, -50000};
    for (unsigned i = 0; i < 3; i++)
    {
        rig_config_t config;
        acq_rig_t rig(config);
        acq_board_set_crystal(rig.board, ppb[i]);
        rig.run_to_ms(400);
        for (size_t k = 0; k < 16; k++)
        {
            at[i].push_back(rig.sample(k, 0).at);
        }
    }
    for (unsigned i = 1; i < 3; i++)
    {
        for (size_t k = 0; k < 16; k++)
        {
            const double ratio = static_cast<double>(at[0][k]) / static_cast<double>(at[i][k]);
            EXPECT_NEAR(ratio, 1.0 + ppb[i] * 1e-9, 1e-9) << ppb[i] << " ppb, scan " << k;
        }
    }
}

TEST(acq_wiring, a_drift_is_a_change_now_and_then)
{
    rig_config_t config;
    acq_rig_t rig(config);
    struct drift_t
    {
        acq_rig_t* rig;
        emu_event_t event;
        int32_t ppb;
        static void fire(void* ctx, emu_time_t at)
        {
            auto* self = static_cast<drift_t*>(ctx);
            self->ppb += 1000;
            acq_board_set_crystal(self->rig->board, self->ppb);
            emu_sched_at(&self->rig->sched, &self->event, at + 10 * kMs);
        }
    } drift{&rig, {}, 0};
    drift.event = {drift_t::fire, &drift, 0, false, nullptr, 0};
    emu_sched_at(&rig.sched, &drift.event, 10 * kMs);
    rig.run_to_ms(1000);
    // 100 ppb/ms for a second: the last period is faster than the first by 98 ppm, in the middle by 49.
    const auto period = [&rig](size_t k) { return static_cast<double>(rig.sample(k + 1, 0).at - rig.sample(k, 0).at); };
    EXPECT_NEAR(period(0) / 20e9, 1.0 - 2.5e-6, 2e-6);
    EXPECT_NEAR(period(24) / 20e9, 1.0 - 49e-6, 2e-6);
    EXPECT_NEAR(period(47) / 20e9, 1.0 - 95e-6, 2e-6);
    EXPECT_EQ(rig.lost() + rig.given_up(), 0u);
    EXPECT_TRUE(rig.reports.empty());
}
} // namespace
