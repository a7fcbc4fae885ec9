// Requirements of every executor, tested on each: local, fake Slurm, real Slurm (with_slurm.py
// starts it and sets BREACH_REAL_SLURM).
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <thread>

#include "core/fault/fault.hpp"
#include "services/orchestrator/executors/local_executor.hpp"
#include "services/orchestrator/executors/slurm_executor.hpp"

namespace breach::orchestrator {
namespace {

namespace fs = std::filesystem;

bool eventually(const std::function<bool()>& condition, double seconds = 60) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return true;
}

/// The number that a phase wrote to a file; 0 if none.
pid_t pid_in(const fs::path& file) {
    pid_t pid = 0;
    std::ifstream(file) >> pid;
    return pid;
}

bool is_alive(pid_t pid) {
    std::ifstream stream("/proc/" + std::to_string(pid) + "/stat");
    std::string line;
    if (!std::getline(stream, line)) return false;
    return line.substr(line.rfind(')') + 2, 1) != "Z";
}

pid_t parent_of(pid_t pid) {
    std::ifstream stream("/proc/" + std::to_string(pid) + "/stat");
    std::string word;
    pid_t parent = 0;
    stream >> word >> word >> word >> parent;
    return parent;
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class ExecutorConformance : public ::testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        std::string pattern = fs::temp_directory_path() / "breach-executor-XXXXXX";
        root_ = mkdtemp(pattern.data());
        fs::permissions(root_, fs::perms::others_exec | fs::perms::group_exec,
                        fs::perm_options::add);
        path_before_ = std::getenv("PATH");
        if (GetParam() == std::string("FakeSlurm")) {
            setenv("FAKE_SLURM", (root_ / "slurm").c_str(), 1);
            setenv("PATH", (std::string(BREACH_ROOT) + "/tests/slurm/fake:" + path_before_).c_str(),
                   1);
        }
        executor_ = made();
    }

    void TearDown() override {
        for (const AttemptFolder& each : submitted_) {
            executor_->clear_away(each, attempt_of(each));
            EXPECT_TRUE(eventually([&] { return !is_held(each.lock()); })) << each.root;
        }
        executor_.reset();
        EXPECT_TRUE(eventually([&] { return !is_held(root_ / "slurm/runners"); }));
        setenv("PATH", path_before_.c_str(), 1);
        fs::remove_all(root_);
    }

    std::unique_ptr<Executor> made() const {
        const fs::path self = fs::path(BREACH_BIN) / "breachline";
        if (GetParam() == std::string("Local")) return std::make_unique<LocalExecutor>(self);
        return std::make_unique<SlurmExecutor>(
            SlurmSettings{
                .options = {}, .poll_seconds = 0.2, .grace_seconds = 2, .command_seconds = 10},
            self);
    }

    AttemptFolder folder(int number = 1) const {
        return {root_ / "task/attempts" / std::to_string(number)};
    }
    static std::string attempt_of(const AttemptFolder& folder) {
        return "run-00000." + folder.root.filename().string() + "." +
               folder.root.parent_path().parent_path().parent_path().filename().string().substr(16);
    }
    /// The phase of these tests: a shell command in a scratch folder.
    void submit(const AttemptFolder& where, const std::string& what, double grace_seconds = 0.3) {
        submitted_.push_back(where);
        executor_->submit(where, {.attempt = attempt_of(where),
                                  .program = "/bin/sh",
                                  .arguments = {"-c", "cd " + root_.string() + "; " + what},
                                  .grace_seconds = grace_seconds});
    }
    bool becomes(const AttemptFolder& where, Life wanted) {
        return eventually([&] { return executor_->probe(where).life == wanted; });
    }
    /// `what` writes the file `pids` when its processes run.
    void clear_away_reaches_all_of(const std::string& what) {
        submit(folder(), what);
        ASSERT_TRUE(eventually([&] { return pid_in(root_ / "pids") > 0; }));
        executor_->clear_away(folder(), attempt_of(folder()));
        EXPECT_TRUE(eventually([&] { return !is_held(folder().lock()); }, 10));
    }

    fs::path root_;
    std::unique_ptr<Executor> executor_;
    std::vector<AttemptFolder> submitted_;
    std::string path_before_;
};

TEST_P(ExecutorConformance, OrderIsRunAndItsEndRecorded) {
    submit(folder(), "echo a line; echo a word >&2; exit 65");
    ASSERT_TRUE(becomes(folder(), Life::ended));
    const ExitRecord record = *read_exit_record(folder());
    EXPECT_EQ(record.attempt, attempt_of(folder()));
    EXPECT_EQ(record.exit_code, 65);
    EXPECT_FALSE(record.signal);
    EXPECT_FALSE(record.stopped);
    EXPECT_EQ(text_of(folder().lines()), "a line\n");
    EXPECT_NE(text_of(folder().log()).find("a word\n"), std::string::npos);
}

TEST_P(ExecutorConformance, EndBySignalIsRecordedAsSuch) {
    submit(folder(), "kill -9 $$");
    ASSERT_TRUE(becomes(folder(), Life::ended));
    EXPECT_EQ(read_exit_record(folder())->signal, SIGKILL);
    EXPECT_FALSE(read_exit_record(folder())->exit_code);
}

TEST_P(ExecutorConformance, AttemptThatWasNeverSubmittedIsGone) {
    fs::create_directories(folder().root);
    EXPECT_EQ(executor_->probe(folder()).life, Life::gone);
}

TEST_P(ExecutorConformance, SameAttemptIsNotTakenTwice) {
    submit(folder(), "echo $$ >>pids; sleep 300");
    ASSERT_TRUE(becomes(folder(), Life::alive));
    EXPECT_THROW(submit(folder(), "echo $$ >>pids; sleep 300"), fault::IoError);
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "pids") > 0; }));
    const std::string lines = text_of(root_ / "pids");
    EXPECT_EQ(std::ranges::count(lines, '\n'), 1);
}

TEST_P(ExecutorConformance, RemainsOfAnAttemptThatTheStoreDoesNotKnowAreNotTheEndOfTheNext) {
    submit(folder(), "echo old; exit 3");
    ASSERT_TRUE(becomes(folder(), Life::ended));
    ASSERT_TRUE(eventually([&] { return !is_held(folder().lock()); }));
    write_stop(folder(), StopReason::cancel);
    executor_.reset();
    executor_ = made();  // as after restoring the store from a backup
    submit(folder(), "echo new; echo $$ >near; while [ ! -e go ]; do sleep 0.05; done; exit 5");
    EXPECT_NE(executor_->probe(folder()).life, Life::ended);
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "near") > 0; }));
    EXPECT_NE(executor_->probe(folder()).life, Life::ended);
    std::ofstream(root_ / "go") << "\n";
    ASSERT_TRUE(becomes(folder(), Life::ended));
    EXPECT_EQ(read_exit_record(folder())->exit_code, 5);
    EXPECT_FALSE(read_exit_record(folder())->stopped);
    EXPECT_EQ(text_of(folder().lines()), "new\n");
}

TEST_P(ExecutorConformance, ClearingAwayReachesWhatIsForkedMeanwhile) {
    clear_away_reaches_all_of(
        "for i in 0 1 2 3 4 5 6 7 8 9; do for j in 0 1 2 3 4 5 6 7 8 9; do sleep 300 & "
        "echo $! >>pids; done; done; wait");
}

TEST_P(ExecutorConformance, ClearingAwayReachesWhatIsBetweenTwoPrograms) {
    clear_away_reaches_all_of(
        "echo 'echo $$ >pids; exec /bin/sh again' >again; "
        "for i in 0 1 2 3 4 5 6 7; do /bin/sh again & done; wait");
}

TEST_P(ExecutorConformance, StopReachesATreeThatIgnoresTermAndHasLeftItsSession) {
    submit(folder(),
           "trap '' TERM; setsid sh -c 'trap \"\" TERM; echo $$ >far; sleep 300' & "
           "echo $$ >near; wait; sleep 300");
    ASSERT_TRUE(
        eventually([&] { return pid_in(root_ / "far") > 0 && pid_in(root_ / "near") > 0; }));
    executor_->stop(folder(), StopReason::cancel);
    ASSERT_TRUE(becomes(folder(), Life::ended));
    EXPECT_EQ(read_exit_record(folder())->stopped, StopReason::cancel);
    EXPECT_FALSE(is_alive(pid_in(root_ / "far")));
    EXPECT_FALSE(is_alive(pid_in(root_ / "near")));
}

TEST_P(ExecutorConformance, ThoseWhoAskWhetherItLivesPutNoSupervisorOff) {
    std::jthread asker([&](const std::stop_token& enough) {
        while (!enough.stop_requested()) is_held(folder().lock());
    });
    submit(folder(), "exit 0");
    ASSERT_TRUE(becomes(folder(), Life::ended));
    EXPECT_EQ(read_exit_record(folder())->exit_code, 0);
}

TEST_P(ExecutorConformance, PhaseThatEndsOnTermIsNotKilled) {
    submit(folder(), "trap 'kill $!; exit 143' TERM; sleep 300 & echo $$ >near; wait", 20);
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "near") > 0; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    executor_->stop(folder(), StopReason::cancel);
    ASSERT_TRUE(becomes(folder(), Life::ended));
    EXPECT_EQ(read_exit_record(folder())->exit_code, 143);
}

TEST_P(ExecutorConformance, TermFromElsewhereEndsThePhaseAndIsNoWordOfTheService) {
    submit(folder(),
           "trap 'kill $!; exit 143' TERM; sleep 300 & echo $$ >near; echo $PPID >above; wait", 20);
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "above") > 0; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    // Slurm may signal only the job's shell, the parent of the supervisor.
    const pid_t supervisor = pid_in(root_ / "above");
    kill(GetParam() == std::string("Local") ? supervisor : parent_of(supervisor), SIGTERM);
    ASSERT_TRUE(becomes(folder(), Life::ended));
    const auto record = read_exit_record(folder());
    EXPECT_EQ(record->exit_code, 143);
    EXPECT_EQ(record->stopped, StopReason::signal);
}

TEST_P(ExecutorConformance, StoppedPhaseIsAliveAndCanBeEnded) {
    submit(folder(), "echo $$ >near; sleep 300");
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "near") > 0; }));
    kill(pid_in(root_ / "near"), SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(executor_->probe(folder()).life, Life::alive);
    executor_->stop(folder(), StopReason::cancel);
    EXPECT_TRUE(becomes(folder(), Life::ended));
    EXPECT_FALSE(is_alive(pid_in(root_ / "near")));
}

TEST_P(ExecutorConformance, NextServiceFindsARunningAttemptAndItsEnd) {
    submit(folder(), "echo $$ >near; while [ ! -e go ]; do sleep 0.05; done; exit 0");
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "near") > 0; }));
    executor_ = made();
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(executor_->probe(folder()).life, Life::alive);
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    std::ofstream(root_ / "go") << "\n";
    ASSERT_TRUE(becomes(folder(), Life::ended));
    EXPECT_EQ(read_exit_record(folder())->exit_code, 0);
}

TEST_P(ExecutorConformance, KilledSupervisorIsNoticedAndItsPhaseDiesWithIt) {
    submit(folder(), "echo $$ >near; echo $PPID >above; sleep 300");
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "above") > 0; }));
    kill(pid_in(root_ / "above"), SIGKILL);
    ASSERT_TRUE(becomes(folder(), Life::gone));
    const std::string why = executor_->probe(folder()).why;
    EXPECT_FALSE(why.empty());
    if (GetParam() != std::string("Local")) {
        EXPECT_NE(why.find("--slurm-option=--time=HH:MM:SS"), std::string::npos) << why;
        EXPECT_NE(why.find("\"memory_MB\": "), std::string::npos) << why;
    }
    EXPECT_FALSE(is_alive(pid_in(root_ / "near")));
}

TEST_P(ExecutorConformance, GivenUpAttemptIsEnded) {
    submit(folder(), "trap '' TERM; echo $$ >near; sleep 300 & wait; sleep 300");
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "near") > 0; }));
    executor_->clear_away(folder(), attempt_of(folder()));
    EXPECT_TRUE(eventually([&] { return !is_alive(pid_in(root_ / "near")); }));
}

TEST_P(ExecutorConformance, TwoAttemptsOfATaskNeverRunTogether) {
    submit(folder(1), "echo $$ >first; while [ ! -e go ]; do sleep 0.05; done");
    ASSERT_TRUE(eventually([&] { return pid_in(root_ / "first") > 0; }));
    submit(folder(2), "[ -e go ] && echo $$ >second");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    EXPECT_FALSE(fs::exists(folder(2).lines()));  // its phase has not started
    std::ofstream(root_ / "go") << "\n";
    EXPECT_TRUE(becomes(folder(1), Life::ended));
    EXPECT_TRUE(becomes(folder(2), Life::ended));
    EXPECT_GT(pid_in(root_ / "second"), 0);
}

class OrderFile : public ::testing::Test {
  protected:
    void SetUp() override {
        std::string pattern = fs::temp_directory_path() / "breach-order-XXXXXX";
        folder_.root = mkdtemp(pattern.data());
    }
    void TearDown() override { fs::remove_all(folder_.root); }
    AttemptFolder folder_;
};

TEST_F(OrderFile, SaysWhatTheNextServiceNeedsToAskSlurmAgain) {
    write_order(folder_, {.attempt = "run-00000.1",
                          .program = "/bin/sh",
                          .arguments = {"-c", "true"},
                          .grace_seconds = 2.5,
                          .cores = 4,
                          .memory_mb = 3000,
                          .priority = 30});
    const Order read = read_order(folder_);
    EXPECT_EQ(read.attempt, "run-00000.1");
    EXPECT_EQ(read.program, "/bin/sh");
    EXPECT_EQ(read.arguments, (std::vector<std::string>{"-c", "true"}));
    EXPECT_EQ(read.grace_seconds, 2.5);
    EXPECT_EQ(read.cores, 4);
    EXPECT_EQ(read.memory_mb, 3000);
    EXPECT_EQ(read.priority, 30);
}

TEST_F(OrderFile, OfAnEarlierVersionIsRead) {
    std::ofstream(folder_.order())
        << R"({"attempt":"run-00000.1","program":"/bin/sh","arguments":[],"grace_seconds":2})";
    const Order read = read_order(folder_);
    EXPECT_EQ(read.attempt, "run-00000.1");
    EXPECT_EQ(read.cores, 1);
    EXPECT_EQ(read.memory_mb, 0);
    EXPECT_EQ(read.priority, 0);
}

INSTANTIATE_TEST_SUITE_P(On, ExecutorConformance, ::testing::Values("Local", "FakeSlurm"),
                         [](const auto& each) { return std::string(each.param); });
INSTANTIATE_TEST_SUITE_P(OnReal, ExecutorConformance,
                         ::testing::ValuesIn(std::getenv("BREACH_REAL_SLURM") != nullptr
                                                 ? std::vector<const char*>{"RealSlurm"}
                                                 : std::vector<const char*>{}),
                         [](const auto& each) { return std::string(each.param); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ExecutorConformance);

}  // namespace
}  // namespace breach::orchestrator
