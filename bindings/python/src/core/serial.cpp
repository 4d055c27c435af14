/// \file   serial.cpp
/// \brief  The handshake's two machines over bytes, in the paper's form and extended: ins/handshake.h, ins/link.h.
/// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <optional>

namespace libins
{
using namespace nb::literals;

namespace
{
const ins_octet_t* octets_of(const nb::bytes& bytes)
{
    return reinterpret_cast<const ins_octet_t*>(bytes.c_str());
}

uint16_t clock_of(uint64_t now)
{
    return static_cast<uint16_t>(now & 0xFFFFu);
}

struct PaperBoard
{
    using Machine = ins_hs_board_t;
    static constexpr const char* name = "HsBoard";
    static constexpr const char* offer_name = "HsBoard.offer";
    static constexpr const char* wants = "block_len 1..32, at least 4 with seq; time-outs below 32768";
    static constexpr auto init = ins_hs_board_init;
    static constexpr auto offer = ins_hs_board_offer;
    static constexpr auto busy = ins_hs_board_busy;
    static constexpr auto tx = ins_hs_board_tx;
    static constexpr auto rx = ins_hs_board_rx;
    static constexpr auto tick = ins_hs_board_tick;
    static const ins_hs_board_t& paper(const Machine& m) { return m; }
};

struct LinkBoard
{
    using Machine = ins_link_board_t;
    static constexpr const char* name = "LinkBoard";
    static constexpr const char* offer_name = "LinkBoard.offer";
    static constexpr const char* wants = "block_len 1..15, at least 4 with seq; time-outs below 32768";
    static constexpr auto init = ins_link_board_init;
    static constexpr auto offer = ins_link_board_offer;
    static constexpr auto busy = ins_link_board_busy;
    static constexpr auto tx = ins_link_board_tx;
    static constexpr auto rx = ins_link_board_rx;
    static constexpr auto tick = ins_link_board_tick;
    static const ins_hs_board_t& paper(const Machine& m) { return m.hs; }
};

struct PaperHost
{
    using Machine = ins_hs_host_t;
    static constexpr const char* name = "HsHost";
    static constexpr const char* wants = PaperBoard::wants;
    static constexpr auto init = ins_hs_host_init;
    static constexpr auto rx = ins_hs_host_rx;
    static constexpr auto tick = ins_hs_host_tick;
    static const ins_hs_host_t& paper(const Machine& m) { return m; }
};

struct LinkHost
{
    using Machine = ins_link_host_t;
    static constexpr const char* name = "LinkHost";
    static constexpr const char* wants = LinkBoard::wants;
    static constexpr auto init = ins_link_host_init;
    static constexpr auto rx = ins_link_host_rx;
    static constexpr auto tick = ins_link_host_tick;
    static const ins_hs_host_t& paper(const Machine& m) { return m.hs; }
};

template <typename Side>
void start(typename Side::Machine* self, uint_least8_t block_len, bool seq, uint_least8_t retries,
           uint16_t reply_timeout, uint16_t octet_timeout)
{
    new (self) typename Side::Machine();
    const ins_hs_config_t cfg = {block_len, static_cast<uint_least8_t>(seq ? 1 : 0), retries, reply_timeout,
                                 octet_timeout};
    Call(Side::name, Side::wants).check(Side::init(self, &cfg));
}

template <typename Side> nb::class_<typename Side::Machine> machine(nb::module_& m, const char* doc)
{
    using Machine = typename Side::Machine;
    nb::class_<Machine> c(m, Side::name, doc);
    c.def("__init__", start<Side>, nb::kw_only(), "block_len"_a, "seq"_a = false, "retries"_a, "reply_timeout"_a,
          "octet_timeout"_a,
          "As in ins_hs_config_t. Time-outs are in the unit of `now`, of which the low 16 bits are used.");
    c.def(
        "tick", [](Machine& self, uint64_t now) { Side::tick(&self, clock_of(now)); }, "now"_a,
        "Time passes without an octet.");
    copies(c);
    return c;
}

template <typename C, typename Side, typename E, typename S>
void counter(C& c, const char* name, E S::*member, const char* doc)
{
    c.def_prop_ro(
        name, [member](const typename Side::Machine& self) { return Side::paper(self).*member; }, doc);
}

template <typename Side> auto bind_board(nb::module_& m, const char* doc)
{
    using Machine = typename Side::Machine;
    auto c = machine<Side>(m, doc);
    c.def(
        "offer",
        [](Machine& self, const nb::bytes& block, uint_least8_t seq, uint64_t now)
        {
            const Call call(Side::offer_name, "a block of block_len octets, when busy is False");
            call.check(block.size() == Side::paper(self).cfg.block_len ? INS_OK : INS_E_RANGE, "block: ");
            call.check(Side::offer(&self, octets_of(block), seq, clock_of(now)));
        },
        "block"_a, "seq"_a, "now"_a, "Offer a block for transmission. StateError while one is on its way.");
    c.def(
        "tx",
        [](Machine& self, uint64_t now) -> std::optional<int>
        {
            const int octet = Side::tx(&self, clock_of(now));
            return octet < 0 ? std::nullopt : std::optional<int>(octet);
        },
        "now"_a, "Next octet to put on the line, or None.");
    c.def(
        "take",
        [](Machine& self, uint64_t now)
        {
            std::vector<char> sent;
            for (int octet; (octet = Side::tx(&self, clock_of(now))) >= 0;)
            {
                sent.push_back(static_cast<char>(octet));
            }
            return nb::bytes(sent.data(), sent.size());
        },
        "now"_a, "All octets to put on the line now.");
    c.def(
        "rx",
        [](Machine& self, const nb::bytes& octets, uint64_t now)
        {
            for (size_t i = 0; i < octets.size(); i++)
            {
                Side::rx(&self, octets_of(octets)[i], clock_of(now));
            }
        },
        "octets"_a, "now"_a, "Octets came from the host.");
    c.def_prop_ro(
        "busy", [](const Machine& self) { return Side::busy(&self) != 0; }, "True while a block is on its way.");
    using C = decltype(c);
    counter<C, Side>(c, "sent", &ins_hs_board_t::sent, "Blocks acknowledged.");
    counter<C, Side>(c, "resent", &ins_hs_board_t::resent, "Frames or requests sent again.");
    counter<C, Side>(c, "given_up", &ins_hs_board_t::given_up, "Blocks dropped after the last retry.");
    return c;
}

using Block = std::tuple<nb::bytes, unsigned, unsigned>;

template <typename Side> auto bind_host(nb::module_& m, const char* doc)
{
    using Machine = typename Side::Machine;
    auto c = machine<Side>(m, doc);
    c.def(
        "rx",
        [](Machine& self, const nb::bytes& octets, uint64_t now)
        {
            std::vector<char> replies;
            std::vector<Block> blocks;
            for (size_t i = 0; i < octets.size(); i++)
            {
                int16_t reply;
                const int event = Side::rx(&self, octets_of(octets)[i], clock_of(now), &reply);
                const ins_hs_host_t& paper = Side::paper(self);
                if (event == INS_HS_BLOCK)
                {
                    blocks.emplace_back(nb::bytes(paper.block, paper.cfg.block_len), paper.seq, paper.gap);
                }
                if (reply >= 0)
                {
                    replies.push_back(static_cast<char>(reply));
                }
            }
            return std::make_pair(nb::bytes(replies.data(), replies.size()), blocks);
        },
        "octets"_a, "now"_a,
        "Octets came from the board. Returns (octets to send back, new blocks as (block, sequence number, blocks "
        "missing before it)).");
    using C = decltype(c);
    counter<C, Side>(c, "accepted", &ins_hs_host_t::accepted, "New blocks delivered.");
    counter<C, Side>(c, "duplicates", &ins_hs_host_t::duplicates, "Resent blocks recognised.");
    counter<C, Side>(c, "corrupt", &ins_hs_host_t::corrupt, "Sums that did not agree.");
    counter<C, Side>(c, "timeouts", &ins_hs_host_t::timeouts, "Blocks that stopped half-way.");
    counter<C, Side>(c, "stray", &ins_hs_host_t::stray, "Octets that fit nowhere.");
    return c;
}

void bind_blocks(nb::module_& m)
{
    m.def(
        "hs_block_put",
        [](const Given& codes)
        {
            Call call("hs_block_put");
            const auto in = call.rows<uint16_t>("codes", codes, {3});
            const auto out = call.out<uint8_t>({6});
            call.run([&](size_t k) { ins_hs_block_put(in[k], out[k]); });
            return out;
        },
        "codes"_a,
        "The paper's block XH XL YH YL ZH ZL, uint8 (6,) or (N, 6), of three 12-bit codes, uint16 (3,) or (N, 3).");
    m.def(
        "hs_block_codes",
        [](const Given& block)
        {
            Call call("hs_block_codes");
            const auto in = call.rows<uint8_t>("block", block, {6});
            const auto out = call.out<uint16_t>({3});
            call.run([&](size_t k) { ins_hs_block_codes(in[k], out[k]); });
            return out;
        },
        "block"_a, "Three 12-bit codes, uint16 (3,) or (N, 3), of the paper's block, uint8 (6,) or (N, 6).");
    m.def(
        "link_crc",
        [](const nb::bytes& octets, uint16_t crc)
        {
            for (size_t i = 0; i < octets.size(); i++)
            {
                crc = ins_link_crc(crc, octets_of(octets)[i]);
            }
            return crc;
        },
        "octets"_a, "crc"_a = INS_LINK_CRC_START, "CRC-16 of the extended frame over octets, continued from crc.");
}
} // namespace

void bind_serial(nb::module_& m)
{
#define LIBINS_CONSTANT(name) m.attr(#name) = static_cast<int>(INS_##name);
    LIBINS_CONSTANT(HS_BLOCK_MAX)
    LIBINS_CONSTANT(HS_REQUEST)
    LIBINS_CONSTANT(HS_READY)
    LIBINS_CONSTANT(HS_ACCEPT)
    LIBINS_CONSTANT(HS_RESEND)
    LIBINS_CONSTANT(LINK_REQUEST)
    LIBINS_CONSTANT(LINK_READY)
    LIBINS_CONSTANT(LINK_PROBE_EVERY)
    LIBINS_CONSTANT(LINK_BLOCK_MAX)
    LIBINS_CONSTANT(LINK_CRC_START)
    bind_blocks(m);
    bind_board<PaperBoard>(m, "The sampling board's side of the handshake.");
    bind_host<PaperHost>(m, "The host's side of the handshake.");
    auto board = bind_board<LinkBoard>(m, "The sampling board's side of the handshake with the extended frame.");
    board.def_ro("extended", &ins_link_board_t::extended, "Blocks acknowledged in the extended form.");
    board.def_ro("fallbacks", &ins_link_board_t::fallbacks, "Times that the extended request had no answer.");
    auto host = bind_host<LinkHost>(m, "The host's side of the handshake with the extended frame.");
    host.def_prop_ro(
        "extended", [](const ins_link_host_t& self) { return self.extended != 0; },
        "The frame under way, or else the last, is extended.");
}

} // namespace libins
