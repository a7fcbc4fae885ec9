#include "services/orchestrator/dispatch/dispatcher.hpp"

#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "core/scene/file_paths.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using Clock = std::chrono::steady_clock;

namespace {

constexpr auto longest_wait = std::chrono::milliseconds(1000);
constexpr auto shortest_round = std::chrono::milliseconds(5);  // changes come in crowds

std::string in_seconds(double time) {
    std::ostringstream text;
    text << time << " s";
    return text.str();
}

/// Why a child's time was not reached; nothing: the parent did not end regularly before it.
/// A FEM whose mesh entangles has done its work, and so has a run without what lies beyond.
std::optional<std::string> why_not_reached(const Task& parent, const BlockedTask& child) {
    if (parent.not_reached && parent.fault) return parent.fault->summary;
    if (!has_output(parent.state) || !parent.result || !child.transfer_time) return std::nullopt;
    if (parent.result->value("ended", "") != "entangled") return std::nullopt;
    return "the FEM ended entangled at " + in_seconds(parent.result->value("end_time", 0.0)) +
           ", before " + in_seconds(*child.transfer_time);
}

std::set<std::string> names_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        names.insert(entry.path().filename());
    return names;
}

}  // namespace

Bell::Bell() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}
Bell::~Bell() { close(descriptor_); }
void Bell::ring() const { eventfd_write(descriptor_, 1); }
void Bell::silence() const {
    eventfd_t count = 0;
    eventfd_read(descriptor_, &count);
}

Dispatcher::Dispatcher(Store& store, const DataFolder& data, Executor& executor,
                       ProgressBoard& board, DispatchSettings settings)
    : store_(store),
      data_(data),
      executor_(executor),
      board_(board),
      settings_(std::move(settings)),
      triggers_(store, data),
      batches_(store, data, settings_.numerics),
      registrar_(store, data,
                 [this](const std::string& task) {
                     {
                         const std::lock_guard lock(registered_mutex_);
                         registered_.push_back(task);
                     }
                     wake();
                 }),
      cache_(store, data, [this](LookedUp found) {
          {
              const std::lock_guard lock(registered_mutex_);
              looked_up_.push_back(std::move(found));
          }
          wake();
      }) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

Dispatcher::~Dispatcher() { stop(); }

void Dispatcher::stop() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    wake();
    thread_.join();
}

void Dispatcher::wake() { bell_.ring(); }

void Dispatcher::settle_all() {
    unsettled_ = true;
    wake();
}

void Dispatcher::serve(const std::stop_token& stop) {
    stop_ = stop;
    bool reconciled = false;
    while (!stop.stop_requested()) {
        try {
            if (!reconciled) reconcile();
            reconciled = true;
            look_around();
            start_ready_tasks();
            wait_for_something();
        } catch (const std::exception& error) {
            // A full disk or the like: nothing was half-stored, but what was stored may not have
            // been acted upon, nor noted in memory. So look again as after a start, when it may be
            // better.
            spdlog::error("dispatcher: {}", error.what());
            reconciled = false;
            std::this_thread::sleep_for(pause_after_trouble);
        }
    }
    try {
        shut_down();
    } catch (const std::exception& error) {
        spdlog::error("dispatcher: {}", error.what());
    }
}

/// What the store says was going on, held against what is; after a start, and after trouble.
void Dispatcher::reconcile() {
    for (const Live& live : live_) stop_watching(live);
    live_.clear();
    {
        const std::lock_guard lock(registered_mutex_);
        registered_.clear();  // all parents are looked at below
    }
    constexpr auto all = static_cast<std::size_t>(1) << 30;
    for (const TaskState state : {TaskState::starting, TaskState::running, TaskState::cancelling}) {
        for (const Task& task : store_.tasks_in(state, all)) {
            const std::vector<Attempt> attempts = store_.attempts_of(task.id);
            const Attempt& last = attempts.back();
            spdlog::info("{} ({}): attempt {} was going on", task.id, task.label, last.number);
            Live& live = attach(task, last.number);
            live.submission_noted = last.state != AttemptState::submitting;
            live.start_noted = task.state == TaskState::running;
            live.begun = last.state == AttemptState::running;
        }
    }
    for (Task& task : store_.tasks_in(TaskState::finalizing, all)) registrar_.add(std::move(task));
    for (const std::string& parent : store_.parents_of_blocked()) {
        if (stop_.stop_requested()) return;
        settle_children(parent);
    }
}

void Dispatcher::look_around() {
    const std::vector<int> changed = watch_.changes();
    settle_after_registrar();
    stop_cancelled();
    const bool all = Clock::now() - looked_at_all_ >= longest_wait;
    if (all) looked_at_all_ = Clock::now();
    for (Live& live : live_) {
        if (all || std::ranges::find(changed, live.output_watch) != changed.end())
            live.outputs_changed = true;
        observe_alone(live);
    }
    forget_the_ended();
    triggers_.look();
    if (batches_.look()) settle_all();
    release_retries();
    if (unsettled_.exchange(false)) {
        for (const std::string& parent : store_.parents_of_blocked()) {
            if (stop_.stop_requested()) return;
            settle_children(parent);
        }
    }
}

/// One whose files cannot be read must not hold up the others: it says why it is stuck, and is
/// looked at again.
void Dispatcher::observe_alone(Live& live) {
    try {
        observe(live);
    } catch (const std::filesystem::filesystem_error& error) {
        const std::string why = std::string("cannot be observed: ") + error.what();
        if (board_.of(live.task.id).message != why)
            spdlog::error("{} ({}): {}", live.task.id, live.task.label, why);
        board_.set(live.task.id, {0.0, why});
    }
}

void Dispatcher::wait_for_something() {
    auto wait = longest_wait;
    if (const auto retry = store_.next_retry()) {
        const auto left = std::chrono::milliseconds(*retry - epoch_ms());
        wait = std::clamp(left, std::chrono::milliseconds(0), longest_wait);
    }
    wait = std::min(wait, triggers_.patience());
    pollfd wanted[] = {{watch_.descriptor(), POLLIN, 0},
                       {triggers_.descriptor(), POLLIN, 0},
                       {bell_.descriptor(), POLLIN, 0}};
    poll(wanted, 3, static_cast<int>(wait.count()));
    std::this_thread::sleep_until(round_began_ + shortest_round);
    round_began_ = Clock::now();
    bell_.silence();
}

void Dispatcher::shut_down() {
    if (executor_.at_stop() == AtStop::leaves_them) return;
    for (Live& live : live_) executor_.stop(live.folder, StopReason::shutdown);
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(settings_.grace_seconds + 2));
    while (!live_.empty() && Clock::now() < deadline) {
        look_around();
        if (!live_.empty()) wait_for_something();
    }
}

// ---------------------------------------------------------------- starting

void Dispatcher::start_ready_tasks() {
    const std::vector<Task> tasks = tasks_that_fit();
    if (!tasks.empty()) start(tasks);
}

/// In order of priority and age; the first that does not fit holds back those behind it, so that
/// small tasks cannot keep a large one waiting for ever. One that asks for more than there is runs
/// alone.
std::vector<Task> Dispatcher::tasks_that_fit() {
    constexpr std::size_t look_ahead = 8;  // the cache needs no slot
    auto cores = static_cast<std::int64_t>(settings_.slots);
    std::int64_t memory = settings_.memory_mb;
    std::map<std::string, std::size_t> running;
    const auto take = [&](const Task& task) {
        cores -= task.resources.cores;
        memory -= task.resources.memory_mb;
        ++running[task.phase];
    };
    for (const Live& live : live_) take(live.task);
    const auto is_full = [&](const std::string& phase) {
        const auto limit = settings_.limits.find(phase);
        return limit != settings_.limits.end() && running[phase] >= limit->second;
    };
    std::vector<std::string> full;
    for (const auto& [phase, limit] : settings_.limits)
        if (is_full(phase)) full.push_back(phase);

    std::vector<Task> chosen;
    bool held_back = false;
    const auto most = static_cast<std::size_t>(std::max<std::int64_t>(cores, 0)) + look_ahead +
                      in_the_cache_.size() + wait_for_equals_.size();
    wait_for_equals_.clear();
    for (Task& task : store_.tasks_to_start(full, most)) {
        if (leave_to_the_cache(task)) continue;
        if (held_back || is_full(task.phase)) continue;
        if (waits_for_an_equal(task, chosen)) {
            wait_for_equals_.insert(task.id);
            continue;
        }
        if (leave_to_the_cache(task)) continue;  // an equal one may just have ended
        const bool alone = live_.empty() && chosen.empty();
        const bool fits = task.resources.cores <= cores &&
                          (settings_.memory_mb == 0 || task.resources.memory_mb <= memory);
        held_back = !fits && !alone;
        if (held_back) continue;
        take(task);
        chosen.push_back(std::move(task));
    }
    return chosen;
}

bool Dispatcher::leave_to_the_cache(const Task& task) {
    if (in_the_cache_.contains(task.id)) return true;
    const auto looked_up = not_cached_.find(task.id);
    const bool asks = looked_up == not_cached_.end()
                          ? cache_.may_answer(task)
                          : cache_.has_changed_since(looked_up->second, task);
    if (!asks) return false;
    in_the_cache_.insert(task.id);
    cache_.examine(task);
    return true;
}

/// What is being computed now, for another run or another variant, is not computed a second time
/// beside it.
bool Dispatcher::waits_for_an_equal(const Task& task, const std::vector<Task>& chosen) const {
    const auto may_be_equal = [&](const Task& other) {
        const bool same_input = other.parent == task.parent && other.input == task.input;
        return task.recipe && other.recipe == task.recipe && (other.run != task.run || same_input);
    };
    if (std::ranges::any_of(chosen, may_be_equal)) {
        bell_.ring();  // once that has been started the store knows
        return true;
    }
    return store_.equal_in_flight(task).has_value();
}

/// One commit before the processes are started and one after, for all of them.
void Dispatcher::start(const std::vector<Task>& tasks) {
    std::vector<std::int64_t> numbers;
    for (const Task& task : tasks) drop_placed_outputs(data_, task);
    reach(Failpoint::claim_before);
    store_.write([&](Transaction& transaction) {
        numbers.clear();
        for (const Task& task : tasks) {
            const bool claimed = transaction.try_move_task(task.id, TaskEvent::claim).has_value();
            numbers.push_back(claimed ? transaction.add_attempt(task.id) : 0);  // 0: cancelled
        }
    });
    reach(Failpoint::claim_after);
    std::vector<Live*> started;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        not_cached_.erase(tasks[i].id);
        if (numbers[i] == 0) continue;
        Live& live = attach(tasks[i], numbers[i]);
        if (!hand_over(live)) continue;
        const Life life = executor_.probe(live.folder).life;
        if (life == Life::alive || life == Life::ended) started.push_back(&live);
    }
    reach(Failpoint::start_after);
    note_starts(started);
    forget_the_ended();
}

/// Of those that run at once, in one commit.
void Dispatcher::note_starts(const std::vector<Live*>& started) {
    if (started.empty()) return;
    store_.write([&](Transaction& transaction) {
        for (const Live* live : started) {
            transaction.move_attempt(live->task.id, live->number, AttemptEvent::submit);
            transaction.move_task(live->task.id, TaskEvent::start);
        }
    });
    for (Live* live : started) live->submission_noted = live->start_noted = true;
}

/// The files that the run's scenes name by their content, beside its scene.
void Dispatcher::link_files(const std::string& run) {
    namespace fs = std::filesystem;
    for (const StoredFile& each : store_.files_of(run)) {
        const fs::path link = data_.run(run) / scene::folder_of_references / each.file;
        if (fs::exists(link)) continue;
        fs::create_directories(link.parent_path());
        std::error_code error;
        fs::create_hard_link(data_.files() / each.file, link, error);
        if (error) fs::copy_file(data_.files() / each.file, link);
    }
}

/// False: it cannot be started, which is noted.
bool Dispatcher::hand_over(Live& live) {
    const Task& task = live.task;
    try {
        const std::filesystem::path scene = data_.scene(task.run);
        if (!std::filesystem::exists(scene)) {
            link_files(task.run);
            exchange::publish_text(
                scene, nlohmann::json::parse(store_.scene_of(task.run).value()).dump(2) + "\n");
        }
        executor_.submit(live.folder, order_for(live));
    } catch (const std::exception& error) {
        note_loss(live, std::string("it cannot be started: ") + error.what());
        return false;
    }
    note_latency(task);
    spdlog::info("{} ({}): attempt {} started", task.id, task.label, live.number);
    return true;
}

void Dispatcher::note_latency(const Task& task) {
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

/// A checkpoint that was refused (damaged, or an earlier version's) is not tried twice.
bool Dispatcher::may_resume(const std::string& task, std::int64_t number) const {
    if (number == 1) return false;
    for (const Attempt& each : store_.attempts_of(task))
        if (each.number == number - 1)
            return each.exit_code != static_cast<std::int64_t>(fault::ExitCode::bad_input);
    return true;
}

Order Dispatcher::order_for(const Live& live) const {
    const Task& task = live.task;
    std::vector<std::string> arguments{data_.scene(task.run)};
    if (!task.input.empty())
        arguments.insert(arguments.end(),
                         {"--input", data_.input(task, store_.task(*task.parent).value())});
    arguments.insert(arguments.end(), {"--output", data_.output(task)});
    for (const std::string& each : task.overrides)
        arguments.insert(arguments.end(), {"--set", each});
    arguments.insert(arguments.end(),
                     {"--progress", "json", "--threads", std::to_string(task.resources.cores)});
    if (live.resumes) arguments.emplace_back("--resume");
    return {.attempt = attempt_id(task.id, live.number),
            .program = settings_.bin / task.phase,
            .arguments = std::move(arguments),
            .grace_seconds = settings_.grace_seconds,
            .cores = task.resources.cores,
            .memory_mb = task.resources.memory_mb,
            .priority = task.priority};
}

Dispatcher::Live& Dispatcher::attach(const Task& task, std::int64_t number) {
    const AttemptFolder folder = data_.attempt(task, number);
    std::error_code error;  // a folder that cannot be made shows when the attempt is started
    std::filesystem::create_directories(folder.root, error);
    std::filesystem::create_directories(data_.output(task), error);
    live_.push_back({.task = task,
                     .number = number,
                     .folder = folder,
                     .resumes = may_resume(task.id, number),
                     .attempt_watch = watch_.add(folder.root, Notice::every_change),
                     .output_watch = watch_.add(data_.output(task), Notice::published_files)});
    return live_.back();
}

// ---------------------------------------------------------------- releasing

void Dispatcher::stop_cancelled() {
    if (live_.empty()) return;
    for (const Task& task : store_.tasks_in(TaskState::cancelling, live_.size())) {
        for (Live& live : live_) {
            if (live.task.id != task.id || live.asked_to_stop) continue;
            executor_.stop(live.folder, StopReason::cancel);
            live.asked_to_stop = true;
        }
    }
}

void Dispatcher::release_retries() {
    for (const std::string& task : store_.due_retries(epoch_ms())) {
        store_.write([&](Transaction& transaction) {
            transaction.try_move_task(task, TaskEvent::wait_over);
        });
    }
}

void Dispatcher::settle_children(const std::string& parent_id) {
    const std::vector<BlockedTask> children = store_.blocked_children(parent_id);
    if (children.empty()) return;
    const std::optional<Task> found = store_.task(parent_id);
    if (!found) return;  // removed meanwhile
    const Task& parent = *found;
    const bool succeeded = has_output(parent.state);
    // Snapshots of a mesh that entangled later are good: the file decides, not the FEM's end.
    // What is placed and not taken may go again before its task runs (dispatch/cache.cpp).
    const auto is_being_placed = [&] {
        return parent.state == TaskState::ready && std::filesystem::exists(data_.reused(parent));
    };
    const bool was_being_placed = is_being_placed();
    std::set<std::string> files = names_in(data_.output(parent));
    if (was_being_placed || is_being_placed()) files.clear();
    std::vector<std::string> released;
    std::vector<std::string> skipped;
    for (const BlockedTask& child : children) {
        const bool delivered =
            child.release == Release::file_exists ? files.contains(child.input) : succeeded;
        if (delivered) {
            released.push_back(child.id);
        } else if (is_final(parent.state)) {
            skipped.push_back(child.id);
        }
    }
    if (released.empty() && skipped.empty()) return;
    const std::string why =
        parent.label + " " + std::string(name_of(parent.state)) + " before it gave ";
    store_.write([&](Transaction& transaction) {
        for (const std::string& each : released)
            transaction.try_move_task(each, TaskEvent::release);
        for (const BlockedTask& child : children) {
            if (!std::ranges::binary_search(skipped, child.id)) continue;
            if (const auto beyond = why_not_reached(parent, child)) {
                transaction.pass_over_task(child.id, *beyond);
            } else {
                transaction.fail_task(child.id, TaskEvent::skip, {std::nullopt, why + child.input});
            }
        }
    });
    for (const std::string& each : skipped) settle_children(each);
}

/// What is not got through, because an exception ends it, is got through by the next reconciling.
void Dispatcher::settle_after_registrar() {
    std::vector<std::string> tasks;
    std::vector<LookedUp> looked_up;
    {
        const std::lock_guard lock(registered_mutex_);
        tasks.swap(registered_);
        looked_up.swap(looked_up_);
    }
    for (const LookedUp& each : looked_up) in_the_cache_.erase(each.task);
    for (const std::string& task : tasks) settle_children(task);
    for (const LookedUp& each : looked_up) {
        const auto now = store_.task(each.task);
        if (now && now->state == TaskState::ready) {
            not_cached_.insert_or_assign(each.task, each);
        } else {
            settle_children(each.task);
        }
    }
}

}  // namespace breach::orchestrator
