// Reading of a watched FEM and states of its triggers, without a service.
#include <gtest/gtest.h>

#include <fstream>

#include "core/exchange/publish.hpp"
#include "core/phases/files.hpp"
#include "services/orchestrator/triggers/settling.hpp"
#include "tests/folder.hpp"
#include "tests/unit/orchestrator/small_run.hpp"

namespace breach::orchestrator::trigger_parts_test {

using nlohmann::json;

class TriggerParts : public testing::Test {
  protected:
    TriggerParts() : data_(folder_.path()), store_(data_.database()), settling_(store_) {
        NewRun run = small_run();
        run.scene = R"({"fem":{}})";
        for (TaskPlan each : run.tasks) {
            each.transfer_time.reset();
            run.firing_plan.push_back(each);
        }
        run.tasks.resize(1);
        fem_task_ = task_id(run.id, 0);
        store_.write([&](Transaction& transaction) {
            transaction.add_run(run);
            transaction.move_task(fem_task_, TaskEvent::claim);
            transaction.move_task(fem_task_, TaskEvent::start);
        });
    }

    void watch(const std::string& kind, const json& spec) {
        const std::string run = store_.task(fem_task_)->run;
        store_.write([&](Transaction& transaction) {
            transaction.add_trigger(run, fem_task_, {"it", kind, spec});
        });
        fem_.emplace(*store_.task(fem_task_), store_, data_);
        fem_->armed.emplace_back(store_.open_triggers().at(0));
        std::filesystem::create_directories(fem_->output);
    }
    void write_lines(const std::vector<double>& jacobians) {
        std::ofstream stream(fem_->output / phases::files::telemetry, std::ios::app);
        for (const double each : jacobians)
            stream << json{{"time", time_ += 1.0}, {"step", 10}, {"jacobian_least_avg", each}}
                   << "\n";
    }
    void write_snapshot(double time) const {
        exchange::publish_text(fem_->output / phases::files::snapshot_name(time), "snapshot");
    }
    void end_fem() {
        store_.write([&](Transaction& transaction) {
            transaction.move_task(fem_task_, TaskEvent::exit_well);
        });
        fem_->task = *store_.task(fem_task_);
    }
    Trigger settled() {
        fem_->read_on(store_, watches_);
        fem_->armed[0].feed(*fem_);
        settling_.settle(*fem_, fem_->armed[0]);
        return store_.triggers_of(fem_->task.run).at(0);
    }
    std::vector<double> transfers() const {
        std::vector<double> times;
        for (const Task& each : store_.tasks_of(fem_->task.run))
            if (each.phase == "transfer_tool") times.push_back(*each.transfer_time);
        return times;
    }

    const test::Folder folder_;
    DataFolder data_;
    Store store_;
    FolderWatch watches_;
    Settling settling_;
    std::string fem_task_;
    std::optional<WatchedFem> fem_;
    double time_ = 0.0;
};

using Times = std::vector<double>;

TEST_F(TriggerParts, AManualTriggerAsksForASnapshotAndTakesIt) {
    watch("manual", {{"after", 0.4}});
    write_snapshot(0.3);
    EXPECT_EQ(settled().state, TriggerState::holding);
    EXPECT_TRUE(std::filesystem::exists(fem_->output / phases::files::request));
    write_snapshot(0.5);
    EXPECT_EQ(settled().state, TriggerState::fired);
    EXPECT_EQ(transfers(), Times{0.5});
}

TEST_F(TriggerParts, ACriterionThatWasNeverMetExpiresWithTheFemAndSaysHowNearItCame) {
    watch("criterion", {{"when", "jacobian_least_avg < 0.9"}, {"hold_s", 0.0}});
    write_lines({1.0, 0.95});
    EXPECT_EQ(settled().state, TriggerState::armed);
    end_fem();
    const Trigger expired = settled();
    EXPECT_EQ(expired.state, TriggerState::expired);
    EXPECT_NE(expired.reason.find("jacobian_least_avg = 0.95"), std::string::npos)
        << expired.reason;
    EXPECT_EQ(*expired.result, (json{{"was_met", false}}));
}

TEST_F(TriggerParts, AWindowTakesTheSnapshotNearestItsMiddleOnceItIsShut) {
    watch("window", {{"lower", "jacobian_least_avg < 0.9"},
                     {"upper", "jacobian_least_avg < 0.5"},
                     {"hold_s", 0.0},
                     {"pick", "midpoint"}});
    for (const double time : {1.0, 2.5, 4.5, 6.0}) write_snapshot(time);
    write_lines({1.0, 0.8, 0.8, 0.7});  // open from 2 s on
    EXPECT_EQ(settled().state, TriggerState::holding);
    EXPECT_EQ(transfers(), Times{});
    write_lines({0.7, 0.4});  // to 6 s
    EXPECT_EQ(settled().state, TriggerState::fired);
    EXPECT_EQ(transfers(), Times{4.5});
}

TEST_F(TriggerParts, ABisectSpreadsItsSeedsOverItsRange) {
    watch("bisect", {{"share", 0.75},
                     {"tolerance_s", 0.5},
                     {"from", 1.0},
                     {"to", 4.0},
                     {"seeds", 2},
                     {"most_runs", 10}});
    for (const double time : {0.5, 1.0, 1.2, 2.0, 3.0, 4.0, 5.0}) write_snapshot(time);
    EXPECT_EQ(settled().state, TriggerState::armed) << "the FEM goes on";
    end_fem();
    EXPECT_EQ(settled().state, TriggerState::holding);
    EXPECT_EQ(transfers(), (Times{1.0, 4.0}));
}

}  // namespace breach::orchestrator::trigger_parts_test
