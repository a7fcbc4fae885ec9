// The parts of the service that the HTTP layer may use. Each guards itself against the many threads
// of requests; none of them knows HTTP.
#pragma once

#include <filesystem>
#include <mutex>
#include <set>
#include <string>

#include "services/orchestrator/accuracy/earlier_costs.hpp"
#include "services/orchestrator/dispatch/dispatcher.hpp"
#include "services/orchestrator/dispatch/progress_board.hpp"
#include "services/orchestrator/dispatch/retention.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/files/frames.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// The Idempotency-Keys of requests that are being stored now: KeyInProgress enters and leaves. In
/// memory only: when the service is killed, its requests are over too. Those of stored runs are in
/// the database.
class KeysInProgress {
  public:
    bool enter(const std::string& key) {
        const std::lock_guard lock(mutex_);
        return keys_.insert(key).second;
    }
    void leave(const std::string& key) {
        const std::lock_guard lock(mutex_);
        keys_.erase(key);
    }

  private:
    std::mutex mutex_;
    std::set<std::string> keys_;
};

/// Made by serve() and shared by all requests; everything in it outlives the HTTP server.
struct Service {
    Store& store;
    const DataFolder& data;
    Dispatcher& dispatcher;
    Retention& retention;
    const ProgressBoard& board;
    FrameReader& frames;
    EarlierCosts& earlier_costs;
    KeysInProgress& keys;
    std::filesystem::path bin;        ///< the phase executables
    Numerics numerics;                ///< versions of their numerics, as they report them
    std::filesystem::path web;        ///< the dashboard's files
    std::filesystem::path workflows;  ///< the shipped studies and their scenes
    std::size_t largest_file = std::size_t{256} << 20;  ///< limit of sent and named files [bytes]
    /// SentFiles::allowed
    std::optional<std::vector<std::filesystem::path>> allowed_folders = {};
};

}  // namespace breach::orchestrator
