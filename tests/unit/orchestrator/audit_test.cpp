// breachline check, and databases of every earlier version (databases/): migrated, they are sound and
// say what they said.
#include "services/orchestrator/audit/audit.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/exchange/provenance.hpp"
#include "core/exchange/publish.hpp"
#include "core/scene/reading.hpp"
#include "services/orchestrator/store/migrations.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator::audit_test {
namespace {

namespace fs = std::filesystem;

class AuditTest : public ::testing::Test {
  protected:
    AuditTest() : data_(fs::path(::testing::TempDir()) / unique()) {
        fs::create_directories(data_.runs());
    }
    ~AuditTest() override { fs::remove_all(data_.root()); }

    static std::string unique() {
        return std::string("audit_") + std::to_string(getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name();
    }

    void make_database(const std::string& sql) const {
        Connection(data_.database(), Access::read_write).script(sql);
    }
    void make_version(int version) const {
        make_database(scene::text_of(BREACH_ROOT "/tests/unit/orchestrator/databases/version_" +
                                     std::to_string(version) + ".sql"));
    }
    /// Files that are what the database says of them.
    void make_outputs() const {
        std::vector<std::pair<fs::path, std::string>> outputs;
        Connection database(data_.database(), Access::read_write);
        database.query("SELECT run, label, name, task FROM artifacts JOIN tasks ON tasks.id=task",
                       {}, [&](const Row& row) {
                           outputs.emplace_back(
                               data_.output(row.text(0), row.text(1)) / row.text(2), row.text(3));
                       });
        fs::create_directories(data_.files());
        database.query("SELECT file FROM files", {}, [&](const Row& row) {
            exchange::publish_text(data_.files() / row.text(0), "record");
        });
        for (const auto& [file, task] : outputs) {
            fs::create_directories(file.parent_path());
            exchange::publish_text(file, task);
            database.change(
                "UPDATE artifacts SET bytes=?, sha256=? WHERE task=?",
                {static_cast<std::int64_t>(task.size()), exchange::sha256_of_file(file), task});
        }
    }
    std::vector<std::string> parts(Look look = Look::at_contents) const {
        std::vector<std::string> found;
        for (const Finding& each : audited(data_, look).findings) found.push_back(each.part);
        return found;
    }
    using Parts = std::vector<std::string>;

    DataPaths data_;
};

class AuditOfVersion : public AuditTest, public ::testing::WithParamInterface<int> {};

TEST_P(AuditOfVersion, IsOldThenMigratedThenSound) {
    make_version(GetParam());
    const Audit old = audited(data_, Look::at_contents);
    ASSERT_EQ(old.findings.size(), 1u) << old.findings.back().cause;
    EXPECT_NE(old.findings[0].remedy.find("start the service once"), std::string::npos);
    EXPECT_EQ(old.version, GetParam());
    {
        const Store store(data_.database());
        EXPECT_EQ(store.run("r1")->state, "questionable");
        EXPECT_EQ(store.run("r1bad")->state, "failed");
        EXPECT_EQ(store.run("r1open")->state, "queued");
        ASSERT_EQ(store.results("r1").size(), 2u);
        EXPECT_EQ(store.tasks_to_start({}, 10).at(0).id, "r1open-00000");
        if (GetParam() >= 2) {
            EXPECT_EQ(store.run_of_key("key-2")->run, "r2again");
            EXPECT_EQ(store.run("r2off")->state, "cancelled");
            EXPECT_TRUE(store.recipe(std::string(62, '0') + "4d"));
        }
        if (GetParam() >= 3) {
            EXPECT_EQ(store.firings_of("r1").size(), 1u);
        }
        if (GetParam() >= 6) {
            EXPECT_EQ(store.run("r6")->state, "questionable");
            EXPECT_EQ(store.results("r6").size(), 2u);
        }
        if (GetParam() >= 7) {
            EXPECT_EQ(store.run("r7")->state, "partial");
        }
        if (GetParam() >= 9) {
            EXPECT_EQ(store.means("r9").size(), 1u);
        }
        if (GetParam() >= 10) {
            EXPECT_TRUE(store.run("r9")->pinned);
            EXPECT_EQ(store.files_of("r9").size(), 1u);
        }
        double spent = 0.0;
        for (const Task& each : store.tasks_of("r1"))
            for (const Attempt& attempt : store.attempts_of(each.id))
                spent += attempt.cpu_seconds.value_or(0.0);
        EXPECT_DOUBLE_EQ(store.run("r1")->spent, spent);
    }
    EXPECT_TRUE(fs::exists(data_.database().string() + ".before_version_" +
                           std::to_string(newest_version())));
    make_outputs();
    for (const Finding& each : audited(data_, Look::at_contents).findings)
        ADD_FAILURE() << each.part << ": " << each.where << ": " << each.cause;
}

INSTANTIATE_TEST_SUITE_P(Of, AuditOfVersion, ::testing::Range(1, 11));

TEST(Databases, OfEveryEarlierVersionAreKept) {
    EXPECT_EQ(newest_version(), 11) << "keep one of the version before: databases/, AuditOfVersion";
}

class AuditOfDamage : public AuditTest {
  protected:
    AuditOfDamage() {
        make_version(9);
        { const Store migrated(data_.database()); }
        make_outputs();
    }
};

TEST_F(AuditOfDamage, FindsOutputsThatAreNotWhatWasStored) {
    ASSERT_EQ(parts(), Parts{});
    const fs::path file = data_.output("r1", "fem") / "result.json";
    std::ofstream(file) << "r1-0000X";
    EXPECT_EQ(parts(Look::at_sizes), Parts{}) << "as many bytes as before";
    EXPECT_EQ(parts(), Parts{"output"});
    fs::remove(file);
    EXPECT_EQ(parts(Look::at_sizes), Parts{"output"});
}

TEST_F(AuditOfDamage, FindsAHistoryThatTheTablesDoNotTell) {
    Connection(data_.database(), Access::read_write)
        .script(
            "UPDATE events SET detail=json_set(detail, '$.to', 'failed') WHERE task='r1-00000' "
            "AND json_extract(detail, '$.event')='keep_outputs'");
    EXPECT_EQ(parts(), (Parts{"history", "history"}))
        << "no such move, and the task's state is another";
}

TEST_F(AuditOfDamage, FindsDamageToTheDatabaseItself) {
    Connection(data_.database(), Access::read_write)
        .script("PRAGMA foreign_keys=OFF; DELETE FROM recipes");
    const Parts found = parts();
    EXPECT_FALSE(found.empty());
    EXPECT_EQ(found.front(), "database");
    Connection(data_.database(), Access::read_write).script("PRAGMA user_version=99");
    const Audit newer = audited(data_, Look::at_sizes);
    EXPECT_NE(newer.findings.at(0).remedy.find("program that made it"), std::string::npos);
}

TEST_F(AuditOfDamage, MendsStraysAndCountsAndLosesNothing) {
    fs::create_directories(data_.runs() / "nobodys" / "fem");
    exchange::publish_text(data_.runs() / "nobodys" / "fem" / "output", "kept");
    fs::create_directories(data_.run("r1") / "no_task");
    fs::create_directories(data_.files());
    exchange::publish_text(data_.files() / "left.at2", "kept");
    Connection(data_.database(), Access::read_write)
        .script("UPDATE run_counts SET ended=0 WHERE run='r1'");
    const Audit before = audited(data_, Look::at_sizes);
    EXPECT_EQ(before.findings.size(), 4u);
    EXPECT_EQ(parts().size(), 4u) << "looking changes nothing";
    {
        const DataFolder owned(data_.root());
        EXPECT_EQ(audited(static_cast<const DataPaths&>(owned), Look::at_sizes).findings.size(), 1u)
            << "beside a service, what is young is passed over";
        mend(owned, audited(owned, Look::at_sizes).findings);
        EXPECT_TRUE(audited(owned, Look::at_contents).findings.empty());
    }
    EXPECT_EQ(scene::text_of(data_.root() / "strays/runs/nobodys/fem/output"), "kept");
    EXPECT_EQ(scene::text_of(data_.root() / "strays/files/left.at2"), "kept");
    EXPECT_EQ(Store(data_.database()).run("r1")->tasks_done, 5);
}

TEST_F(AuditTest, WantsAFolderOfAService) {
    EXPECT_THROW(audited(data_, Look::at_sizes), fault::BadInput);
}

}  // namespace
}  // namespace breach::orchestrator::audit_test
