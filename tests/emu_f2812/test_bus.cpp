/// Decoding, protection, clocks of peripherals, reports, names, observer. The lists are the test's own, from TI SPRS174.
/// SPDX-License-Identifier: MIT
#include "rig.hpp"

namespace
{
const std::vector<uint16_t> PROTECTED = {0x0884, 0x0885, 0x0A80, 0x0A82, 0x0A83, 0x0A84, 0x0A85, 0x0A86, 0x0A87,
                                         0x0AE0, 0x0AE1, 0x0AE2, 0x0AE3, 0x0AE4, 0x0AE5, 0x0AE6, 0x0AE7, 0x0AEF,
                                         0x0D00, 0x0DC0, 0x0DFF, 0x701A, 0x701B, 0x701C, 0x701E, 0x701F, 0x7021,
                                         0x70C0, 0x70C1, 0x70C2, 0x70C4, 0x70C5, 0x70C6, 0x70CC, 0x70CD, 0x70CE,
                                         0x70D0, 0x70D1, 0x70D2, 0x70D4, 0x70D5, 0x70D8, 0x70D9};
const std::vector<uint16_t> FREE = {0x0C02, 0x0C03, 0x0C06, 0x0C0A, 0x0C12, 0x0CE2, 0x0CF2, 0x7070, 0x7071, 0x0B34};

/// A bit that every register above has.
uint16_t probe(uint16_t address)
{
    return address == 0x70D8 || address == 0x70D9 ? 0x0010 : 0x0001;
}

TEST(bus, a_protected_register_is_not_written_without_eallow_and_that_is_told)
{
    for (const uint16_t address : PROTECTED)
    {
        rig r;
        const uint16_t before = f2812_read(r.dsp, address), other = before ^ probe(address);
        r.reports.clear();
        f2812_write(r.dsp, address, other);
        EXPECT_EQ(f2812_read(r.dsp, address), before) << std::hex << address;
        ASSERT_EQ(r.reports.size(), 1u) << std::hex << address;
        EXPECT_EQ(r.reports[0].kind, EMU_GUEST_ERROR);
        EXPECT_EQ(r.reports[0].address, address);
        EXPECT_NE(r.reports[0].text.find("EALLOW"), std::string::npos);
        f2812_set_eallow(r.dsp, true);
        f2812_write(r.dsp, address, other);
        EXPECT_EQ(f2812_read(r.dsp, address), other) << std::hex << address;
        f2812_set_eallow(r.dsp, false);
        f2812_write(r.dsp, address, before);
        EXPECT_EQ(f2812_read(r.dsp, address), other) << "after EDIS, " << std::hex << address;
    }
}

TEST(bus, any_other_register_is_written_without_eallow)
{
    rig r;
    for (const uint16_t address : FREE)
    {
        const uint16_t other = f2812_read(r.dsp, address) ^ 1u;
        r.reports.clear();
        f2812_write(r.dsp, address, other);
        EXPECT_EQ(f2812_read(r.dsp, address), other) << std::hex << address;
        EXPECT_TRUE(r.reports.empty()) << std::hex << address;
    }
}

/// What cannot be seen by reading back: watchdog and control of the low-power modes.
TEST(bus, the_watchdog_is_protected_too)
{
    for (const char* name : {"SCSR", "WDKEY", "WDCR"})
    {
        rig r;
        r.put(name, 0);
        ASSERT_EQ(r.reports.size(), 1u) << name;
        EXPECT_NE(r.reports[0].text.find("EALLOW"), std::string::npos) << name;
        EXPECT_FALSE(f2812_in_reset(r.dsp)) << "WDCHK 000 would have reset the device";
    }
}

TEST(bus, each_report_comes_once_after_a_reset)
{
    rig r;
    r.put("PLLCR", 1);
    r.put("PLLCR", 2);
    r.put("LOSPCP", 2);
    EXPECT_EQ(r.reports.size(), 2u);
    f2812_reset(r.dsp, F2812_RESET_XRS);
    r.put("PLLCR", 1);
    EXPECT_EQ(r.reports.size(), 3u);
}

TEST(bus, registers_begin_at_their_reset_values)
{
    rig r;
    const struct
    {
        const char* name;
        unsigned value;
    } rows[] = {{"HISPCP", 1},     {"LOSPCP", 2},    {"PCLKCR", 0},     {"LPMCR0", 0x00FC}, {"LPMCR1", 0},
                {"PLLCR", 0},      {"SCSR", 5},      {"WDKEY", 0},      {"WDCR", 0},        {"WDCNTR", 0},
                {"PIECTRL", 0},    {"PIEACK", 0},    {"PIEIER9", 0},    {"PIEIFR9", 0},     {"GPFMUX", 0},
                {"GPFDIR", 0},     {"GPGMUX", 0},    {"GPAQUAL", 0},    {"TIMER0TCR", 0},   {"TIMER1PRD", 0xFFFF},
                {"TIMER2PRDH", 0}, {"TIMER0TPR", 0}, {"TIMER0TPRH", 0}, {"XINT1CR", 0}};
    for (const auto& row : rows)
    {
        EXPECT_EQ(r.get(row.name), row.value) << row.name;
        r.put_guarded(row.name, (row.value ^ 1u) | 0x28); // good as WDCHK too
    }
    f2812_reset(r.dsp, F2812_RESET_XRS);
    for (const auto& row : rows)
    {
        EXPECT_EQ(r.get(row.name), row.value) << row.name << " after a reset";
    }
    const f2812_cpu_t* const cpu = f2812_cpu(r.dsp);
    EXPECT_TRUE(cpu->intm);
    EXPECT_TRUE(cpu->dbgm);
    EXPECT_FALSE(cpu->eallow);
    EXPECT_EQ(cpu->ier | cpu->ifr, 0u);
}

TEST(bus, bits_that_are_not_there_read_0)
{
    rig r;
    const struct
    {
        const char* name;
        unsigned bits;
    } rows[] = {{"HISPCP", 7},      {"LOSPCP", 7},     {"PCLKCR", 0x5D0B}, {"LPMCR0", 0xFF},   {"LPMCR1", 0xFFFF},
                {"GPAMUX", 0xFFFF}, {"GPDMUX", 0x63},  {"GPEMUX", 7},      {"GPFMUX", 0x7FFF}, {"GPGMUX", 0x30},
                {"GPFDIR", 0x7FFF}, {"GPBQUAL", 0xFF}, {"XINT2CR", 5},     {"TIMER1TPR", 0xFF}};
    for (const auto& row : rows)
    {
        r.put_guarded(row.name, 0xFFFF);
        EXPECT_EQ(r.get(row.name), row.bits) << row.name;
    }
}

TEST(bus, an_address_without_register_reads_0_and_is_told)
{
    for (const unsigned address :
         {0x0000u, 0x0886u, 0x0C05u, 0x0CFAu, 0x7020u, 0x7058u, 0x705Du, 0x7200u, 0x7FFFu, 0x8000u, 0xFFFFu})
    {
        rig r;
        f2812_write(r.dsp, static_cast<uint16_t>(address), 0x1234);
        EXPECT_EQ(f2812_read(r.dsp, static_cast<uint16_t>(address)), 0u) << std::hex << address;
        ASSERT_EQ(r.reports.size(), 1u) << std::hex << address;
        EXPECT_EQ(r.reports[0].kind, EMU_GUEST_ERROR);
        EXPECT_EQ(r.reports[0].address, address);
    }
}

TEST(bus, what_is_not_modelled_reads_back_and_says_so)
{
    const struct
    {
        const char *name, *peripheral;
    } rows[] = {{"ADCTRL1", "ADC"},
                {"T1CON", "EV-A"},
                {"EVBIFRC", "EV-B"},
                {"SPIPRI", "SPI"},
                {"CANMCH", "eCAN"},
                {"MFFST", "McBSP"},
                {"FOPT", "flash"},
                {"CSMSCR", "code security"},
                {"DEVICEID", "device"},
                {"XNMICR", "NMI"},
                {"XBANK", "external interface"}};
    rig r;
    r.put_guarded("PCLKCR", 0xFFFF);
    r.pass(2);
    for (const auto& row : rows)
    {
        r.reports.clear();
        r.put_guarded(row.name, 0xA5C3);
        EXPECT_EQ(r.get(row.name), 0xA5C3u) << row.name;
        ASSERT_EQ(r.reports.size(), 1u) << row.name;
        EXPECT_EQ(r.reports[0].kind, EMU_NOT_MODELLED);
        EXPECT_EQ(r.reports[0].text.find(row.name), 0u) << r.reports[0].text;
        EXPECT_NE(r.reports[0].text.find(row.peripheral), std::string::npos) << r.reports[0].text;
    }
}

TEST(bus, a_peripheral_without_clock_is_not_written_and_reads_0)
{
    const struct
    {
        const char* name;
        unsigned bit;
    } rows[] = {{"GPTCONA", 0},  {"GPTCONB", 1},  {"ADCTRL3", 3}, {"SPICCR", 8},
                {"SCICCRA", 10}, {"SCICCRB", 11}, {"SPCR1", 12},  {"CANME", 14}};
    for (const auto& row : rows)
    {
        rig r;
        r.put_guarded("PCLKCR", 0xFFFFu & ~(1u << row.bit));
        r.pass(2);
        r.put(row.name, 0x0007);
        EXPECT_EQ(r.get(row.name), 0u) << row.name;
        ASSERT_FALSE(r.reports.empty()) << row.name;
        EXPECT_EQ(r.reports.back().kind, EMU_GUEST_ERROR) << row.name;
        EXPECT_NE(r.reports.back().text.find("PCLKCR"), std::string::npos) << row.name;
        r.put_guarded("PCLKCR", 1u << row.bit);
        r.pass(2);
        EXPECT_EQ(r.get(row.name), 0u) << "the write was lost, " << row.name;
        r.put(row.name, 0x0007);
        EXPECT_EQ(r.get(row.name), 0x0007u) << row.name;
    }
}

TEST(bus, a_switch_lets_accesses_without_clock_pass)
{
    f2812_switches_t switches{};
    ASSERT_EQ(f2812_switch_set(&switches, "clock_off", "take"), nullptr);
    rig r(switches);
    r.put("ADCTRL1", 0x0007);
    EXPECT_EQ(r.get("ADCTRL1"), 0x0007u);
    EXPECT_EQ(f2812_peek(r.dsp, rig::at("ADCTRL1")), 0x0007u);
    EXPECT_EQ(r.reports.back().kind, EMU_GUEST_ERROR);
}

TEST(bus, a_clock_comes_two_cycles_after_the_write)
{
    rig r;
    r.put_guarded("PCLKCR", 0x0008);
    r.pass(1);
    r.put("ADCTRL1", 0x0007);
    r.pass(1);
    EXPECT_EQ(r.get("ADCTRL1"), 0u) << "written one cycle after PCLKCR";
    r.put("ADCTRL1", 0x0007);
    EXPECT_EQ(r.get("ADCTRL1"), 0x0007u);
}

TEST(bus, switches_are_set_by_name_and_others_are_refused)
{
    f2812_switches_t switches{};
    EXPECT_EQ(f2812_switch_set(&switches, "clock_off", "take"), nullptr);
    EXPECT_EQ(switches.clock_off, F2812_CLOCK_OFF_TAKE);
    EXPECT_EQ(f2812_switch_set(&switches, "clock_off", "drop"), nullptr);
    EXPECT_EQ(switches.clock_off, F2812_CLOCK_OFF_DROP);
    EXPECT_NE(f2812_switch_set(&switches, "clock_off", "off"), nullptr);
    EXPECT_NE(f2812_switch_set(&switches, "clock", "drop"), nullptr);
    EXPECT_EQ(switches.clock_off, F2812_CLOCK_OFF_DROP);
}

TEST(bus, names_lead_to_addresses_and_back)
{
    const struct
    {
        const char* name;
        int address;
    } rows[] = {
        {"PIECTRL", 0x0CE0},    {"PIEACK", 0x0CE1},    {"PIEIER9", 0x0CF2},  {"PIEIFR9", 0x0CF3}, {"PIEIFR12", 0x0CF9},
        {"TIMER2TPRH", 0x0C17}, {"HISPCP", 0x701A},    {"PLLCR", 0x7021},    {"WDCR", 0x7029},    {"SCICCRA", 0x7050},
        {"SCIFFTXA", 0x705A},   {"SCITXBUFB", 0x7759}, {"SCIPRIB", 0x775F},  {"GPFMUX", 0x70D4},  {"GPGTOGGLE", 0x70FB},
        {"GPADAT", 0x70E0},     {"XINT2CTR", 0x7079},  {"XNMICTR", 0x707F},  {"ADCST", 0x7119},   {"T2CON", 0x7408},
        {"COMCONB", 0x7511},    {"EVAIFRC", 0x7431},   {"CAP6FBOT", 0x7529}, {"SPIBRR", 0x7044},  {"SPIPRI", 0x704F},
        {"MFFTX", 0x7820},      {"PCR", 0x7812},       {"CANTOS", 0x6032},   {"CANMCH", 0x6015},  {"FOTPWAIT", 0x0A87},
        {"CSMSCR", 0x0AEF},     {"XTIMING6H", 0x0B2D}, {"REVID", 0x0883},    {"H0RAMDFT", 0x0954}};
    for (const auto& row : rows)
    {
        EXPECT_EQ(f2812_register_address(row.name), row.address) << row.name;
        EXPECT_STREQ(f2812_register_name(static_cast<uint16_t>(row.address)), row.name);
    }
    unsigned names = 0;
    for (unsigned address = 0; address <= 0xFFFF; address++)
    {
        const char* const name = f2812_register_name(static_cast<uint16_t>(address));
        if (name != nullptr)
        {
            names++;
            EXPECT_EQ(f2812_register_address(name), static_cast<int>(address)) << name << " is there twice";
        }
    }
    EXPECT_EQ(names, 356u);
    EXPECT_EQ(f2812_register_address("SCIFFTX"), -1);
    EXPECT_EQ(f2812_register_address(""), -1);
    EXPECT_EQ(f2812_register_name(0x7058), nullptr);
}

TEST(bus, entries_of_the_vector_table_have_names)
{
    const struct
    {
        unsigned vector;
        const char* name;
    } rows[] = {{0, "RESET"},      {13, "INT13"},     {18, "NMI"},       {31, "USER12"},
                {32, "PDPINTA"},   {38, "TINT0"},     {39, "WAKEINT"},   {96, "SCIRXINTA"},
                {97, "SCITXINTA"}, {98, "SCIRXINTB"}, {99, "SCITXINTB"}, {101, "ECAN1INTA"}};
    for (const auto& row : rows)
    {
        EXPECT_STREQ(f2812_vector_name(row.vector), row.name);
    }
    EXPECT_EQ(f2812_vector_name(102), nullptr);
    EXPECT_EQ(f2812_vector_name(127), nullptr);
    EXPECT_EQ(f2812_vector_name(128), nullptr);
}

struct seen
{
    uint16_t address, value;
    bool write;
    emu_time_t at;
};

TEST(bus, an_observer_is_told_of_each_access_and_each_interrupt)
{
    rig r;
    r.quiet();
    r.listen();
    std::vector<seen> accesses;
    std::vector<std::pair<int, emu_time_t>> interrupts;
    struct both
    {
        std::vector<seen>* accesses;
        std::vector<std::pair<int, emu_time_t>>* interrupts;
    } ctx{&accesses, &interrupts};
    f2812_observer_t observer{};
    observer.ctx = &ctx;
    observer.access = [](void* c, uint16_t address, uint16_t value, bool write, emu_time_t at) {
        static_cast<both*>(c)->accesses->push_back({address, value, write, at});
    };
    observer.interrupt = [](void* c, unsigned vector, bool enter, emu_time_t at) {
        static_cast<both*>(c)->interrupts->emplace_back(enter ? static_cast<int>(vector) : -static_cast<int>(vector),
                                                        at);
    };
    f2812_observe(r.dsp, &observer);
    r.pass(15);
    r.put("XINT1CR", 0xFFFF);
    r.pass(15);
    EXPECT_EQ(r.get("XINT1CR"), 5u);
    (void)f2812_peek(r.dsp, rig::at("XINT1CR"));
    ASSERT_EQ(accesses.size(), 2u);
    EXPECT_EQ(accesses[0].address, 0x7070);
    EXPECT_EQ(accesses[0].value, 0xFFFF);
    EXPECT_TRUE(accesses[0].write);
    EXPECT_EQ(accesses[0].at, EMU_PS_PER_US);
    EXPECT_EQ(accesses[1].value, 5);
    EXPECT_FALSE(accesses[1].write);
    EXPECT_EQ(accesses[1].at, 2 * EMU_PS_PER_US);
    f2812_set_ifr(r.dsp, 0x1000);
    f2812_context_t saved;
    (void)f2812_take_interrupt(r.dsp, &saved);
    r.pass(15);
    f2812_iret(r.dsp, &saved);
    EXPECT_EQ(interrupts, (std::vector<std::pair<int, emu_time_t>>{{13, 2 * EMU_PS_PER_US}, {-13, 3 * EMU_PS_PER_US}}));
    f2812_observe(r.dsp, nullptr);
    r.put("XINT1CR", 0);
    EXPECT_EQ(accesses.size(), 2u);
}

TEST(bus, peeking_tells_no_one)
{
    rig r;
    for (unsigned address = 0; address <= 0xFFFF; address++)
    {
        (void)f2812_peek(r.dsp, static_cast<uint16_t>(address));
    }
    EXPECT_TRUE(r.reports.empty());
    EXPECT_EQ(f2812_peek(r.dsp, rig::at("LOSPCP")), 2u);
}
} // namespace
