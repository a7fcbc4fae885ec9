// Slots, the attempts that occupy them, the queue, and Slurm's view of it.
#include <algorithm>

#include "services/orchestrator/executors/order.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/records/or_null.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr auto all = static_cast<std::size_t>(1) << 30;

/// 0 stands for "not asked for" and "not limited".
json memory_json(std::int64_t megabytes) { return megabytes > 0 ? json(megabytes) : json(nullptr); }

/// A running task with its attempt. Values that only the supervisor knows are null until its first
/// heartbeat.
json worker_json(const Service& service, const Task& task, const Attempt& attempt,
                 const std::vector<QueuedJob>& jobs) {
    const AttemptFolder folder = service.data.attempt(task, attempt.number);
    // From the attempt's folder, as on Slurm's nodes nothing else is shared.
    const auto beat = read_heartbeat(folder);
    const auto job = std::ranges::find(jobs, folder.root, &QueuedJob::folder);
    const bool queued = job != jobs.end();
    const Progress progress = service.board.of(task.id);
    return {{"task", task.id},
            {"run", task.run},
            {"phase", task.phase},
            {"label", task.label},
            {"variant", task.variant},
            {"transfer_time", or_null(task.transfer_time)},
            {"state", name_of(task.state)},
            {"attempt", attempt.number},
            {"since", or_null(attempt.started)},
            {"host", beat && !beat->host.empty() ? json(beat->host) : json(nullptr)},
            {"pid", beat && beat->pid > 0 ? json(beat->pid) : json(nullptr)},
            {"job", queued && !job->number.empty() ? json(job->number) : json(nullptr)},
            {"job_state", queued && !job->state.empty() ? json(job->state) : json(nullptr)},
            {"job_reason", queued && !job->reason.empty() ? json(job->reason) : json(nullptr)},
            {"cores", task.resources.cores},
            {"memory_MB", memory_json(task.resources.memory_mb)},
            {"cpu_seconds", beat ? json(beat->cpu_seconds) : json(nullptr)},
            {"memory_used_MB", beat && beat->pid > 0 ? json(beat->memory_mb) : json(nullptr)},
            {"progress", progress.fraction},
            {"message", progress.message}};
}

/// Number of jobs by Slurm's state, and of waiting jobs by Slurm's reason.
/// Slurm's own words: an administrator knows them.
json jobs_json(const std::vector<QueuedJob>& jobs) {
    json states = json::object();
    json reasons = json::object();
    const auto count = [](json& in, const std::string& word) {
        in[word] = in.value(word, std::int64_t{0}) + 1;
    };
    for (const QueuedJob& each : jobs) {
        count(states, each.state.empty() ? "not listed yet" : each.state);
        if (!each.reason.empty()) count(reasons, each.reason);
    }
    return {{"states", std::move(states)}, {"reasons", std::move(reasons)}};
}

void workers(const Service& service, Call& call) {
    call.allow_parameters({});
    const DispatchSettings& settings = service.dispatcher.settings();
    const auto jobs = service.dispatcher.jobs();
    // Numbers of this moment from several queries: they need not add up exactly.
    const auto counts = service.store.tasks_by_state();
    json running = json::array();
    std::int64_t cores = 0;
    std::int64_t memory = 0;
    // These three occupy slots.
    for (const TaskState state : {TaskState::starting, TaskState::running, TaskState::cancelling}) {
        for (const Task& task : service.store.tasks_in(state, all)) {
            const std::vector<Attempt> attempts = service.store.attempts_of(task.id);
            // The task moved on between two queries.
            if (attempts.empty()) continue;
            cores += task.resources.cores;
            memory += task.resources.memory_mb;
            running.push_back(worker_json(service, task, attempts.back(),
                                          jobs.value_or(std::vector<QueuedJob>{})));
        }
    }
    const auto waiting = [&](TaskState state) {
        const auto found = counts.find(std::string(name_of(state)));
        return found == counts.end() ? std::int64_t{0} : found->second;
    };
    // Only the Slurm executor has jobs, also when there are none.
    reply(call.response, {{"executor", jobs ? "slurm" : "local"},
                          {"slots", settings.slots},
                          {"slots_used", cores},
                          {"memory_MB", memory_json(settings.memory_mb)},
                          {"memory_asked_MB", memory},
                          {"limits", settings.limits},
                          {"queue",
                           {{"ready", waiting(TaskState::ready)},
                            {"retry_wait", waiting(TaskState::retry_wait)},
                            {"blocked", waiting(TaskState::blocked)}}},
                          {"workers", std::move(running)},
                          {"slurm", jobs ? jobs_json(*jobs) : json(nullptr)}});
}

}  // namespace

void add_worker_routes(Router& router, Service& service) {
    router.get("/v1/workers", [&](Call& call) { workers(service, call); });
}

}  // namespace breach::orchestrator
