/// \file   decode.c
/// \brief  Code memory into the entries of the fast engine: block by block, when first executed.
/// SPDX-License-Identifier: MIT
#include "engine.h"

#define OP(x, octets, cycles, ...)           [0x##x] = {octets, cycles, 0, NOWHERE},
#define OPD(x, access, octets, cycles, ...)  [0x##x] = {octets, cycles, access, NOWHERE},
#define JOP(x, target, octets, cycles, ...)  [0x##x] = {octets, cycles, 0, target},
#define JOPD(x, access, octets, cycles, ...) [0x##x] = {octets, cycles, access, BRANCH},
const opcode_t mcs51_opcodes[256] = {
#include "ops.h"
};

static uint8_t code_at(const mcs51_t* self, uint32_t address)
{
    return self->code[address & 0xFFFFu];
}

/// The row of handlers for direct address d.
static uint8_t operand_at(unsigned access, unsigned d)
{
    const bool effect =
        ((access & READS) && mcs51_read_limit[d] == INT32_MAX) ||
        ((access & WRITES) && mcs51_write_limit[d] == INT32_MAX) ||
        ((access & CHANGES) && (mcs51_latch_limit[d] == INT32_MAX || mcs51_write_limit[d] == INT32_MAX));
    return effect ? (!(access & READS) && (d & 0xCFu) == P0 ? PORT : EFFECT) : d == ACC ? ACCUMULATOR : MEMORY;
}

static uint8_t operand(unsigned access, const entry_t* e)
{
    if ((access & (READS | WRITES)) == (READS | WRITES))
    {
        return operand_at(READS, e->o1) == MEMORY && operand_at(WRITES, e->o2) == MEMORY ? MEMORY : EFFECT;
    }
    return access ? operand_at(access & ~(unsigned)BITS, e->o1) : MEMORY;
}

/// Only an event changes such an octet: RAM, SCON, TCON, a port.
static bool waits(unsigned d)
{
    return d < 0x80u || d == SCON || d == TCON || (d & 0xCFu) == P0;
}

enum
{
    POLL_OCTETS = 3
};

/// JB or JNB to itself, or one of JB, JNB, JBC that leaves a loop before an SJMP back to it.
static void find_poll(const mcs51_t* self, uint32_t pc, entry_t* e)
{
    enum
    {
        BACK = 0xFB ///< from behind the SJMP to the poll
    };
    e->waits = false;
    if ((e->opcode != JBC && e->opcode != JB && e->opcode != JNB) || !waits(e->o1))
    {
        return;
    }
    if (e->target == e && e->opcode != JBC)
    {
        e->waits = true;
        e->until = e->opcode == JNB;
    }
    else if (code_at(self, pc + POLL_OCTETS) == SJMP && code_at(self, pc + POLL_OCTETS + 1u) == BACK &&
             (e->opcode != JBC || (e->o1 & 0xCFu) != P0))
    {
        e->waits = true;
        e->until = e->opcode != JNB;
    }
}

static bool seen(const mcs51_t* self, uint32_t pc, const opcode_t* op)
{
    const unsigned both = MARK_TAKEN | MARK_NOT_TAKEN, marks = self->marks[pc];
    return (marks & MARK_COVERED) && (op->target != BRANCH || (marks & both) == both);
}

static bool counts(const entry_t* e)
{
    const bool djnz = e->opcode == 0xD5u ? e->o1 < 0x80u : (e->opcode & 0xF8u) == 0xD8u;
    return djnz && e->target == e;
}

static void choose(mcs51_t* self, uint32_t pc, entry_t* e)
{
    const opcode_t* const op = &mcs51_opcodes[e->opcode];
    const bool elsewhere = op->target != NOWHERE && op->target != COMPUTED;
    const bool to_self = elsewhere && op->target != BRANCH && e->target == e;
    if (e->opcode == 0xA5u || (self->marks[pc] & MARK_BREAK) || (self->covering && !seen(self, pc, op)) ||
        (elsewhere && !e->target) || to_self)
    {
        e->run = mcs51_one;
    }
    else if (e->waits && !self->no_spin && !(self->marks[(pc + POLL_OCTETS) & 0xFFFFu] & MARK_BREAK))
    {
        e->run = mcs51_poll;
    }
    else if (counts(e) && !self->no_spin)
    {
        e->run = mcs51_count;
    }
    else
    {
        e->run = mcs51_handlers[e->operand][e->opcode];
    }
}

/// \return whether the block ends with it.
static bool decode(mcs51_t* self, uint32_t pc)
{
    entry_t* const e = &self->entries[pc];
    e->opcode = code_at(self, pc);
    const opcode_t* const op = &mcs51_opcodes[e->opcode];
    const uint8_t o1 = code_at(self, pc + 1u);
    e->o1 = (uint8_t)(op->access & BITS ? BIT_BYTE(o1) : o1);
    e->o2 = (uint8_t)(op->access & BITS ? BIT_MASK(o1) : code_at(self, pc + 2u));
    const uint32_t next = pc + op->octets;
    const uint32_t target = mcs51_target(op->target, next, e->opcode, o1, code_at(self, next - 1u));
    e->target = target < self->code_octets ? &self->entries[target] : NULL;
    e->operand = operand(op->access, e);
    find_poll(self, pc, e);
    choose(self, pc, e);
    return op->target != NOWHERE || e->operand >= PORT;
}

void mcs51_decode(mcs51_t* self, uint32_t pc)
{
    entry_t* const entries = self->entries;
    int64_t sum = 0;
    uint32_t at = pc;
    for (bool ends = false; !ends; at += mcs51_opcodes[entries[at].opcode].octets)
    {
        if (entries[at].run != mcs51_decode_here)
        {
            sum += entries[at].sum;
            break;
        }
        ends = decode(self, at);
        sum += MCS51_SPENT(mcs51_opcodes[entries[at].opcode].cycles, 1);
    }
    for (const uint32_t end = at; pc < end; pc += mcs51_opcodes[entries[pc].opcode].octets)
    {
        entries[pc].sum = sum;
        sum -= MCS51_SPENT(mcs51_opcodes[entries[pc].opcode].cycles, 1);
    }
}

static void choose_again(mcs51_t* self, uint32_t pc)
{
    entry_t* const e = &self->entries[pc];
    if (e->run != mcs51_decode_here)
    {
        choose(self, pc, e);
    }
}

void mcs51_choose(mcs51_t* self, uint32_t pc)
{
    choose_again(self, pc);
    if (pc >= POLL_OCTETS) // of a waiting loop, this may be the jump back
    {
        choose_again(self, pc - POLL_OCTETS);
    }
}

void mcs51_forget(mcs51_t* self)
{
    for (uint32_t pc = 0; pc < self->code_octets + MCS51_BEYOND; ++pc)
    {
        self->entries[pc].run = pc < self->code_octets ? mcs51_decode_here : mcs51_leave;
        self->entries[pc].sum = 0;
    }
}
