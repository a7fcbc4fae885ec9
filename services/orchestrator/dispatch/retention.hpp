// Frees disk space, on a thread of its own. Deletes folders of removed runs, runs beyond the kept
// age or size, uploaded files that no run names, and free pages of the database. Every removal is
// stored before it is executed, so that a restart continues it.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

struct RetentionSettings {
    std::optional<double> keep_days;  ///< a run that ended earlier is removed
    std::optional<double> keep_gb;    ///< [1e9 bytes] of runs, files and database: the oldest go
};

class Retention {
  public:
    Retention(Store& store, const DataFolder& data, RetentionSettings settings);

    /// Call after a removal.
    void wake();
    const RetentionSettings& settings() const { return settings_; }
    /// Size of the database with its write-ahead log.
    std::int64_t database_bytes() const;

  private:
    void serve(const std::stop_token& stop);
    void look(const std::stop_token& stop);
    bool is_being_backed_up() const;
    void remove_folders(const std::stop_token& stop);
    void remove_old_runs();
    void remove_for_room();
    void forget_unused_files();
    void shrink_database(const std::stop_token& stop);
    bool remove(const Run& run, const std::string& why);

    Store& store_;
    const DataFolder& data_;
    RetentionSettings settings_;
    bool said_full_ = false;
    std::mutex mutex_;
    std::condition_variable_any woken_;
    bool wanted_ = true;
    std::jthread thread_;  // last: stops before the members it uses are destroyed
};

}  // namespace breach::orchestrator
