/// \file   net_gimu.cpp
/// \brief  See net_gimu.hpp. SPDX-License-Identifier: MIT
#include "net_gimu.hpp"
#include <stdexcept>

namespace libins
{

GimuStation::GimuStation(std::string name, const gimu_config_t& config, std::shared_ptr<ins_track_t> track,
                         const std::optional<ins_gps_config_t>& gps)
    : LocalStation(std::move(name), {{"T", "T", "", {}, {}, false}, {"R", "R", "", {}, {}, false}}),
      track_(std::move(track))
{
    std::array<char, 256> why{};
    gimu_config_t wanted = config;
    wanted.motion = ins_track_motion;
    wanted.motion_ctx = track_.get();
    wanted.sampled = on_sampled;
    wanted.sampled_ctx = this;
    if (gps)
    {
        wanted.fix = on_fix;
        wanted.fix_ctx = this;
        if (!ins_gps_init(&gps_, &*gps, track_.get(), why.data(), why.size()))
        {
            throw std::invalid_argument(this->name() + ": gps: " + why.data());
        }
    }
    emu_sched_init(&sched_);
    emu_wire_init(&t_, "T", true);
    emu_wire_init(&r_, "R", true);
    if (!gimu_init(&gimu_, &wanted, &sched_, &t_, &r_, why.data(), why.size()))
    {
        throw std::invalid_argument(this->name() + ": " + why.data());
    }
    baud_ = gimu_.t.baud;
    attach(&sched_, 0, &t_, nullptr);
    attach(&sched_, 1, &r_, nullptr);
}

emu_wire_t* GimuStation::wire(const std::string& name)
{
    return name == "T" ? &t_ : name == "R" ? &r_ : nullptr;
}

void GimuStation::begin(emu_time_t goal)
{
    emu_sched_advance(&sched_, goal);
}

void GimuStation::act(const FaultList::Entry& entry)
{
    emu_serial_end_set_baud(&gimu_.t, entry.on ? baud_with(entry.fault, baud_, name()) : baud_);
}

void GimuStation::add_fault(const Fault& fault)
{
    (void)baud_with(fault, baud_, "a GIMU");
    faults_.add(fault, now());
}

bool GimuStation::on_fix(void* ctx, int64_t t_ps, gimu_fix_t* fix)
{
    ins_gps_fix_t known;
    const bool valid = ins_gps_fix(&static_cast<GimuStation*>(ctx)->gps_, t_ps, &known);
    *fix = {known.of_ps, known.llh[0], known.llh[1], known.llh[2], known.speed, known.course, known.hdop, known.sats};
    return valid;
}

void GimuStation::on_sampled(void* ctx, uint64_t packet, const uint16_t raw[GIMU_CHANNELS], emu_time_t at)
{
    auto& self = *static_cast<GimuStation*>(ctx);
    self.samples_.push_back({packet, at, {raw[0], raw[1], raw[2], raw[3], raw[4], raw[5]}});
}

} // namespace libins
