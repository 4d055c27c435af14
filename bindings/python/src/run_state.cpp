/// \file   run_state.cpp
/// \brief  Snapshot and restore of a run. SPDX-License-Identifier: MIT
///
/// "LRUN", version; octets that follow and their FNV-1a, by eight octets at a time; then board, line, host, navigator and what was counted. The navigator is there
/// as the core keeps it, in the machine's own layout: a snapshot with a navigator is for builds of one kind.
#include "run.hpp"
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace libins
{
namespace
{

constexpr uint32_t version = 4;
constexpr size_t header_octets = 24;

uint64_t fnv1a(const char* octets, size_t size)
{
    uint64_t hash = 0xCBF29CE484222325;
    uint64_t word = 0;
    for (; size >= sizeof word; size -= sizeof word, octets += sizeof word)
    {
        std::memcpy(&word, octets, sizeof word);
        hash = (hash ^ word) * 0x100000001B3;
    }
    word = 0;
    std::memcpy(&word, octets, size);
    return (hash ^ word) * 0x100000001B3;
}

void same(emu_state_t* io, uint64_t value)
{
    uint64_t loaded = value;
    emu_state_u64(io, &loaded);
    emu_state_check(io, loaded == value);
}

void size(emu_state_t* io, size_t& value)
{
    uint64_t octets = value;
    emu_state_u64(io, &octets);
    value = io->bad ? value : static_cast<size_t>(octets);
}

void text(emu_state_t* io, std::string& value)
{
    size_t length = value.size();
    size(io, length);
    emu_state_check(io, length <= io->size);
    if (!io->bad)
    {
        value.resize(length);
        emu_state_octets(io, value.data(), length);
    }
}

/// A plain struct of the core, as it is.
template <typename T> void plain(emu_state_t* io, T& value)
{
    static_assert(std::is_trivially_copyable_v<T>);
    same(io, sizeof value);
    emu_state_octets(io, &value, sizeof value);
}

/// In one piece, since a long run has many.
void each(emu_state_t* io, Scan& scan)
{
    std::array<uint8_t, sizeof scan.at + sizeof scan.code> octets;
    std::memcpy(octets.data(), &scan.at, sizeof scan.at);
    std::memcpy(octets.data() + sizeof scan.at, &scan.code, sizeof scan.code);
    emu_state_octets(io, octets.data(), octets.size());
    std::memcpy(&scan.at, octets.data(), sizeof scan.at);
    std::memcpy(&scan.code, octets.data() + sizeof scan.at, sizeof scan.code);
}

void each(emu_state_t* io, Report& report)
{
    bool guest = report.kind == EMU_GUEST_ERROR;
    emu_state_bool(io, &guest);
    report.kind = guest ? EMU_GUEST_ERROR : EMU_NOT_MODELLED;
    text(io, report.text);
    emu_state_u32(io, &report.detail);
    emu_state_i64(io, &report.first);
    emu_state_u64(io, &report.count);
}

template <typename T> void list(emu_state_t* io, std::vector<T>& values)
{
    size_t count = values.size();
    size(io, count);
    emu_state_check(io, count <= io->size);
    if (io->bad)
    {
        return;
    }
    values.resize(count);
    for (T& value : values)
    {
        each(io, value);
    }
}

void map(emu_state_t* io, std::map<unsigned, double>& values)
{
    size_t count = values.size();
    size(io, count);
    std::map<unsigned, double> loaded;
    auto next = values.begin();
    for (size_t i = 0; i < count && !io->bad; i++)
    {
        uint32_t key = emu_state_loading(io) ? 0 : next->first;
        double value = emu_state_loading(io) ? 0.0 : (next++)->second;
        emu_state_u32(io, &key);
        emu_state_f64(io, &value);
        loaded[key] = value;
    }
    values = std::move(loaded);
}

void board_of(emu_state_t* io, acq_board_t* board)
{
    size_t octets = acq_board_save(board, nullptr, 0);
    size(io, octets);
    emu_state_check(io, octets <= io->size - io->at);
    if (io->bad)
    {
        return;
    }
    if (emu_state_loading(io))
    {
        emu_state_check(io, acq_board_restore(board, io->from + io->at, octets) == 0);
    }
    else if (io->to != nullptr)
    {
        acq_board_save(board, io->to + io->at, io->size - io->at);
    }
    io->at += octets;
}

} // namespace

void Run::walk(emu_state_t* io)
{
    same(io, config_.nav ? 1 : 0);
    same(io, channels());
    board_of(io, board_.get());
    emu_wire_state(&host_rxd_, io);
    emu_wire_state(&host_txd_, io);
    for (emu_serial_line_t& line : lines_)
    {
        emu_serial_line_state(&line, io);
    }
    emu_serial_end_state(&end_, io);
    faults_->state(io);
    plain(io, navigator_.link);
    plain(io, navigator_.solver);
    if (navigator_.six)
    {
        plain(io, navigator_.six->solver);
        emu_state_i64(io, &navigator_.six->last_fix);
    }
    emu_state_bool(io, &navigator_.started);
    size(io, navigator_.first_scan);
    size(io, navigator_.last_scan);
    each(io, pending_);
    uint32_t channels = pending_channels_;
    emu_state_u32(io, &channels);
    emu_state_check(io, channels < this->channels());
    pending_channels_ = io->bad ? pending_channels_ : channels;
    list(io, scans.kept);
    size(io, scans.gone);
    list(io, reports);
    emu_state_u64(io, &navigator_.corrupt_accepted);
    emu_state_bool(io, &halted_);
    map(io, volts_);
    knobs_.state(io);
    motion_.state(io);
    ins_gyro_config_t gyro = gyro_.config;
    for (ins_gyro_channel_t& channel : gyro.channel)
    {
        emu_state_f64(io, &channel.bias);
        emu_state_f64(io, &channel.noise_density);
    }
    if (emu_state_loading(io))
    {
        emu_state_check(io, ins_gyro_init(&gyro_, &gyro, motion().get(), nullptr, 0));
    }
    front_end_.state(io);
}

/// Room for the header, and the walk behind it.
std::string Run::walked()
{
    emu_state_t count{};
    walk(&count);
    std::string octets(header_octets + count.at, '\0');
    emu_state_t body{reinterpret_cast<uint8_t*>(octets.data()) + header_octets, nullptr, count.at, 0, false};
    walk(&body);
    return octets;
}

std::string Run::save()
{
    std::string octets = walked();
    const size_t rest = octets.size() - header_octets;
    emu_state_t head{reinterpret_cast<uint8_t*>(octets.data()), nullptr, header_octets, 0, false};
    emu_state_tag(&head, "LRUN", version);
    same(&head, rest);
    same(&head, fnv1a(octets.data() + header_octets, rest));
    return octets;
}

void Run::restore(const std::string& octets)
{
    const auto* from = reinterpret_cast<const uint8_t*>(octets.data());
    const size_t rest = octets.size() < header_octets ? 0 : octets.size() - header_octets;
    emu_state_t head{nullptr, from, octets.size(), 0, false};
    emu_state_tag(&head, "LRUN", version);
    same(&head, rest);
    same(&head, fnv1a(octets.data() + octets.size() - rest, rest));
    if (head.bad)
    {
        throw std::invalid_argument("this is no snapshot of a run of this version, or it was changed or cut short");
    }
    const std::string before = walked();
    const auto load = [this](const std::string& all)
    {
        emu_state_t io{nullptr, reinterpret_cast<const uint8_t*>(all.data()) + header_octets,
                       all.size() - header_octets, 0, false};
        walk(&io);
        return !io.bad && io.at == io.size;
    };
    if (!load(octets))
    {
        load(before);
        throw std::invalid_argument(
            "the snapshot is of a run with another configuration: part, memory, image, crystal, converters, "
            "line faults or navigator");
    }
    navigator_.states.clear();
    edges_.clear();
    pin_edges_.clear();
    octets_.clear();
    sent_.clear();
    samples_.clear();
}

} // namespace libins
