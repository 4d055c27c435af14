/// \file   octet.hpp
/// \brief  What the host's end of a line received.
/// SPDX-License-Identifier: MIT
#pragma once
#include "emu/time.h"

namespace libins
{

struct Octet
{
    emu_time_t at; ///< in the stop bit
    uint8_t value;
    bool framing_ok;
};

} // namespace libins
