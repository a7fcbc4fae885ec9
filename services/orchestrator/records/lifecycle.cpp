// The table of moves of tasks and attempts. `cancelling` and `starting` have exits of their own
// for a service that was killed between a row and its process.
#include "services/orchestrator/records/lifecycle.hpp"

#include <algorithm>
#include <array>

#include "core/words/words.hpp"

namespace breach::orchestrator {

// SQL CHECKs contain the same words.
static constexpr auto words_of(TaskState) {
    using enum TaskState;
    return words::in_order<TaskState>({{blocked, "blocked"},
                                       {ready, "ready"},
                                       {cached, "cached"},
                                       {starting, "starting"},
                                       {running, "running"},
                                       {finalizing, "finalizing"},
                                       {succeeded, "succeeded"},
                                       {failed, "failed"},
                                       {lost, "lost"},
                                       {retry_wait, "retry_wait"},
                                       {cancelling, "cancelling"},
                                       {cancelled, "cancelled"},
                                       {skipped, "skipped"}});
}

static constexpr auto words_of(TaskEvent) {
    using enum TaskEvent;
    return words::in_order<TaskEvent>({{release, "release"},
                                       {skip, "skip"},
                                       {reuse, "reuse"},
                                       {reuse_breakdown, "reuse_breakdown"},
                                       {claim, "claim"},
                                       {start, "start"},
                                       {exit_well, "exit_well"},
                                       {exit_badly, "exit_badly"},
                                       {exit_retryable, "exit_retryable"},
                                       {interrupt, "interrupt"},
                                       {vanish, "vanish"},
                                       {retry, "retry"},
                                       {give_up, "give_up"},
                                       {wait_over, "wait_over"},
                                       {keep_outputs, "keep_outputs"},
                                       {refuse_outputs, "refuse_outputs"},
                                       {cancel, "cancel"},
                                       {stopped, "stopped"},
                                       {redo, "redo"}});
}

static constexpr auto words_of(AttemptState) {
    using enum AttemptState;
    return words::in_order<AttemptState>({{submitting, "submitting"},
                                          {submitted, "submitted"},
                                          {running, "running"},
                                          {exited, "exited"},
                                          {lost, "lost"}});
}

static constexpr auto words_of(AttemptEvent) {
    using enum AttemptEvent;
    return words::in_order<AttemptEvent>(
        {{submit, "submit"}, {begin, "begin"}, {exit, "exit"}, {vanish, "vanish"}});
}

namespace {

using T = TaskState;
using E = TaskEvent;
using A = AttemptState;
using B = AttemptEvent;

// `starting` has exits too: the service may die before it notes the start.
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

    // Cancelled between the stored intent and the start: the start is noted, then the process is
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
};

template <class Rules, class State, class Event>
std::optional<State> look_up(const Rules& rules, State from, Event event) {
    const auto found = std::ranges::find_if(
        rules, [&](const auto& rule) { return rule.from == from && rule.event == event; });
    if (found == rules.end()) return std::nullopt;
    return found->to;
}

}  // namespace

std::span<const TaskRule> task_rules() { return task_table; }
std::span<const TaskState> all_task_states() { return words::values<TaskState>; }
std::span<const TaskEvent> all_task_events() { return words::values<TaskEvent>; }
std::span<const AttemptState> all_attempt_states() { return words::values<AttemptState>; }
std::span<const AttemptEvent> all_attempt_events() { return words::values<AttemptEvent>; }

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

bool has_output(TaskState state) {
    return state == TaskState::succeeded || state == TaskState::cached;
}

bool is_live(AttemptState state) {
    return state == A::submitting || state == A::submitted || state == A::running;
}

std::string_view name_of(TaskState state) { return words::name_of(state); }
std::string_view name_of(TaskEvent event) { return words::name_of(event); }
std::string_view name_of(AttemptState state) { return words::name_of(state); }
std::string_view name_of(AttemptEvent event) { return words::name_of(event); }
TaskState task_state_named(std::string_view name) { return words::named<TaskState>(name); }
AttemptState attempt_state_named(std::string_view name) { return words::named<AttemptState>(name); }

}  // namespace breach::orchestrator
