// A service, its supervisors and its phases are killed at random while studies are submitted and
// cancelled. Half of the services have a failpoint, to die exactly between two writes. At the end
// the event log must be consistent and no acknowledged work lost. On Slurm (the fake one of
// tests/slurm) faults occur at the same time.
//
//     BREACH_KILLS (100; on Slurm a fifth of it)   number of kills
//     BREACH_SEED (1)                              of the random choices
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <iostream>
#include <random>
#include <thread>

#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/files/file_lock.hpp"
#include "tests/faults/invariants.hpp"

namespace breach::testing {
namespace {

using nlohmann::json;

int setting(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text == nullptr ? otherwise : std::atoi(text);
}

pid_t parent_of(pid_t pid) {
    std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
    std::string word;
    pid_t parent = 0;
    stat >> word >> word >> word >> parent;
    return parent;
}

enum class Place { local, slurm };

/// Files that make the fake Slurm fail; `hang` would cost a command's whole time limit each.
const std::vector<std::string> troubles{"down",        "drained", "refuse",
                                        "lose_answer", "drop",    "forget"};

class Campaign {
  public:
    Campaign(int seed, Place place)
        : place_(place), random_(static_cast<std::mt19937::result_type>(seed)) {
        std::filesystem::create_directories(slurm());
        for (const std::string_view each : orchestrator::failpoint_names) {
            const bool elsewhere = each.starts_with("firing") ||
                                   (place == Place::local && each.starts_with("sbatch")) ||
                                   each.starts_with("upload");
            if (!elsewhere) places_.emplace_back(each);
        }
    }

    void kill_about(int wanted) {
        while (kills_ < wanted) live_once();
        std::cout << kills_ << " kills: " << kills_of_service_ << " of the service ("
                  << kills_at_failpoints_ << " at failpoints), " << kills_of_supervisors_
                  << " of supervisors, " << kills_of_phases_ << " of phases; "
                  << acknowledged_.size() << " runs acknowledged, " << removed_.size()
                  << " of them removed";
        if (place_ == Place::slurm) std::cout << "; " << troubles_ << " troubles of Slurm";
        std::cout << "\n";
    }

    void settle_and_check() {
        for (const std::string& each : troubles) std::filesystem::remove(slurm() / each);
        {
            Service service(sandbox_, arguments(), environment());
            ASSERT_TRUE(service.valid()) << service.complaint();
            for (const auto& [run, certain] : removed_) {
                const int status = service.get("/v1/runs/" + run).status;
                EXPECT_TRUE(status == 404 || (!certain && status == 200)) << run << " " << status;
            }
            for (const auto& [key, run] : acknowledged_) {
                if (removed_.contains(run)) continue;
                const json end = service.wait_for_end(run, 120);
                ASSERT_TRUE(end.is_object()) << key << " was acknowledged as " << run;
                const bool cancelled = cancelled_.contains(run);
                EXPECT_TRUE(end.at("state") == "succeeded" ||
                            (cancelled && end.at("state") == "cancelled"))
                    << run << " " << end.at("state") << " " << end.at("message");
                if (end.at("state") == "succeeded") check_table(service, run);
                EXPECT_EQ(run_of(service, key), run) << "one key, one run";
            }
            expect_only_what_is_known(service);
            EXPECT_TRUE(eventually([&] { return !orchestrator::is_held(slurm() / "runners"); }))
                << "a job of Slurm goes on";
        }
        expect_sound_history(sandbox_);
    }

  private:
    /// Nothing accumulates: every folder belongs to a run, and nothing waits for removal.
    void expect_only_what_is_known(Service& service) const {
        EXPECT_TRUE(
            eventually([&] { return service.get("/v1/storage").body.value("removing", -1) == 0; }));
        for (const auto& entry : std::filesystem::directory_iterator(sandbox_.data() / "runs"))
            EXPECT_EQ(service.get("/v1/runs/" + entry.path().filename().string()).status, 200)
                << entry.path();
    }

    std::filesystem::path slurm() const { return sandbox_.root() / "slurm"; }
    std::vector<std::string> arguments() const {
        std::vector<std::string> words{"--tries", "100", "--retry-delay", "0.01"};
        if (place_ == Place::slurm)
            words.insert(words.end(), {"--executor", "slurm", "--slurm-poll", "0.2",
                                       "--slurm-grace", "1", "--slurm-command-limit", "20"});
        return words;
    }
    std::vector<std::string> environment() const {
        if (place_ == Place::local) return {};
        return {"PATH=" + std::string(BREACH_ROOT) + "/tests/slurm/fake:" + std::getenv("PATH"),
                "FAKE_SLURM=" + slurm().string()};
    }
    /// Starts a fault, or ends one.
    void change_troubles() {
        const auto file =
            slurm() / troubles[static_cast<std::size_t>(below(static_cast<int>(troubles.size())))];
        if (std::filesystem::remove(file)) return;
        std::ofstream(file) << "\n";
        ++troubles_;
    }
    int below(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }
    void wait_a_moment(int most_ms) {
        std::this_thread::sleep_for(std::chrono::milliseconds(below(most_ms)));
    }

    /// Runs the service until it is killed.
    void live_once() {
        std::vector<std::string> environment = this->environment();
        if (below(2) == 0) {
            const auto token = sandbox_.root() / "token";
            std::ofstream(token) << "\n";
            environment.push_back(
                "BREACHLINE_FAILPOINT=" +
                places_[static_cast<std::size_t>(below(static_cast<int>(places_.size())))] + ":" +
                std::to_string(1 + below(5)) + ":" + token.string());
        }
        Service service(sandbox_, arguments(), environment);
        if (!service.valid()) {
            EXPECT_EQ(service.exit_code(), -1) << service.complaint();
            ++kills_at_failpoints_;
            return count_death_of_service();
        }
        const int deeds = 2 + below(5);
        for (int i = 0; i < deeds; ++i) {
            submit(service);
            wait_a_moment(place_ == Place::local ? 60 : 600);  // Slurm starts jobs later
            if (place_ == Place::slurm && below(3) == 0) change_troubles();
            if (below(8) == 0) cancel_one(service);
            if (below(3) == 0) remove_one(service);
            if (below(3) == 0) kill_a_phase();
            if (below(4) == 0) kill_a_supervisor();
            if (service.get("/healthz").status == 0) {
                ++kills_at_failpoints_;
                break;
            }
        }
        service.kill_at_once();
        count_death_of_service();
    }

    void count_death_of_service() {
        ++kills_of_service_;
        ++kills_;
    }

    static Answer post(Service& service, const std::string& key) {
        json wanted = study("fem_steps=3 mpm_steps=3", {0.25, 0.5});
        wanted["reuse"] = std::hash<std::string>()(key) % 2 == 0;
        return service.post("/v1/runs", wanted.dump(), "application/json",
                            {{"Idempotency-Key", key}});
    }

    /// At most a few unfinished runs. Repeats a key whose answer was lost.
    void submit(Service& service) {
        if (unanswered_.empty() && below(3) > 0) return;
        if (unanswered_.empty()) unanswered_ = "key-" + std::to_string(acknowledged_.size());
        const Answer answer = post(service, unanswered_);
        if (answer.status != 202) return;
        acknowledged_[unanswered_] = answer.body.at("id");
        unanswered_.clear();
    }

    static std::string run_of(Service& service, const std::string& key) {
        return post(service, key).body.value("id", "");
    }

    void cancel_one(Service& service) {
        if (acknowledged_.empty()) return;
        auto chosen = acknowledged_.begin();
        std::advance(chosen, below(static_cast<int>(acknowledged_.size())));
        cancelled_.insert(chosen->second);  // even if the answer is lost
        service.post("/v1/runs/" + chosen->second + "/cancel", "");
    }

    /// Removal of an unfinished run is refused. A lost answer may mean either.
    void remove_one(Service& service) {
        if (acknowledged_.empty()) return;
        auto chosen = acknowledged_.begin();
        std::advance(chosen, below(static_cast<int>(acknowledged_.size())));
        const int status = service.ask("DELETE", "/v1/runs/" + chosen->second).status;
        if (status == 202) removed_[chosen->second] = true;
        if (status == 0) removed_.try_emplace(chosen->second, false);
    }

    std::vector<pid_t> all_phases() const {
        std::vector<pid_t> found;
        for (const char* phase : {"fem_solver", "transfer_tool", "mpm_solver", "lem_tool"})
            for (const pid_t pid : phases_alive(sandbox_, phase)) found.push_back(pid);
        return found;
    }

    void kill_a_phase() {
        const auto phases = all_phases();
        if (phases.empty()) return;
        kill(phases[static_cast<std::size_t>(below(static_cast<int>(phases.size())))], SIGKILL);
        ++kills_of_phases_;
        ++kills_;
    }

    void kill_a_supervisor() {
        const auto phases = all_phases();
        if (phases.empty()) return;
        const pid_t parent = parent_of(phases.front());
        std::ifstream stream("/proc/" + std::to_string(parent) + "/cmdline");
        const std::string command{std::istreambuf_iterator<char>(stream), {}};
        if (command.find("supervise") == std::string::npos) return;
        kill(parent, SIGKILL);
        ++kills_of_supervisors_;
        ++kills_;
    }

    static void check_table(Service& service, const std::string& run) {
        const json rows = service.table(run);
        EXPECT_EQ(rows.size(), 2u) << run;
        for (const json& row : rows) {
            const double time = row.at("transfer_time");
            EXPECT_EQ(row.at("runout"), 10 + time * time) << run;
        }
    }

    Place place_;
    std::vector<std::string> places_;  ///< failpoints reached by these studies
    Sandbox sandbox_;
    std::mt19937 random_;
    int kills_ = 0, troubles_ = 0;
    int kills_of_service_ = 0, kills_at_failpoints_ = 0, kills_of_supervisors_ = 0,
        kills_of_phases_ = 0;
    std::map<std::string, std::string> acknowledged_;  ///< run, by key
    std::string unanswered_;                           ///< key whose answer was lost
    std::set<std::string> cancelled_;
    std::map<std::string, bool> removed_;  ///< true: acknowledged
};

TEST(RandomKills, LeaveASoundHistoryAndLoseNothing) {
    Campaign campaign(setting("BREACH_SEED", 1), Place::local);
    campaign.kill_about(setting("BREACH_KILLS", 100));
    campaign.settle_and_check();
}

TEST(RandomKills, OnASlurmWithTroublesLeaveASoundHistoryAndLoseNothing) {
    Campaign campaign(setting("BREACH_SEED", 1), Place::slurm);
    campaign.kill_about(setting("BREACH_KILLS", 100) / 5);
    campaign.settle_and_check();
}

}  // namespace
}  // namespace breach::testing
