/// \file   run.cpp
/// \brief  See run.hpp. SPDX-License-Identifier: MIT
#include "run.hpp"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace libins
{
namespace
{

emu_time_t picoseconds(double seconds)
{
    return static_cast<emu_time_t>(std::floor(seconds * 1e12 + 0.5));
}

constexpr double front_end_tolerance_v = 1e-7; // a code of 12 bits in 5 V is 1.2e-3
constexpr double unlimited_v = 1e3;            // the rails are the front end's

} // namespace

void Run::open_sensors(ins_gyro_config_t gyro)
{
    std::array<char, 256> why{};
    ins_front_end_config_t f{};
    if (config_.front_end)
    {
        double& low = config_.accels ? config_.accels->rail_low_v : gyro.rail_low_v;
        double& high = config_.accels ? config_.accels->rail_high_v : gyro.rail_high_v;
        f.channels = channels();
        f.tolerance_v = front_end_tolerance_v;
        f.source = on_sensors;
        f.ctx = this;
        std::fill(f.channel, f.channel + f.channels, *config_.front_end);
        for (ins_front_end_channel_t& channel : f.channel)
        {
            channel.rail_low_v = low;
            channel.rail_high_v = high;
        }
        low = -unlimited_v;
        high = unlimited_v;
    }
    if (!ins_gyro_init(&gyro_, &gyro, motion().get(), why.data(), why.size()) ||
        (config_.accels && !ins_accels_init(&accels_, &*config_.accels, config_.track.get(), why.data(), why.size())))
    {
        throw std::invalid_argument(why.data());
    }
    if (config_.front_end)
    {
        f.hold_ps = config_.accels ? accels_.hold_ps : gyro_.noise_step_ps;
        front_end_.open(f);
    }
}

Run::Run(const RunConfig& config, std::shared_ptr<ins_motion_t> motion, const ins_gyro_config_t& gyro)
    : scans(config.scans_kept), config_(config), motion_(std::move(motion))
{
    open_sensors(gyro);
    if (config_.nav)
    {
        config_.six_nav ? navigator_.begin(*config_.six_nav, config_.track)
                        : navigator_.begin(*config_.nav, config_.start_at_truth);
    }
    emu_sched_init(&sched_);
    acq_board_config_t board;
    (config_.six ? acq_board_six_config : acq_board_default_config)(&board);
    board.part = config_.part;
    board.code_octets = config_.code_octets;
    board.xdata_octets = config_.xdata_octets;
    board.crystal_hz = config_.crystal_hz;
    board.adc.analog = {on_volts, this};
    board.adc.sampled = on_sample;
    board.adc.sampled_ctx = this;
    board.adc.fault = on_outcome;
    board.adc.fault_ctx = this;
    board.adc.report = {on_report, this};
    board.report = {on_report, this};
    board_.reset(acq_board_create(&board, &sched_));
    if (!board_)
    {
        throw std::invalid_argument(
            "the board could not be made: out of memory, or a crystal or memory outside its range");
    }
    observers_.emplace(cpu());
    for (const Segment& segment : config_.image)
    {
        const auto* octets = reinterpret_cast<const uint8_t*>(segment.octets.data());
        if (mcs51_load(acq_board_cpu(board_.get()), segment.address, octets, segment.octets.size()) != 0)
        {
            throw std::invalid_argument("the firmware image does not fit the code memory");
        }
    }
    wire_up();
    const uint32_t flash = config_.part == MCS51_AT89S51 ? 4096 : 8192;
    const uint32_t ram = config_.part == MCS51_AT89S51 ? 128 : 256;
    const uint32_t code = config_.code_octets != 0 ? config_.code_octets : flash;
    faults_.emplace(
        Faults::Target{board_.get(), &sched_, &end_, &host_rxd_, config_.baud, ram, config_.xdata_octets, code});
}

void Run::wire_up()
{
    emu_wire_t* const txd = acq_board_wire(board_.get(), "TXD");
    emu_wire_t* const rxd = acq_board_wire(board_.get(), "RXD");
    emu_wire_init(&host_rxd_, "HOST RXD", true);
    emu_wire_init(&host_txd_, "HOST TXD", true);
    for (const auto& [from, to] : config_.cuts_s)
    {
        cuts_.push_back({picoseconds(from), picoseconds(to)});
    }
    emu_serial_faults_t faults{};
    faults.baud = config_.baud;
    faults.bit_error = config_.bit_error;
    faults.octet_loss = config_.octet_loss;
    faults.cuts = cuts_.data();
    faults.cut_count = static_cast<unsigned>(cuts_.size());
    faults.seed = 2 * config_.seed;
    bool wired = emu_serial_line_init(&lines_[0], &sched_, txd, &host_rxd_, &faults) == 0;
    faults.seed = 2 * config_.seed + 1;
    wired = wired && emu_serial_line_init(&lines_[1], &sched_, &host_txd_, rxd, &faults) == 0;
    emu_wire_t* const transmits = config_.outside ? nullptr : &host_txd_;
    wired = wired && emu_serial_end_init(&end_, &sched_, transmits, &host_rxd_, config_.baud, on_octet, this) == 0;
    for (unsigned i = 0; wired && config_.trace && i < traced.size(); i++)
    {
        taps_[i] = {this, i};
        wired = emu_wire_watch(acq_board_wire(board_.get(), traced[i]), on_edge, &taps_[i]) == 0;
    }
    for (unsigned i = 0; wired && config_.seen && i < pins; i++)
    {
        const std::string name = "P" + std::to_string(i / 8) + "." + std::to_string(i % 8);
        pin_taps_[i] = {this, i};
        wired = emu_wire_watch(acq_board_wire(board_.get(), name.c_str()), on_pin_edge, &pin_taps_[i]) == 0;
    }
    if (!wired)
    {
        throw std::invalid_argument("the serial line could not be made: baud, probability or cut out of range");
    }
}

bool Run::until(emu_time_t t)
{
    constexpr emu_time_t look_most = EMU_PS_PER_S; // the host's clock of milliseconds has 16 bits
    while (sched_.now < t)
    {
        if (faults_->next() <= sched_.now)
        {
            faults_->apply();
        }
        while (knobs_.next() <= sched_.now)
        {
            act(knobs_.take());
        }
        const emu_time_t look = config_.nav ? std::min(t, sched_.now + look_most) : t;
        const emu_time_t next = std::min({look, faults_->next(), knobs_.next()});
        const mcs51_stop_t stop = acq_board_run(board_.get(), next);
        halted_ = stop == MCS51_HALTED;
        if (config_.nav)
        {
            navigator_.tick(sched_.now);
        }
        if (stop == MCS51_STOPPED)
        {
            return false;
        }
    }
    return true;
}

bool Run::until_octet(emu_time_t t)
{
    stop_at_octet_ = true;
    const bool reached = until(t);
    stop_at_octet_ = false;
    return reached;
}

void Run::set_motion(std::shared_ptr<ins_motion_t> motion, bool keep)
{
    motion_.set_base(std::move(motion), keep);
    gyro_.motion = motion_.get().get();
}

void Run::add_knob(const Knob& knob)
{
    const bool sensors = knob.kind != KnobKind::volts && knob.kind != KnobKind::release && knob.kind != KnobKind::send;
    if (config_.accels && sensors)
    {
        throw std::invalid_argument("this board has no gyros: volts, release and send are possible");
    }
    if (knob.at <= sched_.now)
    {
        act(knob);
    }
    else
    {
        knobs_.add(knob);
    }
}

void Run::act(const Knob& knob)
{
    const double at_s = static_cast<double>(knob.at) * 1e-12;
    ins_gyro_config_t gyro = gyro_.config;
    switch (knob.kind)
    {
    case KnobKind::rate:
        motion_.turn(at_s, knob.values);
        gyro_.motion = motion().get();
        break;
    case KnobKind::attitude:
        motion_.tilt(at_s, static_cast<double>(knob.lasts) * 1e-12, knob.values);
        gyro_.motion = motion().get();
        break;
    case KnobKind::volts:
        set_volts(knob.channel, knob.values[0]);
        break;
    case KnobKind::release:
        clear_volts(knob.channel);
        break;
    case KnobKind::bias:
    case KnobKind::noise:
        for (unsigned i = 0; i < INS_GYRO_CHANNELS; i++)
        {
            (knob.kind == KnobKind::bias ? gyro.channel[i].bias : gyro.channel[i].noise_density) = knob.values[i];
        }
        set_gyro(gyro);
        break;
    case KnobKind::send:
        send(knob.octets);
        break;
    }
}

void Run::set_gyro(const ins_gyro_config_t& config)
{
    std::array<char, 256> why{};
    if (!ins_gyro_init(&gyro_, &config, motion().get(), why.data(), why.size()))
    {
        throw std::invalid_argument(why.data());
    }
}

/// \return whether the host's transmitter had room.
bool Run::transmit(uint8_t octet)
{
    const bool taken = emu_serial_end_send(&end_, octet);
    if (taken && config_.seen && config_.listen)
    {
        sent_.push_back({sched_.now, octet, true});
    }
    return taken;
}

size_t Run::send(const std::string& octets)
{
    size_t taken = 0;
    while (taken < octets.size() && transmit(static_cast<uint8_t>(octets[taken])))
    {
        taken++;
    }
    return taken;
}

double Run::on_sensors(void* ctx, unsigned channel, int64_t t)
{
    Run& self = *static_cast<Run*>(ctx);
    return self.config_.accels ? ins_accels_volts(&self.accels_, channel, t) : ins_gyro_volts(&self.gyro_, channel, t);
}

double Run::on_volts(void* ctx, unsigned channel, int64_t t)
{
    Run& self = *static_cast<Run*>(ctx);
    const auto held = self.volts_.find(channel);
    const auto signal = self.config_.signals.find(channel);
    const double volts = held != self.volts_.end()              ? held->second
                         : signal != self.config_.signals.end() ? signal->second.at(static_cast<double>(t) * 1e-12)
                         : self.front_end_.is_open()            ? self.front_end_.volts(channel, t)
                                                                : on_sensors(ctx, channel, t);
    return self.faults_->volts(channel, volts, t);
}

void Run::on_outcome(void* ctx, unsigned channel, emu_time_t at, tlc2543_outcome_t* outcome)
{
    static_cast<Run*>(ctx)->faults_->outcome(channel, at, outcome);
}

void Run::on_sample(void* ctx, unsigned channel, uint16_t code, double volts, emu_time_t at)
{
    Run& self = *static_cast<Run*>(ctx);
    if (self.config_.seen)
    {
        self.samples_.push_back({at, channel, code, volts});
    }
    if (channel == 0)
    {
        self.pending_channels_ = 0;
    }
    if (channel != self.pending_channels_ || channel >= self.channels())
    {
        return; // not the next of X, Y, Z: no scan of this firmware's
    }
    self.pending_.at[channel] = at;
    self.pending_.code[channel] = code;
    self.pending_channels_++;
    if (self.pending_channels_ == self.channels())
    {
        self.scans.add(self.pending_);
        self.pending_channels_ = 0;
    }
}

void Run::on_edge(void* ctx, bool level, emu_time_t at)
{
    const Tap& tap = *static_cast<const Tap*>(ctx);
    tap.run->edges_.push_back({at, tap.wire, level});
}

void Run::on_pin_edge(void* ctx, bool level, emu_time_t at)
{
    const Tap& tap = *static_cast<const Tap*>(ctx);
    tap.run->pin_edges_.push_back({at, tap.wire, level});
}

void Run::on_report(void* ctx, emu_report_kind_t kind, const char* text, uint32_t detail, emu_time_t at)
{
    add_report(static_cast<Run*>(ctx)->reports, kind, text, detail, at);
}

void Run::on_octet(void* ctx, uint8_t octet, bool framing_ok, emu_time_t at)
{
    Run& self = *static_cast<Run*>(ctx);
    if (!self.config_.nav || self.config_.listen)
    {
        self.octets_.push_back({at, octet, framing_ok});
    }
    if (self.stop_at_octet_)
    {
        mcs51_stop(self.cpu());
    }
    if (!self.config_.nav || !framing_ok)
    {
        return; // a UART hands no octet on without its stop bit; the end counts it
    }
    if (const int reply = self.navigator_.octet(octet, at, self.scans, self.motion().get()); reply >= 0)
    {
        self.transmit(static_cast<uint8_t>(reply));
    }
}

} // namespace libins
