// What the store keeps of a removed run, and the space that its file releases.
#include <gtest/gtest.h>

#include <filesystem>

#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/store/store.hpp"
#include "tests/folder.hpp"
#include "tests/unit/orchestrator/small_run.hpp"

namespace breach::orchestrator::removal_store_test {
namespace {

class RemovalStore : public ::testing::Test {
  protected:
    std::filesystem::path file() const { return folder_ / "test.db"; }

    /// A completed run with rows in every table.
    static std::string whole_run(Store& store) {
        NewRun run = small_run();
        run.study = R"({"variants": [{"name": "a"}], "draws": 2})";
        run.triggers = {{.name = "now", .kind = "manual", .spec = {{"kind", "manual"}}}};
        run.firing_plan = run.tasks;
        run.recipes = {{std::string(64, 'e'), "fem_solver", 1, "{}"}};
        run.tasks[0].recipe = std::string(64, 'e');
        store.write([&](Transaction& t) {
            t.add_run(run);
            t.keep_idempotency_key("key-" + run.id, std::string(64, 'b'), run.id);
            t.move_task(task_id(run.id, 0), TaskEvent::claim);
            t.add_attempt(task_id(run.id, 0));
        });
        return run.id;
    }

    static void end(Store& store, const std::string& run) {
        store.write([&](Transaction& t) {
            t.cancel_run(run, "");
            t.move_attempt(task_id(run, 0), 1, AttemptEvent::vanish);
            t.move_task(task_id(run, 0), TaskEvent::stopped);
            t.keep_remains(task_id(run, 0), {{task_id(run, 0), "x", std::string(64, 'c'), 1}}, "");
        });
    }

    static Removal removed(Store& store, const std::string& run) {
        Removal outcome = Removal::unknown;
        store.write([&](Transaction& t) { outcome = t.remove_run(run, "test"); });
        return outcome;
    }

    std::map<std::string, std::int64_t> rows() const {
        Connection database(file(), Access::read_only);
        std::map<std::string, std::int64_t> counts;
        for (const std::string& each :
             database.texts("SELECT name FROM sqlite_master WHERE type='table'"))
            counts[each] = database.integer("SELECT count(*) FROM " + each).value();
        return counts;
    }

    const test::Folder folder_;
};

TEST_F(RemovalStore, TakesEveryRowOfARunAndNoneOfAnother) {
    Store store(file());
    const std::string other = whole_run(store);
    end(store, other);
    const auto before = rows();
    const std::string run = whole_run(store);
    EXPECT_EQ(removed(store, run), Removal::going_on);
    end(store, run);
    EXPECT_EQ(removed(store, run), Removal::done);
    EXPECT_EQ(removed(store, run), Removal::unknown);
    for (const Event& each : store.events_after(0, 1000))
        EXPECT_TRUE(each.run == other || each.detail.at("event") == "remove");
    EXPECT_EQ(store.removals(), std::vector<std::string>{run});
    store.write([&](Transaction& t) { t.forget_removal(run); });
    auto after = rows();
    EXPECT_EQ(after.at("events"), before.at("events") + 1) << "the removal itself";
    for (const auto& [table, count] : before)
        if (table != "events" && table != "sqlite_sequence") {
            EXPECT_EQ(after.at(table), count) << table;
        }
    EXPECT_EQ(store.run(other)->state, "cancelled");
    EXPECT_EQ(removed(store, other), Removal::done);
    EXPECT_EQ(rows().at("recipes"), 0) << "nobody asks for it any more";
}

// One of two equal runs is removed before the other's trigger has fired.
TEST_F(RemovalStore, LeavesRecipesThatATriggerOfAnotherRunHasStillToUse) {
    Store store(file());
    const auto waiting_run = [&] {
        NewRun run = small_run();
        run.recipes = {{std::string(64, 'f'), "mpm_solver", 1, "{}"}};
        run.firing_plan = run.tasks;
        for (TaskPlan& each : run.firing_plan) each.recipe = std::string(64, 'f');
        store.write([&](Transaction& t) { t.add_run(run); });
        return run.id;
    };
    const std::string first = waiting_run(), second = waiting_run();
    for (const std::string& each : {first, second})
        store.write([&](Transaction& t) { t.cancel_run(each, ""); });
    EXPECT_EQ(removed(store, first), Removal::done);
    EXPECT_EQ(rows().at("recipes"), 1);
    EXPECT_EQ(removed(store, second), Removal::done);
    EXPECT_EQ(rows().at("recipes"), 0);
}

TEST_F(RemovalStore, OpenTriggerKeepsARunFromBeingOver) {
    Store store(file());
    const std::string run = whole_run(store);
    end(store, run);
    store.write([&](Transaction& t) {
        t.add_trigger(run, task_id(run, 0),
                      {.name = "later", .kind = "manual", .spec = {{"kind", "manual"}}});
    });
    EXPECT_EQ(removed(store, run), Removal::going_on);
}

TEST_F(RemovalStore, EventsGoOnCountingUpwards) {
    std::int64_t seq = 0;
    {
        Store store(file());
        const std::string run = whole_run(store);
        end(store, run);
        EXPECT_EQ(removed(store, run), Removal::done);
        seq = store.last_event();
    }
    Store store(file());
    EXPECT_EQ(store.last_event(), seq);
    whole_run(store);
    EXPECT_GT(store.events_after(seq, 1).at(0).seq, seq);
}

TEST_F(RemovalStore, TheDatabaseShrinks) {
    Store store(file());
    std::vector<std::string> runs;
    for (int i = 0; i < 200; ++i) runs.push_back(whole_run(store));
    for (const std::string& each : runs) end(store, each);
    const auto pages = [&] {
        return Connection(file(), Access::read_only).integer("PRAGMA page_count").value();
    };
    const std::int64_t full = pages();
    for (const std::string& each : runs) {
        removed(store, each);
        store.write([&](Transaction& t) { t.forget_removal(each); });
    }
    EXPECT_GT(store.free_pages(), full / 2);
    while (store.free_pages() > 0) store.write([](Transaction& t) { t.shrink(50); });
    EXPECT_LT(pages(), full / 2) << "of " << full;
}

}  // namespace
}  // namespace breach::orchestrator::removal_store_test
