// `breachline serve`: assembles the service and runs until SIGINT or SIGTERM. The only place that
// knows all of its parts.
#pragma once

#include <filesystem>

#include "services/orchestrator/dispatch/dispatcher.hpp"
#include "services/orchestrator/dispatch/retention.hpp"
#include "services/orchestrator/executors/slurm_executor.hpp"
#include "services/orchestrator/http/http_server.hpp"

namespace breach::orchestrator {

/// local: on this machine, ended when the service stops; slurm: as jobs, which go on without it.
enum class Place { local, slurm };

struct ServeSettings {
    std::filesystem::path data = "breachline-data";
    std::filesystem::path web;
    std::filesystem::path workflows;  ///< folder with studies/ and scenes/
    std::filesystem::path self;       ///< this executable, for supervisors
    Place place = Place::local;
    SlurmSettings slurm;
    DispatchSettings dispatch;
    RetentionSettings retention;
    std::size_t largest_file_mb = 256;                                  ///< sent or named
    std::optional<std::vector<std::filesystem::path>> allowed_folders;  ///< SentFiles::allowed
    HttpSettings http;
};

/// Prints {"event":"listening","url",...} on stdout when requests are answered. Returns the exit
/// code; throws when it cannot start.
int serve(const ServeSettings& settings);

}  // namespace breach::orchestrator
