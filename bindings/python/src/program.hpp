/// \file   program.hpp
/// \brief  A program that knows no board: SBUF written in mode 0 is its console, a read of a chosen XDATA address is its end.
///
/// That is how SDCC's own regression tests are built. SPDX-License-Identifier: MIT
#pragma once
#include "observers.hpp"
#include <optional>
#include <string>
#include <utility>

namespace libins
{

class Program
{
  public:
    Program(mcs51_t* cpu, Observers& observers, bool console, std::optional<uint16_t> end)
        : cpu_(cpu), observers_(observers), console_(console), end_(end)
    {
        observers_.add({this, nullptr, on_access, nullptr});
    }
    ~Program() { observers_.remove(this); }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    bool ended() const { return ended_; }
    std::string take_output() { return std::exchange(output_, {}); }

  private:
    static void on_access(void* ctx, mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t)
    {
        constexpr uint16_t sbuf = 0x99;
        constexpr uint8_t scon = 0x98, modes = 0xC0;
        Program& self = *static_cast<Program*>(ctx);
        if (self.console_ && space == MCS51_SFR && address == sbuf && write &&
            (mcs51_sfr(self.cpu_, scon) & modes) == 0)
        {
            self.output_.push_back(static_cast<char>(value));
        }
        if (space == MCS51_XDATA && address == self.end_ && !write)
        {
            self.ended_ = true;
            mcs51_stop(self.cpu_);
        }
    }

    mcs51_t* cpu_;
    Observers& observers_;
    bool console_;
    std::optional<uint16_t> end_;
    bool ended_ = false;
    std::string output_;
};

} // namespace libins
