/// \file   front_end.cpp
/// \brief  See front_end.hpp. SPDX-License-Identifier: MIT
#include "front_end.hpp"
#include <array>
#include <stdexcept>

namespace libins
{

#ifdef INS_TRUTH_CVODE
void FrontEnd::open(const ins_front_end_config_t& config)
{
    std::array<char, 256> why{};
    ins_front_end_t* const made = ins_front_end_create(&config, why.data(), why.size());
    if (made == nullptr)
    {
        throw std::invalid_argument(why.data());
    }
    handle_ = {made, ins_front_end_destroy};
    channels_ = config.channels;
    rail_low_v_ = config.channel[0].rail_low_v;
}

double FrontEnd::volts(unsigned channel, int64_t t_ps)
{
    return channel < channels_ ? ins_front_end_volts(handle_.get(), channel, t_ps) : rail_low_v_;
}

void FrontEnd::state(emu_state_t* io)
{
    for (unsigned channel = 0; channel < channels_; channel++)
    {
        ins_front_end_state_t state;
        ins_front_end_get(handle_.get(), channel, &state);
        emu_state_i64(io, &state.t_ps);
        for (double& x : state.x)
        {
            emu_state_f64(io, &x);
        }
        ins_front_end_set(handle_.get(), channel, &state);
    }
}
#else
void FrontEnd::open(const ins_front_end_config_t&)
{
    throw std::invalid_argument(
        "this build has no SUNDIALS, which a front end needs: install libsundials-dev and build again");
}

double FrontEnd::volts(unsigned, int64_t)
{
    return rail_low_v_;
}

void FrontEnd::state(emu_state_t*) {}
#endif

} // namespace libins
