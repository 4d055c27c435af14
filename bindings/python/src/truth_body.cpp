/// \file   truth_body.cpp
/// \brief  Bodies driven by tables, manoeuvres and Python functions, integrated by CVODE. SPDX-License-Identifier: MIT
#include "truth_body.hpp"
#include "ins_truth/drive.h"
#include "truth_bind.hpp"
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>
#include <tuple>

namespace nb = nanobind;
using namespace nb::literals;

namespace libins
{
namespace
{

using Vector = std::array<double, 3>;
using Manoeuvre = std::tuple<std::string, double, double>; ///< name, duration [s], amount

/// What drives a body, and what must live as long.
struct Drive
{
    std::shared_ptr<const void> handle;
    ins_body_input_t input;
};

template <typename Create> Drive drive(Create create)
{
    std::array<char, 256> why{};
    ins_drive_t* const made = create(why.data(), why.size());
    if (made == nullptr)
    {
        throw std::invalid_argument(why.data());
    }
    Drive out;
    out.handle = std::shared_ptr<const void>(
        made, [](const void* gone) { ins_drive_destroy(static_cast<ins_drive_t*>(const_cast<void*>(gone))); });
    ins_drive_input(made, &out.input);
    return out;
}

Drive drive_table(const Instants& t, const Rows3& w_ib_b, const Rows3& f_b)
{
    if (w_ib_b.shape(0) != t.shape(0) || f_b.shape(0) != t.shape(0))
    {
        throw std::invalid_argument("t, w_ib_b and f_b must have the same number of rows");
    }
    return drive([&](char* why, size_t n)
                 { return ins_drive_create_table(t.shape(0), t.data(), w_ib_b.data(), f_b.data(), why, n); });
}

constexpr std::array<std::pair<const char*, ins_manoeuvre_kind_t>, 6> kinds = {
    {{"hold", INS_MANOEUVRE_HOLD},
     {"accelerate", INS_MANOEUVRE_ACCELERATE},
     {"turn", INS_MANOEUVRE_TURN},
     {"roll", INS_MANOEUVRE_ROLL},
     {"pitch", INS_MANOEUVRE_PITCH},
     {"yaw", INS_MANOEUVRE_YAW}}};

Drive drive_manoeuvres(const ins_track_site_t& site, const std::vector<Manoeuvre>& plan, double start_s, double speed)
{
    std::vector<ins_manoeuvre_t> out;
    for (const auto& [name, duration_s, amount] : plan)
    {
        out.push_back({named("manoeuvre", name, kinds), duration_s, amount});
    }
    return drive([&](char* why, size_t n)
                 { return ins_drive_create_manoeuvres(&site, out.data(), out.size(), start_s, speed, why, n); });
}

#ifdef INS_TRUTH_CVODE
/// A Python callable with what it raised; it is called with the interpreter's lock.
struct Callable
{
    nb::object function;
    std::exception_ptr raised;

    /// \return false: it raised, or gave something else.
    template <typename Result> bool call(double t, const ins_track_state_t& s, Result* result)
    {
        const nb::gil_scoped_acquire lock;
        try
        {
            *result = nb::cast<Result>(function(t, copied(s.p_n), copied(s.v_n), copied(s.q_nb)));
            return true;
        }
        catch (...)
        {
            raised = raised ? raised : std::current_exception();
            return false;
        }
    }
    ~Callable()
    {
        const nb::gil_scoped_acquire lock;
        function.reset();
    }
};

bool drive_by_callable(void* ctx, double t, const ins_track_state_t* state, double w_ib_b[3], double f_b[3])
{
    std::tuple<Vector, Vector> sensed;
    if (!static_cast<Callable*>(ctx)->call(t, *state, &sensed))
    {
        return false;
    }
    std::copy(std::get<0>(sensed).begin(), std::get<0>(sensed).end(), w_ib_b);
    std::copy(std::get<1>(sensed).begin(), std::get<1>(sensed).end(), f_b);
    return true;
}

bool event_by_callable(void* ctx, double t, const ins_track_state_t* state, double* value)
{
    return static_cast<Callable*>(ctx)->call(t, *state, value);
}

using Event = std::tuple<nb::object, int, bool>; ///< function, direction, stops

/// Owns the functions that CVODE calls back.
struct Functions
{
    Drive drive;
    std::vector<std::unique_ptr<Callable>> of;
};

Track track_body(const ins_track_site_t& site, const nb::object& by, const Vector& p_n, const Vector& v_n,
                 const std::array<double, 4>& q_nb, double start_s, double end_s, double tolerance,
                 const std::vector<Event>& events)
{
    const auto functions = std::make_shared<Functions>();
    if (!nb::try_cast(by, functions->drive))
    {
        functions->of.push_back(std::make_unique<Callable>(Callable{by, nullptr}));
        functions->drive.input = {drive_by_callable, nullptr, functions->of.back().get()};
    }
    std::vector<ins_body_event_t> wanted;
    for (const auto& [function, direction, stops] : events)
    {
        functions->of.push_back(std::make_unique<Callable>(Callable{function, nullptr}));
        wanted.push_back({event_by_callable, functions->of.back().get(), direction, stops});
    }
    ins_body_config_t c = {};
    c.site = site;
    std::copy(p_n.begin(), p_n.end(), c.p_n);
    std::copy(v_n.begin(), v_n.end(), c.v_n);
    std::copy(q_nb.begin(), q_nb.end(), c.q_nb);
    c.start_s = start_s;
    c.end_s = end_s;
    c.tolerance = tolerance;
    std::array<char, 256> why{};
    ins_track_t* const made =
        ins_track_create_body(&c, &functions->drive.input, wanted.data(), wanted.size(), why.data(), why.size());
    for (const std::unique_ptr<Callable>& each : functions->of)
    {
        if (each->raised)
        {
            ins_track_destroy(made);
            std::rethrow_exception(each->raised);
        }
    }
    if (made == nullptr)
    {
        throw std::invalid_argument(why.data());
    }
    return {{made, [functions](ins_track_t* gone) { ins_track_destroy(gone); }}};
}
#else
Track track_body(const ins_track_site_t&, const nb::object&, const Vector&, const Vector&, const std::array<double, 4>&,
                 double, double, double, const std::vector<std::tuple<nb::object, int, bool>>&)
{
    throw std::runtime_error(
        "this build has no SUNDIALS, which integrates bodies: install libsundials-dev and build again");
}
#endif

} // namespace

void bind_bodies(nb::module_& m)
{
    nb::class_<Drive>(m, "Drive", "What drives a body; see ins_truth/drive.h.");
    m.def("drive_table", drive_table, "t"_a, "w_ib_b"_a, "f_b"_a,
          "Natural cubic splines through rows of body rate [rad/s] and specific force [m/s^2].");
    m.def("drive_manoeuvres", drive_manoeuvres, "site"_a, "plan"_a, "start_s"_a, "speed"_a,
          "Rows of (hold | accelerate | turn | roll | pitch | yaw, duration [s], amount [m/s or rad]).");
    m.def("track_body", track_body, "site"_a, "drive"_a, "p_n"_a, "v_n"_a, "q_nb"_a, "start_s"_a, "end_s"_a,
          "tolerance"_a = 1e-12, "events"_a = nb::list(),
          "Integrates a body; see ins_truth/body.h. drive: a Drive, or a function of (t, p_n, v_n, q_nb) that gives "
          "(w_ib_b, f_b). "
          "events: rows of (function of the same that gives a number, direction 1, -1 or 0, whether it stops).");
    m.def(
        "happenings",
        [](const Track& track)
        {
            const ins_body_happening_t* found;
            const size_t count = ins_track_happenings(track.handle.get(), &found);
            nb::list rows;
            for (size_t k = 0; k < count; k++)
            {
                rows.append(nb::make_tuple(found[k].t, found[k].event, found[k].direction));
            }
            return rows;
        },
        "track"_a, "Of a body's events: instant [s], which, 1 rising or -1 falling.");
#ifdef INS_TRUTH_CVODE
    m.attr("SUNDIALS") = true;
#else
    m.attr("SUNDIALS") = false;
#endif
}

} // namespace libins
