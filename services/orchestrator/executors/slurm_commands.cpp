// Calls sbatch, squeue and scancel, on the clerk's thread of SlurmExecutor. An error of sbatch
// does not prove that there is no job: a controller may accept it and lose the connection.
// Therefore three replies, and `doubtful` unless the refusal is certain.
#include "services/orchestrator/executors/slurm_commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include "core/command/command.hpp"

namespace breach::orchestrator {

namespace {

constexpr const char* squeue_format = "%F %K %T %j %r";
/// Users may only lower their jobs' priority (--nice), so the highest of ours is Slurm's zero.
constexpr std::int64_t highest_priority = 100;

/// Quotes a word for /bin/sh.
std::string quoted(const std::string& text) {
    std::string word = "'";
    for (const char each : text) {
        if (each == '\'')
            word += "'\\''";
        else
            word += each;
    }
    return word + "'";
}

/// The job's script: each task of the array (or the only one) becomes its attempt's supervisor.
std::string script_of(const Batch& batch, const std::string& self) {
    std::ostringstream script;
    script << "#!/bin/sh\ncase ${SLURM_ARRAY_TASK_ID:-0} in\n";
    for (std::size_t i = 0; i < batch.folders.size(); ++i) {
        const AttemptFolder& folder = batch.folders[i];
        script << i << ") attempt=" << quoted(batch.attempts[i])
               << " folder=" << quoted(folder.root.string()) << " ;;\n";
    }
    // The shell stays to end processes that a killed supervisor leaves behind: Slurm does not reach
    // processes outside the job's tree. TERM must not end the shell before the supervisor. In
    // control groups Slurm signals the shell only, which passes TERM on.
    script << "*) exit 64 ;;\nesac\nchild=\ntrap '[ -z \"$child\" ] || kill -TERM $child' TERM\n"
           << "export " << attempt_mark << "=\"$attempt\"\n"
           << "exec >>\"$folder/log.txt\" 2>&1 </dev/null\n"
           << quoted(self)
           << " supervise --take-lock \"$folder\" &\nchild=$!\n"
           // A signal ends `wait` before the child ends.
           << "while wait $child; code=$?; kill -0 $child 2>/dev/null; do :; done\n"
           << "[ $code -eq 0 ] ||\n"
           << quoted(self) << " supervise --end-strays \"$folder\"\n";
    return script.str();
}

/// Parts of Slurm's messages, some without the first letter, whose case varies.
bool is_passing_trouble(const std::string& said) {
    constexpr std::array signs{
        "nable to contact", "timed out",    "onnection refused", "uthentication",  "temporarily",
        "Zero Bytes",       "ommunication", "ocket timed",       "not responding", "unavailable",
        "is in backup",     "try again",    "SubmitJob"};  // the queue is full for now
    return std::ranges::any_of(
        signs, [&](const char* sign) { return said.find(sign) != std::string::npos; });
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

SlurmCommands::SlurmCommands(std::vector<std::string> options, std::string self,
                             std::chrono::milliseconds longest)
    : options_(std::move(options)),
      self_(std::move(self)),
      user_(std::to_string(geteuid())),
      longest_(longest) {}

Submitted SlurmCommands::submit(const Batch& batch) const {
    const Order& like = batch.like;
    std::vector<std::string> words{"sbatch",
                                   "--parsable",
                                   "--no-requeue",
                                   "--kill-on-invalid-dep=yes",
                                   "--export=NONE",
                                   "--job-name=" + batch.name,
                                   "--chdir=/",
                                   "--output=/dev/null",
                                   "--ntasks=1",
                                   "--cpus-per-task=" + std::to_string(like.cores),
                                   "--nice=" + std::to_string(highest_priority - like.priority)};
    if (like.memory_mb > 0) words.push_back("--mem=" + std::to_string(like.memory_mb) + "M");
    if (batch.folders.size() > 1) {
        std::string range = "--array=0-" + std::to_string(batch.folders.size() - 1);
        if (batch.throttle > 0) range.append(1, '%').append(std::to_string(batch.throttle));
        words.push_back(std::move(range));
    }
    words.insert(words.end(), options_.begin(), options_.end());
    const command::Result result =
        command::run(std::move(words), script_of(batch, self_), longest_);
    if (!result.exit_code) return {Reply::doubtful, "sbatch gave no answer"};
    const std::string said = first_line(result.err);
    if (*result.exit_code != 0)
        return {is_passing_trouble(result.err) ? Reply::doubtful : Reply::refused, said};
    const bool numbered = !result.out.empty() && result.out[0] >= '0' && result.out[0] <= '9';
    if (!numbered) return {Reply::doubtful, "sbatch answered \"" + first_line(result.out) + "\""};
    return {Reply::accepted, first_line(result.out)};
}

std::optional<std::map<JobName, ListedJob>> SlurmCommands::list() const {
    const command::Result result =
        command::run({"squeue", "--noheader", "--array", "--states=all", "--user=" + user_,
                      std::string("--format=") + squeue_format},
                     "", longest_);
    if (result.exit_code != 0) return std::nullopt;
    std::map<JobName, ListedJob> found;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) {
        if (auto job = job_in(line)) found.insert_or_assign(job->first, std::move(job->second));
    }
    return found;
}

void SlurmCommands::cancel(const JobName& job, const std::string& number) const {
    // By name as well: another job may have the number by now.
    command::run({"scancel", "--quiet", "--name=" + job.name, number}, "", longest_);
}

std::optional<std::pair<JobName, ListedJob>> job_in(const std::string& line) {
    std::istringstream words(line);
    std::string number, index, state;
    JobName job;
    if (!(words >> number >> index >> state >> job.name)) return std::nullopt;
    std::string reason;
    std::getline(words >> std::ws, reason);
    if (reason == "None" || state != "PENDING") reason.clear();
    ListedJob listed{number, state, reason};
    const auto parsed = std::from_chars(index.data(), index.data() + index.size(), job.index);
    if (parsed.ec == std::errc{}) {
        listed.number.append(1, '_').append(index);
    } else {
        job.index = 0;  // "N/A": not an array
    }
    return std::pair{job, listed};
}

}  // namespace breach::orchestrator
