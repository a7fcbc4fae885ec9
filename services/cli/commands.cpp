// Commands that are one or two requests: submit, list, show, cancel and the like. A refusal by the
// server is an exception (cli/http/server.hpp), so each command reads as its good case. With --json
// the answer is printed unchanged: programs see every field, also new ones.
#include "services/cli/commands.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/command/command.hpp"
#include "core/exchange/csv.hpp"
#include "core/exchange/publish.hpp"
#include "core/exchange/temporary_folder.hpp"
#include "core/words/list.hpp"
#include "services/cli/accuracy_view.hpp"
#include "services/cli/sending.hpp"
#include "services/cli/study_file.hpp"
#include "services/cli/table.hpp"
#include "services/cli/uncertainty_view.hpp"
#include "services/cli/views.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;

namespace {

constexpr std::size_t length_of_ids = 26;  // of runs: ULIDs
constexpr auto longest_print = std::chrono::minutes(5);

/// Ids of tasks begin with their run's: "<run>-00007".
/// By the form alone, which saves a request to find out.
bool names_task(const std::string& id) { return id.find('-') == length_of_ids; }

/// The columns are those of the first line. Lists and objects have no place in a cell and are left
/// out.
void show_as_csv(const json& lines, const Console& console) {
    if (lines.empty()) return;
    std::vector<std::string> keys;
    for (const auto& [key, value] : lines.front().items())
        if (value.is_primitive()) keys.push_back(key);
    // A line that lacks a key gets an empty field, so that the later fields stay in their columns.
    for (std::size_t i = 0; i < keys.size(); ++i) console.out << (i > 0 ? "," : "") << keys[i];
    for (const json& line : lines) {
        for (std::size_t i = 0; i < keys.size(); ++i)
            console.out << (i > 0 ? "," : "\n") << exchange::csv_field(line.value(keys[i], json()));
    }
    console.out << "\n";
}

}  // namespace

/// A whole id is taken as it is. Everything else costs one request, as the server may have got a
/// newer run of this name.
/// A name wins over the beginning of an id. Trap: a name of exactly 26 characters is read as an
/// id and not found; use the id or `latest`. Among more than 500 matches only the newest are seen.
std::string run_named(Server& server, const std::string& name) {
    if (name.size() == length_of_ids) return name;
    const bool latest = name == "latest";
    const json runs = server
                          .get("/v1/runs" + query_of({{"limit", latest ? "1" : "500"},
                                                      {"search", latest ? "" : name}}))
                          .at("runs");
    if (latest && runs.empty()) throw Refused(404, "there is no run yet", {});
    if (latest) return runs.front().at("id");
    std::vector<std::string> begun;
    for (const json& each : runs) {
        if (each.at("name") == name) return each.at("id");  // newest first
        if (each.at("id").get<std::string>().starts_with(name)) begun.push_back(each.at("id"));
    }
    if (begun.size() == 1) return begun.front();
    throw Refused(404,
                  begun.empty()
                      ? "no run has the name or id \"" + name + "\"; `breach list` shows the runs"
                      : "several ids begin with \"" + name + "\": " + words::list_of(begun),
                  {});
}

namespace {

/// `route` decides what the server does with the study: run it, sweep it, or only say what it
/// costs. So --dry-run refuses what a submission would.
json post_submission(Server& server, const std::string& route, const SubmitOptions& options,
                     const Console& console) {
    json study = options.scene.empty() ? read_study(options.study, options.overrides)
                                       : study_around(options.scene, options.overrides);
    if (!options.transfer_times.empty()) study["transfer_times"] = options.transfer_times;
    for (const std::string& each : overruled(study, options.overrides))
        console.notes << harmless(each) << "\n";
    // The key makes a repeated submission, after a lost answer, return the first run.
    Headers headers;
    if (!options.idempotency_key.empty()) headers["Idempotency-Key"] = options.idempotency_key;
    return post_study(server, route, std::move(study), headers,
                      options.send_files ? Sending::always : Sending::where_needed, console);
}

/// Every order is answered with the run as it is then.
ExitCode show_order(const json& answer, const Console& console) {
    if (!shown_as_json(answer, console)) console.out << as_progress_line(answer) << "\n";
    return ExitCode::done;
}

}  // namespace

ExitCode show_plan(Server& server, const SubmitOptions& options, const Console& console) {
    const json cost = post_submission(server, "/v1/cost", options, console);
    if (!shown_as_json(cost, console))
        for (const json& each : cost.at("lines")) console.out << each.get<std::string>() << "\n";
    return ExitCode::done;
}

std::string submit(Server& server, const SubmitOptions& options, const Console& console) {
    const json run = post_submission(server, options.route, options, console);
    if (!shown_as_json(run, console)) console.out << cell(run, "id") << std::endl;
    return run.at("id");
}

/// One route for both, with one of two entries; the server says which were new.
ExitCode extend(Server& server, const Extension& by, const Console& console) {
    const bool samples = by.samples > 0;
    const json answer =
        server.post(path_of({"sweeps", run_named(server, by.run), "extend"}),
                    samples ? json{{"samples", by.samples}} : json{{"transfer_times", by.times}});
    if (shown_as_json(answer, console)) return ExitCode::done;
    const json& added = answer.at(samples ? "added_samples" : "added");
    for (const json& each : added)
        console.out << (each.is_string() ? each.get<std::string>() : each.dump()) << "\n";
    if (added.empty())
        console.notes << (samples ? "the run has as many" : "the sweep has all of them") << "\n";
    return ExitCode::done;
}

/// "no runs" is a note: a program that reads the table gets an empty one.
ExitCode list_runs(Server& server, std::size_t most, const Console& console) {
    const json runs =
        server.get("/v1/runs" + query_of({{"limit", std::to_string(most)}})).at("runs");
    if (shown_as_json(runs, console)) return ExitCode::done;
    if (runs.empty()) {
        console.notes << "no runs\n";
    } else {
        console.out << as_run_table(runs);
    }
    return ExitCode::done;
}

ExitCode show(Server& server, const std::string& id, const Console& console) {
    const bool task = names_task(id);
    const json answer =
        server.get(task ? path_of({"tasks", id}) : path_of({"runs", run_named(server, id)}));
    if (!shown_as_json(answer, console))
        console.out << (task ? as_task_page(answer) : as_run_page(answer));
    return ExitCode::done;
}

ExitCode order(Server& server, const std::string& run, const std::string& word,
               const Console& console) {
    return show_order(server.post(path_of({"runs", run_named(server, run), word}), json::object()),
                      console);
}

ExitCode set_priority(Server& server, const std::string& run, std::int64_t priority,
                      const Console& console) {
    return show_order(server.post(path_of({"runs", run_named(server, run), "priority"}),
                                  {{"priority", priority}}),
                      console);
}

ExitCode rename(Server& server, const std::string& run, const std::string& title,
                const Console& console) {
    return show_order(
        server.post(path_of({"runs", run_named(server, run), "title"}), {{"title", title}}),
        console);
}

/// A questionable result is no failure by default, as people read the note. Scripts do not, and say
/// --strict.
ExitCode code_of_end(const json& run, Questionable questionable, const Console& console) {
    if (end_of(run) == RunEnd::bad) return ExitCode::breakdown;
    if (!is_doubtful(run)) return ExitCode::done;
    console.notes << warning_of(run) << " (`breach results " << cell(run, "id")
                  << "` says what to do)\n";
    return questionable == Questionable::fails ? ExitCode::breakdown : ExitCode::done;
}

/// Rows of an unfinished run are shown as far as they are, with a note; only an ended run can fail
/// the exit code.
ExitCode results(Server& server, const ResultsOptions& options, const Console& console) {
    const std::string id = run_named(server, options.run);
    const bool csv = console.style == Style::csv;
    const std::string path =
        path_of({"runs", id, "results"}) + query_of({{"format", csv ? "csv" : ""},
                                                     {"table", options.means ? "means" : ""},
                                                     {"state", options.state},
                                                     {"flag", options.flag}});
    // Before the rows, so that these are at least as new as the state in the note below.
    const json run = server.get(path_of({"runs", id}));
    if (csv) {
        console.out << server.get_text(path).body;
    } else if (console.style == Style::json) {
        show_json(server.get(path), console);
    } else {
        const json answer = server.get(path);
        const std::string means = as_mean_table(answer);
        console.out << as_verdict(run.at("headline"), answer.at("verdict"), answer.at("rows"))
                    << means;
        if (!options.means) console.out << (means.empty() ? "" : "\n") << as_result_table(answer);
        if (options.means && means.empty()) console.notes << "the study has no repeats\n";
    }
    if (end_of(run) != RunEnd::good) console.notes << as_progress_line(run) << "\n";
    return end_of(run) == RunEnd::not_yet ? ExitCode::done
                                          : code_of_end(run, options.questionable, console);
}

ExitCode show_accuracy(Server& server, const std::string& run, const std::string& asked_error,
                       const Console& console) {
    const std::string id = run_named(server, run);
    const json answer =
        server.get(path_of({"runs", id, "accuracy"}) + query_of({{"asked_error", asked_error}}));
    if (!shown_as_json(answer, console)) console.out << as_accuracy_table(answer);
    return ExitCode::done;
}

ExitCode show_uncertainty(Server& server, const UncertaintyOptions& options,
                          const Console& console) {
    const std::string path = path_of({"runs", run_named(server, options.run), "uncertainty"});
    if (console.style == Style::csv) {
        console.out << server.get_text(path + "?format=csv").body;
        return ExitCode::done;
    }
    const json answer = server.get(path + query_of({{"quantity", options.quantity}}));
    if (!shown_as_json(answer, console)) console.out << as_uncertainty_view(answer);
    return ExitCode::done;
}

/// With --json one object a line, like the phase's own telemetry.jsonl, so that the same scripts
/// read both. A phase that still writes has no end: the loop stops where `next` stands still.
ExitCode telemetry(Server& server, const TelemetryOptions& options, const Console& console) {
    const std::string path = path_of({"runs", run_named(server, options.run), "telemetry"});
    json lines = json::array();
    std::int64_t from = options.from;
    for (;;) {  // the server sends long files in parts
        json answer = server.get(path + query_of({{"phase", options.phase},
                                                  {"transfer_time", options.transfer_time},
                                                  {"variant", options.variant},
                                                  {"fields", options.fields},
                                                  {"from", std::to_string(from)},
                                                  {"stride", std::to_string(options.stride)}}));
        for (json& line : answer.at("lines")) lines.push_back(std::move(line));
        const std::int64_t next = answer.at("next");
        if (next <= from || answer["lines"].empty()) break;
        from = next;
    }
    switch (console.style) {
        case Style::json:
            for (const json& line : lines) console.out << line.dump() << "\n";
            break;
        case Style::csv:
            show_as_csv(lines, console);
            break;
        case Style::people:
            console.out << as_telemetry_table(lines);
            break;
    }
    return ExitCode::done;
}

/// The file appears whole or not at all (publish_text): a hydraulic model must not start with half
/// of a flood.
ExitCode hydrograph(Server& server, const HydrographOptions& options, const Console& console) {
    const std::string target = console.style == Style::json ? "json" : options.target;
    const TextAnswer answer =
        server.get_text(path_of({"runs", run_named(server, options.run), "hydrograph"}) +
                        query_of({{"section", options.section},
                                  {"for", target},
                                  {"transfer_time", options.transfer_time},
                                  {"variant", options.variant},
                                  {"breach_width", options.breach_width},
                                  {"interval", options.interval},
                                  {"cell", options.cell},
                                  {"concentration", options.concentration},
                                  {"percentile", options.percentile},
                                  {"rheology", options.rheology},
                                  {"yield_stress", options.yield_stress},
                                  {"viscosity", options.viscosity}}));
    // FLO-2D's file has no place for the warning.
    if (!answer.warning.empty()) console.notes << harmless(answer.warning) << "\n";
    if (options.file.empty()) {
        console.out << answer.body;
    } else {
        exchange::publish_text(options.file, answer.body);
        console.out << options.file.string() << "\n";
    }
    return ExitCode::done;
}

ExitCode report(Server& server, const std::string& run, std::filesystem::path file,
                const Console& console) {
    const std::string path = path_of({"runs", run_named(server, run)});
    if (file.empty()) file = server.get(path + "?tasks=0").at("name").get<std::string>() + ".pdf";
    const std::string page = server.get_text(path + "/report").body;
    if (file.extension() != ".pdf") {
        exchange::publish_text(file, page);
    } else {
        const exchange::TemporaryFolder scratch("report-");
        const std::filesystem::path html = scratch.path() / "report.html";
        exchange::publish_text(html, page);
        exchange::publish(file, [&](const std::filesystem::path& temporary) {
            try {
                const std::vector<std::string> words{"weasyprint", "--quiet", html, temporary};
                if (command::run(words, "", longest_print).exit_code == 0) return;
            } catch (const fault::IoError&) {  // not installed
            }
            throw fault::IoError(file.string() +
                                 ": no PDF; install weasyprint (apt-get install weasyprint), or "
                                 "print the page of --output report.html from a browser");
        });
    }
    console.out << file.string() << "\n";
    return ExitCode::done;
}

/// Of a study, its scene with the overrides for all variants.
ExitCode plan(Server& server, const std::filesystem::path& document, const Console& console) {
    const json scene =
        names_a_scene(document) ? scene_of_study(document) : read_scene_document(document);
    const json plans = server.post("/v1/scenes/plan", scene).at("plans");
    if (shown_as_json(plans, console)) return ExitCode::done;
    for (const auto& [phase, text] : plans.items())
        console.out << phase << "\n" << text.get<std::string>() << "\n";
    return ExitCode::done;
}

}  // namespace breach::cli
