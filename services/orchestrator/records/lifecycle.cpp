#include "services/orchestrator/records/lifecycle.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace breach::orchestrator {

namespace {

using T = TaskState;
using E = TaskEvent;
using A = AttemptState;
using B = AttemptEvent;

// An exit record can be found in `starting` too: the service died before it noted the start.
constexpr std::array task_table{
    TaskRule{T::blocked, E::release, T::ready},
    TaskRule{T::blocked, E::skip, T::skipped},
    TaskRule{T::blocked, E::cancel, T::cancelled},

    TaskRule{T::ready, E::reuse, T::cached},
    TaskRule{T::ready, E::reuse_breakdown, T::failed},
    TaskRule{T::ready, E::claim, T::starting},
    TaskRule{T::ready, E::cancel, T::cancelled},

    TaskRule{T::starting, E::start, T::running},
    TaskRule{T::starting, E::exit_well, T::finalizing},
    TaskRule{T::starting, E::exit_badly, T::failed},
    TaskRule{T::starting, E::exit_retryable, T::retry_wait},
    TaskRule{T::starting, E::interrupt, T::ready},
    TaskRule{T::starting, E::vanish, T::lost},
    TaskRule{T::starting, E::cancel, T::cancelling},

    TaskRule{T::running, E::exit_well, T::finalizing},
    TaskRule{T::running, E::exit_badly, T::failed},
    TaskRule{T::running, E::exit_retryable, T::retry_wait},
    TaskRule{T::running, E::interrupt, T::ready},
    TaskRule{T::running, E::vanish, T::lost},
    TaskRule{T::running, E::cancel, T::cancelling},

    TaskRule{T::finalizing, E::keep_outputs, T::succeeded},
    TaskRule{T::finalizing, E::refuse_outputs, T::failed},

    TaskRule{T::lost, E::retry, T::retry_wait},
    TaskRule{T::lost, E::give_up, T::failed},

    TaskRule{T::retry_wait, E::wait_over, T::ready},
    TaskRule{T::retry_wait, E::cancel, T::cancelled},

    // Cancelled between the stored intent and the start: the start is still noted, then it is
    // stopped.
    TaskRule{T::cancelling, E::start, T::cancelling},
    TaskRule{T::cancelling, E::stopped, T::cancelled},

    TaskRule{T::failed, E::redo, T::blocked},
    TaskRule{T::cancelled, E::redo, T::blocked},
    TaskRule{T::skipped, E::redo, T::blocked},
};

constexpr std::array attempt_table{
    AttemptRule{A::submitting, B::submit, A::submitted},
    AttemptRule{A::submitting, B::exit, A::exited},
    AttemptRule{A::submitting, B::vanish, A::lost},
    AttemptRule{A::submitted, B::begin, A::running},
    AttemptRule{A::submitted, B::exit, A::exited},
    AttemptRule{A::submitted, B::vanish, A::lost},
    AttemptRule{A::running, B::exit, A::exited},
    AttemptRule{A::running, B::vanish, A::lost},
    AttemptRule{A::lost, B::fence, A::fenced},
};

constexpr std::array task_states{T::blocked,    T::ready,     T::cached, T::starting, T::running,
                                 T::finalizing, T::succeeded, T::failed, T::lost,     T::retry_wait,
                                 T::cancelling, T::cancelled, T::skipped};
constexpr std::array<std::string_view, 13> task_state_names{
    "blocked", "ready", "cached",     "starting",   "running",   "finalizing", "succeeded",
    "failed",  "lost",  "retry_wait", "cancelling", "cancelled", "skipped"};

constexpr std::array task_events{
    E::release,   E::skip,       E::reuse,          E::reuse_breakdown, E::claim,  E::start,
    E::exit_well, E::exit_badly, E::exit_retryable, E::interrupt,       E::vanish, E::retry,
    E::give_up,   E::wait_over,  E::keep_outputs,   E::refuse_outputs,  E::cancel, E::stopped,
    E::redo};
constexpr std::array<std::string_view, 19> task_event_names{
    "release",   "skip",       "reuse",          "reuse_breakdown", "claim",  "start",
    "exit_well", "exit_badly", "exit_retryable", "interrupt",       "vanish", "retry",
    "give_up",   "wait_over",  "keep_outputs",   "refuse_outputs",  "cancel", "stopped",
    "redo"};

constexpr std::array attempt_states{A::submitting, A::submitted, A::running,
                                    A::exited,     A::lost,      A::fenced};
constexpr std::array<std::string_view, 6> attempt_state_names{"submitting", "submitted", "running",
                                                              "exited",     "lost",      "fenced"};

constexpr std::array attempt_events{B::submit, B::begin, B::exit, B::vanish, B::fence};
constexpr std::array<std::string_view, 5> attempt_event_names{"submit", "begin", "exit", "vanish",
                                                              "fence"};

template <class Rules, class State, class Event>
std::optional<State> look_up(const Rules& rules, State from, Event event) {
    const auto found = std::ranges::find_if(
        rules, [&](const auto& rule) { return rule.from == from && rule.event == event; });
    if (found == rules.end()) return std::nullopt;
    return found->to;
}

template <class State, std::size_t n>
State state_named(const std::array<State, n>& states, const std::array<std::string_view, n>& names,
                  std::string_view name) {
    const auto found = std::ranges::find(names, name);
    assert(found != names.end());  // SQL CHECKs the spelling
    return states[static_cast<std::size_t>(found - names.begin())];
}

}  // namespace

std::span<const TaskRule> task_rules() { return task_table; }
std::span<const AttemptRule> attempt_rules() { return attempt_table; }
std::span<const TaskState> all_task_states() { return task_states; }
std::span<const TaskEvent> all_task_events() { return task_events; }
std::span<const AttemptState> all_attempt_states() { return attempt_states; }
std::span<const AttemptEvent> all_attempt_events() { return attempt_events; }

std::optional<TaskState> next(TaskState from, TaskEvent event) {
    return look_up(task_table, from, event);
}

std::optional<AttemptState> next(AttemptState from, AttemptEvent event) {
    return look_up(attempt_table, from, event);
}

bool is_final(TaskState state) {
    return std::ranges::none_of(task_table, [&](const TaskRule& rule) {
        return rule.from == state && rule.event != E::redo;
    });
}

bool is_live(AttemptState state) {
    return state == A::submitting || state == A::submitted || state == A::running;
}

std::string_view name_of(TaskState state) {
    return task_state_names[static_cast<std::size_t>(state)];
}
std::string_view name_of(TaskEvent event) {
    return task_event_names[static_cast<std::size_t>(event)];
}
std::string_view name_of(AttemptState state) {
    return attempt_state_names[static_cast<std::size_t>(state)];
}
std::string_view name_of(AttemptEvent event) {
    return attempt_event_names[static_cast<std::size_t>(event)];
}
TaskState task_state_named(std::string_view name) {
    return state_named(task_states, task_state_names, name);
}
AttemptState attempt_state_named(std::string_view name) {
    return state_named(attempt_states, attempt_state_names, name);
}

}  // namespace breach::orchestrator
