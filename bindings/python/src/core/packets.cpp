/// \file   packets.cpp
/// \brief  GIMU packets and NMEA sentences from bytes: ins/gimu.h, ins/nmea.h. SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

namespace libins
{
using namespace nb::literals;

namespace
{
/// A packet or sentence, and which of them it is.
template <typename T> struct Typed : T
{
    int type;
};
using Packet = Typed<ins_gimu_packet_t>;
using Fix = Typed<ins_nmea_fix_t>;

void bind_packet(nb::module_& m)
{
    nb::class_<Packet> packet(m, "GimuPacket", "A packet of the GIMU. Angles in 1e-7 degree.");
    packet.def_ro("type", &Packet::type, "GIMU_T1 or GIMU_T2.");
    reads(packet, "raw", &Packet::raw, {6}, "P, Q, R, AX, AY, AZ [LSB], uint16 (6,).");
    reads(packet, "coordinate", &Packet::coordinate, {2}, "As sent, uint32 (2,) (type 2).");
    packet.def_ro("lat_e7", &Packet::lat_e7, "Latitude, with has_position.");
    packet.def_ro("lon_e7", &Packet::lon_e7, "Longitude, with has_position.");
    packet.def_ro("sats", &Packet::sats, "Satellites (type 2).");
    packet.def_prop_ro(
        "has_position", [](const Packet& self) { return self.has_position != 0; },
        "False for type 1, and where both coordinates are above 90 degrees.");
}

void bind_gimu(nb::module_& m)
{
    bind_packet(m);
    nb::class_<ins_gimu_t> gimu(m, "Gimu", "Reader of GIMU packets.");
    gimu.def(
        "__init__",
        [](ins_gimu_t* self, bool check_12_bits)
        {
            new (self) ins_gimu_t();
            ins_gimu_init(self, check_12_bits ? 1 : 0);
        },
        "check_12_bits"_a = true, "check_12_bits: a sample above FFF is no sample.");
    gimu.def(
        "rx",
        [](ins_gimu_t& self, const nb::bytes& octets)
        {
            std::vector<Packet> packets;
            for (size_t i = 0; i < octets.size(); i++)
            {
                const int type = ins_gimu_rx(&self, static_cast<ins_octet_t>(octets.c_str()[i]));
                if (type != INS_GIMU_NOTHING)
                {
                    packets.push_back({self.packet, type});
                }
            }
            return packets;
        },
        "octets"_a,
        "Octets came; the packets that they complete. A packet is complete with the beginning of the next.");
    gimu.def(
        "flush",
        [](ins_gimu_t& self)
        {
            std::vector<Packet> packets;
            for (int type; (type = ins_gimu_flush(&self)) != INS_GIMU_NOTHING;)
            {
                packets.push_back({self.packet, type});
            }
            return packets;
        },
        "Nothing follows for now: the packets that wait.");
    gimu.def_ro("t1", &ins_gimu_t::t1, "Packets of type 1.");
    gimu.def_ro("t2", &ins_gimu_t::t2, "Packets of type 2.");
    gimu.def_ro("skipped", &ins_gimu_t::skipped, "Octets that belong to no packet.");
    gimu.def_ro("count", &ins_gimu_t::count, "Octets waiting.");
    copies(gimu);
    m.def("gimu_e7", ins_gimu_e7, "coordinate"_a, "A coordinate as sent, in 1e-7 degree.");
}

void bind_scale(nb::module_& m)
{
    nb::class_<ins_gimu_scale_t> scale(m, "GimuScale", "Scale of the GIMU's sensors.");
    scale.def_static(
        "thesis",
        []
        {
            ins_gimu_scale_t self;
            ins_gimu_scale_thesis(&self);
            return self;
        },
        "The thesis's K for the gyros, the data sheet's for the accelerometers, nulls at 2047.");
    scale.def_static(
        "nominal",
        []
        {
            ins_gimu_scale_t self;
            ins_gimu_scale_nominal(&self);
            return self;
        },
        "Data-sheet values, nulls at 2047.");
    writes(scale, "null", &ins_gimu_scale_t::null, {6}, "Readings at rest [LSB], (6,); fractions matter.");
    writes(scale, "rate", &ins_gimu_scale_t::rate, {3}, "[rad/s per LSB], (3,).");
    scale.def_rw("acceleration", &ins_gimu_scale_t::acceleration, "[m/s^2 per LSB].");
    scale.def(
        "increments",
        [](const ins_gimu_scale_t& self, const Given& raw, double dt)
        {
            Call call("GimuScale.increments");
            const auto in = call.rows<uint16_t>("raw", raw, {6});
            const auto dtheta = call.out<ins_real>({3});
            const auto dv = call.out<ins_real>({3});
            call.run([&](size_t k) { ins_gimu_increments(&self, in[k], as_real(dt), dtheta[k], dv[k]); });
            return std::make_pair(dtheta, dv);
        },
        "raw"_a, "dt"_a = 1.0 / INS_GIMU_RATE_HZ,
        "Samples, uint16 (6,) or (N, 6), held for dt [s], to increments of angle [rad] and velocity [m/s], (3,) or (N, "
        "3).");
    copies(scale);
}

void bind_nmea(nb::module_& m)
{
    nb::class_<Fix> fix(m, "NmeaFix", "What one sentence said; `has` tells which figures were in it.");
    fix.def_ro("type", &Fix::type, "NMEA_GGA, NMEA_RMC or NMEA_VTG.");
    fix.def_ro("has", &Fix::has, "NMEA_TIME, NMEA_POSITION, ..., or-ed.");
    fix.def_prop_ro(
        "valid", [](const Fix& self) { return self.valid != 0; }, "The receiver says so.");
    fix.def_ro("quality", &Fix::quality, "GGA: 0 none, 1 GPS, 2 differential, 4 fixed, 5 float.");
    fix.def_ro("sats", &Fix::sats, "Satellites in use.");
    fix.def_prop_ro(
        "date", [](const Fix& self) { return std::make_tuple(self.date[0], self.date[1], self.date[2]); },
        "Day, month, year of the century.");
    fix.def_ro("time_ms", &Fix::time_ms, "Since midnight UTC.");
    fix.def_ro("lat_e7", &Fix::lat_e7, "Latitude [1e-7 deg], north positive.");
    fix.def_ro("lon_e7", &Fix::lon_e7, "Longitude [1e-7 deg], east positive.");
    fix.def_ro("altitude_mm", &Fix::altitude_mm, "Above mean sea level.");
    fix.def_ro("geoid_mm", &Fix::geoid_mm, "Mean sea level above the ellipsoid.");
    fix.def_ro("hdop_milli", &Fix::hdop_milli, "HDOP in thousandths.");
    fix.def_ro("speed_milliknot", &Fix::speed_milliknot, "Speed over ground.");
    fix.def_ro("course_mdeg", &Fix::course_mdeg, "Course from true north, clockwise [1e-3 deg].");
    nb::class_<ins_nmea_t> nmea(m, "Nmea", "Reader of GGA, RMC and VTG.");
    nmea.def("__init__",
             [](ins_nmea_t* self)
             {
                 new (self) ins_nmea_t();
                 ins_nmea_init(self);
             });
    nmea.def(
        "rx",
        [](ins_nmea_t& self, const nb::bytes& octets)
        {
            std::vector<Fix> fixes;
            for (size_t i = 0; i < octets.size(); i++)
            {
                const int type = ins_nmea_rx(&self, static_cast<ins_octet_t>(octets.c_str()[i]));
                if (type != INS_NMEA_NOTHING)
                {
                    fixes.push_back({self.fix, type});
                }
            }
            return fixes;
        },
        "octets"_a, "Octets came; the sentences that they complete.");
    nmea.def_ro("taken", &ins_nmea_t::taken, "Sentences given out.");
    nmea.def_ro("bad_checksum", &ins_nmea_t::bad_checksum, "Checksum did not agree.");
    nmea.def_ro("malformed", &ins_nmea_t::malformed, "Checksum right, but a field cannot be read.");
    nmea.def_ro("cut", &ins_nmea_t::cut, "Sentences that stopped, ran too long, or held what is no text.");
    nmea.def_ro("other", &ins_nmea_t::other, "Right, but none of the three.");
    copies(nmea);
}
} // namespace

void bind_packets(nb::module_& m)
{
#define LIBINS_CONSTANT(name) m.attr(#name) = static_cast<int>(INS_##name);
    LIBINS_CONSTANT(GIMU_T1)
    LIBINS_CONSTANT(GIMU_T2)
    LIBINS_CONSTANT(GIMU_T1_LEN)
    LIBINS_CONSTANT(GIMU_T2_LEN)
    LIBINS_CONSTANT(GIMU_RATE_HZ)
    LIBINS_CONSTANT(NMEA_GGA)
    LIBINS_CONSTANT(NMEA_RMC)
    LIBINS_CONSTANT(NMEA_VTG)
    LIBINS_CONSTANT(NMEA_TIME)
    LIBINS_CONSTANT(NMEA_POSITION)
    LIBINS_CONSTANT(NMEA_SATS)
    LIBINS_CONSTANT(NMEA_HDOP)
    LIBINS_CONSTANT(NMEA_ALTITUDE)
    LIBINS_CONSTANT(NMEA_GEOID)
    LIBINS_CONSTANT(NMEA_SPEED)
    LIBINS_CONSTANT(NMEA_COURSE)
    LIBINS_CONSTANT(NMEA_DATE)
#undef LIBINS_CONSTANT
#define LIBINS_CONSTANT(name) m.attr(#name) = static_cast<double>(INS_##name);
    LIBINS_CONSTANT(GIMU_NULL)
    LIBINS_CONSTANT(GIMU_KP)
    LIBINS_CONSTANT(GIMU_KQ)
    LIBINS_CONSTANT(GIMU_KR)
    LIBINS_CONSTANT(GIMU_K_NOMINAL)
    LIBINS_CONSTANT(GIMU_G_NOMINAL)
    LIBINS_CONSTANT(GIMU_G)
    bind_gimu(m);
    bind_scale(m);
    bind_nmea(m);
}

} // namespace libins
