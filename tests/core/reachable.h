/// \file   reachable.h
/// \brief  Every state that a machine can reach from its beginning, each with every octet and event.
///
/// Breadth first. States that differ only in what decides nothing later are one, found by a key; the first that is met stands for
/// it. From every state each of 256 octets, time and the caller's other moves: the result is sound (tests/proof/sound.h), and the
/// next good block gets through. The search ends when no new key comes, so no depth bounds it.
/// SPDX-License-Identifier: MIT
#ifndef INS_TESTS_REACHABLE_H
#define INS_TESTS_REACHABLE_H
#include "core_test.h"
#include "sound.h"
#include <deque>
#include <set>

namespace core_test
{
constexpr int OCTETS = 256;
using Key = std::vector<unsigned>;

/// `move(state, n)`: octet n, or from 256 on another event, `moves` in all.
template <class S> struct Search
{
    int moves;
    std::function<void(S&, int)> move;
    std::function<Key(const S&)> key;
    std::function<bool(const S&)> sound;
    std::function<bool(S)> recovers;
    std::function<bool(const S&)> follow = [](const S&) { return true; };

    std::set<Key> from(const S& start) const
    {
        std::set<Key> seen = {key(start)};
        std::deque<S> todo = {start};
        long checked = 0;
        while (!todo.empty())
        {
            const S state = todo.front();
            todo.pop_front();
            for (int n = 0; n < moves; n++, checked++)
            {
                S after = state;
                move(after, n);
                const Key k = key(after);
                if (!sound(after) || !recovers(after))
                {
                    ADD_FAILURE() << (sound(after) ? "no good block gets through" : "not sound") << " after "
                                  << (n < OCTETS ? "octet " : "event ") << n << " in state "
                                  << testing::PrintToString(key(state));
                    return seen;
                }
                if (seen.insert(k).second && follow(after))
                {
                    todo.push_back(after);
                }
            }
        }
        std::printf("[ figure   ] %zu states, %ld with an octet or event\n", seen.size(), checked);
        return seen;
    }
};

inline ins_octet_t octet_of(int n)
{
    return static_cast<ins_octet_t>(n);
}

/// The values of one element of the keys.
inline std::set<unsigned> column(const std::set<Key>& keys, size_t at)
{
    std::set<unsigned> values;
    for (const Key& k : keys)
    {
        values.insert(k[at]);
    }
    return values;
}

inline std::set<unsigned> up_to(unsigned last)
{
    std::set<unsigned> values;
    for (unsigned v = 0; v <= last; v++)
    {
        values.insert(v);
    }
    return values;
}
} // namespace core_test

#endif // INS_TESTS_REACHABLE_H
