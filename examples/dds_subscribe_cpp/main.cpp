// Prints navigation states that arrive over DDS, with Cyclone DDS and the installed IDL alone.   subscribe [DOMAIN [COUNT]]
// SPDX-License-Identifier: MIT
#include "libins.h" // which idlc makes of libins.idl
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <dds/dds.h>
#include <exception>
#include <stdexcept>
#include <string>

namespace
{
const char* const loopback =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo' multicast='false'/></Interfaces>"
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>60</MaxAutoParticipantIndex><Peers><Peer address='127.0.0.1'/></Peers></Discovery>"
    "</Domain></CycloneDDS>";

dds_return_t checked(dds_return_t code, const char* what)
{
    if (code < 0)
    {
        throw std::runtime_error(std::string(what) + ": " + dds_strretcode(code));
    }
    return code;
}

constexpr uint32_t position = 0x20; // bits of valid: ins_nav/navigation.h
constexpr uint32_t covariance = 0x80;

/// The place as far as the source knows it: latitude, longitude, and the larger of their standard deviations.
void print(const libins_NavState& state)
{
    const double degrees = 57.295779513082321;
    const double* const e = state.euler_rad;
    std::printf("%s %llu: roll %.6f pitch %.6f yaw %.6f rad", state.source,
                static_cast<unsigned long long>(state.index), e[0], e[1], e[2]);
    if ((state.valid & position) != 0)
    {
        std::printf(", %.7f %.7f deg", state.llh[0] * degrees, state.llh[1] * degrees);
        if ((state.valid & covariance) != 0)
        {
            std::printf(" +- %.2f m", std::sqrt(std::max(state.P[39], state.P[42])));
        }
    }
    std::printf("\n");
}

/// When it goes, all that Cyclone made in it goes too.
struct Domain
{
    explicit Domain(uint32_t id)
    {
        const char* const uri = std::getenv("CYCLONEDDS_URI");
        entity = checked(dds_create_domain(id, uri != nullptr ? uri : loopback), "domain");
    }
    ~Domain() { dds_delete(entity); }
    Domain(const Domain&) = delete;
    Domain& operator=(const Domain&) = delete;
    dds_entity_t entity;
};

dds_entity_t reader_of_states(dds_entity_t participant)
{
    const auto topic =
        checked(dds_create_topic(participant, &libins_NavState_desc, "libins/nav_state", nullptr, nullptr), "topic");
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 100);
    const auto reader = dds_create_reader(participant, topic, qos, nullptr);
    dds_delete_qos(qos);
    return checked(reader, "reader");
}

/// Prints until COUNT states came, or none does for 10 s.
void subscribe(uint32_t id, long left)
{
    const Domain domain(id);
    const auto participant = checked(dds_create_participant(id, nullptr, nullptr), "participant");
    const auto reader = reader_of_states(participant);
    const auto waitset = checked(dds_create_waitset(participant), "waitset");
    checked(dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS), "status mask");
    checked(dds_waitset_attach(waitset, reader, 0), "waitset");
    while (left != 0)
    {
        if (checked(dds_waitset_wait(waitset, nullptr, 0, DDS_SECS(10)), "wait") == 0)
        {
            throw std::runtime_error("nothing came for 10 s");
        }
        void* sample = nullptr; // Cyclone lends one
        dds_sample_info_t info;
        while (left != 0 && checked(dds_take(reader, &sample, &info, 1, 1), "take") > 0)
        {
            const auto& state = *static_cast<const libins_NavState*>(sample);
            if (info.valid_data)
            {
                print(state);
                left--;
            }
            else
            {
                std::printf("%s: its publisher has gone\n", state.source); // of what is not valid, the key is
            }
            checked(dds_return_loan(reader, &sample, 1), "loan");
        }
    }
}
} // namespace

int main(int argc, char** argv)
{
    try
    {
        subscribe(argc > 1 ? static_cast<uint32_t>(std::strtoul(argv[1], nullptr, 10)) : 0,
                  argc > 2 ? std::atol(argv[2]) : -1);
    }
    catch (const std::exception& error)
    {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
