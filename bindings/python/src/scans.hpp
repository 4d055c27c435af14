/// \file   scans.hpp
/// \brief  The scans of an acquisition board, by their number since power-on; the oldest may be gone.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/time.h"
#include "ins_nav/nav.h"
#include <array>
#include <cstddef>
#include <vector>

namespace libins
{

/// X, Y, Z of one scan, or six accelerometers, each with the end of its own acquisition. The scan's instant is that of the first.
struct Scan
{
    std::array<emu_time_t, INS_NAV_CHANNELS> at{};
    std::array<uint16_t, INS_NAV_CHANNELS> code{};
};

class Scans
{
  public:
    /// least: how many of the newest are there at any time; 0: all.
    explicit Scans(size_t least = 0) : least_(least) {}
    void add(const Scan& scan)
    {
        kept.push_back(scan);
        if (least_ != 0 && kept.size() >= 2 * least_)
        {
            kept.erase(kept.begin(), kept.end() - static_cast<std::ptrdiff_t>(least_));
            gone += least_;
        }
    }
    /// Of all, those that are gone included.
    size_t size() const { return gone + kept.size(); }
    /// Number in gone .. size() - 1.
    const Scan& operator[](size_t number) const { return kept[number - gone]; }

    std::vector<Scan> kept;
    size_t gone = 0;

  private:
    size_t least_;
};

} // namespace libins
