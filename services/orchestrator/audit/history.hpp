// Replays the event log from its beginning: every move must be allowed by the lifecycle, and must
// begin in the state in which the one before ended.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/orchestrator/records/lifecycle.hpp"
#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

class History {
  public:
    /// Call in the order of the events' numbers.
    void take(const Event& event);

    /// The task's state according to the log; nothing: it has not moved.
    std::optional<TaskState> state_of(const std::string& task) const;
    /// Violations of these rules, one sentence each.
    const std::vector<std::string>& violations() const { return violations_; }

  private:
    void take_task_move(const Event& event);
    void take_attempt_move(const Event& event);
    void complain(const Event& event, const std::string& what);

    std::map<std::string, TaskState> tasks_;
    std::map<std::string, int> successes_;  ///< ends with exit code 0, by task
    std::map<std::string, std::map<std::int64_t, AttemptState>> attempts_;
    std::vector<std::string> violations_;
};

}  // namespace breach::orchestrator
