/// \file   net_gimu.hpp
/// \brief  The GIMU of the 2006 thesis as a station, on a trajectory and with a GPS receiver; see emu_f2812/gimu_part.h, ins_truth/track.h.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu_f2812/gimu_part.h"
#include "ins_truth/gps.h"
#include "net_station.hpp"
#include <array>
#include <optional>

namespace libins
{

/// The samples of one packet.
struct GimuSample
{
    uint64_t packet;
    emu_time_t at;
    std::array<uint16_t, GIMU_CHANNELS> raw;
};

/// Ports T (packets) and R (NMEA).
class GimuStation final : public LocalStation
{
  public:
    /// Throws std::invalid_argument for a configuration that cannot be. gps nothing: never a fix.
    GimuStation(std::string name, const gimu_config_t& config, std::shared_ptr<ins_track_t> track,
                const std::optional<ins_gps_config_t>& gps);

    emu_time_t now() const override { return sched_.now; }
    emu_time_t silent_until() const override { return emu_sched_next(&sched_); }
    bool light() const override { return true; }
    void begin(emu_time_t goal) override;
    void add_fault(const Fault& fault) override;

    std::vector<GimuSample> take_samples() { return std::exchange(samples_, {}); }
    const gimu_t& part() const { return gimu_; }

  protected:
    emu_wire_t* wire(const std::string& name) override;
    void act(const FaultList::Entry& entry) override;

  private:
    static bool on_fix(void* ctx, int64_t t_ps, gimu_fix_t* fix);
    static void on_sampled(void* ctx, uint64_t packet, const uint16_t raw[GIMU_CHANNELS], emu_time_t at);

    std::shared_ptr<ins_track_t> track_;
    ins_gps_t gps_{};
    emu_sched_t sched_{};
    emu_wire_t t_{}, r_{};
    gimu_t gimu_{};
    double baud_ = 0.0; ///< of pin T
    std::vector<GimuSample> samples_;
};

} // namespace libins
