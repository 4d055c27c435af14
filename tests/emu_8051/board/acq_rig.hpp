/// \file   acq_rig.hpp
/// \brief  The acquisition board with a real image, and a host on the other end of its serial line, in virtual time.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/serial.h"
#include "emu_8051/acq_board.h"
#include "ins/handshake.h"
#include <cmath>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

constexpr emu_time_t kMs = 1000 * EMU_PS_PER_US;
constexpr double kLsb = 5.0 / 4096;
constexpr uint64_t kCyclesPerSecond = 921600;

/// Data records of an Intel HEX file, checked.
inline void load_hex(mcs51_t* cpu, const std::string& path)
{
    std::ifstream in(path);
    ASSERT_TRUE(in.good()) << path << ": build the target firmware_8051";
    std::string line;
    while (std::getline(in, line))
    {
        std::vector<uint8_t> octets;
        unsigned sum = 0;
        for (size_t i = 1; i + 1 < line.size(); i += 2)
        {
            octets.push_back(static_cast<uint8_t>(std::stoul(line.substr(i, 2), nullptr, 16)));
            sum += octets.back();
        }
        ASSERT_EQ(sum & 0xFFu, 0u) << path << ": " << line;
        if (octets[3] == 0)
        {
            const auto address = static_cast<uint16_t>(octets[1] << 8 | octets[2]);
            ASSERT_EQ(mcs51_load(cpu, address, &octets[4], octets[0]), 0) << path << ": " << line;
        }
    }
}

/// Addresses of global symbols, from the linker's map.
inline std::map<std::string, unsigned> load_map(const std::string& path)
{
    std::ifstream in(path);
    std::map<std::string, unsigned> symbols;
    std::string line, address, name;
    while (std::getline(in, line))
    {
        std::istringstream fields(line.rfind("C:", 0) == 0 ? line.substr(2) : line);
        if (fields >> address >> name && address.size() == 8 && name[0] == '_')
        {
            symbols[name] = static_cast<unsigned>(std::stoul(address, nullptr, 16));
        }
    }
    return symbols;
}

struct sample_t
{
    unsigned channel;
    unsigned code;
    emu_time_t at;
};

struct block_t
{
    std::vector<unsigned> octets;
    std::vector<uint16_t> codes;
    unsigned seq, gap;
    emu_time_t at;
};

struct rig_config_t
{
    std::string image = "acq_default";
    double baud = 9600.0, host_baud = 0.0; ///< 0: the same
    uint64_t crystal_hz = 11059200;
    uint8_t block_len = 6, seq = 1;
    unsigned channels = 3;
    uint16_t octet_timeout_ms = 4;
    unsigned ignored_requests = 0;    ///< AAs of each exchange the host lets pass
    emu_serial_faults_t up{}, down{}; ///< board to host, host to board
    double (*volts)(unsigned channel, int64_t t) = nullptr;
};

class acq_rig_t
{
  public:
    explicit acq_rig_t(const rig_config_t& config_) : config(config_)
    {
        emu_sched_init(&sched);
        acq_board_config_t b;
        acq_board_default_config(&b);
        EXPECT_EQ(b.crystal_hz, 11059200u);
        b.crystal_hz = config.crystal_hz;
        b.adc.analog = {[](void* ctx, unsigned channel, int64_t t)
                        {
                            const auto* self = static_cast<acq_rig_t*>(ctx);
                            return self->config.volts != nullptr ? self->config.volts(channel, t) : 2.5;
                        },
                        this};
        b.adc.sampled = [](void* ctx, unsigned channel, uint16_t code, double, emu_time_t at) {
            static_cast<acq_rig_t*>(ctx)->samples.push_back({channel, code, at});
        };
        b.adc.sampled_ctx = this;
        b.report = b.adc.report = {[](void* ctx, emu_report_kind_t, const char* text, uint32_t detail, emu_time_t at)
                                   {
                                       static_cast<acq_rig_t*>(ctx)->reports.push_back(
                                           std::to_string(at) + " ps: " + text + " (" + std::to_string(detail) + ")");
                                   },
                                   this};
        board = acq_board_create(&b, &sched);
        cpu = acq_board_cpu(board);
        load_hex(cpu, INS_FIRMWARE_DIR "/" + config.image + ".ihx");
        symbols = load_map(INS_FIRMWARE_DIR "/" + config.image + ".map");

        emu_wire_init(&to_host, "host RXD", true);
        emu_wire_init(&from_host, "host TXD", true);
        EXPECT_EQ(emu_serial_line_init(&up, &sched, acq_board_wire(board, "TXD"), &to_host, &config.up), 0);
        const double baud = config.host_baud > 0.0 ? config.host_baud : config.baud;
        EXPECT_EQ(emu_serial_end_init(&end, &sched, &from_host, &to_host, baud, received, this), 0);
        EXPECT_EQ(emu_serial_line_init(&down, &sched, &from_host, acq_board_wire(board, "RXD"), &config.down), 0);
        ins_hs_config_t hs; // a snapshot holds the host as it lies in memory, padding and all
        std::memset(&hs, 0, sizeof hs);
        std::memset(&host, 0, sizeof host);
        hs.block_len = config.block_len;
        hs.seq = config.seq;
        hs.retries = 3;
        hs.octet_timeout = config.octet_timeout_ms;
        EXPECT_EQ(ins_hs_host_init(&host, &hs), INS_OK);
        clock = {tick, this, 0, false, nullptr, 0};
        ack = {acknowledge, this, 0, false, nullptr, 0};
        tick(this, 0);
    }
    ~acq_rig_t() { acq_board_destroy(board); }
    acq_rig_t(const acq_rig_t&) = delete;
    acq_rig_t& operator=(const acq_rig_t&) = delete;

    void run_to_ms(double ms) { acq_board_run(board, static_cast<emu_time_t>(ms * 1e9)); }
    /// The line and the host, after the board's own state.
    void outside_state(emu_state_t* io)
    {
        emu_wire_state(&to_host, io);
        emu_wire_state(&from_host, io);
        emu_serial_line_state(&up, io);
        emu_serial_line_state(&down, io);
        emu_serial_end_state(&end, io);
        emu_event_state(&sched, &clock, io);
        emu_event_state(&sched, &ack, io);
        emu_state_octets(io, &host, sizeof host);
        emu_state_bool(io, &exchanging);
        emu_state_u32(io, &asked);
    }
    unsigned u8(const std::string& symbol, unsigned offset = 0)
    {
        EXPECT_EQ(symbols.count(symbol), 1u) << symbol;
        return mcs51_iram(cpu, static_cast<uint8_t>(symbols[symbol] + offset));
    }
    unsigned u16(const std::string& symbol, unsigned offset = 0)
    {
        return u8(symbol, offset) | u8(symbol, offset + 1) << 8;
    }
    unsigned link_counter(unsigned n)
    {
        return u16("_link", mcs51_code(cpu, static_cast<uint16_t>(symbols.at("_link_counters"))) + 2 * n);
    }
    unsigned sent() { return link_counter(0); }
    unsigned resent() { return link_counter(1); }
    unsigned given_up() { return link_counter(2); }
    unsigned sampled() { return u16("_sampled"); }
    unsigned lost() { return u16("_lost"); }
    /// Machine cycle of an instant on a cycle's edge.
    uint64_t cycle(emu_time_t at) const
    {
        const emu_clock_t machine{11059200, 12};
        return emu_clock_tick(&machine, at);
    }
    /// Samples of scan k (from 0), in order: X, Y, Z (of six accelerometers, AIN0 to AIN5) and the last transfer's.
    const sample_t& sample(size_t scan, unsigned transfer) const
    {
        return samples[(config.channels + 1) * scan + transfer];
    }

    rig_config_t config;
    emu_sched_t sched;
    acq_board_t* board;
    mcs51_t* cpu;
    std::map<std::string, unsigned> symbols;
    emu_wire_t to_host, from_host;
    emu_serial_line_t up, down;
    emu_serial_end_t end;
    ins_hs_host_t host;
    emu_event_t clock;
    bool silent = false;      ///< the host answers nothing
    emu_time_t ack_delay = 0; ///< from a block to its 00
    std::vector<sample_t> samples;
    std::vector<block_t> blocks;
    std::vector<emu_time_t> request_at; ///< decision of each AA that began an exchange
    std::vector<std::string> reports;

  private:
    bool exchanging = false; ///< BB is out
    unsigned asked = 0;
    emu_event_t ack;
    static void acknowledge(void* ctx, emu_time_t)
    {
        emu_serial_end_send(&static_cast<acq_rig_t*>(ctx)->end, INS_HS_ACCEPT);
    }
    uint16_t now() const { return static_cast<uint16_t>(sched.now / kMs); }
    static void tick(void* ctx, emu_time_t at)
    {
        auto* self = static_cast<acq_rig_t*>(ctx);
        ins_hs_host_tick(&self->host, self->now());
        emu_sched_at(&self->sched, &self->clock, at + kMs);
    }
    static void received(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at)
    {
        auto* self = static_cast<acq_rig_t*>(ctx);
        if (self->silent || !framing_ok)
        {
            return;
        }
        if (!self->exchanging && octet == INS_HS_REQUEST && ++self->asked <= self->config.ignored_requests)
        {
            return;
        }
        int16_t reply;
        const int what = ins_hs_host_rx(&self->host, octet, self->now(), &reply);
        if (reply == INS_HS_READY)
        {
            self->request_at.push_back(at);
            self->exchanging = true;
        }
        if (what == INS_HS_BLOCK)
        {
            block_t b{{}, {}, self->host.seq, self->host.gap, at};
            b.octets.assign(self->host.block, self->host.block + self->config.block_len);
            b.codes.resize(self->config.channels);
            for (unsigned channel = 0; channel < self->config.channels; channel += 3)
            {
                ins_hs_block_codes(self->host.block + 2 * channel, &b.codes[channel]);
            }
            self->blocks.push_back(b);
        }
        if (reply == INS_HS_ACCEPT)
        {
            self->exchanging = false;
            self->asked = 0;
            emu_sched_at(&self->sched, &self->ack, at + self->ack_delay);
        }
        else if (reply >= 0)
        {
            emu_serial_end_send(&self->end, static_cast<uint8_t>(reply));
        }
    }
};
