// The dispatcher's parts, each separately and without its thread.
#include <gtest/gtest.h>

#include "services/orchestrator/dispatch/attempts.hpp"
#include "services/orchestrator/dispatch/ready_tasks.hpp"
#include "services/orchestrator/dispatch/release.hpp"
#include "tests/folder.hpp"

namespace breach::orchestrator::dispatch_parts_test {

TaskPlan planned(const std::string& phase, std::int64_t cores = 1) {
    TaskPlan task;
    task.phase = phase;
    task.label = phase;
    task.release = Release::at_once;
    task.resources = {cores, 100 * cores};
    return task;
}

/// An executor that accepts everything and reports what the test sets.
class Told : public Executor {
  public:
    void submit(const AttemptFolder&, const Order& order) override { orders.push_back(order); }
    Vitals probe(const AttemptFolder&) override { return vitals; }
    void stop(const AttemptFolder&, StopReason) override { ++stops; }
    void clear_away(const AttemptFolder&, const std::string&) override {}
    AtStop at_stop() const override { return AtStop::ends_them; }

    std::vector<Order> orders;
    Vitals vitals{Life::alive};
    int stops = 0;
};

class DispatchParts : public testing::Test {
  protected:
    DispatchParts() : data_(folder_.path()), store_(data_.database()) { settings_.slots = 4; }

    void submit(std::vector<TaskPlan> tasks) {
        NewRun run;
        run.id = "run";
        run.study = run.scene = "{}";
        run.tasks = std::move(tasks);
        store_.write([&](Transaction& transaction) { transaction.add_run(run); });
    }
    std::vector<std::string> labels(const std::vector<Task>& tasks) const {
        std::vector<std::string> found;
        for (const Task& each : tasks) found.push_back(each.label);
        return found;
    }
    TaskState state(std::size_t i) const { return store_.tasks_of("run").at(i).state; }

    const test::Folder folder_;
    DataFolder data_;
    Store store_;
    Notifier notifier_;
    DispatchSettings settings_;
    Told executor_;
    ProgressBoard board_;
};

using Labels = std::vector<std::string>;

TEST_F(DispatchParts, CapacityHasRoomUntilCoresMemoryOrPhaseAreTaken) {
    settings_.memory_mb = 350;
    settings_.limits = {{"mpm_solver", 2}};
    submit({planned("mpm_solver", 1), planned("fem_solver", 9)});
    const std::vector<Task> tasks = store_.tasks_of("run");
    Capacity capacity(settings_);
    EXPECT_TRUE(capacity.has_room_for(tasks[1]))
        << "one that asks for more than there is runs alone";
    capacity.take(tasks[0]);
    EXPECT_FALSE(capacity.has_room_for(tasks[1]));
    EXPECT_FALSE(capacity.is_full("mpm_solver"));
    capacity.take(tasks[0]);
    EXPECT_EQ(capacity.full_phases(), Labels{"mpm_solver"});
    EXPECT_EQ(capacity.free_cores(), 2u);
    capacity.take(tasks[0]);
    EXPECT_FALSE(capacity.has_room_for(tasks[0])) << "350 MB are less than four times 100";
}

TEST_F(DispatchParts, ProgressIsNotToldLowerUntilTheRunIsOver) {
    EXPECT_EQ(board_.never_back("run", 0.5), 0.5);
    EXPECT_EQ(board_.never_back("run", 0.3), 0.5) << "a trigger added tasks";
    EXPECT_EQ(board_.never_back("other", 0.3), 0.3);
    EXPECT_EQ(board_.never_back("run", 1.0), 1.0);
    EXPECT_EQ(board_.never_back("run", 0.2), 0.2) << "a retry";
}

TEST_F(DispatchParts, OneThatDoesNotFitHoldsBackThoseBehindIt) {
    submit({planned("lem_tool", 1), planned("fem_solver", 4), planned("mpm_solver", 1)});
    ReadyTasks ready(store_, data_, notifier_);
    EXPECT_EQ(labels(ready.to_start(Capacity(settings_))), Labels{"lem_tool"});
}

TEST_F(DispatchParts, WhatWaitsIsReleasedByItsParentOrSkippedWithIt) {
    TaskPlan child = planned("transfer_tool");
    child.parent = 0;
    child.release = Release::parent_succeeded;
    submit({planned("fem_solver"), child});
    const std::string parent = store_.tasks_of("run").front().id;
    settle_children(store_, data_, parent);
    EXPECT_EQ(state(1), TaskState::blocked);
    store_.write([&](Transaction& transaction) {
        transaction.move_task(parent, TaskEvent::claim);
        transaction.move_task(parent, TaskEvent::start);
        transaction.fail_task(parent, TaskEvent::exit_badly, {70, "it broke down"});
    });
    settle_children(store_, data_, parent);
    EXPECT_EQ(state(1), TaskState::skipped);
}

TEST_F(DispatchParts, AttemptsAreStartedStoppedAndTriedAgainWhenLost) {
    submit({planned("fem_solver")});
    std::vector<std::string> over;
    settings_.most_tries = 2;
    settings_.retry_delay = std::chrono::milliseconds(0);
    Attempts attempts(store_, data_, executor_, board_, settings_,
                      [&](const Task& task) { over.push_back(task.label); });
    attempts.start(store_.tasks_of("run"));
    ASSERT_EQ(executor_.orders.size(), 1u);
    EXPECT_EQ(state(0), TaskState::running);
    EXPECT_EQ(attempts.capacity().free_cores(), 3u);
    attempts.stop_all();
    EXPECT_EQ(executor_.stops, 1);
    executor_.vitals = {Life::gone, "no process"};
    attempts.look();
    EXPECT_EQ(state(0), TaskState::retry_wait);
    EXPECT_TRUE(attempts.empty());
    release_due_retries(store_);
    EXPECT_EQ(state(0), TaskState::ready);
    attempts.start(store_.tasks_of("run"));
    EXPECT_EQ(state(0), TaskState::starting) << "its process is gone, which is not looked at yet";
    attempts.look();
    EXPECT_EQ(state(0), TaskState::failed) << "it was tried twice";
    EXPECT_EQ(over, Labels{"fem_solver"});
}

TEST_F(DispatchParts, WhatWasGoingOnIsAdoptedFromTheStore) {
    submit({planned("fem_solver")});
    {
        Attempts before(store_, data_, executor_, board_, settings_, [](const Task&) {});
        before.start(store_.tasks_of("run"));
    }
    Attempts after(store_, data_, executor_, board_, settings_, [](const Task&) {});
    EXPECT_TRUE(after.empty());
    after.adopt();
    EXPECT_FALSE(after.empty());
    EXPECT_EQ(executor_.orders.size(), 1u) << "adopted, not started again";
}

}  // namespace breach::orchestrator::dispatch_parts_test
