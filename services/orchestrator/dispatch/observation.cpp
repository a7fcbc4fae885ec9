// The dispatcher's watching half: what an attempt prints, how it ends, and what follows from that.
#include <spdlog/spdlog.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "core/phases/files.hpp"
#include "services/orchestrator/dispatch/dispatcher.hpp"
#include "services/orchestrator/dispatch/verdict.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

std::string last_line_of(const std::filesystem::path& file) {
    constexpr std::streamoff tail = 4096;
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    if (!stream) return {};
    const std::streamoff size = stream.tellg();
    stream.seekg(std::max<std::streamoff>(0, size - tail));
    std::string line;
    std::string last;
    while (std::getline(stream, line)) {
        if (!line.empty()) last = line;
    }
    return last;
}

/// 1, 2, 4, ... times the first delay, at most a minute.
std::int64_t delay_ms(std::chrono::milliseconds first, std::int64_t tries) {
    return std::min(longest_retry_ms, first.count() << std::min<std::int64_t>(tries - 1, 10));
}

}  // namespace

void Dispatcher::observe(Live& live) {
    if (live.outputs_changed) settle_children(live.task.id);
    live.outputs_changed = false;
    const Vitals vitals = executor_.probe(live.folder);
    switch (vitals.life) {
        case Life::handed_over:
            board_.set(live.task.id, {0.0, vitals.why});
            return;
        case Life::queued:
            board_.set(live.task.id, {0.0, vitals.why});
            note_submission(live);
            return;
        case Life::alive:
            if (!live.start_noted) board_.erase(live.task.id);
            note_start(live);  // after a wait, a restart, or when the disk was full at the start
            read_lines(live);
            return;
        case Life::ended:
            note_exit(live);
            return;
        case Life::gone:
            note_loss(live, vitals.why);
            return;
    }
}

/// Whole lines only: a torn last line is read when it is whole.
void Dispatcher::read_lines(Live& live) {
    std::ifstream stream(live.folder.lines(), std::ios::binary);
    if (!stream) return;
    stream.seekg(live.lines_read);
    std::string line;
    while (std::getline(stream, line) && !stream.eof()) {
        live.lines_read += static_cast<std::streamoff>(line.size()) + 1;
        note_begin(live);
        const json said = json::parse(line, nullptr, false);
        if (!said.is_object() || said.value("event", "") != "progress") continue;
        const auto fraction = said.find("fraction");
        if (fraction == said.end() || !fraction->is_number()) continue;
        board_.set(live.task.id, {fraction->get<double>(), said.value("message", "")});
    }
}

void Dispatcher::note_submission(Live& live) {
    if (live.submission_noted) return;
    store_.write([&](Transaction& transaction) {
        transaction.move_attempt(live.task.id, live.number, AttemptEvent::submit);
    });
    live.submission_noted = true;
}

void Dispatcher::note_start(Live& live) {
    if (live.start_noted) return;
    store_.write([&](Transaction& transaction) {
        if (!live.submission_noted)
            transaction.move_attempt(live.task.id, live.number, AttemptEvent::submit);
        transaction.move_task(live.task.id, TaskEvent::start);
    });
    live.submission_noted = live.start_noted = true;
}

void Dispatcher::note_begin(Live& live) {
    if (live.begun) return;
    store_.write([&](Transaction& transaction) {
        transaction.move_attempt(live.task.id, live.number, AttemptEvent::begin);
    });
    live.begun = true;
}

void Dispatcher::note_exit(Live& live) {
    const std::string& task = live.task.id;
    const ExitRecord record = *read_exit_record(live.folder);
    const Verdict verdict = judge(record, live.resumes);
    const AttemptEnd end{.exit_code = record.exit_code,
                         .signal = record.signal,
                         .wall_seconds = record.wall_seconds,
                         .cpu_seconds = record.cpu_seconds,
                         .reason = record.stopped ? std::string(name_of(*record.stopped)) : ""};
    const TaskFault fault = verdict == Verdict::well ? TaskFault{} : fault_of(live, record);
    std::optional<TaskState> stopped;
    reach(Failpoint::exit_before);
    store_.write([&](Transaction& transaction) {
        transaction.move_attempt(task, live.number, AttemptEvent::exit, end);
        stopped = transaction.try_move_task(task, TaskEvent::stopped);
        if (stopped) return;
        switch (verdict) {
            case Verdict::well:
                transaction.move_task(task, TaskEvent::exit_well);
                break;
            case Verdict::interrupted:
                transaction.move_task(task, TaskEvent::interrupt);
                break;
            case Verdict::badly:
                transaction.fail_task(task, TaskEvent::exit_badly, fault);
                break;
            case Verdict::retryable:
                retry_or_give_up(transaction, live, TaskEvent::exit_retryable,
                                 TaskEvent::exit_badly, fault);
                break;
        }
    });
    reach(Failpoint::exit_after);
    spdlog::info("{} ({}): attempt {} ended, {}", task, live.task.label, live.number,
                 in_words(record));
    live.over = true;
    const bool over = (verdict == Verdict::well && !stopped) || is_over(task);
    if (over) registrar_.add(live.task);
}

bool Dispatcher::is_over(const std::string& task) const {
    const auto now = store_.task(task);
    return now && is_final(now->state);
}

void Dispatcher::note_loss(Live& live, const std::string& why) {
    const std::string& task = live.task.id;
    AttemptEnd end;  // it cost what it had used when it was last heard of
    if (const auto beat = read_heartbeat(live.folder)) end.cpu_seconds = beat->cpu_seconds;
    executor_.clear_away(live.folder, attempt_id(task, live.number));
    store_.write([&](Transaction& transaction) {
        transaction.move_attempt(task, live.number, AttemptEvent::vanish, end);
        if (transaction.try_move_task(task, TaskEvent::stopped)) return;
        transaction.move_task(task, TaskEvent::vanish, {{"why", why}});
        retry_or_give_up(transaction, live, TaskEvent::retry, TaskEvent::give_up,
                         {std::nullopt, why});
    });
    spdlog::warn("{} ({}): attempt {} lost, {}", task, live.task.label, live.number, why);
    live.over = true;
    if (is_over(task)) registrar_.add(live.task);
}

void Dispatcher::retry_or_give_up(Transaction& transaction, const Live& live, TaskEvent retry,
                                  TaskEvent give_up, const TaskFault& fault) {
    const std::int64_t tries = transaction.count_try(live.task.id);
    if (tries >= settings_.most_tries) {
        transaction.fail_task(
            live.task.id, give_up,
            {fault.exit_code, fault.summary + " (tried " + std::to_string(tries) + " times)"});
        return;
    }
    transaction.move_task_to_retry(live.task.id, retry,
                                   epoch_ms() + delay_ms(settings_.retry_delay, tries),
                                   {{"summary", fault.summary}, {"tries", tries}});
}

/// What the phase itself says (fault.json), else the last line of its log.
TaskFault Dispatcher::fault_of(const Live& live, const ExitRecord& record) const {
    TaskFault fault{record.exit_code, in_words(record)};
    if (record.signal == SIGKILL && !record.stopped) {
        const std::int64_t asked = live.task.resources.memory_mb;
        fault.summary +=
            ": most likely the machine's memory, or a memory or time limit of Slurm, was exceeded; "
            "the phase asked for " +
            (asked > 0 ? std::to_string(asked) + " MB" : std::string("no memory of its own")) +
            ". Raise it in the study (\"resources\": {\"" + live.task.phase +
            "\": {\"memory_MB\": ...}}), or the time limit (breachline serve "
            "--slurm-option=--time=HH:MM:SS)";
    }
    if (!record.exit_code) return fault;
    std::ifstream stream(data_.output(live.task) / phases::files::fault);
    const json said = json::parse(stream, nullptr, false);
    std::string summary;
    if (said.is_object() && said.value("exit_code", 0) == *record.exit_code)
        summary = said.value("summary", "");
    if (summary.empty()) summary = last_line_of(live.folder.log());
    if (!summary.empty()) fault.summary = summary;
    return fault;
}

void Dispatcher::stop_watching(const Live& live) {
    watch_.remove(live.attempt_watch);
    watch_.remove(live.output_watch);
    board_.erase(live.task.id);
}

void Dispatcher::forget_the_ended() {
    std::vector<std::string> ended;
    for (const Live& live : live_) {
        if (!live.over) continue;
        stop_watching(live);
        ended.push_back(live.task.id);
    }
    std::erase_if(live_, [](const Live& live) { return live.over; });
    for (const std::string& task : ended) settle_children(task);
}

}  // namespace breach::orchestrator
