// Progress of the running tasks as they report it. In memory only: after a restart the phases' next
// lines fill it again.
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace breach::orchestrator {

struct Progress {
    double fraction = 0.0;  ///< [0, 1]
    std::string message;
};

class ProgressBoard {
  public:
    void set(const std::string& task, Progress progress);
    void erase(const std::string& task);
    Progress of(const std::string& task) const;
    /// Sum of the fractions of a run's running tasks.
    double sum_of_run(const std::string& run) const;
    /// The largest progress of the run so far; forgotten with 1. A trigger that adds tasks,
    /// or a task that is tried again, must not move its bar back.
    double never_back(const std::string& run, double progress) const;

  private:
    mutable std::mutex mutex_;
    std::map<std::string, Progress> tasks_;          ///< by task id; the ids of a run are adjacent
    mutable std::map<std::string, double> largest_;  ///< by run
};

}  // namespace breach::orchestrator
