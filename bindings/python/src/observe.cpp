/// \file   observe.cpp
/// \brief  See observe.hpp. SPDX-License-Identifier: MIT
#include "observe.hpp"
#include <algorithm>

namespace libins
{
namespace
{

enum : uint8_t
{
    SP = 0x81,
    DPL = 0x82,
    DPH = 0x83,
    PCON = 0x87,
    PSW = 0xD0,
    ACC = 0xE0,
    B = 0xF0
};
constexpr uint8_t pcon_asleep = 0x03; ///< IDL or PD
constexpr size_t addresses = 0x10000;

bool is_call(uint8_t opcode)
{
    return opcode == 0x12 || (opcode & 0x1F) == 0x11;
}

bool is_return(uint8_t opcode)
{
    return opcode == 0x22 || opcode == 0x32;
}

} // namespace

Observer::Observer(acq_board_t* board, Observers& observers, const ObserveConfig& config)
    : board_(board), cpu_(acq_board_cpu(board)), observers_(observers), config_(config), is_entry_(addresses),
      cycles_(addresses), executions_(addresses), pc_(mcs51_pc(cpu_)), since_(mcs51_cycle(cpu_)),
      instructions_(mcs51_instructions(cpu_)), stack_top_(mcs51_sfr(cpu_, SP)), stack_top_pc_(pc_)
{
    for (const uint16_t entry : config_.entries)
    {
        is_entry_[entry] = true;
    }
    for (const uint8_t address : config_.watch)
    {
        watched_.push_back(mcs51_sfr(cpu_, address));
    }
    mcs51_observer_t observer{};
    observer.ctx = this;
    observer.step = [](void* ctx, uint16_t pc, uint64_t cycle)
    {
        static_cast<Observer*>(ctx)->stepped(pc, cycle);
        return true;
    };
    observer.access = [](void* ctx, mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t cycle)
    { static_cast<Observer*>(ctx)->accessed(space, address, value, write, cycle); };
    observer.vector = [](void* ctx, unsigned irq, uint16_t from_pc, uint64_t cycle)
    { static_cast<Observer*>(ctx)->vectored(irq, from_pc, cycle); };
    observers_.add(observer);
}

void Observer::stepped(uint16_t pc, uint64_t cycle)
{
    const bool executed = mcs51_instructions(cpu_) != instructions_;
    account(cycle);
    look_at_stack();
    if (executed && !vectoring_)
    {
        follow(pc, cycle);
    }
    vectoring_ = false;
    pc_ = pc;
    for (size_t i = 0; i < watched_.size(); i++)
    {
        note(i, mcs51_sfr(cpu_, config_.watch[i]), cycle);
    }
    if (config_.trace)
    {
        Executed e{cycle, pc, {}};
        const uint8_t psw = mcs51_sfr(cpu_, PSW);
        e.registers = {mcs51_sfr(cpu_, ACC), mcs51_sfr(cpu_, B),   psw,
                       mcs51_sfr(cpu_, SP),  mcs51_sfr(cpu_, DPL), mcs51_sfr(cpu_, DPH)};
        for (uint8_t n = 0; n < 8; n++)
        {
            e.registers[6u + n] = mcs51_iram(cpu_, static_cast<uint8_t>((psw & 0x18) + n));
        }
        trace.push_back(e);
    }
}

void Observer::accessed(mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t cycle)
{
    if (space != MCS51_SFR)
    {
        return;
    }
    (write ? sfrs_[address].writes : sfrs_[address].reads)++;
    if (write && address == SP && stack_base_ < 0)
    {
        stack_base_ = value;
        stack_top_ = value;
    }
    if (write && address == PCON && (value & pcon_asleep) != 0)
    {
        account(cycle);
        sleeps_ = true;
    }
}

void Observer::vectored(unsigned irq, uint16_t from_pc, uint64_t cycle)
{
    const bool executed = mcs51_instructions(cpu_) != instructions_;
    account(cycle);
    look_at_stack();
    const uint16_t vector = static_cast<uint16_t>(8 * irq + 3);
    if (executed && !vectoring_)
    {
        follow(from_pc, cycle);
    }
    push(vector, static_cast<int>(irq), static_cast<uint8_t>(mcs51_sfr(cpu_, SP) + 2), cycle);
    serving(cycle);
    pc_ = vector;
    vectoring_ = true;
}

/// What has passed since the last time belongs to the instruction under way, or to nobody.
void Observer::account(uint64_t cycle)
{
    (sleeps_ ? asleep_ : cycles_[pc_]) += cycle - since_;
    since_ = cycle;
    sleeps_ = false;
    const uint64_t instructions = mcs51_instructions(cpu_);
    executions_[pc_] += vectoring_ ? 0 : instructions - instructions_;
    instructions_ = instructions;
}

/// The instruction at pc_ was executed, and the one at pc follows.
void Observer::follow(uint16_t pc, uint64_t cycle)
{
    const uint8_t opcode = mcs51_code(cpu_, pc_);
    const uint8_t sp = mcs51_sfr(cpu_, SP);
    if (is_call(opcode))
    {
        push(pc, -1, sp, cycle);
        return;
    }
    if (is_return(opcode))
    {
        bool interrupt = false;
        while (!frames_.empty() && frames_.back().sp > sp && !interrupt)
        {
            interrupt = frames_.back().irq >= 0;
            pop(cycle);
        }
        if (interrupt)
        {
            serving(cycle);
        }
        return;
    }
    if (!is_entry_[pc])
    {
        return;
    }
    // A function that goes on as another one ends with it; back at one under way, it has gone on in a loop.
    const auto same = std::find_if(frames_.rbegin(), frames_.rend(),
                                   [&](const Frame& f) { return f.sp != sp || f.irq >= 0 || f.entry == pc; });
    if (same == frames_.rend() || same->sp != sp || same->entry != pc || same->irq >= 0)
    {
        push(pc, -1, sp, cycle);
        return;
    }
    while (frames_.back().entry != pc)
    {
        pop(cycle);
    }
}

void Observer::push(uint16_t entry, int irq, uint8_t sp, uint64_t cycle)
{
    while (!frames_.empty() && frames_.back().sp > sp) // left without a return, by setting SP
    {
        pop(cycle);
    }
    frames_.push_back({entry, sp, irq, cycle, asleep_, 0});
    Called& called = calls_[entry];
    called.calls++;
    called.active++;
}

void Observer::pop(uint64_t cycle)
{
    const Frame frame = frames_.back();
    frames_.pop_back();
    Called& called = calls_[frame.entry];
    if (--called.active == 0)
    {
        called.cycles += own(frame, cycle);
    }
    if (frame.irq < 0)
    {
        return;
    }
    const uint64_t whole = cycle - frame.begin;
    Interrupt& interrupt = interrupts_[static_cast<unsigned>(frame.irq)];
    interrupt.count++;
    interrupt.cycles += whole - frame.stolen;
    interrupt.worst = std::max(interrupt.worst, whole);
    interrupt.worst_alone = std::max(interrupt.worst_alone, whole - frame.stolen);
    steal(frames_, frames_.size(), whole);
}

/// An interrupt's time is none of the frames below it.
void Observer::steal(std::vector<Frame>& frames, size_t below, uint64_t whole)
{
    while (below-- > 0)
    {
        frames[below].stolen += whole;
        if (frames[below].irq >= 0)
        {
            break; // what that one interrupted has all of its time taken when it returns itself
        }
    }
}

void Observer::serving(uint64_t cycle)
{
    const auto frame = std::find_if(frames_.rbegin(), frames_.rend(), [](const Frame& f) { return f.irq >= 0; });
    changes.push_back({acq_board_time(board_, cycle), interrupt_signal, frame == frames_.rend() ? -1 : frame->irq});
}

void Observer::note(size_t i, uint8_t value, uint64_t cycle)
{
    if (value != watched_[i])
    {
        watched_[i] = value;
        changes.push_back({acq_board_time(board_, cycle), static_cast<unsigned>(i), value});
    }
}

void Observer::look_at_stack()
{
    const uint8_t sp = mcs51_sfr(cpu_, SP);
    if (sp > stack_top_)
    {
        stack_top_ = sp;
        stack_top_pc_ = pc_;
    }
}

uint64_t Observer::own(const Frame& frame, uint64_t cycle) const
{
    return cycle - frame.begin - frame.stolen - (asleep_ - frame.asleep);
}

void Observer::settle()
{
    const bool sleeps = sleeps_;
    account(mcs51_cycle(cpu_));
    sleeps_ = sleeps;
}

std::map<uint16_t, Observer::Called> Observer::calls() const
{
    std::map<uint16_t, Called> all = calls_;
    std::map<uint16_t, bool> seen;
    std::vector<Frame> frames = frames_;
    for (size_t i = frames.size(); i-- > 0;)
    {
        if (frames[i].irq >= 0)
        {
            steal(frames, i, since_ - frames[i].begin);
        }
    }
    for (const Frame& frame : frames)
    {
        if (!seen[frame.entry]) // the outermost
        {
            seen[frame.entry] = true;
            all[frame.entry].cycles += own(frame, since_);
        }
    }
    return all;
}

} // namespace libins
