// In the shipped program as well: what is tested is what runs. A pass costs the comparison of an
// empty name when no variable is set. Read once, at the first pass of any point.
#include "services/orchestrator/files/failpoint.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>

#include "core/fault/fault.hpp"

namespace breach::orchestrator {

namespace {

/// The setting of one variable, and how often its failpoint was reached.
class FailpointSetting {
  public:
    explicit FailpointSetting(const char* variable) {
        const char* text = std::getenv(variable);
        if (text == nullptr) return;
        std::istringstream parts(text);
        std::string time;
        std::getline(parts, name_, ':');
        if (std::getline(parts, time, ':')) time_ = std::atoi(time.c_str());
        std::getline(parts, file_);
    }
    /// Whether this pass is the n-th.
    bool is_due(std::string_view place) {
        return !name_.empty() && name_ == place && ++times_ == time_;
    }
    bool takes_the_file() const { return file_.empty() || unlink(file_.c_str()) == 0; }
    bool has_the_file() const { return !file_.empty() && std::filesystem::exists(file_); }

  private:
    std::string name_;
    int time_ = 1;
    std::string file_;
    std::atomic<int> times_ = 0;
};

}  // namespace

void pass_failpoint(Failpoint point) {
    static FailpointSetting to_die("BREACHLINE_FAILPOINT");
    static FailpointSetting to_throw("BREACHLINE_TROUBLE");
    static FailpointSetting to_wait("BREACHLINE_HOLD");
    if (to_wait.is_due(point.name))
        while (to_wait.has_the_file()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (to_die.is_due(point.name) && to_die.takes_the_file()) kill(getpid(), SIGKILL);
    if (to_throw.is_due(point.name) && to_throw.takes_the_file())
        throw fault::IoError("trouble at " + std::string(point.name) + ", asked for by a test");
}

}  // namespace breach::orchestrator
