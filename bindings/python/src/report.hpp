/// \file   report.hpp
/// \brief  What an emulator reported, equal ones counted.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/report.h"
#include <string>
#include <vector>

namespace libins
{

struct Report
{
    emu_report_kind_t kind;
    std::string text;
    uint32_t detail;
    emu_time_t first;
    uint64_t count;
};

inline void add_report(std::vector<Report>& reports, emu_report_kind_t kind, const char* text, uint32_t detail,
                       emu_time_t at)
{
    for (Report& report : reports)
    {
        if (report.kind == kind && report.detail == detail && report.text == text)
        {
            report.count++;
            return;
        }
    }
    reports.push_back({kind, text, detail, at, 1});
}

} // namespace libins
