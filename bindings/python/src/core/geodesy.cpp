/// \file   geodesy.cpp
/// \brief  Ellipsoids, ECEF, local frames, transverse Mercator: ins/geodesy.h, ins/tm.h. SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <nanobind/stl/pair.h>

namespace libins
{
using namespace nb::literals;

namespace
{
const char* const GEODETIC = "finite, |latitude| <= pi/2, |longitude| <= 2 pi";
const char* const GRID = "finite, |latitude| <= pi/2, at most 10 degrees from the central meridian";

void bind_ecef(nb::module_& m)
{
    m.attr("GEODESY_RADIUS_MIN") = static_cast<double>(INS_GEODESY_RADIUS_MIN);
    nb::class_<ins_ellipsoid_t> ellipsoid(m, "Ellipsoid", "Semi-major axis [m] and flattening.");
    ellipsoid.def(
        "__init__",
        [](ins_ellipsoid_t* self, double a, double f) {
            new (self) ins_ellipsoid_t{as_real(a), as_real(f), as_real(f * (2 - f))};
        },
        "a"_a, "f"_a);
    ellipsoid.def_ro("a", &ins_ellipsoid_t::a, "Semi-major axis [m].");
    ellipsoid.def_ro("f", &ins_ellipsoid_t::f, "Flattening.");
    ellipsoid.def_ro("e2", &ins_ellipsoid_t::e2, "First eccentricity squared.");
    m.attr("WGS84") = nb::cast(ins_wgs84);
    m.attr("GRS80") = nb::cast(ins_grs80);
    m.def(
        "geodesy_to_ecef",
        [](const ins_ellipsoid_t& on, const Given& llh)
        {
            Call call("geodesy_to_ecef", GEODETIC);
            const auto in = call.rows<ins_real>("llh", llh, {3});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { return ins_geodesy_to_ecef(&on, in[k], out[k]); });
            return out;
        },
        "ellipsoid"_a, "llh"_a, "Latitude, longitude [rad] and height [m] to ECEF [m], (3,) or (N, 3).");
    m.def(
        "geodesy_from_ecef",
        [](const ins_ellipsoid_t& on, const Given& xyz_e)
        {
            Call call("geodesy_from_ecef", "finite, at least half of a semi-major axis from the centre");
            const auto in = call.rows<ins_real>("xyz_e", xyz_e, {3});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { return ins_geodesy_from_ecef(&on, in[k], out[k]); });
            return out;
        },
        "ellipsoid"_a, "xyz_e"_a, "ECEF [m] to latitude, longitude [rad] and height [m], (3,) or (N, 3).");
}

void bind_local(nb::module_& m)
{
    nb::class_<ins_local_t> local(m, "Local", "A tangent frame, north, east, down, fixed to the Earth.");
    local.def(
        "__init__",
        [](ins_local_t* self, const ins_ellipsoid_t& on, const Given& llh)
        {
            new (self) ins_local_t();
            const Call call("Local", GEODETIC);
            call.check(ins_local_init(self, &on, call.whole<ins_real>("llh", llh, {3}).data));
        },
        "ellipsoid"_a, "llh"_a, "llh: (3,) of the origin [rad, rad, m].");
    local.def(
        "from_ecef",
        [](const ins_local_t& self, const Given& xyz_e)
        {
            Call call("Local.from_ecef");
            const auto in = call.rows<ins_real>("xyz_e", xyz_e, {3});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { ins_local_from_ecef(&self, in[k], out[k]); });
            return out;
        },
        "xyz_e"_a, "ECEF to NED from the origin [m], (3,) or (N, 3).");
    local.def(
        "to_ecef",
        [](const ins_local_t& self, const Given& ned)
        {
            Call call("Local.to_ecef");
            const auto in = call.rows<ins_real>("ned", ned, {3});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { ins_local_to_ecef(&self, in[k], out[k]); });
            return out;
        },
        "ned"_a, "NED from the origin to ECEF [m], (3,) or (N, 3).");
    reads(local, "origin_e", &ins_local_t::origin_e, {3}, "Origin in ECEF, (3,) [m].");
    reads(local, "C_ne", &ins_local_t::C_ne, {3, 3}, "(3, 3), rows: north, east, down in e.");
    copies(local);
    m.def(
        "local_swap",
        [](const Given& v)
        {
            Call call("local_swap");
            const auto in = call.rows<ins_real>("v", v, {3});
            const auto out = call.out<ins_real>({3});
            call.run([&](size_t k) { ins_local_swap(in[k], out[k]); });
            return out;
        },
        "v"_a, "NED to ENU, and ENU to NED, (3,) or (N, 3).");
}

using Inverse = ins_status_t (*)(const ins_tm_t*, const ins_real*, ins_real*);

Made<ins_real> inverse(const char* name, Inverse function, const ins_tm_t& self, const Given& en)
{
    Call call(name, "finite, a point that forward gives");
    const auto in = call.rows<ins_real>("en", en, {2});
    const auto out = call.out<ins_real>({2});
    call.run([&](size_t k) { return function(&self, in[k], out[k]); });
    return out;
}

std::pair<Made<ins_real>, Made<ins_real>> forward(const ins_tm_t& self, const Given& lat, const Given& lon)
{
    Call call("Tm.forward", GRID);
    const auto latitude = call.rows<ins_real>("lat", lat, {});
    const auto longitude = call.rows<ins_real>("lon", lon, {});
    const auto en = call.out<ins_real>({2});
    const auto convergence = call.out<ins_real>({});
    call.run([&](size_t k) { return ins_tm_forward(&self, *latitude[k], *longitude[k], en[k], convergence[k]); });
    return {en, convergence};
}

Made<ins_real> thesis_forward(const ins_tm_t& self, const Given& lat, const Given& lon)
{
    Call call("Tm.thesis_forward", GRID);
    const auto latitude = call.rows<ins_real>("lat", lat, {});
    const auto longitude = call.rows<ins_real>("lon", lon, {});
    const auto en = call.out<ins_real>({2});
    call.run([&](size_t k) { return ins_tm_thesis_forward(&self, *latitude[k], *longitude[k], en[k]); });
    return en;
}

void bind_tm(nb::module_& m)
{
    m.attr("TM_DLON_MAX") = static_cast<double>(INS_TM_DLON_MAX);
    nb::class_<ins_tm_t> tm(m, "Tm", "A transverse Mercator projection, by Krueger's series.");
    tm.def(
        "__init__",
        [](ins_tm_t* self, const ins_ellipsoid_t& on, double lon0, double k0, double false_e, double false_n)
        {
            new (self) ins_tm_t();
            Call("Tm", "0 < f <= 1/150, |lon0| <= pi, k0 in 0.5 .. 2, finite false origin")
                .check(ins_tm_init(self, &on, as_real(lon0), as_real(k0), as_real(false_e), as_real(false_n)));
        },
        "ellipsoid"_a, "lon0"_a, "k0"_a, "false_easting"_a, "false_northing"_a,
        "lon0: central meridian [rad]; false origin [m].");
    tm.def_static(
        "twd97",
        [](int zone)
        {
            ins_tm_t self;
            Call("Tm.twd97", "zone 121 or 119").check(ins_tm_init_twd97(&self, zone));
            return self;
        },
        "zone"_a, "TM2 of TWD97: zone 121 (EPSG:3826) or 119 (EPSG:3825).");
    tm.def("forward", forward, "lat"_a, "lon"_a,
           "Latitude and longitude [rad], () or (N,), to (easting and northing [m], (2,) or (N, 2); bearing of grid "
           "north from true "
           "north, clockwise [rad], () or (N,)).");
    tm.def(
        "inverse",
        [](const ins_tm_t& self, const Given& en) { return inverse("Tm.inverse", ins_tm_inverse, self, en); }, "en"_a,
        "Easting and northing [m] to latitude and longitude [rad], (2,) or (N, 2).");
    tm.def("thesis_forward", thesis_forward, "lat"_a, "lon"_a,
           "As forward, by the thesis's corrected series; no convergence.");
    tm.def(
        "thesis_inverse",
        [](const ins_tm_t& self, const Given& en)
        { return inverse("Tm.thesis_inverse", ins_tm_thesis_inverse, self, en); },
        "en"_a, "As inverse, by the thesis's corrected series.");
    m.def(
        "twd97_zone",
        [](const Given& lon)
        {
            Call call("twd97_zone");
            const auto in = call.rows<ins_real>("lon", lon, {});
            const auto out = call.out<int32_t>({});
            call.run([&](size_t k) { *out[k] = ins_twd97_zone(*in[k]); });
            return out;
        },
        "lon"_a, "TWD97 zone of a longitude [rad], () or (N,): 121, 119, or 0 for none.");
    copies(tm);
}
} // namespace

void bind_geodesy(nb::module_& m)
{
    bind_ecef(m);
    bind_local(m);
    bind_tm(m);
}

} // namespace libins
