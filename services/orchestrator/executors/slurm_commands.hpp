// Sends commands to Slurm and parses its answers: sbatch, squeue and scancel by command line, the
// interface that every version and every site has.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/orchestrator/executors/order.hpp"

namespace breach::orchestrator {

/// Identity of a job. We choose the name, which is unique; Slurm's numbers are not (a controller
/// that lost its state assigns them again). Attempts that were submitted together are tasks of one
/// array.
struct JobName {
    std::string name;
    std::int64_t index = 0;
    auto operator<=>(const JobName&) const = default;
};

struct ListedJob {
    std::string number;  ///< for scancel: "123", or "123_4" in an array
    std::string state;   ///< Slurm's word: "PENDING", ...
    std::string reason;  ///< why it waits: "Priority"; empty: it does not wait
};

/// Attempts submitted to Slurm as one job.
struct Batch {
    std::string name;
    std::vector<AttemptFolder> folders;
    std::vector<std::string> attempts;
    Order like;            ///< resources and priority of all of them
    std::size_t throttle;  ///< of an array: tasks at the same time; 0: no limit
};

enum class Reply {
    accepted,
    refused,   ///< for a reason that persists
    doubtful,  ///< no answer, or one that leaves open whether the job exists
};

struct Submitted {
    Reply reply;
    std::string said;
};

class SlurmCommands {
  public:
    /// `options`: further words for sbatch (partition, account, time limit); `self`: path of the
    /// breachline executable on the nodes.
    SlurmCommands(std::vector<std::string> options, std::string self,
                  std::chrono::milliseconds longest);

    Submitted submit(const Batch& batch) const;
    /// All jobs of this user, in any state; nothing: Slurm does not answer.
    std::optional<std::map<JobName, ListedJob>> list() const;
    /// No error if the job is over; without an answer the next listing still shows the job.
    void cancel(const JobName& job, const std::string& number) const;

  private:
    std::vector<std::string> options_;
    std::string self_;
    std::string user_;
    std::chrono::milliseconds longest_;
};

/// One line of our squeue format: "<array job id> <array index> <state> <name> <reason>".
std::optional<std::pair<JobName, ListedJob>> job_in(const std::string& line);

}  // namespace breach::orchestrator
