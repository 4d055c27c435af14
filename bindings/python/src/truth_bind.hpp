/// \file   truth_bind.hpp
/// \brief  Motions, trajectories and GPS receivers for Python, in each module that has them. SPDX-License-Identifier: MIT
#pragma once
#include "ins_truth/gps.h"
#include "ins_truth/track.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace libins
{

struct Motion
{
    std::shared_ptr<ins_motion_t> handle;
};

/// With the attitude that it looks at.
struct Track
{
    std::shared_ptr<ins_track_t> handle;
};

/// The value whose name it is. Throws std::invalid_argument.
template <typename T, size_t n>
T named(const char* key, const std::string& name, const std::array<std::pair<const char*, T>, n>& names)
{
    std::string all;
    for (const auto& [known, value] : names)
    {
        if (name == known)
        {
            return value;
        }
        all += (all.empty() ? "" : " or ") + std::string(known);
    }
    throw std::invalid_argument(std::string(key) + ": found '" + name + "', but " + all + " is needed");
}

template <typename T, size_t n> const char* name_of(T value, const std::array<std::pair<const char*, T>, n>& names)
{
    for (const auto& [name, known] : names)
    {
        if (value == known)
        {
            return name;
        }
    }
    return "";
}

inline double seconds(int64_t ps)
{
    return static_cast<double>(ps) * 1e-12;
}

inline int64_t picoseconds(const char* key, double s)
{
    if (!(s >= 0.0 && s <= 1e6))
    {
        throw std::invalid_argument(std::string(key) + ": 0 to 1e6 s is needed");
    }
    return static_cast<int64_t>(std::floor(s * 1e12 + 0.5));
}

template <size_t n> std::array<double, n> copied(const double (&values)[n])
{
    std::array<double, n> out{};
    std::copy(values, values + n, out.begin());
    return out;
}

using Instants = nanobind::ndarray<const double, nanobind::ndim<1>, nanobind::c_contig, nanobind::device::cpu>;
using Rows3 = nanobind::ndarray<const double, nanobind::shape<-1, 3>, nanobind::c_contig, nanobind::device::cpu>;

/// Rows x columns, owned by the array.
inline nanobind::ndarray<nanobind::numpy, double, nanobind::ndim<2>> table(size_t rows, size_t columns,
                                                                           std::vector<double>&& values)
{
    auto* kept = new std::vector<double>(std::move(values));
    const nanobind::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<double>*>(p); });
    return {kept->data(), {rows, columns}, owner};
}

/// Adds Motion and its constructors.
void bind_motions(nanobind::module_& m);
/// Adds Site, Track and its constructors. After Motion.
void bind_tracks(nanobind::module_& m);
/// Adds Gps, the configuration of a receiver.
void bind_gps(nanobind::module_& m);

} // namespace libins
