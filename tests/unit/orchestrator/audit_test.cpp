// breachline check on a database with rows of every kind (audit_rows.sql), valid and damaged.
#include "services/orchestrator/audit/audit.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "core/exchange/provenance.hpp"
#include "core/exchange/publish.hpp"
#include "core/scene/reading.hpp"
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
    /// Creates the files that the database lists.
    void make_outputs() const {
        Connection database(data_.database(), Access::read_write);
        const auto outputs = database.select(
            "SELECT run, label, name, task FROM artifacts JOIN tasks ON tasks.id=task", {},
            [&](const Row& row) {
                return std::pair{
                    data_.output(row.text("run"), row.text("label")) / row.text("name"),
                    row.text("task")};
            });
        fs::create_directories(data_.files());
        for (const std::string& each : database.texts("SELECT file FROM files"))
            exchange::publish_text(data_.files() / each, "record");
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
        for (const Inconsistency& each : audited(data_, look).inconsistencies)
            found.push_back(each.part);
        return found;
    }
    using Parts = std::vector<std::string>;

    DataPaths data_;
};

TEST_F(AuditTest, ADatabaseOfAnotherVersionIsNamedAndLeftAlone) {
    { const Store store(data_.database()); }
    make_database("PRAGMA user_version=11");
    const Audit audit = audited(data_, Look::at_contents);
    ASSERT_EQ(audit.inconsistencies.size(), 1u);
    EXPECT_NE(audit.inconsistencies[0].cause.find("breach export"), std::string::npos);
    EXPECT_THROW(Store{data_.database()}, StoreError);
}

class AuditOfDamage : public AuditTest {
  protected:
    AuditOfDamage() {
        { const Store store(data_.database()); }
        make_database(scene::text_of(BREACH_ROOT "/tests/unit/orchestrator/audit_rows.sql"));
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

TEST_F(AuditOfDamage, FindsDamageToTheDatabaseItself) {
    Connection(data_.database(), Access::read_write)
        .script("PRAGMA foreign_keys=OFF; DELETE FROM recipes");
    const Parts found = parts();
    EXPECT_FALSE(found.empty());
    EXPECT_EQ(found.front(), "database");
    Connection(data_.database(), Access::read_write).script("PRAGMA user_version=99");
    const Audit newer = audited(data_, Look::at_sizes);
    EXPECT_NE(newer.inconsistencies.at(0).remedy.find("program that made it"), std::string::npos);
}

TEST_F(AuditOfDamage, FindsEachCountThatIsWrong) {
    for (const std::string count :
         {"total", "ended", "reached", "failed", "cancelled", "runouts"}) {
        const auto add = [&](const char* what) {
            make_database("UPDATE run_counts SET " + count + "=" + count + what +
                          " WHERE run='r1'");
        };
        add("+1");
        EXPECT_EQ(parts(), Parts{"counts"}) << count;
        add("-1");
    }
    EXPECT_EQ(parts(), Parts{});
}

TEST_F(AuditOfDamage, RepairsStraysAndCountsAndLosesNothing) {
    fs::create_directories(data_.runs() / "nobodys" / "fem");
    exchange::publish_text(data_.runs() / "nobodys" / "fem" / "output", "kept");
    fs::create_directories(data_.run("r1") / "no_task");
    fs::create_directories(data_.files());
    exchange::publish_text(data_.files() / "left.at2", "kept");
    Connection(data_.database(), Access::read_write)
        .script("UPDATE run_counts SET ended=0 WHERE run='r1'");
    const Audit before = audited(data_, Look::at_sizes);
    EXPECT_EQ(before.inconsistencies.size(), 4u);
    EXPECT_EQ(parts().size(), 4u) << "looking changes nothing";
    {
        const DataFolder owned(data_.root());
        EXPECT_EQ(
            audited(static_cast<const DataPaths&>(owned), Look::at_sizes).inconsistencies.size(),
            1u)
            << "beside a service, what is young is passed over";
        mend(owned, audited(owned, Look::at_sizes).inconsistencies);
        EXPECT_TRUE(audited(owned, Look::at_contents).inconsistencies.empty());
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
