// The one thread that moves tasks between `ready` and `finalizing`. Other threads (HTTP requests,
// cache, registrar) change rows through the store and wake it; none of them starts or stops a
// process. Every round asks the store again what there is to do, so that a lost notice costs at
// most one longest_wait.
#include "services/orchestrator/dispatch/dispatcher.hpp"

#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "services/orchestrator/dispatch/release.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using Clock = std::chrono::steady_clock;

namespace {

/// The poll's upper bound: the price of a notice that got lost, and the pace of the regular look
/// at all attempts.
constexpr auto longest_wait = std::chrono::milliseconds(1000);
constexpr auto shortest_round = std::chrono::milliseconds(5);  // changes come in bursts

}  // namespace

Dispatcher::Dispatcher(Store& store, const DataFolder& data, Executor& executor,
                       ProgressBoard& board, DispatchSettings settings)
    : store_(store),
      data_(data),
      executor_(executor),
      settings_(std::move(settings)),
      registered_(notifier_),
      // The registrar's thread only leaves a letter; children are settled on the dispatcher's
      // thread.
      registrar_(store, data, [this](const std::string& task) { registered_.put(task); }),
      attempts_(store, data, executor, board, settings_,
                [this](const Task& task) { registrar_.add(task); }),
      ready_(store, data, notifier_),
      triggers_(store, data),
      batches_(store, data, settings_.numerics) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

Dispatcher::~Dispatcher() { stop(); }

/// Also called by the destructor; the second call finds no thread.
void Dispatcher::stop() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    wake();
    thread_.join();
}

void Dispatcher::wake() { notifier_.notify(); }

void Dispatcher::settle_all() {
    unsettled_ = true;
    wake();
}

void Dispatcher::serve(const std::stop_token& stop) {
    // Unset by any error below: memory (live attempts, letters) may then differ from the store.
    bool reconciled = false;
    while (!stop.stop_requested()) {
        try {
            if (!reconciled) reconcile(stop);
            reconciled = true;
            look_around(stop);
            start_ready_tasks();
            wait_for_something();
        } catch (const std::exception& error) {
            // For example a full disk: the store is consistent, but stored changes may not have
            // been acted upon. Reconcile again, as after a start.
            spdlog::error("dispatcher: {}", error.what());
            reconciled = false;
            std::this_thread::sleep_for(pause_after_trouble);
        }
    }
    try {
        shut_down(stop);
    } catch (const std::exception& error) {
        spdlog::error("dispatcher: {}", error.what());
    }
}

/// Compares the store with the processes that exist; after a start, and after an error.
void Dispatcher::reconcile(const std::stop_token& stop) {
    attempts_.adopt();
    registered_.take();  // all parents are checked below
    constexpr auto all = static_cast<std::size_t>(1) << 30;
    for (Task& task : store_.tasks_in(TaskState::finalizing, all)) registrar_.add(std::move(task));
    settle_all_children(store_, data_, stop);
}

/// If an exception interrupts it, the next reconciliation does the rest.
void Dispatcher::look_around(const std::stop_token& stop) {
    for (const std::string& task : registered_.take()) settle_children(store_, data_, task);
    for (const std::string& task : ready_.answered()) settle_children(store_, data_, task);
    attempts_.look();
    triggers_.look();
    if (batches_.look()) settle_all();
    release_due_retries(store_);
    if (unsettled_.exchange(false)) settle_all_children(store_, data_, stop);
}

void Dispatcher::start_ready_tasks() {
    const std::vector<Task> tasks = ready_.to_start(attempts_.capacity());
    if (!tasks.empty()) attempts_.start(tasks);
}

void Dispatcher::wait_for_something() {
    auto wait = longest_wait;
    if (const auto retry = store_.next_retry()) {
        const auto left = std::chrono::milliseconds(*retry - epoch_ms());
        wait = std::clamp(left, std::chrono::milliseconds(0), longest_wait);
    }
    // A window's end by time comes without any notice.
    wait = std::min(wait, triggers_.patience());
    pollfd wanted[] = {{attempts_.descriptor(), POLLIN, 0},
                       {triggers_.descriptor(), POLLIN, 0},
                       {notifier_.descriptor(), POLLIN, 0}};
    poll(wanted, 3, static_cast<int>(wait.count()));
    std::this_thread::sleep_until(round_began_ + shortest_round);
    round_began_ = Clock::now();
    notifier_.clear();
}

/// Slurm's jobs go on without the service. Local attempts get the grace time to write a
/// checkpoint, and two seconds more for their exit record; those that need longer are adopted or
/// counted as lost at the next start.
void Dispatcher::shut_down(const std::stop_token& stop) {
    if (executor_.at_stop() == AtStop::leaves_them) return;
    attempts_.stop_all();
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(settings_.grace_seconds + 2));
    while (!attempts_.empty() && Clock::now() < deadline) {
        look_around(stop);
        if (!attempts_.empty()) wait_for_something();
    }
}

}  // namespace breach::orchestrator
