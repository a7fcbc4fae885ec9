// Hydrographs of one runout and bands over all runouts of a run. The files of the phases are read
// at each request: an ended runout's files do not change.
#include <fstream>

#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/outflow/envelopes.hpp"
#include "services/outflow/exports.hpp"
#include "services/outflow/hec_ras.hpp"

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

json scene_in(const std::filesystem::path& output) {
    std::ifstream stream(output / phases::files::scene);
    return json::parse(stream, nullptr, false);
}

/// From the request, else from the scene of the runout.
std::optional<outflow::BreachWidth> wanted_width(const Call& call,
                                                 const std::filesystem::path& output) {
    if (const auto text = call.parameter("breach_width"); text && !text->empty())
        return outflow::breach_width_from(width_entry(*text), "request", "/breach_width");
    const json scene = scene_in(output);
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

/// One runout's, or that of a percentile over all.
std::pair<Task, outflow::Hydrograph> wanted_hydrograph(Service& service, Call& call) {
    const std::string section = call.parameter("section").value_or("");
    // HDF5 is used by one thread at a time.
    const auto read = [&](const Task& task) {
        outflow::Hydrograph found;
        service.frames.alone([&] {
            found = outflow::hydrograph_in(outflow::history_of(service.data.output(task)), section,
                                           "runout");
        });
        return found;
    };
    if (const auto p = call.number("percentile")) {
        if (*p != 10.0 && *p != 50.0 && *p != 90.0)
            throw bad_request("percentile must be 10, 50 or 90");
        if (call.parameter("transfer_time") || call.parameter("variant"))
            throw bad_request(
                "percentile is over all runouts: leave out transfer_time and variant");
        std::vector<Task> tasks;
        std::vector<outflow::Hydrograph> samples;
        for (const Task& each : service.store.tasks_of(call.parts[0]))
            if (each.phase == phases::mpm.program && has_output(each.state)) {
                tasks.push_back(each);
                samples.push_back(read(each));
            }
        if (samples.empty()) throw not_found("runout of run " + call.parts[0] + " yet");
        outflow::Chosen chosen = outflow::at_percentile(samples, *p, "request");
        const auto rows = service.store.results(call.parts[0]);
        if (const auto doubtful = std::ranges::count_if(
                rows, [](const ResultRow& row) { return value_of(row, "questionable") == true; }))
            chosen.hydrograph.warning += " Questionable: " + std::to_string(doubtful) + " of them.";
        return {tasks[chosen.sample], std::move(chosen.hydrograph)};
    }
    const Task task = meant_task(service, call.parts[0], phases::mpm.program,
                                 call.number("transfer_time"), call.parameter("variant"));
    if (!has_output(task.state))
        throw not_found("hydrograph of task " + task.id + " yet: it has not succeeded");
    outflow::Hydrograph found = read(task);
    found.warning = caution_of(service.store, task);
    return {task, std::move(found)};
}

/// From the request, else from the soils of the runout's scene.
outflow::Rheology wanted_rheology(Call& call, const json& scene) {
    const auto yield = call.number("yield_stress"), viscosity = call.number("viscosity");
    if (yield.has_value() != viscosity.has_value())
        throw bad_request("yield_stress and viscosity go together: give both [Pa], [Pa s]");
    if (yield) {
        if (!(*yield >= 0.0) || !(*viscosity >= 0.0))
            throw bad_request("yield_stress and viscosity must not be below 0");
        return {*yield, *viscosity, "given"};
    }
    return outflow::rheology_of(scene);
}

void hydrograph(Service& service, Call& call) {
    call.allow_parameters({"section", "for", "transfer_time", "variant", "breach_width", "interval",
                           "cell", "concentration", "percentile", "rheology", "yield_stress",
                           "viscosity"});
    wanted_run(service, call.parts[0]);
    const std::string target = call.parameter("for").value_or("json");
    if (target != "json" && target != "csv" && target != "hec-ras" &&
        target != "hec-ras-unsteady" && target != "flo-2d")
        throw bad_request("for must be json, csv, hec-ras, hec-ras-unsteady or flo-2d");
    if (target == "json" || target == "csv")
        for (const char* each : {"interval", "cell", "concentration"})
            if (call.parameter(each))
                throw bad_request(std::string(each) + " has no effect on " + target +
                                  ", which has the run's own times: leave it out, or ask for "
                                  "hec-ras or flo-2d");
    if (target != "hec-ras-unsteady")
        for (const char* each : {"rheology", "yield_stress", "viscosity"})
            if (call.parameter(each))
                throw bad_request(std::string(each) + " has no effect on " + target +
                                  ": leave it out, or ask for hec-ras-unsteady");
    const auto [task, found] = wanted_hydrograph(service, call);
    const auto output = service.data.output(task);
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
    if (target == "hec-ras-unsteady") {
        const auto resistance =
            outflow::resistance_named(call.parameter("rheology").value_or("bingham"));
        if (!resistance) throw bad_request("rheology must be bingham, obrien or herschel-bulkley");
        const auto concentration = call.number("concentration");
        if (!concentration || !(*concentration > 0.0 && *concentration < 1.0))
            throw bad_request("concentration must be given: solids by volume, between 0 and 1");
        return call.response.set_content(
            as_hec_ras_unsteady(found, width->best, interval, *resistance,
                                wanted_rheology(call, scene_in(output)), *concentration, "request"),
            "text/plain");
    }
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
