// Hydrographs of one runout and bands over all runouts of a run. The files of the phases are read
// at each request: an ended runout's files do not change.
#include <fstream>

#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/outflow/envelopes.hpp"
#include "services/outflow/exports.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr double default_interval = 1.0;  // of exports [s]
constexpr std::int64_t largest_cell = 100'000'000;

/// "72" or "60,72,90".
/// A text that is no number becomes "discarded", which breach_width_from refuses with its remedy.
json width_entry(const std::string& text) {
    if (text.find(',') == std::string::npos) return json::parse(text, nullptr, false);
    return json::parse("[" + text + "]", nullptr, false);
}

/// From the request, else from the scene of the runout.
std::optional<outflow::BreachWidth> wanted_width(const Call& call,
                                                 const std::filesystem::path& output) {
    if (const auto text = call.parameter("breach_width"); text && !text->empty())
        return outflow::breach_width_from(width_entry(*text), "request", "/breach_width");
    std::ifstream stream(output / phases::files::scene);
    const json scene = json::parse(stream, nullptr, false);
    const auto pointer = "/mpm/breach_width"_json_pointer;
    if (!scene.is_object() || !scene.contains(pointer)) return std::nullopt;
    return outflow::breach_width_from(scene.at(pointer), "scene", "/mpm/breach_width");
}

json body_of(const Task& task, const outflow::Hydrograph& hydrograph,
             const std::optional<outflow::BreachWidth>& width) {
    json body{{"run", task.run},
              {"task", task.id},
              {"section", hydrograph.section},
              {"warning", outflow::warning_of(hydrograph)},
              {"time", {{"unit", "s"}, {"values", hydrograph.time}}},
              {"breach_width", nullptr}};
    if (width) body["breach_width"] = {width->low, width->best, width->high};
    outflow::for_each_column(hydrograph,
                             [&](const char* name, const char* unit, const auto& values) {
                                 body[name] = {{"unit", unit}, {"values", values}};
                             });
    return body;
}

/// Flags of the runout's row of results.
/// The export goes into other programs, where no one sees the run's flags.
std::string caution_of(const Store& store, const Task& task) {
    for (const ResultRow& row : store.results(task.run)) {
        if (value_of(row, "mpm_task") != task.id) continue;
        std::string codes;
        for (const json& flag : value_of(row, "flags")) {
            if (flag.at("severity") != "questionable") continue;
            codes += (codes.empty() ? "" : ", ") + flag.at("code").get<std::string>();
        }
        std::string warning = codes.empty() ? "" : "Questionable: " + codes + ".";
        if (value_of(row, "lower_bound") == true)
            warning += (warning.empty() ? "" : " ") +
                       std::string("The runout was cut off in motion: volumes are lower bounds.");
        return warning;
    }
    return "";
}

void hydrograph(Service& service, Call& call) {
    call.allow_parameters({"section", "for", "transfer_time", "variant", "breach_width", "interval",
                           "cell", "concentration"});
    wanted_run(service, call.parts[0]);
    const std::string target = call.parameter("for").value_or("json");
    if (target != "json" && target != "csv" && target != "hec-ras" && target != "flo-2d")
        throw bad_request("for must be json, csv, hec-ras or flo-2d");
    if (target == "json" || target == "csv")
        for (const char* each : {"interval", "cell", "concentration"})
            if (call.parameter(each))
                throw bad_request(std::string(each) + " has no effect on " + target +
                                  ", which has the run's own times: leave it out, or ask for "
                                  "hec-ras or flo-2d");
    const Task task = meant_task(service, call.parts[0], phases::mpm.program,
                                 call.number("transfer_time"), call.parameter("variant"));
    if (!has_output(task.state))
        throw not_found("hydrograph of task " + task.id + " yet: it has not succeeded");
    const auto output = service.data.output(task);
    outflow::Hydrograph found;
    // HDF5 is used by one thread at a time.
    service.frames.alone([&] {
        found = outflow::hydrograph_in(outflow::history_of(output),
                                       call.parameter("section").value_or(""), "runout");
    });
    found.warning = caution_of(service.store, task);
    const auto width = wanted_width(call, output);
    if (target == "json" || target == "csv")
        call.response.set_header("X-Warning", outflow::warning_of(found));
    if (target == "json") return reply(call.response, body_of(task, found, width));
    if (target == "csv") return call.response.set_content(as_csv(found, width), "text/csv");
    if (!width)
        throw bad_request("breach_width must be given [m]: the scene has no /mpm/breach_width");
    const double interval = call.number("interval").value_or(default_interval);
    const auto flows = outflow::ordinates_of(found, width->best, interval, "request");
    call.response.set_header("X-Warning",
                             outflow::peaks_in_words(flows) + " " + outflow::warning_of(found));
    if (target == "hec-ras")
        return call.response.set_content(as_hec_ras(found, width->best, interval, "request"),
                                         "text/csv");
    const outflow::Flo2dOptions request{.cell = call.whole_number("cell", 1, 1, largest_cell),
                                        .concentration = call.number("concentration")};
    if (request.concentration && !(*request.concentration >= 0.0 && *request.concentration < 1.0))
        throw bad_request("concentration must be a share of volume, from 0 to below 1");
    call.response.set_content(as_flo_2d(found, width->best, interval, request, "request"),
                              "text/plain");
}

/// Percentiles of the envelopes of the run's runouts so far.
/// A runout without an envelope is listed with the reason: percentiles of fewer samples than the
/// reader thinks would mislead.
void envelopes(const Service& service, Call& call) {
    call.allow_parameters({});
    const Run run = wanted_run(service, call.parts[0]);
    std::vector<outflow::Envelope> samples;
    json left_out = json::array();
    for (const Task& task : service.store.tasks_of(run.id)) {
        if (task.phase != phases::mpm.program) continue;
        const auto leave_out = [&](const std::string& reason) {
            left_out.push_back({{"task", task.id}, {"variant", task.variant}, {"reason", reason}});
        };
        if (!has_output(task.state)) {
            leave_out(std::string(name_of(task.state)));
            continue;
        }
        try {
            samples.push_back(
                outflow::read_envelope(service.data.output(task) / phases::files::envelope));
        } catch (const fault::BadInput& error) {
            leave_out(error.what());
        } catch (const fault::IoError&) {
            leave_out("has no envelope.csv: made by an earlier version, or removed");
        }
    }
    // Variants without a runout count as left out, too.
    for (const WithoutTransfer& each : service.store.without_transfer(run.id))
        left_out.push_back(
            {{"task", each.fem_task}, {"variant", each.variant}, {"reason", each.reason}});
    json body = outflow::as_json(outflow::ensemble_of(samples));
    body["run"] = run.id;
    body["state"] = run.state;
    body["left_out"] = left_out;
    reply(call.response, body);
}

}  // namespace

void add_outflow_routes(Router& router, Service& service) {
    router.get("/v1/runs/{id}/hydrograph", [&](Call& call) { hydrograph(service, call); });
    router.get("/v1/runs/{id}/envelopes", [&](Call& call) { envelopes(service, call); });
}

}  // namespace breach::orchestrator
