// The routes of the API, group by group.
#pragma once

#include <atomic>

#include "services/orchestrator/http/http_router.hpp"
#include "services/orchestrator/http/service.hpp"

namespace breach::orchestrator {

/// All of those below.
void add_all_routes(Router& router, Service& service, const std::atomic<bool>& stopping);

/// Runs and tasks: submit, list, inspect, cancel, results.
void add_run_routes(Router& router, Service& service);
/// Error against run time.
void add_accuracy_routes(Router& router, Service& service);
/// What samples say of a result.
void add_uncertainty_routes(Router& router, Service& service);
void add_motion_routes(Router& router, Service& service);
/// Triggers: what became of them, and new ones while a run goes on.
void add_trigger_routes(Router& router, Service& service);
/// What the phases wrote: logs, telemetry, frames, artifacts.
void add_output_routes(Router& router, Service& service);
/// A run as the report that a person reads.
void add_report_routes(Router& router, Service& service);
/// What leaves the model: hydrographs at sections, envelopes over an ensemble.
void add_outflow_routes(Router& router, Service& service);
/// What lies on the disk, and its removal.
void add_storage_routes(Router& router, Service& service);
/// The stream of events. `stopping` ends every waiting client.
void add_event_routes(Router& router, Service& service, const std::atomic<bool>& stopping);
/// Studies that are shipped, whole, to begin with.
void add_example_routes(Router& router, Service& service);
/// Scenes from templates.
void add_template_routes(Router& router, Service& service);
/// /metrics as Prometheus text. `router` counts the requests.
void add_metric_routes(Router& router, Service& service);
/// Schemas, plans, health, the dashboard.
void add_page_routes(Router& router, Service& service);

/// Files that were sent: motions and meshes that scenes name by their content.
void add_file_routes(Router& router, Service& service);
/// Keeps a motion that was made here like one that was sent; how a scene names it.
std::string keep_motion(Service& service, const std::string& name, const std::string& text);
/// Scenes that were stored, by name and by hash.
void add_scene_routes(Router& router, Service& service);
/// The stored scene that the run was made of, or null.
nlohmann::json scene_source_json(const Service& service, const std::string& run);
/// Transfers of one run or all, with what made them.
void add_transfer_routes(Router& router, Service& service);
/// How a file came to be: PROV-JSON.
void add_provenance_routes(Router& router, Service& service);
/// What runs where.
void add_worker_routes(Router& router, Service& service);

/// Those that the run's scenes name.
nlohmann::json files_json(const Service& service, const std::string& run);

/// A file that is known by its hash: with ETag, at most one range; 410 when it is not on the disk as
/// it was stored.
void send_content(Call& call, const std::filesystem::path& file, const std::string& sha256,
                  std::int64_t bytes, const std::string& name);
/// Empty: it cannot be read.
std::string whole_text(const std::filesystem::path& file);
/// The task, or 404.
Task wanted_task(const Service& service, const std::string& id);
Run wanted_run(const Service& service, const std::string& id);
/// The only task of a phase, for one per transfer of that time, for one per variant of that name;
/// 400 where several are meant, 404 where none is.
Task meant_task(const Service& service, const std::string& run, const std::string& phase,
                std::optional<double> transfer_time, const std::optional<std::string>& variant);

}  // namespace breach::orchestrator
