// Two threads meet in jobs_. The dispatcher calls submit, probe, stop and clear_away, which only
// read the folder and change jobs_; the clerk (serve) talks to Slurm without the lock, because a
// command may take half a minute. jobs_ is memory only: after a restart find_or_adopt makes a job
// again from slurm_job and order in its folder.
#include "services/orchestrator/executors/slurm_executor.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "services/orchestrator/files/failpoint.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::size_t largest_array = 100;  // limits the script's size
/// Tasks of one commit arrive within milliseconds; one sbatch for all of them spares the
/// controller.
constexpr auto gathering = std::chrono::milliseconds(30);
/// After a scancel the queue is looked at again soon, to see it take effect.
constexpr auto soon = std::chrono::seconds(1);
/// The supervisor sends KILL after the grace time and then writes its record.
constexpr auto margin_after_grace = std::chrono::seconds(5);

std::chrono::milliseconds in_milliseconds(double seconds) {
    return std::chrono::milliseconds(static_cast<std::int64_t>(1000 * seconds));
}

bool waits_its_turn(const std::string& state) {
    static const std::set<std::string> words{
        "PENDING",      "CONFIGURING",   "SUSPENDED",    "REQUEUED", "REQUEUE_FED",
        "REQUEUE_HOLD", "RESV_DEL_HOLD", "SPECIAL_EXIT", "STOPPED",  "RESIZING"};
    return words.contains(state);
}

bool runs(const std::string& state) {
    return state == "RUNNING" || state == "COMPLETING" || state == "SIGNALING" ||
           state == "STAGE_OUT";
}

/// Written before sbatch is called, so that the job can be found by its name even after a crash.
void write_job_name(const AttemptFolder& folder, const JobName& job) {
    exchange::publish_text(folder.slurm_job(),
                           json{{"name", job.name}, {"index", job.index}}.dump() + "\n");
}

std::optional<JobName> read_job_name(const AttemptFolder& folder) {
    std::ifstream stream(folder.slurm_job());
    const json document = json::parse(stream, nullptr, false);
    if (!document.is_object()) return std::nullopt;
    return JobName{document.at("name"), document.at("index")};
}

/// Value of the last option of sbatch with this name ("--time", "-t"); empty: there is none.
std::string option_of(const std::vector<std::string>& options, const std::string& name) {
    const std::string start = name.starts_with("--") ? name + "=" : name;
    std::string value;
    for (std::size_t i = 0; i < options.size(); ++i) {
        if (options[i] == name && i + 1 < options.size())
            value = options[i + 1];
        else if (options[i].starts_with(start))
            value = options[i].substr(start.size());
    }
    return value;
}

/// The limits of a job, and how to raise them. state: Slurm's word for its end.
std::string limits_in_words(const std::string& state, const Order& order,
                            const std::vector<std::string>& options) {
    const std::string asked =
        order.memory_mb > 0 ? std::to_string(order.memory_mb) + " MB" : option_of(options, "--mem");
    const std::string brief = option_of(options, "-t"), long_one = option_of(options, "--time");
    const std::string limit = long_one.empty() ? brief : long_one;
    const std::string time = "time limit " +
                             (limit.empty() ? std::string("of the partition") : limit) +
                             " (raise it: breachline serve --slurm-option=--time=HH:MM:SS)";
    const std::string memory =
        "memory " + (asked.empty() ? std::string("of the partition") : asked) +
        " (raise it in the study: \"resources\": {\"" + order.program.filename().string() +
        "\": {\"memory_MB\": " + std::to_string(std::max<std::int64_t>(4000, 2 * order.memory_mb)) +
        "}})";
    if (state == "TIMEOUT") return "it reached its " + time;
    if (state == "OUT_OF_MEMORY") return "it needed more than its " + memory;
    return "its limits were: " + time + ", " + memory;
}

}  // namespace

SlurmExecutor::SlurmExecutor(SlurmSettings settings, const std::filesystem::path& self)
    : settings_(std::move(settings)),
      slurm_(settings_.options, self.string(), in_milliseconds(settings_.command_seconds)) {
    clerk_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

SlurmExecutor::~SlurmExecutor() = default;

void SlurmExecutor::look_soon() {
    looks_soon_ = true;
    news_.notify_all();
}

SlurmExecutor::Clock::duration SlurmExecutor::grace() const {
    return in_milliseconds(settings_.grace_seconds);
}

std::optional<std::vector<QueuedJob>> SlurmExecutor::jobs() {
    const std::lock_guard lock(mutex_);
    std::vector<QueuedJob> list;
    for (const auto& [root, job] : jobs_)
        if (!job.given_up)
            list.push_back({root, job.number, job.number.empty() ? "" : job.state, job.reason});
    return list;
}

// ---------------------------------------------------------------- calls by the dispatcher

/// A folder with a job's name and no exit record may still get a job: a second one is refused.
void SlurmExecutor::submit(const AttemptFolder& folder, const Order& order) {
    std::filesystem::create_directories(folder.root);
    const bool may_come = std::filesystem::exists(folder.slurm_job()) &&
                          !std::filesystem::exists(folder.exit_record());
    if (is_held(folder.lock()) || may_come)
        throw fault::IoError(folder.root.string() + ": the attempt was submitted before");
    remove_remains(folder);
    write_order(folder, order);
    const std::lock_guard lock(mutex_);
    jobs_[folder.root] = {.folder = folder, .order = order, .since = Clock::now()};
    look_soon();
}

Vitals SlurmExecutor::probe(const AttemptFolder& folder) {
    const std::lock_guard lock(mutex_);
    if (std::filesystem::exists(folder.exit_record())) {
        jobs_.erase(folder.root);
        return {Life::ended};
    }
    Job* const job = find_or_adopt(folder);
    if (job == nullptr) return {Life::gone, "it was not submitted before the service ended"};
    if (is_held(folder.lock()) || job->heart_beats()) {
        job->silent_since.reset();
        return {Life::alive};
    }
    const Vitals vitals = vitals_of(*job);
    // It may have ended since the first look.
    if (vitals.life == Life::gone && std::filesystem::exists(folder.exit_record()))
        return {Life::ended};
    return vitals;
}

/// After a restart the attempt's folder is the only source.
SlurmExecutor::Job* SlurmExecutor::find_or_adopt(const AttemptFolder& folder) {
    const auto known = jobs_.find(folder.root);
    if (known != jobs_.end()) return &known->second;
    Job job{.folder = folder};
    try {
        const auto name = read_job_name(folder);
        if (!name) return nullptr;
        job.name = *name;
        job.order = read_order(folder);
    } catch (const std::exception&) {
        return nullptr;  // they were lost with the machine: never submitted
    }
    // Without a heartbeat its sbatch may never have been called.
    const bool began = std::filesystem::exists(folder.heartbeat());
    job.stage = began ? Stage::submitted : Stage::doubtful;
    job.since = Clock::now();
    look_soon();
    return &jobs_.emplace(folder.root, std::move(job)).first->second;
}

/// A sign of life without locks across machines or a common clock: the file's time changes.
bool SlurmExecutor::Job::heart_beats() {
    constexpr auto fresh = std::chrono::seconds(10);
    std::error_code error;
    const auto time = std::filesystem::last_write_time(folder.heartbeat(), error);
    if (error) return false;
    if (heartbeat != time) {
        // The first time read may be old and proves nothing.
        if (heartbeat) heart_beat_at = Clock::now();
        heartbeat = time;
    }
    return heart_beat_at != Clock::time_point{} && Clock::now() - heart_beat_at < fresh;
}

/// Why a submitted job is not in the queue yet.
std::string SlurmExecutor::Job::what_keeps() const {
    const auto seconds =
        std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - since).count();
    switch (stage) {
        case Stage::waiting:
            return asked == 0 ? "is being handed to Slurm" : "is handed to Slurm again";
        case Stage::asking:
            return "sbatch was called " + std::to_string(seconds) + " s ago and has not answered";
        case Stage::doubtful:
            return "unknown for " + std::to_string(seconds) + " s: " + why +
                   "; looking for it in Slurm's queue";
        case Stage::submitted:
        case Stage::refused:
            break;
    }
    return {};
}

/// Only the last branch gives an attempt up, after the grace time: Slurm may list a job as over
/// before its exit record is seen here.
Vitals SlurmExecutor::vitals_of(Job& job) const {
    switch (job.stage) {
        case Stage::waiting:
        case Stage::asking:
        case Stage::doubtful:
            return {Life::handed_over, job.what_keeps()};
        case Stage::refused:
            return {Life::gone, job.why};
        case Stage::submitted:
            break;
    }
    const bool waits = job.state.empty() || waits_its_turn(job.state);  // empty: not listed yet
    if (waits || !answers_) {
        job.silent_since.reset();
        if (!answers_) return {Life::queued, "squeue does not answer; waiting for the job"};
        return {Life::queued, "in Slurm's queue: " + (job.state.empty() ? "taken" : job.state)};
    }
    if (!job.silent_since) job.silent_since = Clock::now();
    // Cancelled before its start: no process can follow.
    const bool never_began = job.state == "CANCELLED" && !job.heartbeat;
    if (!never_began && Clock::now() - *job.silent_since < grace()) return {Life::queued};
    return {Life::gone, "Slurm says " + job.state + ", and the job left no exit record; " +
                            limits_in_words(job.state, job.order, settings_.options)};
}

void SlurmExecutor::stop(const AttemptFolder& folder, StopReason reason) {
    write_stop(folder, reason);
    const std::lock_guard lock(mutex_);
    Job* const job = find_or_adopt(folder);
    if (job == nullptr) return;
    if (job->stage == Stage::waiting) {
        job->stage = Stage::refused;
        job->why = "stopped before it was submitted";
    }
    if (!job->unwanted_since) job->unwanted_since = Clock::now();
    look_soon();
}

/// Called when the dispatcher counts the attempt as lost. The job may still start: the stop file
/// makes its supervisor leave without a record, and scancel removes it from the queue.
/// cancel_the_unwanted erases the entry once Slurm shows the job as over.
void SlurmExecutor::clear_away(const AttemptFolder& folder, const std::string&) {
    try {
        write_stop(folder, StopReason::revoked);
    } catch (const std::exception& error) {
        spdlog::warn("{}: {}", folder.root.string(), error.what());  // scancel must stop it
    }
    const std::lock_guard lock(mutex_);
    const auto known = jobs_.find(folder.root);
    if (known == jobs_.end()) return;
    Job& job = known->second;
    if (job.stage == Stage::waiting || job.stage == Stage::refused) {
        jobs_.erase(known);
        return;
    }
    if (!job.unwanted_since) job.unwanted_since = Clock::now();
    job.given_up = true;
    look_soon();
}

// ---------------------------------------------------------------- the clerk

void SlurmExecutor::serve(const std::stop_token& stop) {
    const auto poll = in_milliseconds(settings_.poll_seconds);
    auto next_look = Clock::now();
    while (!stop.stop_requested()) {
        {
            std::unique_lock lock(mutex_);
            news_.wait_until(lock, stop, next_look, [&] { return looks_soon_; });
            looks_soon_ = false;
        }
        if (stop.stop_requested()) return;
        try {
            recover_the_unanswered();
            std::this_thread::sleep_for(gathering);  // collects jobs that are submitted together
            submit_what_waits();
            if (Clock::now() >= next_look || must_be_found()) {
                look_at_the_queue();
                next_look = Clock::now() + poll;
            }
            if (cancel_the_unwanted()) next_look = std::min(next_look, Clock::now() + soon);
        } catch (const std::exception& error) {
            spdlog::error("slurm: {}", error.what());
            next_look = Clock::now() + poll;
        }
    }
}

/// Whether a job must be cancelled and its number is not known yet.
bool SlurmExecutor::must_be_found() {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(jobs_, [](const auto& entry) {
        const Job& job = entry.second;
        return job.unwanted_since && job.stage == Stage::submitted && job.state.empty();
    });
}

void SlurmExecutor::submit_what_waits() {
    // Jobs with equal resources and priority become one array. Repeated requests use smaller
    // arrays, because a user's limit of queued jobs may have room for some only.
    struct Like {
        std::int64_t cores, memory_mb, priority;
        int asked;
        auto operator<=>(const Like&) const = default;
    };
    std::map<Like, std::vector<std::filesystem::path>> groups;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [root, job] : jobs_) {
            if (job.stage != Stage::waiting) continue;
            groups[{job.order.cores, job.order.memory_mb, job.order.priority, job.asked}].push_back(
                root);
        }
    }
    for (const auto& [like, roots] : groups) {
        const std::size_t most =
            std::clamp(roots.size() >> std::min(like.asked, 30), std::size_t{1}, largest_array);
        for (std::size_t first = 0; first < roots.size(); first += most) {
            const auto begin = roots.begin() + static_cast<std::ptrdiff_t>(first);
            const auto count = std::min(most, roots.size() - first);
            submit_together({begin, begin + static_cast<std::ptrdiff_t>(count)});
        }
    }
}

/// One call of sbatch. Between open_round and close_round the jobs are in `asking` and the lock is
/// free. A job may change meanwhile: a quick one has ended, another is stopped. So close_round
/// looks at the present state of each job; recover_the_unanswered handles rounds that never closed.
void SlurmExecutor::submit_together(const std::vector<std::filesystem::path>& roots) {
    const Batch batch = open_round(roots);
    if (batch.folders.empty()) return;
    const Submitted answer = ask(batch);
    pass_failpoint("sbatch_after");
    if (answer.reply != Reply::accepted) spdlog::warn("slurm: {}: {}", batch.name, answer.said);
    close_round(batch, answer);
}

/// Marks the jobs that still wait as `asking`; a job may have been stopped meanwhile.
Batch SlurmExecutor::open_round(const std::vector<std::filesystem::path>& roots) {
    Batch batch{
        .name = {}, .folders = {}, .attempts = {}, .like = {}, .throttle = settings_.throttle};
    const std::lock_guard lock(mutex_);
    for (const auto& root : roots) {
        const auto known = jobs_.find(root);
        if (known == jobs_.end() || known->second.stage != Stage::waiting) continue;
        Job& job = known->second;
        if (batch.name.empty()) {
            // A repeated request after a doubtful answer gets a new name, because the batch may
            // differ. If the first job appears as well, the attempt's lock lets only one of them
            // run.
            batch.name = "breachline-" + job.order.attempt;
            if (job.asked > 0) batch.name += "_" + std::to_string(job.asked + 1);
            batch.like = job.order;
        }
        batch.folders.push_back(job.folder);
        batch.attempts.push_back(job.order.attempt);
        job.name = {batch.name, static_cast<std::int64_t>(batch.folders.size()) - 1};
        job.stage = Stage::asking;
        job.since = Clock::now();
        ++job.asked;
    }
    return batch;
}

Submitted SlurmExecutor::ask(const Batch& batch) const {
    try {
        for (std::size_t i = 0; i < batch.folders.size(); ++i)
            write_job_name(batch.folders[i], {batch.name, static_cast<std::int64_t>(i)});
        pass_failpoint("sbatch_before");
        return slurm_.submit(batch);
    } catch (const fault::IoError& error) {  // no sbatch: there is no job
        return {Reply::refused, error.what()};
    } catch (const std::exception& error) {
        return {Reply::doubtful, error.what()};
    }
}

void SlurmExecutor::close_round(const Batch& batch, const Submitted& answer) {
    const std::lock_guard lock(mutex_);
    for (const AttemptFolder& folder : batch.folders) {
        const auto known = jobs_.find(folder.root);
        if (known == jobs_.end() || known->second.stage != Stage::asking) continue;
        Job& job = known->second;
        job.since = Clock::now();
        switch (answer.reply) {
            case Reply::accepted:
                job.stage = Stage::submitted;
                break;
            case Reply::refused:
                job.stage = Stage::refused;
                job.why = "Slurm refused it: " + answer.said;
                break;
            case Reply::doubtful:
                job.stage = Stage::doubtful;
                job.why = answer.said;
                break;
        }
    }
}

/// Only the clerk opens rounds, and none is open here: a job still in `asking` has lost its answer.
/// The queue will show whether it exists.
void SlurmExecutor::recover_the_unanswered() {
    const std::lock_guard lock(mutex_);
    for (auto& [root, job] : jobs_) {
        if (job.stage != Stage::asking) continue;
        job.stage = Stage::doubtful;
        job.since = Clock::now();
        job.why = "its round with sbatch ended without an answer";
        spdlog::error("slurm: {}: {}; looking for it in the queue", job.order.attempt, job.why);
    }
}

void SlurmExecutor::look_at_the_queue() {
    {
        const std::lock_guard lock(mutex_);
        if (jobs_.empty()) return;
    }
    const auto asked = Clock::now();
    const auto listed = slurm_.list();
    const std::lock_guard lock(mutex_);
    if (answers_ != listed.has_value())
        spdlog::log(listed ? spdlog::level::info : spdlog::level::warn, "slurm: squeue {}",
                    listed ? "answers again" : "does not answer; nothing is concluded from that");
    answers_ = listed.has_value();
    if (!listed) return;
    for (auto& [root, job] : jobs_) take_in(job, *listed, asked);
}

/// `asked`: time of the request for the list; later submissions cannot be in it.
void SlurmExecutor::take_in(Job& job, const std::map<JobName, ListedJob>& listed,
                            Clock::time_point asked) {
    if (job.stage == Stage::waiting || job.stage == Stage::asking || job.stage == Stage::refused)
        return;
    const auto found = listed.find(job.name);
    if (found != listed.end()) {
        job.stage = Stage::submitted;
        job.state = found->second.state;
        job.number = found->second.number;
        job.reason = found->second.reason;
        return;
    }
    if (asked <= job.since) return;
    if (job.stage == Stage::doubtful) {  // it did not arrive
        job.stage = job.unwanted_since ? Stage::refused : Stage::waiting;
        if (job.unwanted_since) job.why = "stopped before it was submitted";
        looks_soon_ = true;
        return;
    }
    job.state = "that it knows no such job";
    job.number.clear();
}

/// A queued job at once. A running job when its supervisor did not react in time.
bool SlurmExecutor::Job::is_due_for_scancel() const {
    if (!unwanted_since || number.empty()) return false;
    if (waits_its_turn(state)) return true;
    if (!runs(state)) return false;
    const auto patience = in_milliseconds(order.grace_seconds) + margin_after_grace;
    return given_up || Clock::now() - *unwanted_since > patience;
}

/// True: cancelled something.
bool SlurmExecutor::cancel_the_unwanted() {
    std::vector<std::pair<JobName, std::string>> unwanted;
    {
        const std::lock_guard lock(mutex_);
        std::erase_if(jobs_, [&](const auto& entry) {
            const Job& job = entry.second;
            const bool over = job.stage == Stage::refused ||
                              (job.stage == Stage::submitted && !waits_its_turn(job.state) &&
                               !runs(job.state) && !job.state.empty());
            return job.given_up && over;
        });
        for (const auto& [root, job] : jobs_)
            if (job.is_due_for_scancel()) unwanted.emplace_back(job.name, job.number);
    }
    for (const auto& [job, number] : unwanted) slurm_.cancel(job, number);
    return !unwanted.empty();
}

}  // namespace breach::orchestrator
