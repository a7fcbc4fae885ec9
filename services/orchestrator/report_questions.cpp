// The program `report` is in Python and must say what the service would say. So it asks the
// service's own code: a run that no service knows is stored in a temporary database, and every
// sentence, verdict and error comes from there as for any other run.
#include "services/orchestrator/report_questions.hpp"

#include <algorithm>
#include <iostream>

#include "core/check/check.hpp"
#include "core/criteria/window.hpp"
#include "core/exchange/temporary_folder.hpp"
#include "core/fault/fault.hpp"
#include "core/telemetry/lines.hpp"
#include "services/drawing/section_drawing.hpp"
#include "services/orchestrator/accuracy/runout_error.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/phase_folders.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/records/or_null.hpp"
#include "services/orchestrator/scene_entries.hpp"
#include "services/outflow/hydrograph.hpp"

namespace breach::orchestrator {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

// ---------------------------------------------------------------- findings

/// As its service would have stored it: the study beside the phases, or the scene of the first
/// alone.
NewRun run_of(const fs::path& folder, const std::vector<PhaseFolder>& phases) {
    const json study = read_if_there(folder / "study.json");
    const json own = study.is_object() ? study.value("scene", json()) : json();
    const json& scene = own.is_object() ? own : phases.front().scene;
    const auto name = scene.at("name").get<std::string>();
    NewRun run{.id = new_run_id(),
               .name = name,
               .title = scene.value("title", name),
               .study = study.is_object() ? study.dump() : "{}",
               .scene = scene.dump(),
               .tasks = {}};
    run.warnings = check::checked_document(scene, "scene", folder, {}).scene.warnings;
    for (const PhaseFolder& each : phases) run.tasks.push_back(each.plan);
    return run;
}

/// Moves each task through the states that a service would: claimed, then ended.
void store_results(Transaction& transaction, const NewRun& run,
                   const std::vector<PhaseFolder>& phases) {
    transaction.add_run(run);
    for (std::size_t i = 0; i < phases.size(); ++i) {
        const std::string task = task_id(run.id, i);
        transaction.move_task(task, TaskEvent::claim);
        if (phases[i].result.is_object()) {
            transaction.move_task(task, TaskEvent::exit_well);
            transaction.finish_task(task, phases[i].result, {});
        } else {
            transaction.fail_task(task, TaskEvent::exit_badly, {std::nullopt, phases[i].fault});
        }
    }
}

/// {"run", "results", "tasks"} as the API answers them, and the folder of each task.
json findings_in(const fs::path& folder) {
    const std::vector<PhaseFolder> phases = phases_in(folder);
    const exchange::TemporaryFolder scratch("breachline-");
    const DataFolder data(scratch.path());
    Store store(data.database());
    const NewRun stored = run_of(folder, phases);
    store.write([&](Transaction& transaction) { store_results(transaction, stored, phases); });
    // Empty: nothing runs here.
    const ProgressBoard board;
    Run run = unless_removed(store.run(stored.id));
    std::vector<ResultRow> rows = store.results(run.id), means = store.means(run.id);
    const AllRows all_rows = [&]() -> const std::vector<ResultRow>& { return rows; };
    // As http_runs.cpp does for a request: errors are computed when asked, not stored.
    tell_runout_errors(store, data, run.id, rows, means, all_rows);
    tell_governing_error(store, data, run);
    json answer{{"run", as_json(run, store, board)},
                {"results", json::parse(results_text(store, run, rows, means, all_rows))},
                {"tasks", json::array()}};
    for (const char* unknown : {"id", "state", "created", "started", "finished"})
        answer["run"][unknown] = nullptr;  // of the store for this answer alone
    for (std::size_t i = 0; i < phases.size(); ++i) {
        json task = as_json(unless_removed(store.task(task_id(run.id, i))), {}, {}, board);
        task["folder"] = fs::relative(phases[i].files, folder);
        answer["tasks"].push_back(std::move(task));
    }
    return answer;
}

// ---------------------------------------------------------------- conditions

criteria::Expression condition(const json& text) {
    return criteria::parse(text.get<std::string>(), criteria::Kind::condition, "/conditions");
}

/// The evaluation keeps samples for its windows, so the lines must go through it in their order.
json first_time(const criteria::Expression& condition, const std::vector<telemetry::Line>& lines,
                const std::map<std::string, double>& constants) {
    criteria::Evaluation evaluation(condition);
    for (const telemetry::Line& line : lines)
        if (evaluation(line.time, criteria::line_for(condition, line, constants).values) == 1.0)
            return line.time;
    return nullptr;
}

/// The edges of the window of transfer times [s]; null: the telemetry does not meet it.
json edges_of(const json& spec, const std::vector<telemetry::Line>& lines,
              const std::map<std::string, double>& constants) {
    criteria::Window window(condition(spec.at("lower")), condition(spec.at("upper")),
                            spec.value("hold_s", 0.0));
    for (const telemetry::Line& line : lines) window.take(line, constants);
    const auto time_of = [](const std::optional<criteria::Line>& line) {
        return line ? json(line->time) : json();
    };
    const bool developed = window.lower().state() == criteria::Criterion::State::met;
    // A lower edge counts only when its condition also held for hold_s.
    return {{"lower", developed ? time_of(window.lower().crossing()) : json()},
            {"upper", time_of(window.shut_since() ? window.shut_since() : window.upper_edge())}};
}

/// {"field", "value"} for every comparison of a field with a number.
/// For the lines that the report draws into its charts: `field < number` and `number < field`. Time
/// is the axis itself and gets none.
json thresholds_in(const criteria::Expression& condition) {
    using Code = criteria::Instruction::Code;
    json found = json::array();
    const auto& steps = condition.program;
    for (std::size_t k = 0; k + 2 < steps.size(); ++k) {
        const Code what = steps[k + 2].code;
        if (what < Code::less || what > Code::greater_equal) continue;
        std::size_t field = k, number = k + 1;
        // The program is in reverse Polish order: two operands, then the comparison.
        if (steps[field].code != Code::field) std::swap(field, number);
        if (steps[field].code != Code::field || steps[number].code != Code::constant) continue;
        if (const std::string& name = condition.fields[steps[field].index]; name != "time")
            found.push_back({{"field", name}, {"value", steps[number].value}});
    }
    return found;
}

/// asked: {"constants": {name: number}, "first": [condition], "window": {"lower", "upper",
/// "hold_s"}, "thresholds": [condition]}, each optional.
json conditions_over(const fs::path& file, const json& asked) {
    const auto lines = telemetry::read(file);
    const std::map<std::string, double> constants = asked.value("constants", json::object());
    json answer{{"first", json::array()}, {"thresholds", json::array()}};
    for (const json& each : asked.value("first", json::array()))
        answer["first"].push_back(first_time(condition(each), lines, constants));
    for (const json& each : asked.value("thresholds", json::array()))
        for (json& found : thresholds_in(condition(each)))
            answer["thresholds"].push_back(std::move(found));
    if (const json spec = asked.value("window", json()); spec.is_object())
        answer["window"] = edges_of(spec, lines, constants);
    return answer;
}

// ---------------------------------------------------------------- inputs

/// asked: {"scene", "set": pointers that overrides set}. Ignores faults of the scene: it was
/// computed, and a file that is missing here is only not drawn.
json inputs_of(const fs::path& folder, const json& asked) {
    json entries = json::array();
    for (const SceneEntry& each : entries_of(asked.at("scene"), asked.value("set", json::array())))
        entries.push_back({{"pointer", each.pointer},
                           {"value", each.value},
                           {"unit", each.unit},
                           {"what", each.what},
                           {"default", each.is_default}});
    drawing::BaseScene base{asked.at("scene"), {}, ""};
    check::Checked checked = check::checked_document(base.scene, "scene", folder, {});
    // A drawing lists the faults of its scene.
    checked.faults.clear();
    const drawing::Draft draft = drawing::draft_of(std::move(base), std::move(checked));
    json answer{
        {"entries", std::move(entries)},
        {"drawing", drawing::can_be_drawn(draft) ? json(drawing::as_svg(draft, {})) : json()},
        {"breach_width", nullptr}};
    if (asked.at("scene").contains("mpm")) {
        const outflow::StatedWidth stated = outflow::stated_width(asked.at("scene"));
        answer["breach_width"] = {{"low", stated.width.low},
                                  {"best", stated.width.best},
                                  {"high", stated.width.high},
                                  {"from", stated.from}};
    }
    return answer;
}

}  // namespace

void ReportQuestions::add_to(CLI::App& program) {
    const auto add = [&](const char* name, const char* purpose, const char* of) {
        CLI::App* made = program.add_subcommand(name, purpose);
        made->add_option("place", place_, of)->required();
        return made;
    };
    findings_ =
        add("findings", "verdict, results and tasks of phases that were run by hand, as JSON",
            "folder with one folder per phase");
    conditions_ = add("conditions", "when conditions come true; reads them as JSON from stdin",
                      "a FEM's telemetry.jsonl");
    inputs_ = add("inputs", "entries and drawing of the scene on stdin, as JSON",
                  "folder of the files that the scene names");
}

void ReportQuestions::answer() const {
    json answer;
    try {
        answer = *findings_     ? findings_in(place_)
                 : *conditions_ ? conditions_over(place_, json::parse(std::cin))
                                : inputs_of(place_, json::parse(std::cin));
    } catch (const json::exception& error) {
        // Files of another version may lack keys that are read here.
        throw fault::BadInput(place_.string(),
                              {{"", error.what(), "run its phases again with this version"}});
    }
    std::cout << answer.dump(-1, ' ', false, json::error_handler_t::replace) << "\n";
}

}  // namespace breach::orchestrator
