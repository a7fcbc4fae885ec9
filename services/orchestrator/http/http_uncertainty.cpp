// One document for all statistics (uncertainty/answer.cpp); samples as a table for those who make
// their own.
#include <algorithm>

#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/http/results_file.hpp"
#include "services/orchestrator/uncertainty/answer.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Statistics of an uncertainty study so far, or its samples as CSV or HDF5.
void uncertainty(const Service& service, Call& call) {
    call.allow_parameters({"format", "quantity"});
    const Run run = wanted_run(service, call.parts[0]);
    const auto ensemble = ensemble_of(service.store, run.id);
    if (!ensemble)
        throw not_found("uncertainty study in run " + run.id +
                        " (its study has no entry \"uncertainty\")");
    // Statistics of all quantities take a while; the page asks for the one it shows.
    const std::string quantity = call.parameter("quantity").value_or("");
    const auto known = result_columns();
    if (!quantity.empty() && std::ranges::find(known, quantity, &ResultColumn::name) == known.end())
        throw bad_request("quantity must be one of the table of results, not " + quantity);
    const std::string format = call.parameter("format").value_or("json");
    if (format == "json")
        return reply(
            call.response,
            uncertainty_of(*ensemble, json::parse(unless_removed(service.store.scene_of(run.id))),
                           quantity));
    const SampleTable samples = sample_table(*ensemble);
    if (format == "csv")
        return call.response.set_content(as_csv(samples.rows, samples.columns),
                                         "text/csv; charset=utf-8");
    if (format != "hdf5") throw bad_request("format must be json, csv or hdf5");
    call.response.set_header("Content-Disposition", "attachment; filename=\"samples.h5\"");
    call.response.set_content(as_hdf5({"uncertainty_samples", samples.columns, samples.rows},
                                      run.id, unless_removed(service.store.scene_of(run.id)),
                                      service.frames, service.data.scratch()),
                              "application/x-hdf5");
}

}  // namespace

void add_uncertainty_routes(Router& router, Service& service) {
    router.get("/v1/runs/{id}/uncertainty", [&](Call& call) { uncertainty(service, call); });
}

}  // namespace breach::orchestrator
