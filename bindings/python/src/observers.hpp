/// \file   observers.hpp
/// \brief  Several observers of one CPU, told in the order in which they came. SPDX-License-Identifier: MIT
#pragma once
#include "emu_8051/mcs51.h"
#include <algorithm>
#include <vector>

namespace libins
{

class Observers
{
  public:
    explicit Observers(mcs51_t* cpu) : cpu_(cpu) {}
    Observers(const Observers&) = delete;
    Observers& operator=(const Observers&) = delete;

    /// `observer` is copied; its ctx names it for remove().
    void add(const mcs51_observer_t& observer)
    {
        all_.push_back(observer);
        tell();
    }
    void remove(const void* ctx)
    {
        all_.erase(std::remove_if(all_.begin(), all_.end(), [&](const auto& o) { return o.ctx == ctx; }), all_.end());
        tell();
    }

  private:
    /// The CPU is asked for no more than somebody looks at: with nobody, nothing is paid.
    void tell()
    {
        const auto any = [&](auto member)
        { return std::any_of(all_.begin(), all_.end(), [&](const auto& o) { return o.*member != nullptr; }); };
        const mcs51_observer_t together = {this, any(&mcs51_observer_t::step) ? on_step : nullptr,
                                           any(&mcs51_observer_t::access) ? on_access : nullptr,
                                           any(&mcs51_observer_t::vector) ? on_vector : nullptr};
        mcs51_observe(cpu_, all_.empty() ? nullptr : &together);
    }
    /// One that wants to stop ends the telling: it is told again, and so are those after it.
    static bool on_step(void* ctx, uint16_t pc, uint64_t cycle)
    {
        const auto& all = static_cast<Observers*>(ctx)->all_;
        return std::all_of(all.begin(), all.end(),
                           [&](const auto& o) { return o.step == nullptr || o.step(o.ctx, pc, cycle); });
    }
    static void on_access(void* ctx, mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t cycle)
    {
        for (const mcs51_observer_t& o : static_cast<Observers*>(ctx)->all_)
        {
            if (o.access != nullptr)
            {
                o.access(o.ctx, space, address, value, write, cycle);
            }
        }
    }
    static void on_vector(void* ctx, unsigned irq, uint16_t from_pc, uint64_t cycle)
    {
        for (const mcs51_observer_t& o : static_cast<Observers*>(ctx)->all_)
        {
            if (o.vector != nullptr)
            {
                o.vector(o.ctx, irq, from_pc, cycle);
            }
        }
    }

    mcs51_t* cpu_;
    std::vector<mcs51_observer_t> all_;
};

} // namespace libins
