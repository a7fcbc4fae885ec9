// Removes runs in two steps. Transaction::remove_run deletes the rows and notes the run in
// `removals`; this thread deletes the folder and then the note. Killed in between, the next look
// finds the note and goes on. The other order would leave rows whose files are gone.
#include "services/orchestrator/dispatch/retention.hpp"

#include <spdlog/spdlog.h>

#include <chrono>

#include "services/orchestrator/files/disk_use.hpp"
#include "services/orchestrator/files/failpoint.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

namespace fs = std::filesystem;

namespace {

/// Days and gigabytes change slowly; an order by a user calls wake() instead of waiting.
constexpr auto between_looks = std::chrono::seconds(60);
constexpr std::int64_t pages_at_once = 2000;  // 8 MB: bounds the wait of other writers
constexpr double file_grace_days = 1.0;       // between the upload and a study that names it

}  // namespace

Retention::Retention(Store& store, const DataFolder& data, RetentionSettings settings)
    : store_(store), data_(data), settings_(settings) {
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

void Retention::wake() {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = true;
    }
    woken_.notify_one();
}

void Retention::serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        {
            std::unique_lock lock(mutex_);
            woken_.wait_for(lock, stop, between_looks, [&] { return wanted_; });
            wanted_ = false;
        }
        if (stop.stop_requested()) return;
        try {
            look(stop);
        } catch (const std::exception& error) {
            spdlog::error("retention: {}; trying again", error.what());
        }
    }
}

void Retention::look(const std::stop_token& stop) {
    if (settings_.keep_days) remove_old_runs();
    if (settings_.keep_gb) remove_for_room();
    if (!is_being_backed_up()) {
        remove_folders(stop);
        forget_unused_files();
    }
    shrink_database(stop);
}

/// breachline-backup copies the database first, then the files. A killed backup blocks removals for
/// a day at most.
bool Retention::is_being_backed_up() const {
    std::error_code error;
    const auto since = fs::last_write_time(data_.root() / "backup-under-way", error);
    return !error && fs::file_time_type::clock::now() - since < std::chrono::hours(24);
}

void Retention::remove_folders(const std::stop_token& stop) {
    for (const std::string& run : store_.removals()) {
        pass_failpoint("removal_rows_gone");
        std::error_code none_left;
        for (const auto& entry : fs::directory_iterator(data_.run(run), none_left)) {
            if (stop.stop_requested()) return;
            fs::remove_all(entry.path());
            pass_failpoint("removal_half_way");
        }
        fs::remove_all(data_.run(run));
        pass_failpoint("removal_files_gone");
        store_.write([&](Transaction& transaction) { transaction.forget_removal(run); });
        spdlog::info("{}: removed", run);
    }
}

bool Retention::remove(const Run& run, const std::string& why) {
    const Removal outcome =
        store_.write([&](Transaction& transaction) { return transaction.remove_run(run.id, why); });
    if (outcome != Removal::done) return false;  // retried
    spdlog::info("{} ({}): is removed, {}", run.id, run.name, why);
    return true;
}

void Retention::remove_old_runs() {
    const std::string limit = utc_days_ago(*settings_.keep_days);
    for (const Run& run : store_.runs_that_may_go()) {
        if (*run.finished >= limit) return;
        remove(run, "it ended longer ago than --keep-days");
    }
}

void Retention::remove_for_room() {
    DiskUse use(data_.runs(), data_.files());
    const double most = 1e9 * *settings_.keep_gb;
    const auto held = [&] {
        return static_cast<double>(use.bytes_of_runs() + use.bytes_of_files() + database_bytes());
    };
    for (const std::string& run : store_.removals()) use.leave_out(run);
    if (held() > most)
        for (const Run& run : store_.runs_that_may_go()) {
            if (!remove(run, "to keep within --keep-gb")) continue;
            use.leave_out(run.id);
            if (held() <= most) break;
        }
    const bool full = held() > most;
    if (full && !said_full_)
        spdlog::warn(
            "the data folder has {:.2f} GB, more than --keep-gb {}: what is left runs, or "
            "is the database",
            1e-9 * held(), *settings_.keep_gb);
    said_full_ = full;
}

void Retention::forget_unused_files() {
    const std::string limit = utc_days_ago(file_grace_days);
    for (const StoredFile& each : store_.unused_files(limit)) {
        const bool forgotten = store_.write([&](Transaction& transaction) {
            return transaction.forget_unused_file(each.sha256, limit,
                                                  [&] { fs::remove(data_.files() / each.file); });
        });
        if (forgotten) spdlog::info("file {} ({}): removed, no run names it", each.file, each.name);
    }
}

void Retention::shrink_database(const std::stop_token& stop) {
    for (std::int64_t left = store_.free_pages(); left > 0 && !stop.stop_requested();) {
        store_.write([&](Transaction& transaction) { transaction.shrink(pages_at_once); });
        const std::int64_t now = store_.free_pages();
        if (now >= left) return;  // the database does not shrink
        left = now;
    }
}

std::int64_t Retention::database_bytes() const {
    std::int64_t bytes = 0;
    for (const char* end : {"", "-wal", "-shm"}) {
        fs::path file = data_.database();
        file += end;
        std::error_code error;
        const auto size = fs::file_size(file, error);
        if (!error) bytes += static_cast<std::int64_t>(size);
    }
    return bytes;
}

}  // namespace breach::orchestrator
