/// \file   debug.hpp
/// \brief  Where a run stops for a debugger: accesses, changes of memory, edges, and the ends of steps by instruction and by C line.
///
/// A run goes on by Run::until() and stops at instruction boundaries. A call is known by its opcode and its frame by the stack pointer: a frame is
/// left when SP falls below what its call left there, however that is done (RET, or an indirect call by PUSH, PUSH, RET).
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/wire.h"
#include "emu_8051/acq_board.h"
#include "observers.hpp"
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace libins
{

class Watcher
{
  public:
    static constexpr size_t addresses = 65536;

    enum class Goal
    {
        none,         ///< nothing but what is watched
        instructions, ///< after so many
        cycle,        ///< at the first boundary at or after that cycle
        line,         ///< where another C line begins, interrupts passed over
        over,         ///< the same, calls passed over too
        out,          ///< behind the return of the function or interrupt that runs now
        before,       ///< never: notes the last boundary before that cycle
        record        ///< never: notes the boundaries passed
    };
    enum class Watch
    {
        read,
        write,
        access,
        change ///< a write after which the octets differ
    };
    struct Hit
    {
        unsigned id;
        bool write;
        uint16_t address; ///< of an edge: its level
        uint8_t value;
        uint64_t cycle;
    };
    struct Place
    {
        uint64_t cycle;
        uint16_t pc;
        uint32_t frame; ///< index into frames()
    };
    struct Frame
    {
        uint32_t parent; ///< itself where that is not known
        uint8_t sp;
        bool interrupt;
        bool left; ///< before now
    };

    Watcher(acq_board_t* board, Observers& observers);
    Watcher(const Watcher&) = delete;
    Watcher& operator=(const Watcher&) = delete;

    void watch(unsigned id, Watch kind, mcs51_space_t space, unsigned address, unsigned length);
    /// wire: by a name of acq_board_wire(). Throws std::invalid_argument.
    void edge(unsigned id, const std::string& wire, bool rising, bool falling);
    /// Takes away every watch and edge.
    void clear();
    /// Without, what is watched does not stop the run.
    void arm(bool on);
    std::vector<Hit> take_hits() { return std::exchange(hits_, {}); }

    /// By address: 0 where no C line made the code; else twice the number of the line, plus one where its code begins.
    void set_lines(std::vector<uint32_t> lines) { lines_ = std::move(lines); }
    /// Brings up to now what the CPU leaves for later, so that equal instants have equal octets in a snapshot, however they were reached.
    void settle();
    /// From here to the goal; n: of instructions, or the cycle; of record: 1 notes only where the code of another line begins.
    void begin(Goal goal, uint64_t n);
    /// The run stands still: what its last instruction did to the frames counts too.
    void end() { follow_frames(mcs51_pc(cpu_)); }
    bool reached() const { return reached_; }
    uint64_t last_before() const { return last_before_; }
    const std::vector<Place>& places() const { return places_; }
    const std::vector<Frame>& frames() const { return frames_; }

  private:
    struct Watched
    {
        unsigned id;
        Watch kind;
        mcs51_space_t space;
        unsigned address, length;
        std::vector<uint8_t> was;
    };
    struct Edge
    {
        unsigned id;
        const emu_wire_t* wire;
        bool rising, falling;
    };
    struct Tap
    {
        Watcher* self;
        const emu_wire_t* wire;
    };
    static bool on_step(void* ctx, uint16_t pc, uint64_t cycle);
    static void on_access(void* ctx, mcs51_space_t space, uint16_t address, uint8_t value, bool write, uint64_t cycle);
    static void on_vector(void* ctx, unsigned irq, uint16_t from_pc, uint64_t cycle);
    static void on_edge(void* ctx, bool level, emu_time_t at);
    void observe();
    void follow_frames(uint16_t pc);
    void enter_frame(uint8_t sp, bool interrupt);
    bool step(uint16_t pc, uint64_t cycle);
    bool in_interrupt() const;
    uint32_t line(uint16_t pc) const { return lines_.empty() ? 0 : lines_[pc] / 2; }
    bool line_begins(uint16_t pc) const { return !lines_.empty() && lines_[pc] % 2 != 0; }
    std::vector<uint8_t> octets(const Watched& watched) const;

    acq_board_t* board_;
    mcs51_t* cpu_;
    Observers& observers_;
    std::map<emu_wire_t*, Tap> taps_; ///< on a wire from the first time on that an edge of it is asked for
    std::vector<Watched> watched_;
    std::vector<Edge> edges_;
    std::vector<Hit> hits_;
    std::vector<uint32_t> lines_;
    bool armed_ = false;

    Goal goal_ = Goal::none;
    uint64_t n_ = 0, count_ = 0, from_cycle_ = 0;
    uint32_t from_line_ = 0;
    uint64_t last_before_ = UINT64_MAX; ///< UINT64_MAX: none
    bool reached_ = false;
    bool first_ = true, called_ = false, vectored_ = false, left_base_ = false;
    uint8_t last_opcode_ = 0;
    uint16_t last_pc_ = 0;
    std::vector<Frame> frames_;
    std::vector<uint32_t> stack_; ///< frames entered since begin() and not left; below them, base_
    uint32_t base_ = 0;
    std::vector<Place> places_;
};

} // namespace libins
