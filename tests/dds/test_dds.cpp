// libins_dds: round trips within and between processes, what is left behind, and each refusal with its text. Loopback only.
// SPDX-License-Identifier: MIT
#include "ins_dds/dds.h"
#include "process.hpp"
#include <cstring>
#include <dirent.h>
#include <gtest/gtest.h>

namespace
{
const double limit_s = 20;

/// Test programs that run at once must not meet.
uint32_t domain(uint32_t n = 0)
{
    return 100 + (static_cast<uint32_t>(getpid()) + n) % 100;
}

struct Close
{
    void operator()(ins_dds_t* dds) const { ins_dds_close(dds); }
};
using Handle = std::unique_ptr<ins_dds_t, Close>;

ins_dds_config_t config(int publishes, int subscribes)
{
    ins_dds_config_t cfg;
    ins_dds_config_default(&cfg);
    cfg.domain = domain();
    cfg.publishes = publishes;
    cfg.subscribes = subscribes;
    cfg.topic[INS_DDS_STATE].qos.history = 1000;
    return cfg;
}

Handle open(const ins_dds_config_t& cfg)
{
    ins_dds_t* dds = nullptr;
    EXPECT_EQ(ins_dds_open(&cfg, &dds), INS_DDS_OK) << ins_dds_error_text();
    return Handle(dds);
}

/// A refusal, and the words that its text must hold.
void expect_refused(const ins_dds_config_t& cfg, int status, const std::vector<std::string>& words)
{
    auto* dds = reinterpret_cast<ins_dds_t*>(1);
    EXPECT_EQ(ins_dds_open(&cfg, &dds), status) << ins_dds_error_text();
    EXPECT_EQ(dds, nullptr);
    for (const auto& word : words)
    {
        EXPECT_NE(std::string(ins_dds_error_text()).find(word), std::string::npos) << ins_dds_error_text();
    }
}

/// Every field its own value.
ins_nav_state_t state_of(uint64_t n)
{
    ins_nav_state_t s;
    std::memset(&s, 0, sizeof s);
    const auto x = static_cast<double>(n);
    s.index = n;
    s.t_s = 0.1 * x;
    for (int i = 0; i < 4; i++)
    {
        s.q_nb[i] = x + 0.1 * (i + 1);
    }
    for (int i = 0; i < 3; i++)
    {
        s.euler_rad[i] = x + 1.1 * (i + 1);
        s.w_ib_b[i] = x + 2.1 * (i + 1);
        s.dtheta_b[i] = x + 3.1 * (i + 1);
    }
    s.seq = 11;
    s.bridged = 12;
    s.status = 13;
    s.used = 14 + (uint64_t{1} << 40);
    s.missed = 15;
    s.counts = {16, 17, 18, 19, 20, 21, 22};
    return s;
}

size_t entries(const char* directory)
{
    size_t count = 0;
    DIR* d = opendir(directory);
    while (readdir(d) != nullptr)
    {
        count++;
    }
    closedir(d);
    return count;
}

/// Takes until `count` samples are there.
std::vector<ins_dds_sample_t> take(ins_dds_t* dds, size_t count)
{
    std::vector<ins_dds_sample_t> all;
    for (const double end = seconds_now() + limit_s; all.size() < count && seconds_now() < end;)
    {
        ins_dds_sample_t some[7];
        const int got = ins_dds_take(dds, 0.5, some, 7);
        EXPECT_GE(got, 0) << ins_dds_error_text();
        all.insert(all.end(), some, some + std::max(got, 0));
    }
    EXPECT_EQ(all.size(), count);
    return all;
}

TEST(Dds, CarriesEveryFieldWithinAProcess)
{
    const Handle dds = open(config(1, 1));
    EXPECT_EQ(ins_dds_matched(dds.get()), 2);
    const uint64_t count = 40;
    for (uint64_t n = 0; n < count; n++)
    {
        const auto state = state_of(n);
        ASSERT_EQ(ins_dds_publish(dds.get(), &state, "unit A", static_cast<int64_t>(1000 + n)), INS_DDS_OK);
    }
    const auto got = take(dds.get(), count);
    for (uint64_t n = 0; n < got.size(); n++)
    {
        const auto want = state_of(n);
        EXPECT_STREQ(got[n].source, "unit A");
        EXPECT_EQ(got[n].published_ns, static_cast<int64_t>(1000 + n));
        EXPECT_EQ(got[n].valid, 1);
        EXPECT_EQ(got[n].gone, 0);
        EXPECT_EQ(std::memcmp(&got[n].state, &want, sizeof want), 0) << n;
    }
    ins_dds_sample_t none;
    const double begin = seconds_now();
    EXPECT_EQ(ins_dds_take(dds.get(), 0.2, &none, 1), 0);
    EXPECT_NEAR(seconds_now() - begin, 0.2, 0.15) << "waits, and no longer than told";
}

TEST(Dds, CarriesSolutionsWithEveryField)
{
    ins_dds_config_t cfg = config(1, 1);
    ins_dds_config_carry(&cfg, INS_DDS_SOLUTION);
    const Handle dds = open(cfg);
    ins_nav_solution_t want;
    std::memset(&want, 0, sizeof want);
    double* const reals[] = {
        want.q_nb,          want.q_nb + 1,   want.q_nb + 2, want.q_nb + 3,    want.euler_rad,       want.euler_rad + 1,
        want.euler_rad + 2, want.en_m,       want.en_m + 1, want.lat_lon_rad, want.lat_lon_rad + 1, want.v_en_m_s,
        want.v_en_m_s + 1,  &want.fix_age_s, &want.t_s};
    for (size_t i = 0; i < std::size(reals); i++)
    {
        *reals[i] = 0.1 * static_cast<double>(i + 1);
    }
    want.index = uint64_t{1} << 40;
    want.sats = 9;
    want.zone = 119;
    want.seq = 200;
    want.lost = 3;
    want.status = INS_NAV_BLOCK_STATUS_ALL | INS_NAV_RESTARTED;
    want.counts = {16, 17, 18, 19, 20, 21, 22};
    ASSERT_EQ(ins_dds_publish_solution(dds.get(), &want, "dsp", 77), INS_DDS_OK) << ins_dds_error_text();
    const auto got = take(dds.get(), 1);
    ASSERT_EQ(got.size(), 1u);
    EXPECT_STREQ(got[0].source, "dsp");
    EXPECT_EQ(got[0].published_ns, 77);
    EXPECT_EQ(std::memcmp(&got[0].solution, &want, sizeof want), 0);
    const ins_dds_status_t status{};
    EXPECT_EQ(ins_dds_publish_status(dds.get(), &status, "dsp", 0), INS_DDS_E_ARGUMENT);
    EXPECT_NE(std::string(ins_dds_error_text()).find("not opened to publish libins/status"), std::string::npos);
}

TEST(Dds, DaemonPublishesTheSolutionsItPrints)
{
    const size_t count = 100;
    ins_dds_config_t cfg = config(0, 1);
    ins_dds_config_carry(&cfg, INS_DDS_SOLUTION);
    cfg.topic[INS_DDS_STATE].name = nullptr;
    const Handle dds = open(cfg);
    Pty pty;
    Process navd({INS_NAVD, "--input", "nav", "--device", pty.path, "--dds=" + std::to_string(domain()), "--json", "-",
                  "--source", "dsp", "--limit", std::to_string(count), "--queue", "100000"});
    for (const double end = seconds_now() + limit_s; ins_dds_matched(dds.get()) < 1 && seconds_now() < end;)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    Board board(pty.fd, 0, 1000000, nav_block);
    std::map<uint64_t, ins_dds_sample_t> got;
    bool gone = false;
    for (const double end = seconds_now() + limit_s; !gone && seconds_now() < end;)
    {
        ins_dds_sample_t s;
        if (ins_dds_take(dds.get(), 0.1, &s, 1) == 1)
        {
            EXPECT_STREQ(s.source, "dsp");
            gone = s.gone != 0;
            if (s.valid)
            {
                got[s.solution.index] = s;
            }
        }
        (void)navd.read_until([] { return false; }, 0.001);
    }
    EXPECT_EQ(navd.finish(limit_s), 0) << navd.err;
    const auto lines = navd.states();
    ASSERT_EQ(lines.size(), count);
    ASSERT_GT(got.size(), 0u);
    for (const auto& [index, s] : got)
    {
        char line[INS_NAV_JSON_MAX];
        ASSERT_GT(ins_nav_solution_json(&s.solution, line, sizeof line), 0u);
        ASSERT_EQ(nlohmann::json::parse(line), lines[index]);
    }
}

TEST(Dds, KeepsTheNewestOfEachSourceWhenTheReaderIsSlow)
{
    ins_dds_config_t cfg = config(1, 1);
    cfg.topic[INS_DDS_STATE].qos.history = 3;
    const Handle dds = open(cfg);
    for (uint64_t n = 0; n < 50; n++)
    {
        const auto state = state_of(n);
        ASSERT_EQ(ins_dds_publish(dds.get(), &state, n % 2 != 0 ? "odd" : "even", 0), INS_DDS_OK);
    }
    std::map<std::string, std::vector<uint64_t>> got;
    for (const auto& s : take(dds.get(), 6))
    {
        got[s.source].push_back(s.state.index);
    }
    EXPECT_EQ(got["odd"], (std::vector<uint64_t>{45, 47, 49}));
    EXPECT_EQ(got["even"], (std::vector<uint64_t>{44, 46, 48}));
}

TEST(Dds, LeavesNothingBehind)
{
    {
        const Handle once = open(config(1, 1)); // what Cyclone and the C library keep for the process
    }
    const size_t threads = entries("/proc/self/task");
    const size_t files = entries("/proc/self/fd");
    for (int i = 0; i < 5; i++)
    {
        const Handle dds = open(config(1, 1));
        EXPECT_GT(entries("/proc/self/task"), threads);
    }
    EXPECT_EQ(entries("/proc/self/task"), threads);
    EXPECT_EQ(entries("/proc/self/fd"), files);
    ins_dds_config_t bad = config(1, 0);
    bad.topic[INS_DDS_STATE].name = "no good";
    expect_refused(bad, INS_DDS_E_DDS, {"topic", "letters, digits"});
    EXPECT_EQ(entries("/proc/self/task"), threads) << "nor does a refused one";
    EXPECT_EQ(entries("/proc/self/fd"), files);
}

TEST(Dds, CarriesStatesBetweenProcessesAndTellsWhenTheWriterIsGone)
{
    const size_t count = 500;
    const Handle dds = open(config(0, 1));
    Process publisher({DDS_PUBLISHER, std::to_string(domain()), "other process", std::to_string(count)});
    const auto got = take(dds.get(), count);
    for (size_t n = 0; n < got.size(); n++)
    {
        ASSERT_EQ(got[n].state.index, n);
        ASSERT_EQ(got[n].state.q_nb[0], 1.0 / static_cast<double>(n + 1));
        ASSERT_STREQ(got[n].source, "other process");
    }
    publisher.close_in();
    EXPECT_EQ(publisher.finish(limit_s), 0) << publisher.err;
    const auto last = take(dds.get(), 1);
    ASSERT_EQ(last.size(), 1u);
    EXPECT_EQ(last[0].gone, 1);
    EXPECT_EQ(last[0].valid, 0);
    EXPECT_STREQ(last[0].source, "other process");
}

TEST(Dds, AKilledWriterIsGoneAfterItsLease)
{
    const Handle dds = open(config(0, 1));
    Process publisher({DDS_PUBLISHER, std::to_string(domain()), "short-lived", "1"});
    (void)take(dds.get(), 1);
    publisher.signal(SIGKILL);
    const double begin = seconds_now();
    const auto last = take(dds.get(), 1);
    ASSERT_EQ(last.size(), 1u);
    EXPECT_EQ(last[0].gone, 1);
    EXPECT_LT(seconds_now() - begin, 3.0) << "the lease is 1 s; a participant's would be 10 s";
}

TEST(Dds, DaemonPublishesWhatItPrints)
{
    const size_t count = 600;
    const size_t at_least = 100; // the writer may find the reader later than the reader found it
    const Handle dds = open(config(0, 1));
    Pty pty;
    Process navd({INS_NAVD, "--device", pty.path, "--dds=" + std::to_string(domain()), "--json", "-", "--source",
                  "imu7", "--limit", std::to_string(count), "--queue", "100000"});
    for (const double end = seconds_now() + limit_s; ins_dds_matched(dds.get()) < 1 && seconds_now() < end;)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    Board board(pty.fd, 0, 1000000);
    std::map<uint64_t, ins_dds_sample_t> got;
    bool gone = false;
    bool drained = false;
    for (const double end = seconds_now() + limit_s; !(gone && drained) && seconds_now() < end;)
    {
        ins_dds_sample_t s;
        drained = ins_dds_take(dds.get(), 0.1, &s, 1) == 0;
        if (!drained)
        {
            EXPECT_STREQ(s.source, "imu7");
            gone = s.gone != 0;
        }
        if (!drained && s.valid)
        {
            got[s.state.index] = s;
        }
        (void)navd.read_until([] { return false; }, 0.001);
    }
    EXPECT_EQ(navd.finish(limit_s), 0) << navd.err;
    EXPECT_TRUE(gone);
    const auto states = navd.states();
    ASSERT_EQ(states.size(), count);
    EXPECT_EQ(navd.events("summary")[0]["published"], count);
    ASSERT_GE(got.size(), at_least);
    EXPECT_EQ(got.size(), count - got.begin()->first) << "from the first on, none is lost";
    for (const auto& [index, s] : got)
    {
        char line[INS_NAV_JSON_MAX];
        ASSERT_GT(ins_nav_state_json(&s.state, line, sizeof line), 0u);
        ASSERT_EQ(nlohmann::json::parse(line), states[index]);
        EXPECT_GT(s.published_ns, int64_t{1600000000} * 1000000000);
    }
}

TEST(Dds, DomainTakenIsToldAndCanBeJoined)
{
    ins_dds_config_t cfg = config(1, 0);
    ins_dds_config_t join = config(0, 1);
    join.network = INS_DDS_JOIN;
    expect_refused(join, INS_DDS_E_DOMAIN, {"no DDS domain " + std::to_string(cfg.domain) + " to join"});
    const Handle owner = open(cfg);
    expect_refused(cfg, INS_DDS_E_DOMAIN, {"already has DDS domain " + std::to_string(cfg.domain), "INS_DDS_JOIN"});
    {
        const Handle guest = open(join);
        const auto state = state_of(5);
        ASSERT_EQ(ins_dds_publish(owner.get(), &state, "x", 0), INS_DDS_OK);
        EXPECT_EQ(take(guest.get(), 1).size(), 1u);
    }
    const auto state = state_of(6);
    EXPECT_EQ(ins_dds_publish(owner.get(), &state, "x", 0), INS_DDS_OK) << "the guest left the domain alone";
}

TEST(Dds, SamplesReadAfterTheirWriterLeftSayThatItIsGone)
{
    const Handle reader = open(config(0, 1));
    ins_dds_config_t join = config(1, 0);
    join.network = INS_DDS_JOIN;
    Handle writer = open(join);
    for (uint64_t n = 0; n < 3; n++)
    {
        const auto state = state_of(n);
        ASSERT_EQ(ins_dds_publish(writer.get(), &state, "x", 0), INS_DDS_OK);
    }
    writer.reset();
    const auto got = take(reader.get(), 3);
    ASSERT_EQ(got.size(), 3u);
    for (uint64_t n = 0; n < 3; n++)
    {
        EXPECT_EQ(got[n].valid, 1);
        EXPECT_EQ(got[n].gone, 1);
        EXPECT_EQ(got[n].state.index, n);
    }
}

TEST(Dds, PartitionsAreApart)
{
    ins_dds_config_t cfg = config(1, 0);
    cfg.partition = "left";
    const Handle writer = open(cfg);
    ins_dds_config_t same = config(0, 1);
    same.network = INS_DDS_JOIN;
    same.partition = "left";
    ins_dds_config_t other = same;
    other.partition = "right";
    const Handle left = open(same);
    const Handle right = open(other);
    const auto state = state_of(1);
    ASSERT_EQ(ins_dds_publish(writer.get(), &state, "x", 0), INS_DDS_OK);
    EXPECT_EQ(take(left.get(), 1).size(), 1u);
    ins_dds_sample_t none;
    EXPECT_EQ(ins_dds_take(right.get(), 0.3, &none, 1), 0);
}

TEST(Dds, RefusesBadConfigurationsWithAReason)
{
    const auto with = [](auto change)
    {
        ins_dds_config_t cfg = config(1, 1);
        change(cfg);
        return cfg;
    };
    const auto xml = [&](const char* text)
    {
        return with(
            [&](auto& c)
            {
                c.network = INS_DDS_XML;
                c.xml = text;
            });
    };
    expect_refused(with([](auto& c) { c.domain = 231; }), INS_DDS_E_ARGUMENT, {"231", "0 to 230"});
    expect_refused(with([](auto& c) { c.network = 9; }), INS_DDS_E_ARGUMENT, {"9"});
    expect_refused(with([](auto& c) { c.publishes = c.subscribes = 0; }), INS_DDS_E_ARGUMENT, {"neither"});
    expect_refused(with([](auto& c) { c.topic[INS_DDS_STATE].name = ""; }), INS_DDS_E_ARGUMENT,
                   {"topic name is empty", "libins/nav_state"});
    expect_refused(with([](auto& c) { c.topic[INS_DDS_STATE].qos.deadline_s = std::nan(""); }), INS_DDS_E_ARGUMENT,
                   {"deadline"});
    expect_refused(with([](auto& c) { c.lease_s = 0; }), INS_DDS_E_ARGUMENT, {"lease"});
    expect_refused(with([](auto& c) { c.topic[INS_DDS_STATE].qos.history = 0; }), INS_DDS_E_ARGUMENT, {"history"});
    expect_refused(xml(nullptr), INS_DDS_E_ARGUMENT, {"XML"});
    expect_refused(xml("file.xml"), INS_DDS_E_ARGUMENT, {"XML"});
    expect_refused(xml("<CycloneDDS><Oops"), INS_DDS_E_ARGUMENT, {"refused its configuration", "Oops"});
    expect_refused(xml("<CycloneDDS><Oops/></CycloneDDS>"), INS_DDS_E_ARGUMENT, {"Oops: unknown element"});
    expect_refused(xml("<CycloneDDS><Domain><General><Interfaces><NetworkInterface "
                       "name=\"nope0\"/></Interfaces></General></Domain>"
                       "</CycloneDDS>"),
                   INS_DDS_E_NETWORK, {"nope0", "name one of this machine"});
    unsetenv("CYCLONEDDS_URI");
    const auto environment = with([](auto& c) { c.network = INS_DDS_ENVIRONMENT; });
    expect_refused(environment, INS_DDS_E_ARGUMENT, {"CYCLONEDDS_URI", "not set"});
    setenv("CYCLONEDDS_URI", "<CycloneDDS><Wrong/></CycloneDDS>", 1);
    expect_refused(environment, INS_DDS_E_ARGUMENT, {"Wrong: unknown element"});
    EXPECT_NE(open(config(1, 0)), nullptr) << "the loopback configuration does not look at the environment";
    unsetenv("CYCLONEDDS_URI");
}

TEST(Dds, RefusesWrongUseOfAHandle)
{
    const Handle writer = open(config(1, 0));
    ins_dds_config_t join = config(0, 1);
    join.network = INS_DDS_JOIN;
    const Handle reader = open(join);
    const auto state = state_of(1);
    ins_dds_sample_t sample;
    const auto text_has = [](const char* word) { return std::strstr(ins_dds_error_text(), word) != nullptr; };
    EXPECT_EQ(ins_dds_publish(reader.get(), &state, "x", 0), INS_DDS_E_ARGUMENT);
    EXPECT_TRUE(text_has("not opened to publish"));
    EXPECT_EQ(ins_dds_take(writer.get(), 0, &sample, 1), INS_DDS_E_ARGUMENT);
    EXPECT_TRUE(text_has("not opened to subscribe"));
    EXPECT_EQ(ins_dds_publish(writer.get(), &state, "", 0), INS_DDS_E_ARGUMENT);
    EXPECT_EQ(ins_dds_publish(writer.get(), &state, std::string(64, 's').c_str(), 0), INS_DDS_E_ARGUMENT);
    EXPECT_TRUE(text_has("1 to 63 octets, this one 64"));
    EXPECT_EQ(ins_dds_publish(writer.get(), &state, std::string(63, 's').c_str(), 0), INS_DDS_OK);
    EXPECT_EQ(take(reader.get(), 1)[0].source, std::string(63, 's'));
    EXPECT_EQ(ins_dds_take(reader.get(), std::nan(""), &sample, 1), INS_DDS_E_ARGUMENT);
    EXPECT_EQ(ins_dds_take(reader.get(), 0, &sample, 0), INS_DDS_E_ARGUMENT);
    ins_dds_close(nullptr);
}

TEST(Dds, SaysSoWithoutANetworkInterface)
{
    Process probe({"unshare", "-rn", "true"});
    ASSERT_EQ(probe.finish(limit_s), 0)
        << "this test needs a network namespace of its own: run it as root, or allow user "
           "namespaces (sysctl user.max_user_namespaces): "
        << probe.err;
    Process p({"unshare", "-rn", DDS_PUBLISHER, std::to_string(domain()), "x", "1"});
    EXPECT_EQ(p.finish(limit_s), 3) << p.err;
    EXPECT_NE(p.err.find("no network interface that DDS can use"), std::string::npos) << p.err;
    EXPECT_NE(p.err.find("ip link set lo up"), std::string::npos) << p.err;
    Pty pty;
    Process navd({"unshare", "-rn", INS_NAVD, "--device", pty.path, "--dds"});
    EXPECT_EQ(navd.finish(limit_s), 2) << navd.err;
    EXPECT_NE(navd.err.find("no network interface that DDS can use"), std::string::npos) << navd.err;
}

TEST(Dds, ItsLogReachesTheCaller)
{
    std::string text;
    ins_dds_config_t cfg = config(1, 0);
    cfg.network = INS_DDS_XML;
    // Deprecated in Cyclone 0.10, which it says in a warning.
    cfg.xml = "<CycloneDDS><Domain><General><NetworkInterfaceAddress>lo</"
              "NetworkInterfaceAddress><AllowMulticast>false</AllowMulticast>"
              "</General></Domain></CycloneDDS>";
    cfg.log = [](void* context, const char* line) { *static_cast<std::string*>(context) += line; };
    cfg.log_context = &text;
    const Handle dds = open(cfg);
    EXPECT_NE(text.find("NetworkInterfaceAddress"), std::string::npos) << text;
}
} // namespace
