/// \file   test_parts.cpp
/// \brief  What memory each part has, and external code and data memory behind it (Atmel 2487D, 1919D; MCS-51 hardware description).
/// SPDX-License-Identifier: MIT
#include "bare_cpu.hpp"

namespace
{

mcs51_config_t with(mcs51_part_t part, uint32_t code_octets = 0, uint32_t xdata_octets = 0, uint8_t stack_limit = 0)
{
    mcs51_config_t config{};
    config.part = part;
    config.code_octets = code_octets;
    config.xdata_octets = xdata_octets;
    config.stack_limit = stack_limit;
    return config;
}

TEST(parts, sizes_that_there_are_not_are_refused)
{
    const mcs51_config_t bad[] = {with(MCS51_AT89S51, 4095), with(MCS51_AT89S52, 8191), with(MCS51_AT89S51, 65537),
                                  with(MCS51_AT89S51, 0, 65537), with(MCS51_AT89S51, 0, 0, 0x80)};
    for (const mcs51_config_t& config : bad)
    {
        EXPECT_EQ(mcs51_create(&config), nullptr);
    }
    bare_cpu all(with(MCS51_AT89S52, 65536, 65536, 0xFF));
    EXPECT_NE(all.cpu, nullptr);
}

TEST(parts, flash_ends_where_the_part_says)
{
    for (const auto& [part, code, octets] : {std::tuple{MCS51_AT89S51, 0u, 4096u},
                                             {MCS51_AT89S52, 0u, 8192u},
                                             {MCS51_AT89S51, 20000u, 20000u},
                                             {MCS51_AT89S52, 65536u, 65536u}})
    {
        bare_cpu b(with(part, code));
        const std::vector<uint8_t> image(octets + 1);
        EXPECT_EQ(mcs51_load(b.cpu, 0, image.data(), octets + 1), -1);
        EXPECT_EQ(mcs51_load(b.cpu, 1, image.data(), octets), -1);
        EXPECT_EQ(mcs51_code(b.cpu, 1), 0xFF);
        EXPECT_EQ(mcs51_load(b.cpu, 0, image.data(), octets), 0);
        mcs51_set_pc(b.cpu, static_cast<uint16_t>(octets - 1));
        b.step();
        EXPECT_TRUE(b.reports.empty());
        b.step();
        if (octets == 65536)
        {
            EXPECT_TRUE(b.reports.empty()); // it is address 0 again
        }
        else
        {
            ASSERT_EQ(b.reports.size(), 1u);
            EXPECT_EQ(b.reports[0].detail, octets);
        }
    }
}

TEST(parts, upper_ram_of_the_s52_is_indirect_and_stack_only)
{
    bare_cpu b(with(MCS51_AT89S52));
    b.set(sfr::P1, 0x11);
    b.set_ram(0, 0x90);
    b.execute(0, {0x76, 0x22, 0xE6, 0x86, 0x30, 0xE5, sfr::P1}, 4); // MOV @R0,#; MOV A,@R0; MOV 30h,@R0; MOV A,P1
    EXPECT_EQ(b.ram(0x90), 0x22);
    EXPECT_EQ(b.ram(0x30), 0x22);
    EXPECT_EQ(b.get(sfr::ACC), 0x11); // P1 is elsewhere
    for (int address = 0x80; address < 0x100; ++address)
    {
        b.set_ram(0, address);
        b.set(sfr::ACC, address ^ 0xFF);
        b.execute(0, {0xF6});
    }
    for (int address = 0x80; address < 0x100; ++address)
    {
        EXPECT_EQ(b.ram(static_cast<uint8_t>(address)), address ^ 0xFF);
    }
    EXPECT_EQ(b.get(sfr::P1), 0x11);
    EXPECT_TRUE(b.reports.empty());
}

TEST(parts, the_stack_of_the_s52_runs_through_80h)
{
    bare_cpu b(with(MCS51_AT89S52));
    b.load(0x100, {0xC0, 0x30, 0xD0, 0x31, 0x22}); // PUSH 30h; POP 31h; RET
    b.set_ram(0x30, 0x5A);
    b.execute(0x234, {0x75, sfr::SP, 0x7E, 0x12, 0x01, 0x00}, 5);
    EXPECT_EQ(b.ram(0x7F), 0x3A);
    EXPECT_EQ(b.ram(0x80), 0x02);
    EXPECT_EQ(b.ram(0x81), 0x5A);
    EXPECT_EQ(b.ram(0x31), 0x5A);
    EXPECT_EQ(b.pc(), 0x23A);
    b.load(0x0B, {0x32});
    b.execute(0x300, {0x75, sfr::SP, 0x9F, 0x75, sfr::IE, 0x82, 0xD2, 0x8D, 0x00, 0x80, 0xFE},
              6); // an interrupt as well
    EXPECT_EQ(b.ram(0xA0), 0x09);
    EXPECT_EQ(b.ram(0xA1), 0x03);
    EXPECT_EQ(mcs51_interrupts(b.cpu), 1u);
    EXPECT_TRUE(b.reports.empty());
}

TEST(parts, stack_overflow_is_the_top_of_ram_or_the_limit_and_wraps_at_ffh)
{
    for (const auto& [part, limit, last, kept] : {std::tuple{MCS51_AT89S51, 0, 0x7F, false},
                                                  {MCS51_AT89S51, 0x5F, 0x5F, true},
                                                  {MCS51_AT89S52, 0, 0xFF, true},
                                                  {MCS51_AT89S52, 0xBF, 0xBF, true}})
    {
        bare_cpu b(with(part, 0, 0, static_cast<uint8_t>(limit)));
        const auto beyond = static_cast<uint8_t>(last + 1);
        b.set(sfr::ACC, 0x77);
        b.execute(0, {0x75, sfr::SP, last - 1, 0xC0, sfr::ACC}, 2); // PUSH ACC
        EXPECT_TRUE(b.reports.empty());
        b.execute(5, {0xC0, sfr::ACC, 0xC0, sfr::ACC}, 2);
        EXPECT_EQ(b.get(sfr::SP), static_cast<uint8_t>(last + 2));
        ASSERT_EQ(b.reports.size(), 1u);
        EXPECT_EQ(b.reports[0].kind, EMU_GUEST_ERROR);
        EXPECT_NE(b.reports[0].text.find("stack overflow"), std::string::npos);
        EXPECT_EQ(b.reports[0].detail, beyond);
        EXPECT_EQ(b.ram(beyond) == 0x77, kept);
    }
    bare_cpu b;
    b.load(0x0B, {0x80, 0xFE});
    b.execute(0x100, {0x75, sfr::SP, 0x7F, 0x75, sfr::IE, 0x82, 0xD2, 0x8D, 0x00, 0x00}, 5);
    EXPECT_EQ(mcs51_interrupts(b.cpu), 1u);
    ASSERT_EQ(b.reports.size(), 1u); // the vector pushed
    EXPECT_NE(b.reports[0].text.find("stack overflow"), std::string::npos);
}

TEST(parts, stack_overflow_is_told_in_the_midst_of_a_run)
{
    const std::vector<std::vector<uint8_t>> runaways = {{0x12, 0x00, 0x00}, {0x11, 0x00}, {0xC0, sfr::ACC, 0x80, 0xFC}};
    for (const int limit : {0, 0x40, 0xE0})
    {
        for (const auto& code : runaways)
        {
            bare_cpu b(with(MCS51_AT89S52, 0, 0, static_cast<uint8_t>(limit)));
            ASSERT_EQ(mcs51_load(b.cpu, 0, code.data(), code.size()), 0);
            b.run(5000);
            ASSERT_EQ(b.reports.size(), 1u);
            EXPECT_EQ(b.reports[0].detail, static_cast<uint8_t>(limit ? limit + 1 : 0)) << +code[0];
        }
    }
}

TEST(external, movx_by_dptr_and_by_ri_with_p2)
{
    bare_cpu b(with(MCS51_AT89S51, 0, 65536));
    b.execute(0, {0x90, 0x12, 0x34, 0x74, 0x5A, 0xF0, 0xE4, 0xE0},
              5); // MOV DPTR,#; MOV A,#; MOVX @DPTR,A; CLR A; MOVX A,@DPTR
    EXPECT_EQ(mcs51_xdata(b.cpu, 0x1234), 0x5A);
    EXPECT_EQ(b.get(sfr::ACC), 0x5A);
    b.execute(0x20, {0x75, sfr::P2, 0xFF, 0x79, 0xFF, 0x74, 0xA5, 0xF3, 0x75, sfr::P2, 0x12, 0x78, 0x34, 0xE2}, 7);
    EXPECT_EQ(mcs51_xdata(b.cpu, 0xFFFF), 0xA5); // MOVX @R1,A
    EXPECT_EQ(b.get(sfr::ACC), 0x5A);            // MOVX A,@R0
    EXPECT_EQ(b.get(sfr::P2), 0x12);
    EXPECT_EQ(b.now(), 2u + 1u + 2u + 1u + 2u + 2u + 1u + 1u + 2u + 2u + 1u + 2u);
    EXPECT_TRUE(b.reports.empty());
}

TEST(external, movx_uses_the_selected_data_pointer)
{
    bare_cpu b(with(MCS51_AT89S51, 0, 256));
    mcs51_set_xdata(b.cpu, 0x41, 0x99);
    b.execute(0, {0x90, 0x00, 0x40, 0x05, sfr::AUXR1, 0x90, 0x00, 0x41, 0xE0, 0x05, sfr::AUXR1, 0xF0}, 6);
    EXPECT_EQ(mcs51_xdata(b.cpu, 0x40), 0x99);
    EXPECT_TRUE(b.reports.empty());
}

TEST(external, every_access_leaves_ffh_in_the_latch_of_p0)
{
    bare_cpu b(with(MCS51_AT89S51, 0, 16));
    b.execute(0, {0x75, sfr::P0, 0x3C, 0xE0}, 2);
    EXPECT_EQ(b.get(sfr::P0), 0xFF);
    EXPECT_EQ(mcs51_port_out(b.cpu, 0), 0xFF);
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].kind, EMU_GUEST_ERROR);
    EXPECT_EQ(b.reports[0].detail, 0x3Cu);
}

TEST(external, beyond_the_ram_is_the_firmwares_error_and_no_ram_is_ours)
{
    bare_cpu b(with(MCS51_AT89S51, 0, 0x200));
    b.execute(0, {0x90, 0x02, 0x00, 0xF0, 0xE0}, 3);
    EXPECT_EQ(b.get(sfr::ACC), 0xFF);
    ASSERT_EQ(b.reports.size(), 1u);
    EXPECT_EQ(b.reports[0].kind, EMU_GUEST_ERROR);
    EXPECT_EQ(b.reports[0].detail, 0x200u);
    bare_cpu none;
    none.execute(0, {0xE0});
    ASSERT_EQ(none.reports.size(), 1u);
    EXPECT_EQ(none.reports[0].kind, EMU_NOT_MODELLED);
}

TEST(external, ram_is_kept_by_reset_and_cleared_by_power)
{
    bare_cpu b(with(MCS51_AT89S52, 0, 0x400));
    mcs51_set_xdata(b.cpu, 0x3FF, 0x12);
    mcs51_set_xdata(b.cpu, 0x400, 0x34);
    b.set_ram(0xFF, 0x56);
    EXPECT_EQ(mcs51_xdata(b.cpu, 0x400), 0xFF);
    mcs51_reset(b.cpu, false);
    EXPECT_EQ(mcs51_xdata(b.cpu, 0x3FF), 0x12);
    EXPECT_EQ(b.ram(0xFF), 0x56);
    mcs51_reset(b.cpu, true);
    EXPECT_EQ(mcs51_xdata(b.cpu, 0x3FF), 0x00);
    EXPECT_EQ(b.ram(0xFF), 0x00);
}

TEST(external, code_runs_and_is_read_behind_the_flash)
{
    bare_cpu b(with(MCS51_AT89S51, 65536));
    b.load(0xFFF0, {0xE4, 0x83, 0x22, 0x77}); // CLR A; MOVC A,@A+PC; RET
    b.execute(0xFFE, {0x12, 0xFF, 0xF0}, 3);  // across the end of the flash
    EXPECT_EQ(b.get(sfr::ACC), 0x22);
    b.step();
    EXPECT_EQ(b.pc(), 0x1001);
    b.execute(0x100, {0x90, 0xFF, 0xF3, 0xE4, 0x93}, 3);
    EXPECT_EQ(b.get(sfr::ACC), 0x77);
    EXPECT_TRUE(b.reports.empty());
}

TEST(external, a_changed_octet_of_code_is_what_runs_next)
{
    bare_cpu b;
    b.load(0, {0x04, 0x80, 0xFD}); // INC A; SJMP 0
    b.run(30);
    const int a = b.get(sfr::ACC);
    EXPECT_EQ(a, 10);
    mcs51_set_code(b.cpu, 0, 0x14); // one bit flips: DEC A
    EXPECT_EQ(mcs51_code(b.cpu, 0), 0x14);
    b.run(60);
    EXPECT_EQ(b.get(sfr::ACC), 0);
    mcs51_set_code(b.cpu, 0x1000, 0x00);
    EXPECT_EQ(mcs51_code(b.cpu, 0x1000), 0xA5); // nothing there
}

} // namespace
