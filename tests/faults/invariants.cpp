#include "tests/faults/invariants.hpp"

#include <gtest/gtest.h>

#include "core/exchange/provenance.hpp"
#include "services/orchestrator/files/data_folder.hpp"

namespace breach::testing {

using namespace orchestrator;
using nlohmann::json;

namespace {

TaskEvent task_event_named(const std::string& name) {
    for (const TaskEvent each : all_task_events())
        if (name_of(each) == name) return each;
    throw std::runtime_error("no event " + name);
}

AttemptEvent attempt_event_named(const std::string& name) {
    for (const AttemptEvent each : all_attempt_events())
        if (name_of(each) == name) return each;
    throw std::runtime_error("no event " + name);
}

class History {
  public:
    void take(const Event& event) {
        if (event.kind == "task") take_task_move(event);
        if (event.kind == "attempt") take_attempt_move(event);
    }

    void compare_with(const Store& store, const DataFolder& data) const {
        for (const auto& [id, state] : tasks_) {
            const auto task = store.task(id);
            ASSERT_TRUE(task) << id;
            EXPECT_EQ(name_of(task->state), name_of(state)) << id;
            if (task->state == TaskState::succeeded || task->state == TaskState::cached)
                check_artifacts(store, data, *task);
        }
    }

  private:
    void take_task_move(const Event& event) {
        const json& said = event.detail;
        const TaskState from = task_state_named(said.at("from").get<std::string>());
        const TaskState to = task_state_named(said.at("to").get<std::string>());
        const TaskEvent what = task_event_named(said.at("event"));
        EXPECT_EQ(next(from, what), to) << *event.task << " " << said;
        const auto known = tasks_.find(*event.task);
        if (known != tasks_.end()) {
            EXPECT_EQ(name_of(known->second), name_of(from)) << *event.task << " " << said;
        }
        tasks_[*event.task] = to;
        const bool well = what == TaskEvent::exit_well;
        successes_[*event.task] += well ? 1 : 0;
        EXPECT_LE(successes_[*event.task], 1) << *event.task;
    }

    void take_attempt_move(const Event& event) {
        const json& said = event.detail;
        auto& attempts = attempts_[*event.task];
        const std::int64_t number = said.at("number");
        const AttemptState to = attempt_state_named(said.at("to").get<std::string>());
        if (!said.contains("from")) {
            EXPECT_EQ(number, static_cast<std::int64_t>(attempts.size()) + 1) << *event.task;
            for (const auto& [earlier, state] : attempts) {
                EXPECT_FALSE(is_live(state)) << *event.task << " has attempt " << earlier
                                             << " live when " << number << " begins";
            }
        } else {
            const AttemptState from = attempt_state_named(said.at("from").get<std::string>());
            EXPECT_EQ(name_of(attempts.at(number)), name_of(from)) << *event.task << " " << said;
            EXPECT_EQ(next(from, attempt_event_named(said.at("event"))), to) << said;
        }
        attempts[number] = to;
    }

    static void check_artifacts(const Store& store, const DataFolder& data, const Task& task) {
        const auto artifacts = store.artifacts_of(task.id);
        EXPECT_FALSE(artifacts.empty()) << task.id;
        for (const Artifact& each : artifacts)
            EXPECT_EQ(exchange::sha256_of_file(data.output(task) / each.name), each.sha256)
                << task.label << "/" << each.name;
    }

    std::map<std::string, TaskState> tasks_;
    std::map<std::string, int> successes_;
    std::map<std::string, std::map<std::int64_t, AttemptState>> attempts_;
};

}  // namespace

void expect_sound_history(const Sandbox& sandbox) {
    const DataFolder data(sandbox.data());
    const Store store(data.database());
    History history;
    std::int64_t seq = 0;
    while (true) {
        const std::vector<Event> events = store.events_after(seq, 1000);
        if (events.empty()) break;
        for (const Event& each : events) history.take(each);
        seq = events.back().seq;
    }
    EXPECT_GT(seq, 0);
    history.compare_with(store, data);
}

}  // namespace breach::testing
