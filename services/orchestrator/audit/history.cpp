#include "services/orchestrator/audit/history.hpp"

#include <algorithm>

namespace breach::orchestrator {

namespace {

template <class Events>
auto event_named(const Events& all, const std::string& name) {
    const auto found =
        std::ranges::find_if(all, [&](const auto each) { return name_of(each) == name; });
    if (found == all.end()) throw std::invalid_argument("there is no event " + name);
    return *found;
}

std::string text_of(const std::optional<TaskState>& state) {
    return state ? std::string(name_of(*state)) : "nowhere";
}

}  // namespace

void History::take(const Event& event) {
    if (!event.task) return;
    try {
        if (event.kind == "task") take_task_move(event);
        if (event.kind == "attempt") take_attempt_move(event);
    } catch (const std::exception& error) {  // unknown word or missing entry
        complain(event, error.what());
    }
}

std::optional<TaskState> History::state_of(const std::string& task) const {
    const auto known = tasks_.find(task);
    return known == tasks_.end() ? std::nullopt : std::optional(known->second);
}

void History::complain(const Event& event, const std::string& what) {
    violations_.push_back("event " + std::to_string(event.seq) + ", task " + *event.task + ": " +
                          what);
}

void History::take_task_move(const Event& event) {
    const nlohmann::json& said = event.detail;
    const TaskState from = task_state_named(said.at("from").get<std::string>());
    const TaskState to = task_state_named(said.at("to").get<std::string>());
    const TaskEvent what = event_named(all_task_events(), said.at("event"));
    const auto known = state_of(*event.task);
    tasks_[*event.task] = to;
    if (next(from, what) != to)
        complain(event, std::string(name_of(what)) + " leads from " + text_of(from) + " to " +
                            text_of(next(from, what)) + ", not to " + text_of(to));
    if (known && *known != from)
        complain(event, "it moved from " + text_of(from) + " but was " + text_of(known));
    if (what == TaskEvent::redo) successes_[*event.task] = 0;
    if (what == TaskEvent::exit_well && ++successes_[*event.task] > 1)
        complain(event, "it succeeded twice");
}

void History::take_attempt_move(const Event& event) {
    const nlohmann::json& said = event.detail;
    auto& attempts = attempts_[*event.task];
    const std::int64_t number = said.at("number");
    const std::string attempt = "attempt " + std::to_string(number);
    const AttemptState to = attempt_state_named(said.at("to").get<std::string>());
    if (!said.contains("from")) {
        if (number != static_cast<std::int64_t>(attempts.size()) + 1)
            complain(event, attempt + " follows " + std::to_string(attempts.size()));
        for (const auto& [earlier, state] : attempts)
            if (is_live(state))
                complain(event, "attempt " + std::to_string(earlier) + " is live when " + attempt +
                                    " begins");
    } else {
        const AttemptState from = attempt_state_named(said.at("from").get<std::string>());
        if (attempts.at(number) != from)
            complain(event, attempt + " moved from " + std::string(name_of(from)) + " but was " +
                                std::string(name_of(attempts.at(number))));
        if (next(from, event_named(all_attempt_events(), said.at("event"))) != to)
            complain(event, attempt + " may not go from " + std::string(name_of(from)) + " to " +
                                std::string(name_of(to)));
    }
    attempts[number] = to;
}

}  // namespace breach::orchestrator
