// The list of groups; each group's file has its own add function and knows no other group.
#include "services/orchestrator/http/http_routes.hpp"

#include <fstream>

namespace breach::orchestrator {

std::string whole_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void add_all_routes(Router& router, Service& service, const std::atomic<bool>& stopping) {
    add_run_routes(router, service);
    add_accuracy_routes(router, service);
    add_uncertainty_routes(router, service);
    add_motion_routes(router, service);
    add_trigger_routes(router, service);
    add_output_routes(router, service);
    add_report_routes(router, service);
    add_outflow_routes(router, service);
    add_storage_routes(router, service);
    add_file_routes(router, service);
    add_transfer_routes(router, service);
    add_worker_routes(router, service);
    add_event_routes(router, service, stopping);
    add_example_routes(router, service);
    add_template_routes(router, service);
    add_metric_routes(router, service);
    add_page_routes(router, service);
    add_drawing_routes(router, service);
}

}  // namespace breach::orchestrator
