/// GPIO ports, their pins, and the external interrupts on two of them.
/// SPDX-License-Identifier: MIT
#include "rig.hpp"

namespace
{
struct port
{
    const char* letter;
    unsigned pins;
};
const port PORTS[] = {{"A", 0xFFFF}, {"B", 0xFFFF}, {"D", 0x0063}, {"E", 0x0007}, {"F", 0x7FFF}, {"G", 0x0030}};

std::string reg(const port& p, const char* what)
{
    return std::string("GP") + p.letter + what;
}

emu_wire_t* pin(rig& r, const port& p, unsigned bit)
{
    return f2812_wire(r.dsp, (std::string("GPIO") + p.letter + std::to_string(bit)).c_str());
}

TEST(gpio, only_pins_that_exist_have_a_wire)
{
    rig r;
    unsigned pins = 0;
    for (const port& p : PORTS)
    {
        for (unsigned bit = 0; bit < 16; bit++)
        {
            EXPECT_EQ(pin(r, p, bit) != nullptr, (p.pins >> bit & 1) != 0) << p.letter << bit;
            pins += pin(r, p, bit) != nullptr ? 1 : 0;
        }
    }
    EXPECT_EQ(pins, 56u);
    EXPECT_EQ(f2812_wire(r.dsp, "GPIOC0"), nullptr);
    EXPECT_EQ(f2812_wire(r.dsp, ""), nullptr);
    EXPECT_EQ(f2812_wire(r.dsp, "SCITXDA"), f2812_wire(r.dsp, "GPIOF4"));
    EXPECT_EQ(f2812_wire(r.dsp, "SCIRXDA"), f2812_wire(r.dsp, "GPIOF5"));
    EXPECT_EQ(f2812_wire(r.dsp, "SCITXDB"), f2812_wire(r.dsp, "GPIOG4"));
    EXPECT_EQ(f2812_wire(r.dsp, "SCIRXDB"), f2812_wire(r.dsp, "GPIOG5"));
}

TEST(gpio, outputs_follow_dat_set_clear_toggle)
{
    for (const port& p : PORTS)
    {
        rig r;
        r.quiet();
        r.put_guarded(reg(p, "DIR").c_str(), 0xFFFF);
        const auto levels = [&]
        {
            unsigned on = 0;
            for (unsigned bit = 0; bit < 16; bit++)
            {
                on |= pin(r, p, bit) != nullptr && pin(r, p, bit)->level ? 1u << bit : 0u;
            }
            EXPECT_EQ(r.get(reg(p, "DAT").c_str()), on);
            return on;
        };
        EXPECT_EQ(levels(), 0u);
        r.put(reg(p, "DAT").c_str(), 0x5A5A);
        EXPECT_EQ(levels(), 0x5A5A & p.pins) << p.letter;
        r.put(reg(p, "SET").c_str(), 0x00FF);
        EXPECT_EQ(levels(), 0x5AFF & p.pins) << p.letter;
        r.put(reg(p, "CLEAR").c_str(), 0x0F0F);
        EXPECT_EQ(levels(), 0x50F0 & p.pins) << p.letter;
        r.put(reg(p, "TOGGLE").c_str(), 0x1111);
        EXPECT_EQ(levels(), 0x41E1 & p.pins) << p.letter;
        EXPECT_EQ(r.get(reg(p, "SET").c_str()) | r.get(reg(p, "CLEAR").c_str()) | r.get(reg(p, "TOGGLE").c_str()), 0u);
    }
}

TEST(gpio, an_input_reads_who_drives_it_and_else_its_pull_up)
{
    rig r;
    r.quiet();
    emu_wire_t* const wire = f2812_wire(r.dsp, "GPIOB7");
    EXPECT_EQ(r.get("GPBDAT"), 0xFFFFu);
    const int driver = emu_wire_add_driver(wire);
    emu_wire_drive(wire, driver, EMU_STRONG0, f2812_now(r.dsp));
    EXPECT_EQ(r.get("GPBDAT"), 0xFF7Fu);
    emu_wire_drive(wire, driver, EMU_Z, f2812_now(r.dsp));
    EXPECT_EQ(r.get("GPBDAT"), 0xFFFFu);
    r.put("GPBDAT", 0);
    EXPECT_EQ(r.get("GPBDAT"), 0xFFFFu) << "a latch that is not put out";
}

TEST(gpio, mux_takes_the_pin_from_gpio)
{
    rig r;
    r.quiet();
    r.put_guarded("GPFDIR", 0x0110);
    r.put_guarded("GPFMUX", 0x0100);
    EXPECT_FALSE(f2812_wire(r.dsp, "GPIOF4")->level);
    EXPECT_TRUE(f2812_wire(r.dsp, "GPIOF8")->level) << "its peripheral does not drive it";
}

/// Both SCIs: with GPxMUX the pin is the transmitter's, which sends; without it nothing moves.
TEST(gpio, mux_gives_a_pin_to_the_sci)
{
    const struct
    {
        const char *mux, *name;
        unsigned clock;
    } scis[] = {{"GPFMUX", "A", 0x0400}, {"GPGMUX", "B", 0x0800}};
    for (const auto& sci : scis)
    {
        for (const bool is_sci : {true, false})
        {
            rig r;
            r.quiet();
            r.put_guarded("PCLKCR", sci.clock);
            r.pass(2);
            r.put_guarded(sci.mux, is_sci ? 0x0010 : 0x0020);
            const std::string name(sci.name);
            unsigned edges = 0;
            (void)emu_wire_watch(
                f2812_wire(r.dsp, ("SCITXD" + name).c_str()),
                [](void* ctx, bool, emu_time_t) { ++*static_cast<unsigned*>(ctx); }, &edges);
            r.put(("SCICCR" + name).c_str(), 0x07);
            r.put(("SCILBAUD" + name).c_str(), 0x10);
            r.put(("SCICTL1" + name).c_str(), 0x22);
            r.put(("SCITXBUF" + name).c_str(), 0x55);
            r.pass(100000);
            EXPECT_EQ(edges, is_sci ? 10u : 0u) << name;
        }
    }
}

/// A frame into each SCI, and a frame out of it: the four vectors, and which bit of GPxMUX connects the receiver.
TEST(gpio, each_sci_has_its_own_vectors_and_receiver_pin)
{
    const struct
    {
        const char *mux, *name, *rx;
        unsigned clock;
        int rx_vector;
    } scis[] = {{"GPFMUX", "A", "GPIOF5", 0x0400, 96}, {"GPGMUX", "B", "GPIOG5", 0x0800, 98}};
    for (const auto& sci : scis)
    {
        for (const unsigned mux : {0x30u, 0x10u})
        {
            rig r;
            r.quiet();
            r.listen();
            r.put("PIEIER9", 0x0F);
            r.put_guarded("PCLKCR", sci.clock);
            r.pass(2);
            r.put_guarded(sci.mux, mux);
            const std::string name(sci.name);
            r.put(("SCICCR" + name).c_str(), 0x07);
            r.put(("SCILBAUD" + name).c_str(), 99); // a bit is 800 LSPCLK = 3200 cycles
            r.put(("SCICTL2" + name).c_str(), 0x03);
            r.put(("SCICTL1" + name).c_str(), 0x23);
            emu_wire_t* const wire = f2812_wire(r.dsp, sci.rx);
            const int driver = emu_wire_add_driver(wire);
            emu_wire_drive(wire, driver, EMU_STRONG1, f2812_now(r.dsp));
            for (const bool bit : {true, false, true, false, true, false, true, false, true, false, true, true})
            {
                emu_wire_drive(wire, driver, bit ? EMU_STRONG1 : EMU_STRONG0, f2812_now(r.dsp));
                r.pass(3200);
            }
            EXPECT_EQ(r.serve(), mux == 0x30 ? std::vector<int>{sci.rx_vector} : std::vector<int>{}) << name;
            EXPECT_EQ(r.get(("SCIRXBUF" + name).c_str()), mux == 0x30 ? 0x55u : 0u) << name;
            r.put(("SCITXBUF" + name).c_str(), 0xA5);
            r.pass(40000);
            EXPECT_EQ(r.serve(), std::vector<int>{sci.rx_vector + 1}) << name;
        }
    }
}

struct xint_rig : rig
{
    emu_wire_t* wire[2];
    int driver[2];
    xint_rig()
    {
        quiet();
        listen();
        put("PIEIER1", 0x18);
        put_guarded("GPEMUX", 0x0003);
        for (unsigned n = 0; n < 2; n++)
        {
            wire[n] = f2812_wire(dsp, n == 0 ? "GPIOE0" : "GPIOE1");
            driver[n] = emu_wire_add_driver(wire[n]);
        }
    }
    void drive(unsigned n, bool level)
    {
        emu_wire_drive(wire[n], driver[n], level ? EMU_STRONG1 : EMU_STRONG0, f2812_now(dsp));
    }
};

TEST(xint, comes_at_the_edge_that_polarity_says)
{
    for (unsigned n = 0; n < 2; n++)
    {
        for (const bool rising : {false, true})
        {
            xint_rig r;
            const std::vector<int> its{35 + static_cast<int>(n)}, none;
            r.put(n == 0 ? "XINT1CR" : "XINT2CR", rising ? 5 : 1);
            r.drive(n, false);
            EXPECT_EQ(r.serve(), rising ? none : its) << n;
            r.drive(n, true);
            EXPECT_EQ(r.serve(), rising ? its : none) << n;
            r.drive(1 - n, false);
            EXPECT_EQ(r.serve(), none) << "the other is not enabled";
            r.put_guarded("GPEMUX", 0);
            r.drive(n, false);
            r.drive(n, true);
            EXPECT_EQ(r.serve(), none) << "a pin of GPIO";
        }
    }
}

TEST(xint, counts_cycles_since_the_last_edge)
{
    xint_rig r;
    r.put("XINT2CR", 1);
    r.pass(777);
    r.drive(1, false);
    EXPECT_EQ(r.get("XINT2CTR"), 0u);
    r.pass(70000);
    EXPECT_EQ(r.get("XINT2CTR"), 70000u - 65536u);
}
} // namespace

TEST(gpio, a_pin_moves_at_the_cycle_of_the_write)
{
    static constexpr uint64_t CYCLES = 1000003;
    rig r;
    r.quiet();
    emu_time_t moved = 0;
    (void)emu_wire_watch(
        f2812_wire(r.dsp, "GPIOA0"), [](void* ctx, bool, emu_time_t at) { *static_cast<emu_time_t*>(ctx) = at; },
        &moved);
    const emu_time_t from = f2812_now(r.dsp);
    r.put_guarded("GPADIR", 1);
    EXPECT_EQ(moved, from) << "the latch is low";
    r.pass(CYCLES);
    r.put("GPADAT", 1);
    EXPECT_EQ(moved, from + exact(CYCLES, rig::OSC_HZ / 2));
}
