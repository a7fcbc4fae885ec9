// The life of an attempt, all on the dispatcher's thread. start() claims the task, attach() adds
// it to live_, observe() moves it on, settle() marks it `over`, and forget_the_ended() removes
// it. Rows are written before processes are started: if the service is killed in between, adopt()
// finds the row, probe() finds no process, and note_loss() retries the task. The other order
// could leave a process of which no row knows.
#include "services/orchestrator/dispatch/attempts.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "services/orchestrator/dispatch/cache.hpp"
#include "services/orchestrator/dispatch/ending.hpp"
#include "services/orchestrator/dispatch/release.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

namespace {

/// A folder watch may miss changes (another machine's file system, a full queue of the kernel),
/// so every attempt is observed once a second even without a notice.
constexpr auto look_at_all_after = std::chrono::seconds(1);

/// 1, 2, 4, ... times the first delay, at most a minute.
/// The shift stops at 2^10, before it overflows; longest_retry_ms decides long before.
std::int64_t delay_ms(std::chrono::milliseconds first, std::int64_t tries) {
    return std::min(longest_retry_ms, first.count() << std::min<std::int64_t>(tries - 1, 10));
}

}  // namespace

/// Called by Dispatcher::reconcile, after a start and after every error. The three flags come
/// from the rows, so that no event is stored twice; lines are read again from the first.
void Attempts::adopt() {
    for (const LiveAttempt& live : live_) stop_watching(live);
    live_.clear();
    constexpr auto all = static_cast<std::size_t>(1) << 30;
    for (const TaskState state : {TaskState::starting, TaskState::running, TaskState::cancelling}) {
        for (const Task& task : store_.tasks_in(state, all)) {
            const std::vector<Attempt> attempts = store_.attempts_of(task.id);
            const Attempt& last = attempts.back();
            spdlog::info("{} ({}): attempt {} was going on", task.id, task.label, last.number);
            LiveAttempt& live = attach(task, last.number);
            // `cancelling` does not say whether the start was noted; the table allows the event
            // there, so it may be noted twice.
            live.submission_noted = last.state != AttemptState::submitting;
            live.start_noted = task.state == TaskState::running;
            live.begun = last.state == AttemptState::running;
        }
    }
}

/// If the files of an attempt cannot be read, its progress shows the reason, the others continue,
/// and it is observed again in the next round.
void Attempts::look() {
    const std::vector<int> changed = watch_.changes();
    stop_cancelled();
    const bool all = Clock::now() - looked_at_all_ >= look_at_all_after;
    if (all) looked_at_all_ = Clock::now();
    for (LiveAttempt& live : live_) {
        if (all || std::ranges::find(changed, live.output_watch) != changed.end())
            live.outputs_changed = true;
        try {
            observe(live);
        } catch (const std::filesystem::filesystem_error& error) {
            const std::string why = std::string("cannot be observed: ") + error.what();
            if (board_.of(live.task.id).message != why)
                spdlog::error("{} ({}): {}", live.task.id, live.task.label, why);
            board_.set(live.task.id, {0.0, why});
        }
    }
    forget_the_ended();
}

void Attempts::stop_all() {
    for (const LiveAttempt& live : live_) executor_.stop(live.folder, StopReason::shutdown);
}

/// A cancelled task stays in `cancelling` until its process is gone: note_exit or note_loss then
/// moves it by `stopped`. asked_to_stop is in memory only; after a restart the executor is asked
/// again, and the stop file that exists stays as it is.
void Attempts::stop_cancelled() {
    if (live_.empty()) return;
    for (const Task& task : store_.tasks_in(TaskState::cancelling, live_.size())) {
        for (LiveAttempt& live : live_) {
            if (live.task.id != task.id || live.asked_to_stop) continue;
            executor_.stop(live.folder, StopReason::cancel);
            live.asked_to_stop = true;
        }
    }
}

Capacity Attempts::capacity() const {
    Capacity left(settings_);
    for (const LiveAttempt& live : live_) left.take(live.task);
    return left;
}

// ---------------------------------------------------------------- starting

/// The tasks come from ReadyTasks::to_start in the same round. One that was cancelled since then
/// is not claimed. Outputs that the cache had placed go first, as the phase must not write into
/// links to another run's files.
void Attempts::start(const std::vector<Task>& tasks) {
    for (const Task& task : tasks) drop_placed_outputs(data_, task);
    pass_failpoint("claim_before");
    const auto numbers = store_.write([&](Transaction& transaction) {
        std::vector<std::int64_t> made;
        for (const Task& task : tasks) {
            const bool claimed = transaction.try_move_task(task.id, TaskEvent::claim).has_value();
            made.push_back(claimed ? transaction.add_attempt(task.id) : 0);  // 0: cancelled
        }
        return made;
    });
    pass_failpoint("claim_after");
    std::vector<LiveAttempt*> started;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        // A very short phase may have ended by now. Slurm's jobs still wait: observe() notes
        // their start.
        if (numbers[i] == 0) continue;
        LiveAttempt& live = attach(tasks[i], numbers[i]);
        if (!hand_over(live)) continue;
        const Life life = executor_.probe(live.folder).life;
        if (life == Life::alive || life == Life::ended) started.push_back(&live);
    }
    pass_failpoint("start_after");
    note_starts(started);
    forget_the_ended();
}

/// Also creates the output folder, because a watch needs a folder that exists.
LiveAttempt& Attempts::attach(const Task& task, std::int64_t number) {
    const AttemptFolder folder = data_.attempt(task, number);
    std::error_code error;  // a missing folder shows when the attempt starts
    std::filesystem::create_directories(folder.root, error);
    std::filesystem::create_directories(data_.output(task), error);
    live_.push_back({.task = task,
                     .number = number,
                     .folder = folder,
                     .resumes = may_resume(store_, task.id, number),
                     .attempt_watch = watch_.add(folder.root, Notice::every_change),
                     .output_watch = watch_.add(data_.output(task), Notice::published_files)});
    return live_.back();
}

/// False: the attempt cannot be started; stores why.
bool Attempts::hand_over(LiveAttempt& live) {
    try {
        lay_out_scene(store_, data_, live.task.run);
        executor_.submit(live.folder, order_for(live, store_, data_, settings_));
    } catch (const std::exception& error) {
        note_loss(live, std::string("it cannot be started: ") + error.what());
        return false;
    }
    note_latency(live.task);
    spdlog::info("{} ({}): attempt {} started", live.task.id, live.task.label, live.number);
    return true;
}

/// For the metrics only. A snapshot's time is the file's own, which includes what the watch lost.
void Attempts::note_latency(const Task& task) {
    const auto note = [&](Histogram& in, std::int64_t since) {
        if (const auto waited = clock_.seconds_since(since)) in.add(*waited);
    };
    if (const auto ready_at = store_.ready_at(task.id)) note(queue_wait_, *ready_at);
    if (task.release != Release::file_exists) return;
    std::error_code error;
    const auto appeared = std::filesystem::last_write_time(
        data_.input(task, store_.task(*task.parent).value()), error);
    if (error) return;
    const auto since = std::chrono::file_clock::to_sys(appeared).time_since_epoch();
    note(snapshot_to_start_, std::chrono::duration_cast<std::chrono::milliseconds>(since).count());
}

// ---------------------------------------------------------------- watching

void Attempts::observe(LiveAttempt& live) {
    if (live.outputs_changed) settle_children(store_, data_, live.task.id);
    live.outputs_changed = false;
    const Vitals vitals = executor_.probe(live.folder);
    switch (vitals.life) {
        case Life::handed_over:
            board_.set(live.task.id, {0.0, vitals.why});
            return;
        case Life::queued:
            board_.set(live.task.id, {0.0, vitals.why});
            note(live, AttemptEvent::submit, &LiveAttempt::submission_noted);
            return;
        case Life::alive:
            if (!live.start_noted) {  // after a wait, a restart, or when the disk was full
                board_.erase(live.task.id);
                note_starts({&live});
            }
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

/// Whole lines only: an incomplete last line is read later.
void Attempts::read_lines(LiveAttempt& live) {
    std::ifstream stream(live.folder.lines(), std::ios::binary);
    if (!stream) return;
    stream.seekg(live.lines_read);
    std::string line;
    while (std::getline(stream, line) && !stream.eof()) {
        live.lines_read += static_cast<std::streamoff>(line.size()) + 1;
        note(live, AttemptEvent::begin, &LiveAttempt::begun);
        const json said = json::parse(line, nullptr, false);
        if (!said.is_object() || said.value("event", "") != "progress") continue;
        const auto fraction = said.find("fraction");
        if (fraction == said.end() || !fraction->is_number()) continue;
        board_.set(live.task.id, {fraction->get<double>(), said.value("message", "")});
    }
}

/// Stores the event once.
void Attempts::note(LiveAttempt& live, AttemptEvent event, bool LiveAttempt::*noted) {
    if (live.*noted) return;
    store_.write([&](Transaction& transaction) {
        transaction.move_attempt(live.task.id, live.number, event);
    });
    live.*noted = true;
}

/// Notes the starts of all running attempts in one commit.
void Attempts::note_starts(const std::vector<LiveAttempt*>& started) {
    if (started.empty()) return;
    store_.write([&](Transaction& transaction) {
        for (const LiveAttempt* live : started) {
            if (!live->submission_noted)
                transaction.move_attempt(live->task.id, live->number, AttemptEvent::submit);
            transaction.move_task(live->task.id, TaskEvent::start);
        }
    });
    for (LiveAttempt* live : started) live->submission_noted = live->start_noted = true;
}

// ---------------------------------------------------------------- settling

void Attempts::note_exit(LiveAttempt& live) {
    const std::string& task = live.task.id;
    const ExitRecord record = *read_exit_record(live.folder);
    const Ending ending = ending_of(record, live.resumes);
    const AttemptEnd end{.exit_code = record.exit_code,
                         .signal = record.signal,
                         .wall_seconds = record.wall_seconds,
                         .cpu_seconds = record.cpu_seconds,
                         .reason = record.stopped ? std::string(name_of(*record.stopped)) : ""};
    const TaskFault fault = ending == Ending::well ? TaskFault{} : fault_of(live, record, data_);
    pass_failpoint("exit_before");
    store_.write([&](Transaction& transaction) {
        transaction.move_attempt(task, live.number, AttemptEvent::exit, end);
        if (transaction.stop_task(task)) return;
        switch (ending) {
            case Ending::well:
                transaction.move_task(task, TaskEvent::exit_well);
                break;
            case Ending::interrupted:
                transaction.move_task(task, TaskEvent::interrupt);
                break;
            case Ending::badly:
                transaction.fail_task(task, TaskEvent::exit_badly, fault);
                break;
            case Ending::retryable:
                retry_or_give_up(transaction, live, TaskEvent::exit_retryable,
                                 TaskEvent::exit_badly, fault);
                break;
        }
    });
    pass_failpoint("exit_after");
    spdlog::info("{} ({}): attempt {} ended, {}", task, live.task.label, live.number,
                 in_words(record));
    settle(live);
}

void Attempts::note_loss(LiveAttempt& live, const std::string& why) {
    const std::string& task = live.task.id;
    AttemptEnd end;  // cost according to the last heartbeat
    if (const auto beat = read_heartbeat(live.folder)) end.cpu_seconds = beat->cpu_seconds;
    executor_.clear_away(live.folder, attempt_id(task, live.number));
    store_.write([&](Transaction& transaction) {
        transaction.move_attempt(task, live.number, AttemptEvent::vanish, end);
        if (transaction.stop_task(task)) return;
        transaction.move_task(task, TaskEvent::vanish, {{"why", why}});
        retry_or_give_up(transaction, live, TaskEvent::retry, TaskEvent::give_up,
                         {std::nullopt, why});
    });
    spdlog::warn("{} ({}): attempt {} lost, {}", task, live.task.label, live.number, why);
    settle(live);
}

void Attempts::retry_or_give_up(Transaction& transaction, const LiveAttempt& live, TaskEvent retry,
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

/// The attempt is over; its task too, unless it is retried.
void Attempts::settle(LiveAttempt& live) {
    live.over = true;
    const auto now = store_.task(live.task.id);
    if (now && (is_final(now->state) || now->state == TaskState::finalizing)) over_(live.task);
}

void Attempts::stop_watching(const LiveAttempt& live) {
    watch_.remove(live.attempt_watch);
    watch_.remove(live.output_watch);
    board_.erase(live.task.id);
}

void Attempts::forget_the_ended() {
    std::vector<std::string> ended;
    for (const LiveAttempt& live : live_) {
        if (!live.over) continue;
        stop_watching(live);
        ended.push_back(live.task.id);
    }
    std::erase_if(live_, [](const LiveAttempt& live) { return live.over; });
    for (const std::string& task : ended) settle_children(store_, data_, task);
}

}  // namespace breach::orchestrator
