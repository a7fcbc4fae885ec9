// One thread writes; all others queue a job and wait. It commits many jobs at once, because a
// commit waits for the disk and the jobs do not. Each job has a savepoint: one that throws is
// undone alone, the others are stored. Readers have connections of their own and see the last
// commit.
#include "services/orchestrator/store/store.hpp"

#include <algorithm>
#include <exception>
#include <iterator>

#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/store/schema.hpp"

namespace breach::orchestrator {

namespace {

/// Bounds how long the first job of a group waits for the others.
constexpr std::size_t largest_group = 256;
constexpr std::size_t most_idle_readers =
    32;  // typical number of concurrent readers; each needs some 100 kB

std::filesystem::path with_schema(const std::filesystem::path& file) {
    Connection database(file, Access::read_write);
    make_schema(database, file);
    return file;
}

}  // namespace

Store::Store(const std::filesystem::path& file)
    : file_(with_schema(file)), writing_(file, Access::read_write) {
    last_event_ = writing_.integer("SELECT max(seq) FROM events").value_or(0);
    writer_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

Store::~Store() = default;

/// Returns after the commit: whoever has an answer may rely on the disk. Throws what the job
/// threw, or StoreError for the whole group.
void Store::wait_for(std::function<void(Transaction&)> change, const std::string& by) {
    Job job{std::move(change), by, {}, nullptr};
    std::future<void> done = job.done.get_future();
    {
        const std::lock_guard lock(jobs_mutex_);
        jobs_.push_back(std::move(job));
    }
    jobs_arrived_.notify_one();
    done.get();
}

void Store::serve(const std::stop_token& stop) {
    while (true) {
        std::deque<Job> group;
        {
            std::unique_lock lock(jobs_mutex_);
            if (!jobs_arrived_.wait(lock, stop, [&] { return !jobs_.empty(); })) return;
            while (!jobs_.empty() && group.size() < largest_group) {
                group.push_back(std::move(jobs_.front()));
                jobs_.pop_front();
            }
        }
        commit(group);
    }
}

void Store::commit(std::deque<Job>& jobs) {
    std::vector<Event> events;
    bool removes_events = false;
    try {
        writing_.script("BEGIN IMMEDIATE");
        for (Job& job : jobs) {
            writing_.change("SAVEPOINT job", {});
            try {
                Transaction transaction(writing_, job.by);
                job.change(transaction);
                std::ranges::move(transaction.take_events(), std::back_inserter(events));
                removes_events = removes_events || transaction.removes_events();
            } catch (...) {
                job.refused = std::current_exception();
                writing_.script("ROLLBACK TO job");
            }
            writing_.change("RELEASE job", {});
        }
        pass_failpoint("store_before_commit");
        writing_.script("COMMIT");
        // Events are published after the commit, so that no client hears of what a crash undoes.
        pass_failpoint("store_after_commit");
    } catch (const StoreError&) {
        const std::exception_ptr failure = std::current_exception();
        try {
            writing_.script("ROLLBACK");
        } catch (const StoreError&) {
            // SQLite has already rolled back (disk full, I/O error).
        }
        for (Job& job : jobs) job.done.set_exception(failure);
        return;
    }
    commit_sizes_.add(static_cast<double>(jobs.size()));
    if (!events.empty()) {
        {
            const std::lock_guard lock(events_mutex_);
            last_event_ = events.back().seq;
            if (removes_events)
                recent_events_.forget();
            else
                recent_events_.add(std::move(events));
        }
        event_stored_.notify_all();
    }
    for (Job& job : jobs) {
        if (job.refused) {
            job.done.set_exception(job.refused);
        } else {
            job.done.set_value();
        }
    }
}

Store::Reader Store::reader() const {
    {
        const std::lock_guard lock(readers_mutex_);
        if (!idle_readers_.empty()) {
            Reader idle(idle_readers_.back().release(), {this});
            idle_readers_.pop_back();
            return idle;
        }
    }
    return {new Connection(file_, Access::read_only), {this}};
}

void Store::GiveBack::operator()(Connection* connection) const {
    std::unique_ptr<Connection> idle(connection);
    const std::lock_guard lock(store->readers_mutex_);
    if (store->idle_readers_.size() < most_idle_readers)
        store->idle_readers_.push_back(std::move(idle));
}

bool Store::wait_for_event(std::int64_t seq, std::chrono::milliseconds longest) const {
    std::unique_lock lock(events_mutex_);
    return event_stored_.wait_for(lock, longest, [&] { return last_event_ > seq; });
}

}  // namespace breach::orchestrator
