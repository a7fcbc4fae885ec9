#include "services/orchestrator/records/lifecycle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace breach::orchestrator::lifecycle_test {
namespace {

/// The allowed transitions as "from --event--> to", independent of the code's table.
const std::set<std::string> task_moves{
    "blocked release ready",
    "blocked skip skipped",
    "blocked cancel cancelled",
    "ready reuse cached",
    "ready reuse_breakdown failed",
    "ready claim starting",
    "ready cancel cancelled",
    "starting start running",
    "starting exit_well finalizing",
    "starting exit_badly failed",
    "starting exit_retryable retry_wait",
    "starting interrupt ready",
    "starting vanish lost",
    "starting cancel cancelling",
    "running exit_well finalizing",
    "running exit_badly failed",
    "running exit_retryable retry_wait",
    "running interrupt ready",
    "running vanish lost",
    "running cancel cancelling",
    "finalizing keep_outputs succeeded",
    "finalizing refuse_outputs failed",
    "lost retry retry_wait",
    "lost give_up failed",
    "retry_wait wait_over ready",
    "retry_wait cancel cancelled",
    "cancelling start cancelling",
    "cancelling stopped cancelled",
    "failed redo blocked",
    "cancelled redo blocked",
    "skipped redo blocked",
};

const std::set<std::string> attempt_moves{
    "submitting submit submitted", "submitting exit exited", "submitting vanish lost",
    "submitted begin running",     "submitted exit exited",  "submitted vanish lost",
    "running exit exited",         "running vanish lost",
};

template <class State, class Event>
std::set<std::string> moves_of(std::span<const State> states, std::span<const Event> events) {
    std::set<std::string> moves;
    for (const State from : states) {
        for (const Event event : events) {
            const auto to = next(from, event);
            if (!to) continue;
            moves.insert(std::string(name_of(from)) + " " + std::string(name_of(event)) + " " +
                         std::string(name_of(*to)));
        }
    }
    return moves;
}

TEST(Lifecycle, TaskMovesAreTheseAndEveryOtherIsRefused) {
    EXPECT_EQ(moves_of(all_task_states(), all_task_events()), task_moves);
}

TEST(Lifecycle, AttemptMovesAreTheseAndEveryOtherIsRefused) {
    EXPECT_EQ(moves_of(all_attempt_states(), all_attempt_events()), attempt_moves);
}

TEST(Lifecycle, NoRuleIsGivenTwice) {
    std::map<std::pair<TaskState, TaskEvent>, int> seen;
    for (const TaskRule& rule : task_rules())
        EXPECT_EQ(++seen[std::pair(rule.from, rule.event)], 1);
}

TEST(Lifecycle, FinalStatesAreTheFiveThatEndATask) {
    std::set<std::string_view> final_states;
    for (const TaskState state : all_task_states()) {
        if (is_final(state)) final_states.insert(name_of(state));
    }
    EXPECT_EQ(final_states, (std::set<std::string_view>{"cached", "succeeded", "failed",
                                                        "cancelled", "skipped"}));
}

TEST(Lifecycle, EveryStateCanReachAFinalOne) {
    for (const TaskState start : all_task_states()) {
        std::set<TaskState> reached{start};
        for (std::size_t before = 0; before != reached.size();) {
            before = reached.size();
            for (const TaskRule& rule : task_rules()) {
                if (reached.contains(rule.from)) reached.insert(rule.to);
            }
        }
        EXPECT_TRUE(std::ranges::any_of(reached, [](TaskState state) { return is_final(state); }))
            << name_of(start);
    }
}

TEST(Lifecycle, NamesAreReadBack) {
    for (const TaskState state : all_task_states())
        EXPECT_EQ(task_state_named(name_of(state)), state);
    for (const AttemptState state : all_attempt_states())
        EXPECT_EQ(attempt_state_named(name_of(state)), state);
}

}  // namespace
}  // namespace breach::orchestrator::lifecycle_test
