/// \file   debug.cpp
/// \brief  See debug.hpp. SPDX-License-Identifier: MIT
#include "debug.hpp"
#include <algorithm>
#include <stdexcept>

namespace libins
{
namespace
{

constexpr uint8_t sp_register = 0x81, timer_register = 0x8A;

bool is_call(uint8_t opcode)
{
    return opcode == 0x12 || (opcode & 0x1F) == 0x11; // LCALL, ACALL
}

bool is_return(uint8_t opcode)
{
    return opcode == 0x22 || opcode == 0x32; // RET, RETI
}

} // namespace

Watcher::Watcher(acq_board_t* board, Observers& observers)
    : board_(board), cpu_(acq_board_cpu(board)), observers_(observers)
{
}

void Watcher::watch(unsigned id, Watch kind, mcs51_space_t space, unsigned address, unsigned length)
{
    watched_.push_back({id, kind, space, address, length, {}});
    observe();
}

void Watcher::edge(unsigned id, const std::string& wire, bool rising, bool falling)
{
    emu_wire_t* const found = acq_board_wire(board_, wire.c_str());
    if (found == nullptr)
    {
        throw std::invalid_argument(wire + ": no wire of this board");
    }
    const auto [tap, added] = taps_.try_emplace(found, Tap{this, found});
    if (added && emu_wire_watch(found, on_edge, &tap->second) != 0)
    {
        taps_.erase(tap);
        throw std::invalid_argument(wire + ": too many watch this wire already");
    }
    edges_.push_back({id, found, rising, falling});
}

void Watcher::clear()
{
    watched_.clear();
    edges_.clear();
    observe();
}

void Watcher::arm(bool on)
{
    armed_ = on;
    hits_.clear();
    for (Watched& watched : watched_)
    {
        watched.was = octets(watched);
    }
    observe();
}

/// The CPU tells no more than is needed, since being told costs.
void Watcher::observe()
{
    const bool stepping = goal_ != Goal::none;
    const bool accesses = armed_ && !watched_.empty();
    const mcs51_observer_t observer = {this, stepping ? on_step : nullptr, accesses ? on_access : nullptr,
                                       stepping ? on_vector : nullptr};
    observers_.remove(this);
    if (stepping || accesses)
    {
        observers_.add(observer);
    }
}

void Watcher::settle()
{
    mcs51_run(cpu_, mcs51_cycle(cpu_));
    mcs51_sfr(cpu_, timer_register);
}

void Watcher::begin(Goal goal, uint64_t n)
{
    goal_ = goal;
    n_ = n;
    count_ = 0;
    reached_ = called_ = vectored_ = left_base_ = false;
    first_ = true;
    from_cycle_ = mcs51_cycle(cpu_);
    from_line_ = line(mcs51_pc(cpu_));
    frames_ = {{0, mcs51_sfr(cpu_, sp_register), false, false}};
    stack_.clear();
    base_ = 0;
    places_.clear();
    last_before_ = UINT64_MAX;
    observe();
}

std::vector<uint8_t> Watcher::octets(const Watched& watched) const
{
    std::vector<uint8_t> octets;
    for (unsigned i = 0; i < watched.length; i++)
    {
        const auto address = static_cast<uint16_t>(watched.address + i);
        switch (watched.space)
        {
        case MCS51_IRAM:
            octets.push_back(mcs51_iram(cpu_, static_cast<uint8_t>(address)));
            break;
        case MCS51_SFR:
            octets.push_back(mcs51_sfr(cpu_, static_cast<uint8_t>(address)));
            break;
        case MCS51_XDATA:
            octets.push_back(mcs51_xdata(cpu_, address));
            break;
        case MCS51_CODE:
            octets.push_back(mcs51_code(cpu_, address));
            break;
        }
    }
    return octets;
}

void Watcher::on_access(void* ctx, mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t cycle)
{
    Watcher& self = *static_cast<Watcher*>(ctx);
    for (Watched& watched : self.watched_)
    {
        if (watched.space != space || address < watched.address || address - watched.address >= watched.length)
        {
            continue;
        }
        bool stops = watched.kind == Watch::access || (watched.kind == Watch::read) == !write;
        if (watched.kind == Watch::change)
        {
            const std::vector<uint8_t> now = self.octets(watched);
            stops = write && now != watched.was;
            watched.was = now;
        }
        if (stops)
        {
            self.hits_.push_back({watched.id, write, address, value, cycle});
            mcs51_stop(self.cpu_);
        }
    }
}

void Watcher::on_edge(void* ctx, bool level, emu_time_t)
{
    const Tap& tap = *static_cast<const Tap*>(ctx);
    Watcher& self = *tap.self;
    for (const Edge& edge : self.edges_)
    {
        if (self.armed_ && edge.wire == tap.wire && (level ? edge.rising : edge.falling))
        {
            self.hits_.push_back({edge.id, level, level, level, mcs51_cycle(self.cpu_)});
            mcs51_stop(self.cpu_);
        }
    }
}

void Watcher::on_vector(void* ctx, unsigned, uint16_t, uint64_t)
{
    static_cast<Watcher*>(ctx)->vectored_ = true;
}

bool Watcher::on_step(void* ctx, uint16_t pc, uint64_t cycle)
{
    return static_cast<Watcher*>(ctx)->step(pc, cycle);
}

void Watcher::enter_frame(uint8_t sp, bool interrupt)
{
    const uint32_t parent = stack_.empty() ? base_ : stack_.back();
    stack_.push_back(static_cast<uint32_t>(frames_.size()));
    frames_.push_back({parent, sp, interrupt, false});
}

/// What the last instruction, and an interrupt after it, did to the frames.
void Watcher::follow_frames(uint16_t pc)
{
    const uint8_t sp = mcs51_sfr(cpu_, sp_register);
    const auto before_vector = static_cast<uint8_t>(vectored_ ? sp - 2 : sp);
    if (!first_ && is_return(last_opcode_) && stack_.empty())
    {
        const auto outer = static_cast<uint32_t>(frames_.size());
        frames_[base_] = {outer, frames_[base_].sp, last_opcode_ == 0x32, true};
        frames_.push_back({outer, before_vector, false, false});
        base_ = outer;
        left_base_ = true;
    }
    while (!stack_.empty() && frames_[stack_.back()].sp > before_vector)
    {
        frames_[stack_.back()].left = true;
        stack_.pop_back();
    }
    if (called_)
    {
        enter_frame(before_vector, false);
    }
    if (vectored_)
    {
        enter_frame(sp, true);
    }
    vectored_ = false;
    last_opcode_ = mcs51_code(cpu_, pc);
    called_ = is_call(last_opcode_);
}

bool Watcher::in_interrupt() const
{
    return std::any_of(stack_.begin(), stack_.end(), [&](uint32_t frame) { return frames_[frame].interrupt; });
}

/// \return whether the instruction may be executed.
bool Watcher::step(uint16_t pc, uint64_t cycle)
{
    if (reached_)
    {
        return true; // told again: the boundary is dealt with
    }
    const uint16_t last_pc = last_pc_;
    if (goal_ != Goal::before)
    {
        follow_frames(pc);
    }
    last_pc_ = pc;
    if (goal_ == Goal::record)
    {
        if (n_ == 0 || (line_begins(pc) && (first_ || line(pc) != line(last_pc))))
        {
            places_.push_back({cycle, pc, stack_.empty() ? base_ : stack_.back()});
        }
        first_ = false;
        return true;
    }
    if (goal_ == Goal::before)
    {
        last_before_ = cycle < n_ ? cycle : last_before_;
        return true;
    }
    const bool at_start = first_ && cycle == from_cycle_;
    first_ = false;
    if (goal_ == Goal::cycle)
    {
        reached_ = cycle >= n_;
    }
    else if (!at_start)
    {
        const bool other_line = line_begins(pc) && (left_base_ || line(pc) != from_line_) && !in_interrupt();
        reached_ = (goal_ == Goal::instructions && ++count_ >= n_) || (goal_ == Goal::line && other_line) ||
                   (goal_ == Goal::over && other_line && stack_.empty()) || (goal_ == Goal::out && left_base_);
    }
    return !reached_;
}

} // namespace libins
