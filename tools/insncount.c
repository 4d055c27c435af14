/// \file   insncount.c
/// \brief  QEMU TCG plugin (API v1, QEMU 6 to 8.1; Debian ships no header for it): what each call of one function costs.
///
///     -plugin insncount.so,entry=0x..,caller_low=0x..,caller_high=0x..,stack_low=0x..,stack_high=0x..,out=FILE
///
/// A call starts with the fetch of `entry` and ends with the next fetch inside the caller [caller_low, caller_high): neither the call
/// instruction nor the caller's loop is counted, everything below is. FILE gets one line a call: instructions, and octets of the stack
/// [stack_low, stack_high) between the highest and the lowest address stored to (the callers' data must live elsewhere).
/// SPDX-License-Identifier: MIT
#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPORT         __attribute__((visibility("default")))
#define PLUGIN_VERSION 1
#define NO_REGISTERS   0 // QEMU_PLUGIN_CB_NO_REGS
#define WRITES         2 // QEMU_PLUGIN_MEM_W

struct qemu_plugin_tb;
struct qemu_plugin_insn;
struct qemu_info_t;
typedef uint64_t plugin_id_t;
typedef uint32_t mem_info_t;
extern void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id_t, void (*)(plugin_id_t, struct qemu_plugin_tb*));
extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb*);
extern struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb*, size_t);
extern uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn*);
extern void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn*, void (*)(unsigned, void*), int, void*);
extern void qemu_plugin_register_vcpu_mem_cb(struct qemu_plugin_insn*, void (*)(unsigned, mem_info_t, uint64_t, void*),
                                             int, int, void*);
extern unsigned qemu_plugin_mem_size_shift(mem_info_t);
extern void qemu_plugin_register_atexit_cb(plugin_id_t, void (*)(plugin_id_t, void*), void*);

typedef struct
{
    uint64_t low;
    uint64_t high;
} range_t;

static uint64_t entry;
static range_t caller;
static range_t stack;
static FILE* out;

static bool inside;
static uint64_t instructions;
static range_t touched;

EXPORT int qemu_plugin_version = PLUGIN_VERSION;

static bool within(const range_t* range, uint64_t address)
{
    return address >= range->low && address < range->high;
}

static void on_instruction(unsigned cpu, void* data)
{
    const uint64_t address = (uintptr_t)data;
    (void)cpu;
    if (inside && within(&caller, address))
    {
        inside = false;
        fprintf(out, "%" PRIu64 " %" PRIu64 "\n", instructions,
                touched.high > touched.low ? touched.high - touched.low : 0);
    }
    if (!inside && address == entry)
    {
        inside = true;
        instructions = 0;
        touched = (range_t){UINT64_MAX, 0};
    }
    instructions += inside;
}

static void on_store(unsigned cpu, mem_info_t info, uint64_t address, void* data)
{
    (void)cpu;
    (void)data;
    const uint64_t end = address + (UINT64_C(1) << qemu_plugin_mem_size_shift(info));
    if (inside && within(&stack, address))
    {
        touched.low = address < touched.low ? address : touched.low;
        touched.high = end > touched.high ? end : touched.high;
    }
}

static void on_block(plugin_id_t id, struct qemu_plugin_tb* block)
{
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); i++)
    {
        struct qemu_plugin_insn* insn = qemu_plugin_tb_get_insn(block, i);
        void* address = (void*)(uintptr_t)qemu_plugin_insn_vaddr(insn);
        qemu_plugin_register_vcpu_insn_exec_cb(insn, on_instruction, NO_REGISTERS, address);
        qemu_plugin_register_vcpu_mem_cb(insn, on_store, NO_REGISTERS, WRITES, NULL);
    }
}

static void on_exit_of_guest(plugin_id_t id, void* data)
{
    (void)id;
    (void)data;
    fclose(out);
}

EXPORT int qemu_plugin_install(plugin_id_t id, const struct qemu_info_t* info, int argc, char** argv)
{
    (void)info;
    const struct
    {
        const char* name;
        uint64_t* value;
    } options[] = {{"entry=", &entry},
                   {"caller_low=", &caller.low},
                   {"caller_high=", &caller.high},
                   {"stack_low=", &stack.low},
                   {"stack_high=", &stack.high}};
    for (int i = 0; i < argc; i++)
    {
        if (strncmp(argv[i], "out=", 4) == 0)
        {
            out = fopen(argv[i] + 4, "w");
        }
        for (size_t k = 0; k < sizeof options / sizeof options[0]; k++)
        {
            const size_t length = strlen(options[k].name);
            if (strncmp(argv[i], options[k].name, length) == 0)
            {
                *options[k].value = strtoull(argv[i] + length, NULL, 0);
            }
        }
    }
    if (out == NULL || entry == 0 || caller.high == 0 || stack.high == 0)
    {
        fprintf(stderr,
                "insncount: entry, caller_low, caller_high, stack_low, stack_high and a writable out are needed\n");
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_block);
    qemu_plugin_register_atexit_cb(id, on_exit_of_guest, NULL);
    return 0;
}
