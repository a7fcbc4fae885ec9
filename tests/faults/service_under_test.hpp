// A real `breachline serve` on loopback with fake phases, its own data folder, and a client.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace breach::testing {

struct Answer {
    int status = 0;  ///< 0: no answer
    nlohmann::json body;
    std::string text;
    std::multimap<std::string, std::string> headers;
};

/// A temporary folder with `bin` (the phases) and `data`; removed at the end unless
/// BREACH_KEEP_SANDBOX is set.
class Sandbox {
  public:
    Sandbox();
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;
    std::filesystem::path bin() const { return root_ / "bin"; }
    std::filesystem::path data() const { return root_ / "data"; }
    std::filesystem::path root() const { return root_; }
    /// Number of successes per output, recorded by the fake phases.
    std::map<std::string, int> successes() const;

  private:
    std::filesystem::path root_;
};

class Service {
  public:
    /// Starts the service and waits until it listens; valid() is false if it exited. `environment`:
    /// more entries "NAME=value".
    explicit Service(const Sandbox& sandbox, std::vector<std::string> more_arguments = {},
                     std::vector<std::string> environment = {});
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    bool valid() const { return port_ > 0; }
    int port() const { return port_; }
    /// Standard error of a service that exited at once.
    const std::string& complaint() const { return complaint_; }
    int exit_code() const { return exit_code_; }

    void kill_at_once();  ///< SIGKILL
    void terminate();     ///< SIGTERM, waits for the end

    Answer get(const std::string& path,
               const std::multimap<std::string, std::string>& headers = {});
    Answer post(const std::string& path, const std::string& body,
                const std::string& type = "application/json",
                const std::multimap<std::string, std::string>& headers = {});
    Answer ask(const std::string& method, const std::string& path);

    /// Posts the study and returns the run's id.
    std::string submit(const nlohmann::json& study);
    /// Waits until the run is in a final state; returns /v1/runs/{id}.
    nlohmann::json wait_for_end(const std::string& run, double seconds = 30);
    /// The results without ids, which differ between executions.
    nlohmann::json table(const std::string& run);

  private:
    void end_with(int signal);
    pid_t pid_ = -1;
    int port_ = 0;
    int exit_code_ = -1;
    std::string complaint_;
};

/// Polls until true; false after the time limit.
bool eventually(const std::function<bool()>& condition, double seconds = 60);

/// The slope scene with this title (read by the fake phases) and these transfer times.
nlohmann::json study(const std::string& title, const std::vector<double>& times);

/// The run's task with this label; throws if there is none.
const nlohmann::json& task_labelled(const nlohmann::json& run, const std::string& label);

/// Pids of running phases (not supervisors) of this sandbox, by program name.
std::vector<pid_t> phases_alive(const Sandbox& sandbox, const std::string& phase);
bool is_alive(pid_t pid);

}  // namespace breach::testing
