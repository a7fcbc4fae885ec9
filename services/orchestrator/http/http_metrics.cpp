// For Prometheus: only what the store counts quickly or the process has in memory. Open without a
// token like /healthz (http_router.cpp), so it names no run.
#include <sstream>

#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

namespace {

void by_state(std::ostringstream& text, const char* name, const char* help,
              const std::map<std::string, std::int64_t>& counts) {
    text << "# HELP " << name << " " << help << "\n# TYPE " << name << " gauge\n";
    for (const auto& [state, count] : counts)
        text << name << "{state=\"" << state << "\"} " << count << "\n";
}

std::string metrics(const Router& router, const Service& service) {
    std::ostringstream text;
    by_state(text, "breachline_tasks", "Tasks by state.", service.store.tasks_by_state());
    by_state(text, "breachline_attempts", "Attempts by state.", service.store.attempts_by_state());
    // Counters of the process begin at 0 with each start; Prometheus expects that.
    text << "# HELP breachline_http_requests_total Answers by class of status.\n"
            "# TYPE breachline_http_requests_total counter\n";
    const auto answers = router.answers();
    for (std::size_t i = 1; i < answers.size(); ++i)
        text << "breachline_http_requests_total{status=\"" << i << "xx\"} " << answers[i] << "\n";
    text << service.dispatcher.queue_wait().as_text("breachline_queue_wait_seconds",
                                                    "From ready to given to the executor.")
         << service.dispatcher.snapshot_to_start().as_text(
                "breachline_dispatch_latency_seconds",
                "From the snapshot on the disk to the start of its transfer.")
         << service.store.commit_sizes().as_text("breachline_store_commit_size",
                                                 "Changes committed together.");
    return text.str();
}

}  // namespace

void add_metric_routes(Router& router, Service& service) {
    router.get("/metrics", [&](Call& call) {
        call.allow_parameters({});
        call.response.set_content(metrics(router, service), "text/plain; version=0.0.4");
    });
}

}  // namespace breach::orchestrator
