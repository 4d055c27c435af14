/// \file   soup.hpp
/// \brief  Random octets that run as MCS-51 programs: all opcodes, waiting loops, traffic with every peripheral.
/// SPDX-License-Identifier: MIT
#ifndef SOUP_HPP_INCLUDED
#define SOUP_HPP_INCLUDED
#include "bare_cpu.hpp"
#include <algorithm>
#include <random>

class soup
{
  public:
    static constexpr size_t SIZE = 4096;

    explicit soup(unsigned seed) : rng_(seed)
    {
        while (image_.size() < SIZE - 8)
        {
            below(24) == 0 ? wait() : instruction();
        }
        image_.resize(SIZE);
        for (size_t irq = 0; irq < 5; ++irq)
        {
            const uint8_t handler[] = {0x05, static_cast<uint8_t>(0x70 + irq), 0x32}; // INC; RETI
            std::copy(std::begin(handler), std::end(handler), image_.begin() + static_cast<long>(8 * irq + 3));
        }
    }
    const std::vector<uint8_t>& image() const { return image_; }

  private:
    std::mt19937 rng_;
    std::vector<uint8_t> image_;

    unsigned below(unsigned n) { return static_cast<unsigned>(rng_() % n); }
    int octet() { return static_cast<int>(below(256)); }
    int any(const std::vector<int>& of) { return of[below(static_cast<unsigned>(of.size()))]; }
    void emit(std::initializer_list<int> octets)
    {
        for (const int x : octets)
        {
            image_.push_back(static_cast<uint8_t>(x));
        }
    }
    int direct()
    {
        static const std::vector<int> SFRS = {sfr::P0,  sfr::P1,  sfr::P2,   sfr::P3,   sfr::TCON, sfr::TL0, sfr::TL1,
                                              sfr::TH0, sfr::TH1, sfr::SCON, sfr::SBUF, sfr::IE,   sfr::IP,  sfr::PSW,
                                              sfr::ACC, sfr::ACC, sfr::B,    sfr::DPL,  sfr::DPH,  sfr::TMOD};
        const unsigned kind = below(128);
        return kind == 0 ? octet() : kind < 40 ? any(SFRS) : static_cast<int>(below(0x80));
    }
    int bit()
    {
        static const std::vector<int> BITS = {0x98, 0x99, 0x8D, 0x8F, 0x8C, 0x8E, 0x89, 0x8B, 0x90, 0x91, 0xB2,
                                              0xB4, 0xE0, 0xE7, 0xD5, 0xD7, 0xF0, 0xA9, 0xAB, 0xAC, 0xAF, 0xAF};
        return below(2) ? any(BITS) : static_cast<int>(below(0x80));
    }
    int near() { return below(8) ? static_cast<int>(below(12)) : -static_cast<int>(below(24)) & 0xFF; }

    /// The shapes that the fast engine passes over, on bits that only an event changes; interrupts are on, or the end may never come.
    void wait()
    {
        const int b = any({0x99, 0x98, 0x8D, 0x8F, 0x89, 0x90, 0xB2, 0x08}), jump = any({0x20, 0x30, 0x30});
        emit({0xD2, 0xAF});
        switch (below(4))
        {
        case 0:
            emit({jump, b, 0xFD});
            break;
        case 1:
            emit({below(3) ? jump : 0x10, b, 0x02, 0x80, 0xFB});
            break;
        case 2:
            emit({static_cast<int>(0xD8 + below(8)), 0xFE});
            break;
        default:
            emit({0xD5, static_cast<int>(below(0x80)), 0xFD});
            break;
        }
    }
    void instruction()
    {
        static const char* const LENGTHS[8] = {"1333223222223211", "2222222222222222", "3311222222222211",
                                               "1111111111111111", "1122222212131111", "2222222332132322",
                                               "1111111221231111", "1111111221231211"};
        const unsigned opcode = below(256), row = opcode >> 4, column = opcode & 15u;
        if (opcode == 0xA5 && below(16))
        {
            return;
        }
        const unsigned octets = static_cast<unsigned>(LENGTHS[column < 8 ? column : 7][row] - '0');
        const bool bits = (column == 0 && ((row >= 1 && row <= 3) || row == 10 || row == 11)) ||
                          (column == 2 && row >= 7 && row != 14 && row != 15) || opcode == 0xA2;
        const bool branch = (column == 0 && row >= 1 && row <= 8) || (row == 11 && column >= 4) || opcode == 0xD5 ||
                            (row == 13 && column >= 8);
        emit({static_cast<int>(opcode)});
        for (unsigned k = 1; k < octets; ++k)
        {
            const bool far = column == 2 && row < 2 && k == 1;
            const bool last = k + 1 == octets;
            emit({far ? static_cast<int>(below(SIZE >> 8)) : branch && last ? near() : bits ? bit() : direct()});
        }
    }
};

#endif // SOUP_HPP_INCLUDED
