/// \file   cpu/engine.h
/// \brief  What the two engines and the decoder share: the table of opcodes, decoded code, the word of cycles and instructions.
/// SPDX-License-Identifier: MIT
#ifndef MCS51_ENGINE_H_INCLUDED
#define MCS51_ENGINE_H_INCLUDED
#include "mcs51_internal.h"

#define NO_PC 0x10000u ///< no address

/// mcs51_t.marks, by address of an instruction.
enum
{
    MARK_BREAK = 1,
    MARK_COVERED = 2,
    MARK_NOT_TAKEN = 4,
    MARK_TAKEN = 8
};

/// Engines: execute until left < 0, until a jump to itself is reached (self_jump; it has not been executed), or until a breakpoint or
/// observer stops it (stop). The fast one also comes back where it cannot go on; the plain one is watched, and can be had for `one`.
void mcs51_fast(mcs51_t* self);
void mcs51_plain(mcs51_t* self, bool one);
/// An instruction at pc is about to be executed. \return false: stop before it.
bool mcs51_enter(mcs51_t* self);
static inline void mcs51_seen(mcs51_t* self, mcs51_space_t space, uint16_t address, uint8_t value, bool write)
{
    if (self->observer.access)
    {
        self->observer.access(self->observer.ctx, space, address, value, write, mcs51_cycle(self));
    }
}

/// How an instruction accesses its direct operand, the first octet after the opcode. READS | WRITES: reads the first, writes the second.
enum
{
    READS = 1,
    WRITES = 2,
    CHANGES = 4, ///< reads the latch and writes
    BITS = 8     ///< the operand is the address of a bit
};

/// Where an instruction may go but to the next one.
enum
{
    NOWHERE,
    BRANCH, ///< conditionally, by the last octet
    NEARBY, ///< by the last octet
    IN_PAGE,
    ANYWHERE,
    COMPUTED
};

typedef struct opcode_t
{
    uint8_t octets, cycles, access, target;
} opcode_t;
extern const opcode_t mcs51_opcodes[256];

/// Target of the instruction before `next`, whose last octet is `last` and first operand o1.
static inline uint32_t mcs51_target(unsigned kind, uint32_t next, unsigned opcode, unsigned o1, unsigned last)
{
    switch (kind)
    {
    case BRANCH:
    case NEARBY:
        return (next + last - (last & 0x80u) * 2u) & 0xFFFFu;
    case IN_PAGE:
        return (next & 0xF800u) | (opcode & 0xE0u) << 3 | o1;
    default:
        return o1 << 8 | last;
    }
}

/// Opcodes that waiting loops are made of.
enum
{
    JBC = 0x10,
    JB = 0x20,
    JNB = 0x30,
    SJMP = 0x80
};

#define BIT_BYTE(b) ((b) < 0x80u ? 0x20u + ((b) >> 3) : (b)&0xF8u)
#define BIT_MASK(b) (1u << ((b)&7u))

#define MCS51_BEYOND 3u ///< entries past the end of code memory: an instruction may end there

typedef struct entry_t entry_t;

/// Execute the instruction of an entry and those after it. What changes often is in arguments; the rest is in self, and pc is ip.
typedef void mcs51_handler_fn(mcs51_t* self, const entry_t* ip, uint32_t a, uint32_t cy, uint32_t fx, uint8_t* bank);

/// The instruction that begins at one address. Decoded when it is first reached.
struct entry_t
{
    mcs51_handler_fn* run;
    int64_t sum; ///< to be taken from budget: from here to the end of the block, itself included
    const entry_t* target;
    uint8_t o1, o2; ///< operand octets; of a bit, its octet and its place in it
    uint8_t opcode;
    uint8_t operand; ///< row of mcs51_handlers
    bool waits;      ///< a polling loop begins here
    uint8_t until;   ///< of the bit that is polled: the loop ends when it is so
};

/// What a direct operand is. A block ends where an instruction can go elsewhere or its operand has side effects.
enum
{
    MEMORY,
    ACCUMULATOR,
    PORT, ///< of a port, which the instruction writes
    EFFECT
};
extern mcs51_handler_fn* const mcs51_handlers[4][256];

mcs51_handler_fn mcs51_decode_here; ///< of every entry at first
mcs51_handler_fn mcs51_one;         ///< executes the instruction on the plain engine
mcs51_handler_fn mcs51_leave;       ///< back to the run loop, this instruction is not executed
mcs51_handler_fn mcs51_poll;        ///< a loop that waits for a bit: passes over the turns in which it cannot change
mcs51_handler_fn mcs51_count;       ///< DJNZ to itself: passes over turns

/// Decode the block that begins at pc.
void mcs51_decode(mcs51_t* self, uint32_t pc);
/// Choose the handler anew, after a change of breakpoints or coverage.
void mcs51_choose(mcs51_t* self, uint32_t pc);
/// Forget everything decoded, as code memory has changed.
void mcs51_forget(mcs51_t* self);

#endif // MCS51_ENGINE_H_INCLUDED
