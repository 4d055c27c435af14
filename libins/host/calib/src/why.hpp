/// \file   why.hpp
/// \brief  Refusals in words. SPDX-License-Identifier: MIT
#ifndef INS_CALIB_WHY_HPP_INCLUDED
#define INS_CALIB_WHY_HPP_INCLUDED
#include <cstdio>
#include <string>

namespace ins_calib
{
/// Where a caller wants the reason.
struct Why
{
    char* text;
    size_t size;

    /// Returns the status, so that a refusal is one line.
    int say(int status, const std::string& reason) const
    {
        if (text != nullptr && size > 0)
        {
            std::snprintf(text, size, "%s", reason.c_str());
        }
        return status;
    }
};

/// A number as a person writes it.
inline std::string number(double x)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", x);
    return text;
}
} // namespace ins_calib
#endif // INS_CALIB_WHY_HPP_INCLUDED
