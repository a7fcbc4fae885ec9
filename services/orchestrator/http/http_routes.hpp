// The routes of the API, group by group.
#pragma once

#include <atomic>

#include "services/orchestrator/http/http_router.hpp"
#include "services/orchestrator/http/service.hpp"

namespace breach::orchestrator {

void add_all_routes(Router& router, Service& service, const std::atomic<bool>& stopping);

/// Runs and tasks: submit, list, inspect, cancel, results.
void add_run_routes(Router& router, Service& service);
/// Error against run time.
void add_accuracy_routes(Router& router, Service& service);
/// Statistics of the samples of a result.
void add_uncertainty_routes(Router& router, Service& service);
void add_motion_routes(Router& router, Service& service);
/// Triggers: their states, and new ones while a run goes on.
void add_trigger_routes(Router& router, Service& service);
/// Output of the phases: logs, telemetry, frames, artifacts.
void add_output_routes(Router& router, Service& service);
/// The report of a run.
void add_report_routes(Router& router, Service& service);
/// Flow past sections: hydrographs, and envelopes over an ensemble.
void add_outflow_routes(Router& router, Service& service);
/// Disk use, and removal.
void add_storage_routes(Router& router, Service& service);
/// The stream of events. `stopping` ends every waiting client.
void add_event_routes(Router& router, Service& service, const std::atomic<bool>& stopping);
/// The shipped example studies, complete.
void add_example_routes(Router& router, Service& service);
/// Scenes from templates.
void add_template_routes(Router& router, Service& service);
/// Documents before they are submitted: a picture of the section, an imported drawing, the cost.
void add_drawing_routes(Router& router, Service& service);
/// /metrics as Prometheus text. `router` counts the requests.
void add_metric_routes(Router& router, Service& service);
/// Schemas, plans, health, the dashboard.
void add_page_routes(Router& router, Service& service);

/// Uploaded files: motions and meshes that scenes name by their content.
void add_file_routes(Router& router, Service& service);
/// Stores a generated motion like an uploaded one; returns the reference for scenes.
std::string keep_motion(Service& service, const std::string& name, const std::string& text);
/// Transfers of one run or all, with their triggers.
void add_transfer_routes(Router& router, Service& service);
/// Running tasks and workers.
void add_worker_routes(Router& router, Service& service);

/// The uploaded files that the run's scenes name.
nlohmann::json files_json(const Service& service, const std::string& run);

/// Sends a file with a known hash: with ETag, at most one range; 410 when the file on the disk
/// differs from the stored one.
void send_content(Call& call, const std::filesystem::path& file, const std::string& sha256,
                  std::int64_t bytes, const std::string& name);
/// Empty: it cannot be read.
std::string whole_text(const std::filesystem::path& file);
/// The task, or 404.
Task wanted_task(const Service& service, const std::string& id);
Run wanted_run(const Service& service, const std::string& id);
/// The run as the API describes it, with the error of its governing runout.
nlohmann::json run_json(const Service& service, Run run);
/// The only task of a phase; with a time, the one per transfer of that time, with a name, the one
/// of that variant; 400 where several match, 404 where none does.
Task meant_task(const Service& service, const std::string& run, const std::string& phase,
                std::optional<double> transfer_time, const std::optional<std::string>& variant);

}  // namespace breach::orchestrator
