/// What the compiler calls in firmware made with -fsanitize=thread --param tsan-distinguish-volatile=1 -fsanitize-coverage=trace-pc.
///
/// A read hook stands before its load: it asks the device and puts the answer where the load will find it. A write hook stands before
/// its store: the value is not there yet, so the next hook takes it to the device. Time passes between the two in no case.
/// SPDX-License-Identifier: MIT
#include "shim_internal.h"
#include <string.h>

#define HOOK EMU_API

f2812_shim_t* f2812_shim_current;
uint32_t f2812_shim_debt;
uint64_t f2812_shim_changes;
/// The same as f2812-cc names them in calls to functions that are not instrumented.
_Static_assert(sizeof f2812_shim_debt == 4, "the thunks of f2812-cc add to 32 bits");

/// The words of an access, from the one that holds its first octet; a byte access may name the upper octet.
static inline uint16_t* words_of(uintptr_t at)
{
    return (uint16_t*)(at & ~(uintptr_t)1);
}

/// What the firmware sees at an entry of the map.
static inline uint16_t load(f2812_shim_t* self, uint16_t entry)
{
    const uint16_t address = entry & F2812_MAP_ADDRESS;
    const uint16_t* const value = self->device->map[address].value;
    f2812_shim_changes += (entry & F2812_MAP_RESTLESS) != 0;
    return value != NULL && self->device->unobserved != 0 ? *value : f2812_access_read(self->device, address);
}

static void load_special(f2812_shim_t* self, uint16_t* word, uint16_t entry)
{
    if (entry == F2812_MAP_IER || entry == F2812_MAP_IFR)
    {
        *word = entry == F2812_MAP_IER ? self->device->cpu.ier : self->device->cpu.ifr;
    }
    else if (entry == F2812_MAP_ZERO)
    {
        *word = 0;
    }
}

static inline void load_words(f2812_shim_t* self, uintptr_t at, unsigned words)
{
    uint16_t* const word = words_of(at);
    const uint16_t* const map = self->map + (at - self->base) / 2;
    for (unsigned i = 0; i < words; i++)
    {
        if (map[i] > F2812_MAP_VECTOR)
        {
            word[i] = load(self, map[i]);
        }
        else
        {
            load_special(self, &word[i], map[i]);
        }
    }
}

static inline void reading(uintptr_t at, unsigned words)
{
    f2812_shim_t* const self = f2812_shim_current;
    f2812_shim_step(self, F2812_CYCLES_REGISTER);
    self->midway = true;
    self->stats.accesses++;
    if (at - self->base < self->span)
    {
        load_words(self, at, words);
    }
}

/// As load(), but nothing comes of it.
static inline uint16_t look(const f2812_shim_t* self, uint16_t address)
{
    const uint16_t* const value = self->device->map[address].value;
    return value != NULL ? *value : f2812_access_peek(self->device, address);
}

/// The memory is made what the device holds: a store to a bit-field puts back the rest of its word, and for its read there is no hook.
static inline void merge(const f2812_shim_t* self, uint16_t* word, uint16_t address)
{
    *word = look(self, address);
}

static inline void expect(f2812_shim_t* self, const uint16_t* word, uint16_t address)
{
    self->store = (uintptr_t)word;
    self->store_address = address;
}

/// An entry of PieVectTable is kept, since the store may be refused.
static void prepare_words(f2812_shim_t* self, uint16_t* word, const uint16_t* map, unsigned words)
{
    if (map[0] == F2812_MAP_VECTOR)
    {
        memcpy(&self->vector_before, word, words * sizeof *word);
    }
    for (unsigned i = 0; i < words; i++)
    {
        if (map[i] > F2812_MAP_VECTOR)
        {
            merge(self, &word[i], map[i] & F2812_MAP_ADDRESS);
        }
    }
    expect(self, word, 0);
    self->store_words = words;
}

static inline void prepare_store(f2812_shim_t* self, uintptr_t at, unsigned words)
{
    uint16_t* const word = words_of(at);
    const uint16_t* const map = self->map + (at - self->base) / 2;
    const uint16_t entry = map[0];
    if (words == 1 && entry > F2812_MAP_VECTOR)
    {
        const uint16_t address = entry & F2812_MAP_ADDRESS;
        merge(self, word, address);
        expect(self, word, address);
    }
    else
    {
        prepare_words(self, word, map, words);
    }
}

/// What each store does first.
static inline f2812_shim_t* before_store(void)
{
    f2812_shim_t* const self = f2812_shim_current;
    f2812_shim_step(self, F2812_CYCLES_REGISTER);
    self->midway = false;
    self->stats.accesses++;
    f2812_shim_changes++;
    return self;
}

static void writing_words(uintptr_t at, unsigned words)
{
    f2812_shim_t* const self = before_store();
    if (at - self->base < self->span)
    {
        prepare_store(self, at, words);
    }
}

/// The same, made for the one word that most stores are.
static void writing_word(uintptr_t at)
{
    f2812_shim_t* const self = before_store();
    if (at - self->base < self->span)
    {
        prepare_store(self, at, 1);
    }
}

static inline void writing(uintptr_t at, unsigned words)
{
    if (words == 1)
    {
        writing_word(at);
    }
    else
    {
        writing_words(at, words);
    }
}

/// Whether there is a register, or the vector table: other variables lie between the objects.
static inline bool is_register(const f2812_shim_t* self, uintptr_t at)
{
    return at - self->base < self->span && self->map[(at - self->base) / 2] != F2812_MAP_NONE;
}

/// An access of an object that is not volatile: registers all the same, when firmware has cast that away.
static inline void touching(uintptr_t at, unsigned words)
{
    f2812_shim_debt += F2812_CYCLES_MEMORY;
    if (is_register(f2812_shim_current, at))
    {
        reading(at, words);
    }
}

static inline void changing(uintptr_t at, unsigned words)
{
    f2812_shim_debt += F2812_CYCLES_MEMORY;
    f2812_shim_changes++;
    f2812_shim_current->midway = false;
    if (is_register(f2812_shim_current, at))
    {
        writing(at, words);
    }
}

/// A vector of PieVectTable is written: EALLOW must be on, and the device's RAM holds the low 32 bits of the function's address.
static void commit_vector(f2812_shim_t* self, uint16_t* word, unsigned words)
{
    const uintptr_t offset = (uintptr_t)word - (uintptr_t)self->program->vectors;
    const unsigned entry = (unsigned)(offset / sizeof(void*));
    const unsigned first = (unsigned)(offset % sizeof(void*)) / 2;
    for (unsigned i = 0; i < words && first + i < 2; i++)
    {
        f2812_write(self->device, (uint16_t)(0x0D00u + 2u * entry + first + i), word[i]);
    }
    if (!f2812_cpu(self->device)->eallow)
    {
        memcpy(word, &self->vector_before, words * sizeof *word);
    }
}

void f2812_shim_commit_words(f2812_shim_t* self, uint16_t* word)
{
    const uint16_t* const map = self->map + ((uintptr_t)word - self->base) / 2;
    if (map[0] == F2812_MAP_VECTOR)
    {
        commit_vector(self, word, self->store_words);
        return;
    }
    for (unsigned i = 0; i < self->store_words; i++)
    {
        switch (map[i])
        {
        case F2812_MAP_NONE:
        case F2812_MAP_ZERO:
        case F2812_MAP_VECTOR:
            break;
        case F2812_MAP_IER:
            f2812_set_ier(self->device, word[i]);
            break;
        case F2812_MAP_IFR:
            f2812_set_ifr(self->device, word[i]);
            break;
        default:
            f2812_write(self->device, map[i] & F2812_MAP_ADDRESS, word[i]);
            break;
        }
    }
}

void f2812_shim_commit(f2812_shim_t* self)
{
    uint16_t* const word = (uint16_t*)self->store;
    self->store = 0;
    if (self->store_address != 0)
    {
        f2812_write(self->device, self->store_address, *word);
    }
    else
    {
        f2812_shim_commit_words(self, word);
    }
}

// clang-format off
#define HOOK_SIZE(SIZE, WORDS)                                                                                                             \
    HOOK void __tsan_volatile_read##SIZE(const void* at);                                                                                  \
    HOOK void __tsan_volatile_read##SIZE(const void* at) { reading((uintptr_t)at, WORDS); }                                                \
    HOOK void __tsan_volatile_write##SIZE(void* at);                                                                                       \
    HOOK void __tsan_volatile_write##SIZE(void* at) { writing((uintptr_t)at, WORDS); }                                           \
    HOOK void __tsan_unaligned_volatile_read##SIZE(const void* at);                                                                        \
    HOOK void __tsan_unaligned_volatile_read##SIZE(const void* at) { reading((uintptr_t)at, WORDS); }                                      \
    HOOK void __tsan_unaligned_volatile_write##SIZE(void* at);                                                                             \
    HOOK void __tsan_unaligned_volatile_write##SIZE(void* at) { writing((uintptr_t)at, WORDS); }                                 \
    HOOK void __tsan_read##SIZE(const void* at);                                                                                           \
    HOOK void __tsan_read##SIZE(const void* at) { touching((uintptr_t)at, WORDS); }                                                        \
    HOOK void __tsan_write##SIZE(void* at);                                                                                                \
    HOOK void __tsan_write##SIZE(void* at) { changing((uintptr_t)at, WORDS); }                                                   \
    HOOK void __tsan_unaligned_read##SIZE(const void* at);                                                                                 \
    HOOK void __tsan_unaligned_read##SIZE(const void* at) { touching((uintptr_t)at, WORDS); }                                              \
    HOOK void __tsan_unaligned_write##SIZE(void* at);                                                                                      \
    HOOK void __tsan_unaligned_write##SIZE(void* at) { changing((uintptr_t)at, WORDS); }
HOOK_SIZE(1, 1)
HOOK_SIZE(2, 1)
HOOK_SIZE(4, 2)
HOOK_SIZE(8, 4)
HOOK_SIZE(16, 8)
// clang-format on

HOOK void __tsan_read_range(const void* at, unsigned long octets);
HOOK void __tsan_read_range(const void* at, unsigned long octets)
{
    f2812_shim_debt += F2812_CYCLES_MEMORY * (uint32_t)(octets / 2);
    if (is_register(f2812_shim_current, (uintptr_t)at))
    {
        reading((uintptr_t)at, (unsigned)(octets / 2));
    }
}

HOOK void __tsan_write_range(void* at, unsigned long octets);
HOOK void __tsan_write_range(void* at, unsigned long octets)
{
    f2812_shim_debt += F2812_CYCLES_MEMORY * (uint32_t)(octets / 2);
    f2812_shim_changes++;
    if (is_register(f2812_shim_current, (uintptr_t)at))
    {
        writing((uintptr_t)at, (unsigned)(octets / 2));
    }
}

/// Called once by a constructor that the compiler adds to each file.
HOOK void __tsan_init(void);
HOOK void __tsan_init(void) {}

HOOK void __sanitizer_cov_trace_pc(void);
HOOK void __sanitizer_cov_trace_pc(void)
{
    f2812_shim_t* const self = f2812_shim_current;
    self->midway = false;
    self->stats.blocks++;
    f2812_shim_step(self, F2812_CYCLES_BLOCK);
}
