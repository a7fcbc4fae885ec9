#include "services/orchestrator/store/store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "services/orchestrator/records/firing_plan.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/records/mean_columns.hpp"
#include "services/orchestrator/store/schema.hpp"
#include "services/orchestrator/uncertainty/batch_watch.hpp"
#include "tests/folder.hpp"
#include "tests/unit/orchestrator/small_run.hpp"

namespace breach::orchestrator::store_test {
namespace {

using nlohmann::json;

class StoreTest : public ::testing::Test {
  protected:
    std::filesystem::path file() const { return folder_ / "test.db"; }

    static void bring_to_success(Store& store, const std::string& task, const json& result,
                                 double wall_seconds = 1.0) {
        store.write([&](Transaction& t) {
            t.try_move_task(task, TaskEvent::release);
            t.move_task(task, TaskEvent::claim);
            const auto number = t.add_attempt(task);
            t.move_attempt(task, number, AttemptEvent::submit);
            t.move_task(task, TaskEvent::start);
            AttemptEnd end;
            end.exit_code = 0;
            end.wall_seconds = wall_seconds;
            t.move_attempt(task, number, AttemptEvent::exit, end);
            t.move_task(task, TaskEvent::exit_well);
            t.finish_task(task, result, {{task, "result.json", std::string(64, 'a'), 10}});
        });
    }

    const test::Folder folder_;
};

TEST_F(StoreTest, SweepsRefineWhenMoreIsDrawnThanAtFirst) {
    Store store(file());
    NewRun run = small_run();
    run.batches = {{"percentile", 50}};
    store.write([&](Transaction& t) { t.add_run(run); });
    EXPECT_EQ(store.sweep(run.id)->state, "queued");
    Extension more{.times = {}, .tasks = {}, .recipes = {}, .study = json::object()};
    more.tasks.push_back({run.tasks[2], task_id(run.id, 1)});
    more.tasks[0].plan.parent.reset();
    more.tasks[0].plan.label = "mpm_0.500000_s0002";
    store.write([&](Transaction& t) { t.extend_run(run.id, more); });
    EXPECT_EQ(store.sweep(run.id)->state, "refining");
    EXPECT_EQ(store.run(run.id)->state, "queued");
    RunFilter filter;
    filter.state = "refining";
    filter.sweeps_only = true;
    EXPECT_EQ(store.runs(filter, 10).size(), 1u);
}

TEST_F(StoreTest, CostsAndPaceOfASweepAreNotThoseOfItsFirstRunouts) {
    Store store(file());
    NewRun run = small_run();
    const TaskPlan runout = run.tasks[2];
    run.tasks.clear();
    for (int i = 0; i < 20; ++i) {
        run.tasks.push_back(runout);
        run.tasks.back().label = "mpm_" + std::to_string(i);
        run.tasks.back().transfer_time = i;
        run.tasks.back().parent = {};
        run.tasks.back().release = Release::at_once;
    }
    store.write([&](Transaction& t) { t.add_run(run); });
    for (int i = 0; i < 12; ++i)
        bring_to_success(store, task_id(run.id, i), {{"number", i}}, i < 4 ? 1.0 : 10.0);

    std::vector<double> times;
    for (const Task& each : store.computed_tasks_of(run.id, 4))
        times.push_back(*each.transfer_time);
    EXPECT_EQ(times, (std::vector<double>{2, 5, 8, 11}));
    EXPECT_EQ(store.computed_tasks_of(run.id, 50).size(), 12u);

    const std::vector<PhaseLeft> left = store.left_of(run.id);
    ASSERT_EQ(left.size(), 1u);
    EXPECT_EQ(left[0].waiting, 8);
    EXPECT_EQ(left[0].running, 0);
    EXPECT_DOUBLE_EQ(*left[0].pace, 10.0);
}

/// Number of the attempt.
std::int64_t claim_and_submit(Transaction& t, const std::string& task) {
    t.move_task(task, TaskEvent::claim);
    const std::int64_t number = t.add_attempt(task);
    t.move_attempt(task, number, AttemptEvent::submit);
    return number;
}

TEST_F(StoreTest, WhatWaitsInAClustersQueueHasNotBegun) {
    Store store(file());
    const NewRun run = small_run();
    const std::string fem = task_id(run.id, 0);
    store.write([&](Transaction& t) {
        t.add_run(run);
        claim_and_submit(t, fem);
    });
    EXPECT_FALSE(store.attempts_of(fem)[0].started);
    const auto left_of_fem = [&] { return store.left_of(run.id).at(0); };
    EXPECT_EQ(left_of_fem().waiting, 1);
    EXPECT_EQ(left_of_fem().running, 0);
    EXPECT_EQ(left_of_fem().running_for, 0.0);

    store.write([&](Transaction& t) { t.move_task(fem, TaskEvent::start); });
    const auto started = store.attempts_of(fem)[0].started;
    EXPECT_TRUE(started);
    EXPECT_EQ(left_of_fem().running, 1);
    EXPECT_LT(left_of_fem().running_for, 3600.0);
    // As when a restarted service records it again.
    store.write([&](Transaction& t) {
        t.cancel_run(run.id, "");
        t.move_task(fem, TaskEvent::start);
    });
    EXPECT_EQ(store.attempts_of(fem)[0].started, started);
}

TEST_F(StoreTest, TimeForWhichNothingRanIsNotTimeThatATaskHasRun) {
    Store store(file());
    const NewRun run = small_run();
    const std::string fem = task_id(run.id, 0);
    store.write([&](Transaction& t) {
        t.add_run(run);
        const auto number = claim_and_submit(t, fem);
        t.move_task(fem, TaskEvent::start);
        AttemptEnd stopped;
        stopped.exit_code = 143;
        stopped.wall_seconds = 40.0;
        stopped.reason = "shutdown";
        t.move_attempt(fem, number, AttemptEvent::exit, stopped);
        t.move_task(fem, TaskEvent::interrupt);
    });
    {
        Connection database(file(), Access::read_write);
        database.change("UPDATE tasks SET started='2020-01-01T00:00:00.000Z' WHERE id=?", {fem});
        database.change("UPDATE attempts SET started='2020-01-01T00:00:00.000Z' WHERE task=?",
                        {fem});
    }
    store.write([&](Transaction& t) {
        claim_and_submit(t, fem);
        t.move_task(fem, TaskEvent::start);
    });
    const PhaseLeft left = store.left_of(run.id).at(0);
    EXPECT_EQ(left.running, 1);
    EXPECT_GT(left.running_for, 39.9);
    EXPECT_LT(left.running_for, 3600.0);
    EXPECT_EQ(store.attempts_of(fem)[0].started, "2020-01-01T00:00:00.000Z");
}

TEST_F(StoreTest, AttemptThatBeganAndEndedBetweenTwoLooksHasItsBeginning) {
    Store store(file());
    const NewRun run = small_run();
    const std::string fem = task_id(run.id, 0);
    store.write([&](Transaction& t) {
        t.add_run(run);
        t.move_task(fem, TaskEvent::claim);
        AttemptEnd end;
        end.exit_code = 0;
        end.wall_seconds = 90.0;
        t.move_attempt(fem, t.add_attempt(fem), AttemptEvent::exit, end);
        t.move_task(fem, TaskEvent::exit_well);
    });
    const Attempt attempt = store.attempts_of(fem)[0];
    ASSERT_TRUE(attempt.started);
    EXPECT_LT(*attempt.started, utc_text(epoch_ms() - 89000));
    EXPECT_LT(*attempt.started, *attempt.finished);
}

TEST_F(StoreTest, OutputsAreThoseOfTheLastAttemptAndOfNoneThatGoesOn) {
    Store store(file());
    const NewRun run = small_run();
    const std::string fem = task_id(run.id, 0);
    const auto artifact = [&](const char* name) {
        return Artifact{fem, name, std::string(64, 'a'), 10};
    };
    const auto names = [&] {
        std::vector<std::string> found;
        for (const Artifact& each : store.artifacts_of(fem)) found.push_back(each.name);
        return found;
    };
    using Names = std::vector<std::string>;
    store.write([&](Transaction& t) {
        t.add_run(run);
        t.move_task(fem, TaskEvent::claim);
        t.fail_task(fem, TaskEvent::exit_badly, {74, "no space"});
        t.keep_remains(fem, {artifact("fault.json"), artifact("snapshot_1")}, "");
    });
    EXPECT_EQ(names(), (Names{"fault.json", "snapshot_1"}));
    store.write([&](Transaction& t) { t.retry_run(run.id); });
    EXPECT_TRUE(names().empty());
    // The registrar has read the remains and reaches the store after the retry.
    store.write([&](Transaction& t) { t.keep_remains(fem, {artifact("fault.json")}, "old"); });
    EXPECT_TRUE(names().empty());
    store.write([&](Transaction& t) {
        t.move_task(fem, TaskEvent::claim);
        t.fail_task(fem, TaskEvent::exit_badly, {74, "no space"});
        t.keep_remains(fem, {artifact("fault.json"), artifact("snapshot_1")}, "");
        t.keep_remains(fem, {artifact("snapshot_1")}, "");
    });
    EXPECT_EQ(names(), Names{"snapshot_1"});
    store.write([&](Transaction& t) { t.retry_run(run.id); });
    Connection(file(), Access::read_write)
        .change("INSERT INTO artifacts (task, name, sha256, bytes) VALUES (?, 'old', ?, 1)",
                {fem, std::string(64, 'b')});
    bring_to_success(store, fem, {{"number", 1}});
    EXPECT_EQ(names(), Names{"result.json"});
    store.write([&](Transaction& t) { t.keep_remains("nobody-00000", {artifact("x")}, ""); });
}

TEST_F(StoreTest, AStudyThatCannotContinueDelaysNoOtherAndIsLookedAtAgain) {
    Store store(file());
    const DataFolder data(folder_ / "data");
    const Numerics numerics;
    std::vector<NewRun> runs{small_run(), small_run()};
    const char* sound =
        R"({"uncertainty": {"samples": 4, "drawn": 2, "parameters": [],
    "until": {"percentile": 50, "half_width": 0.1}}, "variants": []})";
    runs[1].study = sound;  // the other one's cannot be read
    for (NewRun& each : runs) {
        each.batches = {{"batch", 2}};
        store.write([&](Transaction& t) { t.add_run(each); });
        for (std::size_t i = 0; i < each.tasks.size(); ++i)
            bring_to_success(store, task_id(each.id, i), {{"runout", 12.5}});
    }
    const auto state = [&](std::size_t i) { return store.batches_of(runs[i].id)->state; };
    RunFilter open;
    open.state = "running";
    EXPECT_EQ(store.runs(open, 10).size(), 2u) << "open by their batches alone";
    BatchWatch watch(store, data, numerics);
    EXPECT_FALSE(watch.look());
    EXPECT_EQ(state(0), "open");
    EXPECT_EQ(state(1), "given_up");
    EXPECT_FALSE(watch.look());
    EXPECT_EQ(state(0), "open");
    Connection(file(), Access::read_write)
        .change("UPDATE runs SET study=? WHERE id=?", {sound, runs[0].id});
    watch.look();  // though nothing was stored that tells of it
    EXPECT_EQ(state(0), "given_up");
}

TEST(FiringPlan, AFemComputedAgainStandsWhereItsVariantsStands) {
    const auto fem = [](const char* label, const char* variant) {
        TaskPlan plan{.phase = "fem_solver",
                      .label = label,
                      .transfer_time = {},
                      .parent = {},
                      .release = Release::at_once,
                      .input = {},
                      .overrides = {}};
        plan.variant = variant;
        return plan;
    };
    TaskPlan transfer = fem("transfer_firm", "firm");
    transfer.parent = 0;
    const std::vector<TaskPlan> plan{fem("fem_firm", "firm"), transfer, fem("fem_deep", "deep")};
    EXPECT_EQ(place_of_fem(plan, "fem_firm", "firm"), 0u);
    EXPECT_EQ(place_of_fem(plan, "fem_deep", "deep"), 2u);
    EXPECT_EQ(place_of_fem(plan, "fem_deep_2", "deep"), 2u);
    EXPECT_FALSE(place_of_fem(plan, "fem_wet", "wet"));
    EXPECT_FALSE(place_of_fem({}, "fem", ""));
    // Version 0.1.0 stored no variants: the label decides.
    EXPECT_EQ(place_of_fem({fem("fem_firm", ""), fem("fem_deep", "")}, "fem_deep", ""), 1u);
}

TEST_F(StoreTest, ARunKeepsItsNewTitleAndIsFoundByAPartOfIt) {
    NewRun run = small_run(), other = small_run();
    run.title = "First try";
    {
        Store store(file());
        bool known = true;
        store.write([&](Transaction& t) {
            t.add_run(run);
            t.add_run(other);
            EXPECT_TRUE(t.rename_run(run.id, "100 % Weak beach"));
            known = t.rename_run("nobody", "x");
        });
        EXPECT_FALSE(known);
    }
    const Store store(file());
    EXPECT_EQ(store.run(run.id)->title, "100 % Weak beach");
    const auto found = [&](const std::string& text) {
        RunFilter filter;
        filter.search = text;
        return store.runs(filter, 10).size();
    };
    EXPECT_EQ(found("weak"), 1u);
    EXPECT_EQ(found("0 % w"), 1u);
    EXPECT_EQ(found("%"), 1u) << "no wildcard";
    EXPECT_EQ(found("First"), 0u);
    EXPECT_EQ(found("SMALL"), 2u) << "their name";
    EXPECT_EQ(found(run.id.substr(3)), 1u);
}

TEST_F(StoreTest, RunsTasksAttemptsAndArtifactsComeBackAsTheyWereWritten) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) { t.add_run(run); });
    EXPECT_EQ(store.run(run.id)->state, "queued");
    const auto tasks = store.tasks_of(run.id);
    ASSERT_EQ(tasks.size(), 3u);
    EXPECT_EQ(tasks[0].state, TaskState::ready);
    EXPECT_EQ(tasks[0].overrides, std::vector<std::string>{"/a=1"});
    EXPECT_EQ(tasks[1].state, TaskState::blocked);
    EXPECT_EQ(*tasks[1].parent, tasks[0].id);
    EXPECT_EQ(tasks[1].transfer_time, 0.5);

    for (const Task& task : tasks) {
        bring_to_success(
            store, task.id,
            {{"runout", 12.5}, {"energy", {{"numerical", {{"share", 0.01}}}}}, {"cpu_seconds", 2}});
    }
    EXPECT_EQ(store.run(run.id)->state, "succeeded");
    EXPECT_TRUE(store.run(run.id)->finished);
    const auto attempts = store.attempts_of(tasks[2].id);
    ASSERT_EQ(attempts.size(), 1u);
    EXPECT_EQ(attempts[0].exit_code, 0);
    EXPECT_EQ(store.artifacts_of(tasks[0].id).at(0).bytes, 10);
    const auto rows = store.results(run.id);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(value_of(rows[0], "runout"), 12.5);
    EXPECT_EQ(value_of(rows[0], "numerical_share"), 0.01);
    EXPECT_TRUE(value_of(rows[0], "volume_ratio").is_null());
}

json flag(const char* code, const char* severity, const char* pointer = "") {
    return {{"code", code}, {"severity", severity}, {"message", "why"}, {"pointer", pointer}};
}

TEST_F(StoreTest, QuestionableResultMakesItsRowAndItsRunQuestionable) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) { t.add_run(run); });
    const json implausible = flag("implausible", "warning", "/materials/a/density");
    bring_to_success(store, task_id(run.id, 0), {{"flags", {implausible}}});
    bring_to_success(store, task_id(run.id, 1), {{"flags", {implausible}}});
    EXPECT_EQ(store.run(run.id)->questionable, 0);
    bring_to_success(store, task_id(run.id, 2),
                     {{"runout", 12.5},
                      {"at_rest", false},
                      {"flags", {implausible, flag("still_moving", "questionable")}}});
    const auto ended = *store.run(run.id);
    EXPECT_EQ(ended.state, "questionable");
    EXPECT_EQ(ended.questionable, 1);
    EXPECT_EQ(ended.message,
              "1 of 1 FEM results flagged implausible; 1 of 1 runouts still moving: lower bounds");
    ASSERT_EQ(ended.facts.raised.size(), 4u) << "implausible by three phases, and still_moving";
    EXPECT_EQ(ended.facts.raised.front().flag.code, "still_moving");
    const auto rows = store.results(run.id);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(value_of(rows[0], "state"), "questionable");
    EXPECT_EQ(value_of(rows[0], "questionable"), true);
    EXPECT_EQ(value_of(rows[0], "at_rest"), false);
    EXPECT_EQ(value_of(rows[0], "lower_bound"), true);
    const json flags = value_of(rows[0], "flags");
    ASSERT_EQ(flags.size(), 2u) << flags;  // flags of all three phases are given once
    EXPECT_EQ(flags[0].at("code"), "still_moving");
    EXPECT_EQ(flags[1].at("phase"), "fem_solver");
    EXPECT_EQ(store.task(task_id(run.id, 2))->state, TaskState::succeeded);
    Connection database(file(), Access::read_only);
    database.query("SELECT state, flags FROM sweep_results WHERE run=?", {run.id},
                   [&](const Row& row) {
                       EXPECT_EQ(row.text("state"), "questionable");
                       EXPECT_EQ(row.text("flags"), "still_moving;implausible");
                   });
}

TEST_F(StoreTest, AQuestionableFemMakesItsRunoutsQuestionable) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) { t.add_run(run); });
    bring_to_success(store, task_id(run.id, 0),
                     {{"flags", {flag("entangled_corner", "questionable")}}});
    bring_to_success(store, task_id(run.id, 1), {{"flags", json::array()}});
    bring_to_success(store, task_id(run.id, 2), {{"runout", 1.0}, {"flags", json::array()}});
    EXPECT_EQ(value_of(store.results(run.id).at(0), "state"), "questionable");
    EXPECT_EQ(store.run(run.id)->message, "1 of 1 FEM results ended by one bad corner of the mesh");
}

TEST_F(StoreTest, RowsAreNotJudgedBeforeTheirResult) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) { t.add_run(run); });
    EXPECT_TRUE(value_of(store.results(run.id).at(0), "questionable").is_null());  // no result yet
    for (const Task& task : store.tasks_of(run.id))
        bring_to_success(store, task.id, {{"runout", 12.5}, {"at_rest", true}});
    const auto rows = store.results(run.id);
    EXPECT_EQ(value_of(rows[0], "state"), "succeeded");
    EXPECT_EQ(value_of(rows[0], "at_rest"), true);
    EXPECT_EQ(value_of(rows[0], "questionable"), false);
    EXPECT_EQ(value_of(rows[0], "lower_bound"), false);
}

TaskPlan alone(const char* phase, const std::string& variant) {
    TaskPlan task{.phase = phase,
                  .label = {},
                  .transfer_time = {},
                  .parent = {},
                  .release = Release::at_once,
                  .input = "",
                  .overrides = {},
                  .variant = variant};
    task.label = label_of(task);
    return task;
}

TEST_F(StoreTest, RowsOfAStaticSceneHaveTheirOwnFactorOfSafety) {
    Store store(file());
    NewRun run = small_run();
    run.tasks = {alone("mpm_solver", "weak"), alone("lem_tool", "weak"),
                 alone("mpm_solver", "strong"), alone("lem_tool", "strong")};
    store.write([&](Transaction& t) { t.add_run(run); });
    bring_to_success(store, task_id(run.id, 0), {{"runout", 4.5}, {"flags", json::array()}});
    bring_to_success(store, task_id(run.id, 1),
                     {{"factor_of_safety", 0.5},
                      {"stages",
                       {{{"layers_liquefied", 0}, {"factor_of_safety", 0.5}},
                        {{"layers_liquefied", 1}, {"factor_of_safety", 0.25}}}}});
    bring_to_success(store, task_id(run.id, 3),
                     {{"factor_of_safety", 1.5},
                      {"stages", {{{"layers_liquefied", 0}, {"factor_of_safety", 1.5}}}}});
    const auto rows = store.results(run.id);
    ASSERT_EQ(rows.size(), 2u) << "a stability analysis beside runouts has no row of its own";
    const auto stability = [&](const std::string& of, const std::string& variant) {
        return store.stability_of(of, variant, "lem_tool");
    };
    EXPECT_EQ(stability(run.id, "weak")->id, task_id(run.id, 1));
    EXPECT_EQ(stability(run.id, "strong")->id, task_id(run.id, 3));
    EXPECT_EQ(stability(run.id, "")->id, task_id(run.id, 1)) << "the first";
    EXPECT_FALSE(stability("no run", ""));
    for (const ResultRow& row : rows) {
        const bool weak = value_of(row, "variant") == "weak";
        EXPECT_EQ(value_of(row, "factor_of_safety"), weak ? 0.5 : 1.5);
        EXPECT_EQ(value_of(row, "factor_of_safety_liquefied"), weak ? json(0.25) : json());
        EXPECT_EQ(value_of(row, "runout").is_null(), !weak);
        EXPECT_TRUE(value_of(row, "transfer_time").is_null());
        EXPECT_TRUE(value_of(row, "transfer_task").is_null());
        EXPECT_EQ(value_of(row, "trigger"), "");
    }
    EXPECT_EQ(store.points_of(run.id), (std::pair<std::int64_t, std::int64_t>{2, 1}));
    const auto factors = store.factors_of_safety(run.id);
    EXPECT_EQ(factors.at("weak").intact, 0.5);
    EXPECT_EQ(factors.at("weak").liquefied, 0.25);
    EXPECT_EQ(factors.at("strong").liquefied, std::nullopt);
}

TEST_F(StoreTest, StabilityAnalysesAloneAreTheRowsOfTheirRun) {
    Store store(file());
    NewRun run = small_run();
    run.tasks = {alone("lem_tool", "weak"), alone("lem_tool", "strong")};
    store.write([&](Transaction& t) { t.add_run(run); });
    bring_to_success(store, task_id(run.id, 0),
                     {{"factor_of_safety", 0.5}, {"flags", json::array()}});
    const auto rows = store.results(run.id);
    ASSERT_EQ(rows.size(), 2u);
    for (const ResultRow& row : rows) {
        const bool ended = value_of(row, "variant") == "weak";
        EXPECT_EQ(value_of(row, "factor_of_safety"), ended ? json(0.5) : json());
        EXPECT_EQ(value_of(row, "questionable"), ended ? json(false) : json());
    }
    const std::string other = task_id(run.id, 1);
    store.write([&](Transaction& t) {
        t.try_move_task(other, TaskEvent::release);
        t.move_task(other, TaskEvent::claim);
        t.move_attempt(other, t.add_attempt(other), AttemptEvent::submit);
        t.move_task(other, TaskEvent::start);
        t.fail_task(other, TaskEvent::exit_badly, {70, "it broke down"});
    });
    EXPECT_EQ(store.run(run.id)->state, "partial") << "one has its result, and no runout is asked";
}

TEST_F(StoreTest, RowsComeInTheStudysOrderOfVariantsPageByPage) {
    Store store(file());
    NewRun run = small_run();
    run.study = R"({"variants": [{"name": "weak"}, {"name": "medium"}, {"name": "strong"}]})";
    run.tasks.resize(1);
    for (const char* variant : {"medium", "strong", "weak"}) {
        for (const double time : {1.0, 0.5}) {
            const std::string end = "_" + std::to_string(time) + variant;
            run.tasks.push_back({.phase = "transfer_tool",
                                 .label = "transfer" + end,
                                 .transfer_time = time,
                                 .parent = 0,
                                 .release = Release::file_exists,
                                 .input = "snapshot",
                                 .overrides = {},
                                 .variant = variant});
            run.tasks.push_back({.phase = "mpm_solver",
                                 .label = "mpm" + end,
                                 .transfer_time = time,
                                 .parent = run.tasks.size() - 1,
                                 .release = Release::parent_succeeded,
                                 .input = "particles",
                                 .overrides = {},
                                 .variant = variant});
        }
    }
    store.write([&](Transaction& t) { t.add_run(run); });
    const auto places = [](const std::vector<ResultRow>& rows) {
        std::string text;
        for (const ResultRow& row : rows)
            text += value_of(row, "variant").get<std::string>() +
                    (value_of(row, "transfer_time") == 0.5 ? " early, " : " late, ");
        return text;
    };
    EXPECT_EQ(places(store.results(run.id)),
              "weak early, weak late, medium early, medium late, strong early, strong late, ");
    EXPECT_EQ(places(store.results(run.id, {.state = {}, .flag = {}, .from = 1, .most = 3})),
              "weak late, medium early, medium late, ");
    EXPECT_EQ(places(store.results(run.id, {.state = "blocked", .flag = {}, .from = 4})),
              "strong early, strong late, ");
    EXPECT_TRUE(store.results(run.id, {.state = {}, .flag = "still_moving"}).empty());
}

TEST_F(StoreTest, EveryChangeOfStateLeavesItsEventInTheSameTransaction) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) { t.add_run(run); });
    const std::string fem = task_id(run.id, 0);
    const auto before = store.last_event();
    EXPECT_THROW(store.write([&](Transaction& t) {
        t.move_task(fem, TaskEvent::claim);
        t.move_task(fem, TaskEvent::exit_well);
        t.move_task(fem, TaskEvent::claim);  // not from finalizing
    }),
                 IllegalMove);
    EXPECT_EQ(store.task(fem)->state, TaskState::ready);  // nothing of it was kept
    EXPECT_TRUE(store.events_after(before, 10).empty());
    store.write([&](Transaction& t) { t.move_task(fem, TaskEvent::claim); });
    const auto events = store.events_after(before, 10);
    ASSERT_EQ(events.size(), 1u);
    EXPECT_EQ(events[0].detail.at("from"), "ready");
    EXPECT_EQ(events[0].detail.at("to"), "starting");
}

TEST_F(StoreTest, RecentEventsAreThoseOfTheDatabase) {
    Store store(file());
    const auto told = [](const std::vector<Event>& events) {
        json list;
        for (const Event& each : events)
            list.push_back(
                {each.seq, each.time, each.run, each.task.value_or(""), each.kind, each.detail});
        return list;
    };
    // More than are kept, from jobs of which every tenth is rolled back.
    for (int i = 0; i < 100; ++i) {
        try {
            store.write([&](Transaction& t) {
                for (int k = 0; k < 15; ++k) t.add_run(small_run());
                if (i % 10 == 0) throw std::runtime_error("changed my mind");
            });
        } catch (const std::runtime_error&) {
        }
    }
    const std::int64_t last = store.last_event();
    ASSERT_GT(last, 1300);
    Store fresh(file());  // remembers none
    for (const std::int64_t after : {std::int64_t{0}, last - 1001, last - 1000, last - 999,
                                     last - 7, last - 1, last, last + 5})
        for (const std::size_t most : {std::size_t{1}, std::size_t{500}, std::size_t{5000}})
            EXPECT_EQ(told(store.events_after(after, most)), told(fresh.events_after(after, most)))
                << after;
}

TEST_F(StoreTest, OneBadJobInAGroupDoesNotHarmTheOthers) {
    Store store(file());
    std::vector<std::jthread> clients;
    std::atomic<int> refused = 0;
    for (int i = 0; i < 8; ++i) {
        clients.emplace_back([&, i] {
            for (int k = 0; k < 5; ++k) {
                try {
                    store.write([&](Transaction& t) {
                        t.add_run(small_run());
                        if (i == 0) throw std::runtime_error("changed my mind");
                    });
                } catch (const std::runtime_error&) {
                    ++refused;
                }
            }
        });
    }
    clients.clear();
    EXPECT_EQ(refused, 5);
    EXPECT_EQ(store.runs(1000).size(), 35u);
}

/// More pages than memory can restore.
TEST_F(StoreTest, AJobOfThousandsOfTasksIsDoneWholeOrPutBackWhole) {
    Store store(file());
    NewRun run = small_run();
    for (int i = 0; i < 3000; ++i) {
        run.tasks.push_back(run.tasks[2]);
        run.tasks.back().label += "_" + std::to_string(i);
    }
    const auto all = static_cast<std::int64_t>(run.tasks.size());
    store.write([&](Transaction& t) { t.add_run(run); });
    store.write([&](Transaction& t) { t.cancel_run(run.id, "cancel"); });
    EXPECT_EQ(store.tasks_by_state().at("cancelled"), all);
    EXPECT_THROW(store.write([&](Transaction& t) {
        EXPECT_EQ(t.retry_run(run.id), all);
        throw std::runtime_error("changed my mind");
    }),
                 std::runtime_error);
    EXPECT_EQ(store.tasks_by_state().at("cancelled"), all);
    store.write([&](Transaction& t) { t.retry_run(run.id); });
    EXPECT_EQ(store.tasks_by_state().count("cancelled"), 0u);
}

TEST_F(StoreTest, ARetryWhileAProcessIsStillBeingStoppedRunsItsTaskAgain) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) { t.add_run(run); });
    const std::string first = store.tasks_of(run.id).front().id;
    const auto cancelled_and_stopped = [&](bool retried) {
        store.write([&](Transaction& t) {
            t.move_task(first, TaskEvent::claim);
            t.cancel_run(run.id, "test");
        });
        if (retried) store.write([&](Transaction& t) { EXPECT_EQ(t.retry_run(run.id), 3u); });
        EXPECT_EQ(store.task(first)->state, TaskState::cancelling);
        store.write([&](Transaction& t) { EXPECT_TRUE(t.stop_task(first)); });
        return store.task(first)->state;
    };
    EXPECT_EQ(cancelled_and_stopped(true), TaskState::ready);
    EXPECT_EQ(cancelled_and_stopped(false), TaskState::cancelled) << "the last order counts";
    store.write([&](Transaction& t) { EXPECT_FALSE(t.stop_task(first)); });
}

TEST_F(StoreTest, TwoLiveAttemptsOfOneTaskAreRefusedByTheDatabaseItself) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) { t.add_run(run); });
    const std::string fem = task_id(run.id, 0);
    EXPECT_THROW(store.write([&](Transaction& t) {
        t.add_attempt(fem);
        t.add_attempt(fem);
    }),
                 StoreError);
    EXPECT_TRUE(store.attempts_of(fem).empty());
}

TEST_F(StoreTest, StaleAttemptThatEndsLateIsRefused) {
    Store store(file());
    const NewRun run = small_run();
    const std::string fem = task_id(run.id, 0);
    store.write([&](Transaction& t) {
        t.add_run(run);
        t.move_task(fem, TaskEvent::claim);
        const auto first = t.add_attempt(fem);
        t.move_attempt(fem, first, AttemptEvent::vanish);
        t.move_task(fem, TaskEvent::vanish);
        t.move_task_to_retry(fem, TaskEvent::retry, 0, json::object());
        t.move_task(fem, TaskEvent::wait_over);
        t.move_task(fem, TaskEvent::claim);
        t.add_attempt(fem);
    });
    EXPECT_THROW(store.write([&](Transaction& t) { t.move_attempt(fem, 1, AttemptEvent::exit); }),
                 IllegalMove);
    EXPECT_EQ(store.attempts_of(fem).at(1).state, AttemptState::submitting);
}

TEST_F(StoreTest, CancelEndsWhatWaitsAndMarksWhatRuns) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) {
        t.add_run(run);
        t.move_task(task_id(run.id, 0), TaskEvent::claim);
    });
    bool known = false;
    store.write([&](Transaction& t) { known = t.cancel_run(run.id, "test"); });
    EXPECT_TRUE(known);
    EXPECT_EQ(store.task(task_id(run.id, 0))->state, TaskState::cancelling);
    EXPECT_EQ(store.task(task_id(run.id, 1))->state, TaskState::cancelled);
    EXPECT_EQ(store.run(run.id)->state, "running");
    store.write([&](Transaction& t) { known = t.cancel_run("nobody", "test"); });
    EXPECT_FALSE(known);
}

TEST_F(StoreTest, ReopenedStoreKnowsEverything) {
    const NewRun run = small_run();
    std::int64_t seq = 0;
    {
        Store store(file());
        store.write([&](Transaction& t) { t.add_run(run); });
        seq = store.last_event();
    }
    const Store again(file());
    EXPECT_EQ(again.last_event(), seq);
    EXPECT_EQ(again.tasks_of(run.id).size(), 3u);
}

TEST_F(StoreTest, DatabaseOfAnotherVersionIsRefusedAndLeftAsItIs) {
    for (const char* version : {"11", "99"}) {
        { const Store store(file()); }
        Connection database(file(), Access::read_write);
        const std::int64_t own = version_of(database);
        database.script(std::string("PRAGMA user_version=") + version);
        EXPECT_THROW(Store{file()}, StoreError);
        EXPECT_EQ(std::to_string(version_of(database)), version);
        database.script("PRAGMA user_version=" + std::to_string(own));
    }
}

TEST_F(StoreTest, DrawsHaveTheirMeans) {
    { const Store made(file()); }
    {
        Connection database(file(), Access::read_write);
        database.script(
            "INSERT INTO runs (id, name, title, created, study, scene) VALUES ('r', 'old', '', "
            "'2026-01-01T00:00:00.000Z', '{\"draws\": 2, \"variants\": [{\"name\": "
            "\"soft_dam\"}, {\"name\": \"soft_dam_d2\", \"made_by\": \"draws\"}]}', '{}'),"
            "('unnamed', 'old', '', '2026-01-01T00:00:00.000Z', '{\"draws\": 2, \"variants\": "
            "[{\"name\": \"d1\", \"made_by\": \"draws\"}]}', '{}');"
            "INSERT INTO tasks (id, run, phase, label, transfer_time, parent, release, input, "
            "overrides, state, finished, result, variant) VALUES "
            "('r-0', 'r', 'transfer_tool', 'ta', 1, NULL, 'at_once', '', '[]', 'succeeded', '1', "
            "'{}', 'soft_dam'),"
            "('r-1', 'r', 'mpm_solver', 'ma', 1, 'r-0', 'at_once', '', '[]', 'succeeded', '1', "
            "'{\"runout\": 1, \"at_rest\": true}', 'soft_dam'),"
            "('r-2', 'r', 'mpm_solver', 'mb', 1, 'r-0', 'at_once', '', '[]', 'succeeded', '1', "
            "'{\"runout\": 3, \"at_rest\": false, \"flags\": [{\"code\": \"still_moving\", "
            "\"severity\": \"questionable\"}]}', 'soft_dam_d2'),"
            "('r-3', 'r', 'mpm_solver', 'mc', 2, 'r-0', 'at_once', '', '[]', 'succeeded', '1', "
            "'{\"runout\": 5, \"at_rest\": true}', 'soft_dam'),"
            "('r-4', 'r', 'mpm_solver', 'md', 2, 'r-0', 'at_once', '', '[]', 'failed', '1', NULL, "
            "'soft_dam_d2');"
            "UPDATE tasks SET result = result WHERE result IS NOT NULL");
    }
    const Store store(file());
    const std::vector<ResultRow> means = store.means("r");
    ASSERT_EQ(means.size(), 2u);
    const auto value = [&](std::size_t row, std::string_view name) {
        return value_of(means[row], name, mean_columns());
    };
    EXPECT_EQ(value(0, "variant"), "soft_dam");
    EXPECT_EQ(value(0, "runout"), 2.0);
    EXPECT_NEAR(value(0, "runout_deviation").get<double>(), std::sqrt(2.0), 1e-15);
    EXPECT_EQ(value(0, "state"), "questionable");
    EXPECT_EQ(value(0, "questionable_draws"), "soft_dam_d2");
    EXPECT_EQ(value(0, "lower_bound"), true);
    EXPECT_TRUE(value(0, "volume_ratio").is_null());
    EXPECT_EQ(value(1, "lower_bound"), false);
    EXPECT_EQ(value(1, "state"), "partial");
    EXPECT_EQ(value(1, "runout"), 5.0);
    EXPECT_TRUE(value(1, "runout_deviation").is_null());
    EXPECT_EQ(value(1, "missing_draws"), "soft_dam_d2: failed");
    EXPECT_TRUE(store.means("nobody").empty());
    EXPECT_EQ(store.repeated_variants("r"),
              (std::map<std::string, std::string>{{"soft_dam", "soft_dam"},
                                                  {"soft_dam_d2", "soft_dam"}}));
    EXPECT_EQ(store.repeated_variants("unnamed"), (std::map<std::string, std::string>{{"d1", ""}}));
}

TEST_F(StoreTest, RowsAreReadByNameInAnyOrder) {
    Connection database(file(), Access::read_write);
    const std::string sql =
        "SELECT value AS a, value + 1 AS b, nullif(value, 2) AS c FROM json_each(?)";
    const auto rows = database.select(sql, {"[1, 2, 3]"}, [](const Row& row) {
        const auto c = row.optional_integer("c");  // of two rows different columns are asked for
        return std::pair{row.integer("b"), c ? row.integer("a") : row.integer("b")};
    });
    const std::vector<std::pair<std::int64_t, std::int64_t>> expected{{2, 1}, {3, 3}, {4, 3}};
    EXPECT_EQ(rows, expected);
    EXPECT_EQ(database.first(sql, {"[]"}, [](const Row& row) { return row.integer("a"); }),
              std::nullopt);
    EXPECT_EQ(database.integer("SELECT NULL"), std::nullopt);
    EXPECT_EQ(database.texts("SELECT value FROM json_each(?)", {"[7, \"x\"]"}),
              (std::vector<std::string>{"7", "x"}));
    try {
        database.query(sql, {"[1]"}, [](const Row& row) { row.text("d"); });
        FAIL() << "the statement has no d";
    } catch (const std::logic_error& error) {
        EXPECT_NE(std::string(error.what()).find("no column d"), std::string::npos);
    }
}

TEST_F(StoreTest, ViewsAreThoseOfTheProgramInAnyDatabase) {
    { const Store store(file()); }
    Connection(file(), Access::read_write)
        .script("DROP VIEW sweep_results; CREATE VIEW sweep_results AS SELECT 1 AS outdated");
    const Store store(file());
    EXPECT_TRUE(store.results("nobody").empty());
    const auto names = Connection(file(), Access::read_only)
                           .texts("SELECT name FROM pragma_table_info('sweep_results')");
    const std::set<std::string> columns(names.begin(), names.end());
    for (const ResultColumn& each : result_columns()) {
        // The error comes from other runs; the service computes it outside the database.
        const std::string_view name = each.name;
        const bool worked_out = name.starts_with("runout_error") || name == "lower_bound";
        EXPECT_EQ(columns.contains(each.name), !worked_out) << each.name;
    }
    EXPECT_FALSE(columns.contains("outdated"));
}

TEST_F(StoreTest, CountsOfARunAreAlwaysThoseOfItsTasks) {
    Store store(file());
    const NewRun run = small_run();
    store.write([&](Transaction& t) { t.add_run(run); });
    const auto agrees = [&] {
        Connection database(file(), Access::read_only);
        return database.integer(
                   "SELECT total=count(*) AND ended=count(tasks.finished) AND reached=sum(state IN "
                   "('succeeded','cached')) AND failed=sum(state IN ('failed','skipped')) AND "
                   "run_counts.cancelled=sum(state='cancelled') AND runouts=sum(phase='mpm_solver' "
                   "AND "
                   "state IN ('succeeded','cached')) FROM run_counts JOIN tasks USING (run)",
                   {}) == 1;
    };
    EXPECT_TRUE(agrees());
    store.write([&](Transaction& t) { t.cancel_run(run.id, "test"); });
    EXPECT_TRUE(agrees());
    EXPECT_EQ(store.run(run.id)->state, "cancelled");
    store.write([&](Transaction& t) { EXPECT_EQ(t.retry_run(run.id), 3u); });
    EXPECT_TRUE(agrees());
    EXPECT_EQ(store.run(run.id)->state, "queued");
    for (const Task& task : store.tasks_of(run.id)) {
        bring_to_success(store, task.id, {{"runout", 1.0}});
        EXPECT_TRUE(agrees());
    }
    EXPECT_EQ(store.run(run.id)->state, "succeeded");
    EXPECT_EQ(store.run(run.id)->tasks_done, 3);
}

TEST_F(StoreTest, ReaderWokenByANewEventSeesIt) {
    Store store(file());
    EXPECT_FALSE(store.wait_for_event(0, std::chrono::milliseconds(10)));
    std::jthread writer([&] { store.write([&](Transaction& t) { t.add_run(small_run()); }); });
    ASSERT_TRUE(store.wait_for_event(0, std::chrono::seconds(10)));
    EXPECT_EQ(store.events_after(0, 10).size(), 1u);
}

TEST(Identity, RunIdsAscendAndDiffer) {
    const std::string first = new_run_id();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const std::string second = new_run_id();
    EXPECT_EQ(first.size(), 26u);
    EXPECT_LT(first, second);
    EXPECT_LT(task_id(first, 9), task_id(first, 10));
}

}  // namespace
}  // namespace breach::orchestrator::store_test
