/// The event queue.
/// SPDX-License-Identifier: MIT
#include "emu/sched.h"
#include <gtest/gtest.h>
#include <vector>

namespace
{
struct log_t
{
    emu_sched_t sched;
    std::vector<std::pair<int, emu_time_t>> fired;
};

struct event_t
{
    event_t(log_t& log_, int id_) : log(&log_), id(id_) { e = {fire, this, 0, false, nullptr, 0}; }
    static void fire(void* ctx, emu_time_t at)
    {
        auto* self = static_cast<event_t*>(ctx);
        EXPECT_EQ(self->log->sched.now, at);
        self->log->fired.emplace_back(self->id, at);
        if (self->again > 0)
        {
            emu_sched_at(&self->log->sched, &self->e, at + self->again);
        }
    }
    log_t* log;
    int id;
    emu_time_t again = 0;
    emu_event_t e;
};

using fired_t = std::vector<std::pair<int, emu_time_t>>;

class sched : public testing::Test
{
  protected:
    void SetUp() override { emu_sched_init(&log.sched); }
    log_t log;
    event_t a{log, 1}, b{log, 2}, c{log, 3};
};

TEST_F(sched, fires_in_order_and_equal_times_in_the_order_they_were_set)
{
    emu_sched_at(&log.sched, &b.e, 20);
    emu_sched_at(&log.sched, &c.e, 10);
    emu_sched_at(&log.sched, &a.e, 20);
    EXPECT_EQ(emu_sched_next(&log.sched), 10);
    emu_sched_advance(&log.sched, 19);
    EXPECT_EQ(log.fired, (fired_t{{3, 10}}));
    EXPECT_EQ(log.sched.now, 19);
    emu_sched_advance(&log.sched, 20);
    EXPECT_EQ(log.fired, (fired_t{{3, 10}, {2, 20}, {1, 20}}));
    EXPECT_EQ(emu_sched_next(&log.sched), EMU_TIME_MAX);
}

TEST_F(sched, what_comes_from_outside_fires_before_all_else_of_its_instant)
{
    emu_sched_at(&log.sched, &a.e, 20);
    emu_sched_first(&log.sched, &b.e, 20);
    emu_sched_first(&log.sched, &c.e, 20);
    emu_sched_advance(&log.sched, 20);
    EXPECT_EQ(log.fired, (fired_t{{2, 20}, {3, 20}, {1, 20}}));
}

TEST_F(sched, moves_and_cancels)
{
    emu_sched_at(&log.sched, &a.e, 10);
    emu_sched_at(&log.sched, &b.e, 20);
    emu_sched_at(&log.sched, &c.e, 30);
    emu_sched_at(&log.sched, &a.e, 25);
    emu_sched_cancel(&log.sched, &b.e);
    emu_sched_cancel(&log.sched, &b.e);
    emu_sched_advance(&log.sched, 100);
    EXPECT_EQ(log.fired, (fired_t{{1, 25}, {3, 30}}));
    EXPECT_FALSE(a.e.pending || b.e.pending || c.e.pending);
}

TEST_F(sched, an_event_may_set_itself_again_and_the_past_means_now)
{
    a.again = 40;
    emu_sched_at(&log.sched, &a.e, 30);
    emu_sched_advance(&log.sched, 110);
    EXPECT_EQ(log.fired, (fired_t{{1, 30}, {1, 70}, {1, 110}}));
    emu_sched_at(&log.sched, &b.e, 5);
    EXPECT_EQ(b.e.at, 110);
    emu_sched_advance(&log.sched, 1);
    EXPECT_EQ(log.sched.now, 110) << "time never goes back";
}

TEST_F(sched, tells_the_executor_only_when_the_earliest_event_became_earlier)
{
    std::vector<emu_time_t> told;
    log.sched.earlier = [](void* ctx, emu_time_t at) { static_cast<std::vector<emu_time_t>*>(ctx)->push_back(at); };
    log.sched.earlier_ctx = &told;
    emu_sched_at(&log.sched, &a.e, 30);
    emu_sched_at(&log.sched, &b.e, 30);
    emu_sched_at(&log.sched, &c.e, 40);
    emu_sched_at(&log.sched, &c.e, 20);
    EXPECT_EQ(told, (std::vector<emu_time_t>{30, 20}));
}
} // namespace
