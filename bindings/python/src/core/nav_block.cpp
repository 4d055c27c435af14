/// \file   nav_block.cpp
/// \brief  The navigation result in 32 octets: ins/nav_block.h. SPDX-License-Identifier: MIT
#include "arrays.hpp"

namespace libins
{
using namespace nb::literals;

void bind_nav_block(nb::module_& m)
{
    m.attr("NAV_BLOCK_LEN") = INS_NAV_BLOCK_LEN;
    m.attr("NAV_BLOCK_V_MAX") = static_cast<double>(INS_NAV_BLOCK_V_MAX);
#define LIBINS_STATUS(name, value, text) m.attr(&#name[4]) = (value);
    INS_NAV_BLOCK_STATUS_LIST(LIBINS_STATUS)
#undef LIBINS_STATUS
    nb::class_<ins_nav_block_t> nav(m, "NavBlock", "Position, velocity and attitude as a navigating board sends them.");
    nav.def(
        "__init__",
        [](ins_nav_block_t* self)
        {
            new (self) ins_nav_block_t();
            self->q_nb[0] = 1;
            self->fix_age = INS_NAV_BLOCK_OLD;
        },
        "At time 0, level and north, without a fix.");
    nav.def_rw("time_ms", &ins_nav_block_t::time_ms, "Since the board's start, modulo 2^32.");
    nav.def_rw("status", &ins_nav_block_t::status, "NAV_BLOCK_ALIGNED, ..., or-ed.");
    nav.def_rw("sats", &ins_nav_block_t::sats, "Satellites of the last fix.");
    nav.def_rw("fix_age", &ins_nav_block_t::fix_age, "Of the last fix [0.1 s]; 255: that or longer, or none.");
    writes(nav, "en_cm", &ins_nav_block_t::en_cm, {2}, "Easting, northing [cm], int32 (2,).");
    writes(nav, "v_en", &ins_nav_block_t::v_en, {2}, "Velocity east, north [m/s], (2,).");
    writes(nav, "q_nb", &ins_nav_block_t::q_nb, {4}, "Attitude, scalar first, (4,).");
    nav.def(
        "put",
        [](const ins_nav_block_t& self)
        {
            ins_octet_t block[INS_NAV_BLOCK_LEN];
            const Call call("NavBlock.put", "|v_en| <= 8388 m/s, q_nb within 1e-3 of unit norm, status below 0x800");
            call.check(ins_nav_block_put(&self, block));
            return nb::bytes(reinterpret_cast<const char*>(block), INS_NAV_BLOCK_LEN);
        },
        "The 32 octets.");
    nav.def_static(
        "get",
        [](const nb::bytes& octets)
        {
            const Call call("NavBlock.get", "32 octets of version 1 without a sequence number");
            ins_nav_block_t self;
            call.check(octets.size() == INS_NAV_BLOCK_LEN
                           ? ins_nav_block_get(reinterpret_cast<const ins_octet_t*>(octets.c_str()), &self)
                           : static_cast<ins_status_t>(INS_E_RANGE));
            return self;
        },
        "octets"_a, "From 32 octets.");
    copies(nav);
}

} // namespace libins
