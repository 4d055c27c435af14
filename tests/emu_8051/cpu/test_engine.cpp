/// \file   test_engine.cpp
/// \brief  Opcodes against the definitions in the MCS-51 Programmer's Guide: flags over all operands, cycles, memory that is not there.
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"
#include <bitset>

namespace
{

uint8_t parity(unsigned a)
{
    return static_cast<uint8_t>(std::bitset<8>(a).count() & 1u);
}

/// PSW after A op x op c, from the definitions of CY, AC and OV as ranges.
struct expectation
{
    uint8_t a, psw;
};

expectation sum(int a, int x, int c)
{
    const int s = static_cast<int8_t>(a) + static_cast<int8_t>(x) + c;
    const int cy = a + x + c > 255, ac = (a & 15) + (x & 15) + c > 15, ov = s > 127 || s < -128;
    const auto r = static_cast<uint8_t>(a + x + c);
    return {r, static_cast<uint8_t>(cy << 7 | ac << 6 | ov << 2 | parity(r))};
}

expectation difference(int a, int x, int c)
{
    const int s = static_cast<int8_t>(a) - static_cast<int8_t>(x) - c;
    const int cy = a - x - c < 0, ac = (a & 15) - (x & 15) - c<0, ov = s> 127 || s < -128;
    const auto r = static_cast<uint8_t>(a - x - c);
    return {r, static_cast<uint8_t>(cy << 7 | ac << 6 | ov << 2 | parity(r))};
}

TEST(engine, add_addc_subb_over_all_operands)
{
    bare_cpu b;
    b.load(0, {0x25, 0x30, 0x35, 0x30, 0x95, 0x30}); // ADD, ADDC, SUBB A,30h
    for (int i = 0; i < 0x20000; ++i)
    {
        const int a = i & 255, x = i >> 8 & 255, c = i >> 16;
        const expectation want[3] = {sum(a, x, 0), sum(a, x, c), difference(a, x, c)};
        b.set_ram(0x30, x);
        for (int op = 0; op < 3; ++op)
        {
            b.set(sfr::ACC, a);
            b.set(sfr::PSW, c << 7 | 0x44);
            mcs51_set_pc(b.cpu, static_cast<uint16_t>(2 * op));
            b.step();
            ASSERT_EQ(b.get(sfr::ACC), want[op].a) << op << ": " << a << ' ' << x << ' ' << c;
            ASSERT_EQ(b.get(sfr::PSW), want[op].psw) << op << ": " << a << ' ' << x << ' ' << c;
        }
    }
}

TEST(engine, da_makes_decimal_sums_of_all_pairs)
{
    bare_cpu b;
    b.load(0, {0x25, 0x30, 0xD4});
    for (int i = 0; i < 10000; ++i)
    {
        const int m = i / 100, n = i % 100, s = (m + n) % 100;
        b.set(sfr::ACC, m / 10 << 4 | m % 10);
        b.set_ram(0x30, n / 10 << 4 | n % 10);
        mcs51_set_pc(b.cpu, 0);
        b.step();
        b.step();
        ASSERT_EQ(b.get(sfr::ACC), s / 10 << 4 | s % 10) << m << " + " << n;
        ASSERT_EQ(b.get(sfr::PSW) >> 7, m + n > 99);
    }
    b.set(sfr::PSW, 0);
    b.set(sfr::ACC, 0x9B);
    b.execute(0x10, {0xD4});
    EXPECT_EQ(b.get(sfr::ACC), 0x01);
    EXPECT_EQ(b.get(sfr::PSW), 0x81);
}

TEST(engine, mul_and_div_set_ov_clear_cy_keep_ac)
{
    bare_cpu b;
    b.set(sfr::PSW, 0xC0);
    b.set(sfr::ACC, 0x51);
    b.set(sfr::B, 0xA0);
    b.execute(0, {0xA4});
    EXPECT_EQ(b.get(sfr::B) << 8 | b.get(sfr::ACC), 0x51 * 0xA0);
    EXPECT_EQ(b.get(sfr::PSW), 0x44);
    b.set(sfr::PSW, 0xC4);
    b.set(sfr::ACC, 251);
    b.set(sfr::B, 18);
    b.execute(0, {0x84});
    EXPECT_EQ(b.get(sfr::ACC), 13);
    EXPECT_EQ(b.get(sfr::B), 17);
    EXPECT_EQ(b.get(sfr::PSW), 0x41);
    b.set(sfr::B, 0);
    b.execute(0, {0x84});
    EXPECT_EQ(b.get(sfr::PSW), 0x45);
}

TEST(engine, parity_is_hardware_also_after_a_write_to_psw)
{
    bare_cpu b;
    b.set(sfr::ACC, 0x07);
    b.execute(0, {0x75, sfr::PSW, 0x00});
    EXPECT_EQ(b.get(sfr::PSW), 0x01);
    b.execute(0, {0xC2, 0xD0}); // CLR P
    EXPECT_EQ(b.get(sfr::PSW), 0x01);
    b.execute(0, {0xE5, sfr::PSW});
    EXPECT_EQ(b.get(sfr::ACC), 0x01);
    b.execute(0, {0x75, sfr::PSW, 0xFE, 0x04}, 2);
    EXPECT_EQ(b.get(sfr::PSW), 0xFF); // ACC = 2
}

TEST(engine, psw_bits_select_the_register_bank)
{
    bare_cpu b;
    b.execute(0, {0xD2, 0xD4, 0x7B, 0x33}, 2); // SETB RS1; MOV R3,#
    EXPECT_EQ(b.ram(0x13), 0x33);
    b.execute(0, {0xD3, 0x92, 0xD3, 0x7B, 0x44}, 3); // SETB C; MOV RS0,C; MOV R3,#
    EXPECT_EQ(b.ram(0x1B), 0x44);
    b.execute(0, {0x10, 0xD4, 0x00, 0x7B, 0x55}, 2); // JBC RS1; MOV R3,#
    EXPECT_EQ(b.ram(0x0B), 0x55);
}

TEST(engine, cycles_are_those_of_the_intel_table)
{
    const std::vector<int> two = {0x10, 0x20, 0x30, 0x40, 0x50, 0x60, 0x70, 0x80, 0x02, 0x12, 0x22,
                                  0x32, 0x72, 0x82, 0x92, 0xA0, 0xB0, 0x43, 0x53, 0x63, 0x73, 0x83,
                                  0x93, 0xA3, 0x75, 0x85, 0x86, 0x87, 0xA6, 0xA7, 0x90, 0xB4, 0xB5,
                                  0xB6, 0xB7, 0xC0, 0xD0, 0xD5, 0xE0, 0xE2, 0xE3, 0xF0, 0xF2, 0xF3};
    std::vector<uint64_t> cycles(256, 1);
    for (const int op : two)
    {
        cycles[static_cast<size_t>(op)] = 2;
    }
    for (unsigned n = 0; n < 8; ++n)
    {
        for (const unsigned row : {0x88u, 0xA8u, 0xB8u, 0xD8u})
        {
            cycles[row + n] = 2; // MOV dir,Rn; MOV Rn,dir; CJNE Rn; DJNZ Rn
        }
        cycles[0x01 + 0x20 * n] = cycles[0x11 + 0x20 * n] = 2;
    }
    cycles[0x84] = cycles[0xA4] = 4;
    for (int op = 0; op < 256; ++op)
    {
        bare_cpu b;
        b.set(sfr::B, 1);
        b.execute(0x100, {op, 0x20, 0x20});
        EXPECT_EQ(b.now(), cycles[static_cast<size_t>(op)]) << std::hex << op;
        EXPECT_EQ(mcs51_instructions(b.cpu), 1u);
    }
}

TEST(engine, xchd_movc_and_stack_order)
{
    bare_cpu b;
    b.set(sfr::ACC, 0x12);
    b.set_ram(0, 0x40);
    b.set_ram(0x40, 0x34);
    b.execute(0, {0xD6});
    EXPECT_EQ(b.get(sfr::ACC), 0x14);
    EXPECT_EQ(b.ram(0x40), 0x32);
    b.set(sfr::ACC, 2);
    b.execute(0x200, {0x83, 0x00, 0x00, 0x77}); // MOVC A,@A+PC counts from the next instruction
    EXPECT_EQ(b.get(sfr::ACC), 0x77);
    b.execute(0x234, {0x12, 0x05, 0x67});
    EXPECT_EQ(b.pc(), 0x567);
    EXPECT_EQ(b.get(sfr::SP), 0x09);
    EXPECT_EQ(b.ram(8), 0x37);
    EXPECT_EQ(b.ram(9), 0x02);
    b.execute(0x567, {0x22});
    EXPECT_EQ(b.pc(), 0x237);
}

TEST(engine, what_is_not_there_is_reported_once_and_reads_a_constant)
{
    bare_cpu b;
    b.set_ram(0, 0x80);
    b.execute(0, {0x76, 0x11, 0xE6}, 2); // MOV @R0,#; MOV A,@R0
    EXPECT_EQ(b.get(sfr::ACC), 0xFF);
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].kind, EMU_GUEST_ERROR);
    EXPECT_EQ(b.reports[0].detail, 0x80u);

    b.execute(0, {0x75, 0xC8, 0x01, 0xE5, 0xC8, 0xE5, 0xCD}, 3);
    EXPECT_EQ(b.get(sfr::ACC), 0xFF);
    ASSERT_EQ(b.reports.size(), 3u); // C8h once, CDh once
    EXPECT_EQ(b.reports[1].detail, 0xC8u);
    EXPECT_EQ(b.reports[2].detail, 0xCDu);

    b.execute(0, {0xA5, 0xA5}, 2);
    EXPECT_EQ(b.pc(), 2);
    ASSERT_EQ(b.reports.size(), 4u);
    EXPECT_EQ(b.reports[3].detail, 0u);

    b.execute(0, {0xE0}); // MOVX
    ASSERT_EQ(b.reports.size(), 5u);
    EXPECT_EQ(b.reports[4].kind, EMU_NOT_MODELLED);

    b.execute(0xFFF, {0x00}, 2);
    EXPECT_EQ(b.pc(), 0x1001);
    ASSERT_EQ(b.reports.size(), 6u);
    EXPECT_EQ(b.reports[5].detail, 0x1000u);
}

TEST(engine, stack_grows_into_nothing_at_80h)
{
    bare_cpu b;
    b.execute(0, {0x75, sfr::SP, 0x7E, 0x12, 0x01, 0x00}, 2);
    EXPECT_EQ(b.ram(0x7F), 0x06);
    ASSERT_EQ(b.reports.size(), 1u);
    b.execute(0x100, {0x22});
    EXPECT_EQ(b.pc(), 0xFF06); // high octet was lost
}

TEST(engine, program_counter_wraps)
{
    bare_cpu b;
    b.load(0, {0x80, 0xFD}); // SJMP -3: to FFFFh
    b.step();
    EXPECT_EQ(b.pc(), 0xFFFF);
    b.step();
    EXPECT_EQ(b.pc(), 0x0000);
}

TEST(engine, image_larger_than_flash_is_refused)
{
    bare_cpu b;
    const std::vector<uint8_t> image(4097, 0);
    EXPECT_EQ(mcs51_load(b.cpu, 0, image.data(), 4097), -1);
    EXPECT_EQ(mcs51_load(b.cpu, 1, image.data(), 4096), -1);
    EXPECT_EQ(mcs51_code(b.cpu, 1), 0xFF);
    EXPECT_EQ(mcs51_load(b.cpu, 0, image.data(), 4096), 0);
}

} // namespace
