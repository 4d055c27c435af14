/// \file   observe.hpp
/// \brief  What firmware does, gathered instruction by instruction: where its cycles go, calls, interrupts, stack, SFRs, a trace.
///
/// All cycles of the CPU are accounted for: each to the instruction that took it, asleep ones (idle, power-down) aside, and the two of
/// an interrupt's hardware call to its vector. A call's time is inclusive of what it calls and exclusive of interrupts and sleep.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu_8051/acq_board.h"
#include "observers.hpp"
#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace libins
{

struct ObserveConfig
{
    std::vector<uint16_t> entries; ///< where functions begin: arriving there by a jump is a call too
    std::vector<uint8_t> watch;    ///< SFRs whose every change is noted
    bool trace = false;            ///< note every instruction
};

/// The registers before an instruction.
struct Executed
{
    uint64_t cycle;
    uint16_t pc;
    std::array<uint8_t, 14> registers; ///< A, B, PSW, SP, DPL, DPH, R0 to R7
};

struct Change
{
    emu_time_t at;
    unsigned what; ///< index into ObserveConfig::watch; interrupt_signal: the interrupt in service
    int value;     ///< of the SFR; bit of IE, or -1: none
};

class Observer
{
  public:
    static constexpr unsigned interrupt_signal = 0xFFFF;

    struct Called
    {
        uint64_t calls = 0;
        uint64_t cycles = 0; ///< inclusive, of the outermost call only where it calls itself
        unsigned active = 0;
    };
    struct Interrupt
    {
        uint64_t count = 0;       ///< completed
        uint64_t cycles = 0;      ///< from vector to RETI, those that interrupt it excluded
        uint64_t worst = 0;       ///< included
        uint64_t worst_alone = 0; ///< excluded
    };
    struct Touched
    {
        uint64_t reads = 0, writes = 0;
    };

    /// One of the observers of the board's CPU until it goes. Board and observers must live longer.
    Observer(acq_board_t* board, Observers& observers, const ObserveConfig& config);
    ~Observer() { observers_.remove(this); }
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;

    /// Account for everything up to now. What follows is as of the last call.
    void settle();
    const std::vector<uint64_t>& cycles() const { return cycles_; } ///< by address of the instruction
    const std::vector<uint64_t>& executions() const { return executions_; }
    uint64_t asleep() const { return asleep_; }
    std::map<uint16_t, Called> calls() const; ///< by entry; those under way count up to now
    const std::map<unsigned, Interrupt>& interrupts() const { return interrupts_; }
    const std::array<Touched, 256>& sfrs() const { return sfrs_; } ///< by address, named by the program
    int stack_base() const { return stack_base_; }          ///< what the program first wrote to SP, or its reset value
    uint8_t stack_top() const { return stack_top_; }        ///< the highest SP
    uint16_t stack_top_pc() const { return stack_top_pc_; } ///< of the instruction that went there

    std::vector<Executed> trace;
    std::vector<Change> changes;

  private:
    /// A call or interrupt under way.
    struct Frame
    {
        uint16_t entry;
        uint8_t sp; ///< with its return address on the stack
        int irq;    ///< -1: a call
        uint64_t begin;
        uint64_t asleep; ///< asleep_ when it began
        uint64_t stolen; ///< by interrupts since
    };

    void stepped(uint16_t pc, uint64_t cycle);
    void accessed(mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t cycle);
    void vectored(unsigned irq, uint16_t from_pc, uint64_t cycle);
    void account(uint64_t cycle);
    void follow(uint16_t pc, uint64_t cycle);
    void push(uint16_t entry, int irq, uint8_t sp, uint64_t cycle);
    void pop(uint64_t cycle);
    static void steal(std::vector<Frame>& frames, size_t below, uint64_t whole);
    void serving(uint64_t cycle);
    void note(size_t i, uint8_t value, uint64_t cycle);
    void look_at_stack();
    uint64_t own(const Frame& frame, uint64_t cycle) const;

    acq_board_t* board_;
    mcs51_t* cpu_;
    Observers& observers_;
    ObserveConfig config_;
    std::vector<bool> is_entry_;
    std::vector<uint64_t> cycles_, executions_;
    std::map<uint16_t, Called> calls_;
    std::map<unsigned, Interrupt> interrupts_;
    std::array<Touched, 256> sfrs_{};
    std::vector<Frame> frames_;
    std::vector<uint8_t> watched_; ///< last values
    uint16_t pc_;                  ///< under way
    uint64_t since_;               ///< accounted for up to here
    uint64_t instructions_;
    uint64_t asleep_ = 0;
    bool sleeps_ = false, vectoring_ = false;
    int stack_base_ = -1;
    uint8_t stack_top_;
    uint16_t stack_top_pc_;
};

} // namespace libins
