#include "services/report/read/run_folder.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/check/check.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/findings/flags.hpp"
#include "services/report/read/read_results.hpp"

namespace breach::report {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* task_file = "task.json";  ///< of an exported task

std::size_t rank_of(const std::string& phase) {
    const auto found = std::ranges::find(phases::all, phase, &phases::Phase::program);
    return static_cast<std::size_t>(found - phases::all.begin());
}

json read_if_there(const fs::path& file) {
    return fs::is_regular_file(file) ? read_json(file) : json();
}

/// The number at the beginning of a text; nothing: there is none.
std::optional<double> leading_number(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() ? std::optional(value) : std::nullopt;
}

/// A time as in labels, "13.000000"; nothing for another word, such as "20" of a variant "20_kpa".
std::optional<double> spelt_time(const std::string& word) {
    const auto time = leading_number(word);
    const bool is_time = time && std::isfinite(*time) && *time >= 0.0;
    return is_time && phases::files::spelt(*time) == word ? time : std::nullopt;
}

/// Splits "mpm_13.000000_softened" into time and variant; both may be missing.
void take_apart(const std::string& label, PhaseFolder& phase) {
    const std::size_t first = label.find('_');
    if (first == std::string::npos) return;
    const std::string rest = label.substr(first + 1);
    const std::size_t next = rest.find('_');
    phase.transfer_time = spelt_time(rest.substr(0, next));
    if (!phase.transfer_time) {
        phase.variant = rest;
    } else if (next != std::string::npos) {
        phase.variant = rest.substr(next + 1);
    }
}

/// A task's own entries override its label, including a missing transfer time.
void take_task(const json& task, PhaseFolder& phase) {
    phase.task = task.value("id", "");
    phase.variant = task.value("variant", phase.variant);
    if (task.contains("transfer_time")) {
        const json& time = task.at("transfer_time");
        phase.transfer_time = time.is_number() ? std::optional(time.get<double>()) : std::nullopt;
    }
    for (const json& each : task.value("artifacts", json::array()))
        phase.artifacts.push_back(each.at("sha256"));
}

/// The label is the folder's name, or its parent's when the folder is the service's "output".
std::string label_of(const fs::path& folder) {
    const fs::path name = folder.filename();
    return name == "output" ? folder.parent_path().filename().string() : name.string();
}

std::string phase_of(const std::string& label, const json& task, const json& result) {
    for (const json& each : {task, result}) {
        if (each.is_object() && each.contains("phase")) return each.at("phase");
    }
    for (const phases::Phase& each : phases::all)
        if (label.starts_with(each.part)) return each.program;
    return {};
}

std::string fault_of(const fs::path& files, const json& task) {
    if (const json fault = read_if_there(files / phases::files::fault); fault.is_object()) {
        return fault.value("summary", "");
    }
    if (task.is_object() && task.contains("fault") && task.at("fault").is_object()) {
        return task.at("fault").value("summary", "");
    }
    const std::string state = task.is_object() ? task.value("state", "") : "";
    if (state == "cancelled" || state == "failed" || state == "skipped") return "it was " + state;
    return state.empty() ? "it has not ended" : "it has not ended (" + state + ")";
}

/// Such a task is not part of the run.
bool was_not_reached(const json& task) {
    return task.is_object() && task.value("not_reached", json()) == json(true);
}

std::optional<PhaseFolder> read_phase(const fs::path& files) {
    const json task = read_if_there(files / task_file);
    if (was_not_reached(task)) return {};
    PhaseFolder phase{.phase = {},
                      .label = label_of(files),
                      .variant = {},
                      .transfer_time = {},
                      .files = files,
                      .scene = read_if_there(files / phases::files::scene),
                      .result = read_if_there(files / phases::files::result),
                      .runout_error = {},
                      .runout_error_from = {},
                      .fault = {},
                      .artifacts = {}};
    phase.phase = phase_of(phase.label, task, phase.result);
    if (rank_of(phase.phase) == phases::all.size()) return {};
    take_apart(phase.label, phase);
    if (task.is_object()) take_task(task, phase);
    if (phase.phase == phases::fem.program || phase.phase == phases::lem.program)
        phase.transfer_time.reset();
    if (!phase.result.is_object()) phase.fault = fault_of(files, task);
    return phase;
}

/// Folders that may be phases: this one and three levels below (tasks/<label>, <label>/output).
std::vector<fs::path> phase_folders(const fs::path& folder) {
    std::vector<fs::path> found;
    fs::recursive_directory_iterator it(folder);
    const auto is_phase = [](const fs::path& at) {
        return fs::is_regular_file(at / phases::files::scene) ||
               fs::is_regular_file(at / task_file);
    };
    if (is_phase(folder)) found.push_back(folder);
    for (; it != fs::recursive_directory_iterator(); ++it) {
        if (it.depth() >= 2) it.disable_recursion_pending();
        if (it->is_directory() && is_phase(it->path())) found.push_back(it->path());
    }
    return found;
}

/// transfer_time null: the points fill the section.
bool is_at(const PhaseFolder& mpm, const json& transfer_time) {
    constexpr double same_time = 5e-7;  // [s]; tables and folders spell times to the microsecond
    if (transfer_time.is_null() || !mpm.transfer_time)
        return transfer_time.is_null() && !mpm.transfer_time;
    return std::abs(*mpm.transfer_time - transfer_time.get<double>()) <= same_time;
}

/// Name of the repeated variant; its own name when it is not a repeat.
std::string repeated_variant(const json& variant) {
    const std::string name = variant.at("name");
    if (variant.value("made_by", "") != "draws") return name;
    const std::size_t suffix = name.rfind("_d");
    return suffix == std::string::npos ? "" : name.substr(0, suffix);
}

/// Adds errors of runouts from the table of `breach export`; only the service knows them.
void take_errors(const json& table, std::vector<PhaseFolder>& phases) {
    if (!table.is_object()) return;
    for (const json& row : table.at("rows")) {
        const json error = row.value("runout_error", json());
        for (PhaseFolder& each : phases) {
            if (each.phase != phases::mpm.program || json(each.variant) != row.at("variant"))
                continue;
            if (!is_at(each, row.at("transfer_time"))) continue;
            if (error.is_number()) each.runout_error = error;
            if (const json from = row.value("runout_error_from", json()); from.is_string())
                each.runout_error_from = from;
        }
    }
}

/// The first row of each variant that has only "not_reached" rows; none for samples.
json rows_not_reached(const json& table, const json& study) {
    if (study.is_object() && study.contains("uncertainty")) return json::array();
    std::map<std::string, json> first;
    std::set<std::string> reached;
    for (const json& row : table.at("rows")) {
        if (row.value("state", "") != "not_reached") reached.insert(row.at("variant"));
        first.emplace(row.at("variant"), row);
    }
    json found = json::array();
    for (auto& [variant, row] : first)
        if (!reached.contains(variant)) found.push_back(std::move(row));
    return found;
}

/// The study's scene without its variants' changes, because a phase's result may come from another
/// run. In a folder without a study, the scene of the first phase that has begun; null: none has.
json asked_scene(const Run& run) {
    if (run.study.is_object() && run.study.value("scene", json()).is_object())
        return run.study.at("scene");
    const auto begun = std::ranges::find_if(
        run.phases, [](const PhaseFolder& phase) { return phase.scene.is_object(); });
    return begun == run.phases.end() ? json() : begun->scene;
}

}  // namespace

Run read_run(const fs::path& folder) {
    if (!fs::is_directory(folder)) {
        throw fault::IoError(
            folder.string() +
            ": is no folder; give the folder of a run, as breach export writes it");
    }
    Run run;
    run.folder = folder;
    try {
        for (const fs::path& each : phase_folders(folder)) {
            if (auto phase = read_phase(each)) run.phases.push_back(std::move(*phase));
        }
        if (run.phases.empty()) {
            throw fault::BadInput(folder.string(),
                                  {{"", "no phase's folder is in it",
                                    "give a run exported by breach export, or the folder that "
                                    "holds the phases' output folders"}});
        }
        std::ranges::sort(run.phases, {}, [](const PhaseFolder& p) {
            return std::tuple(rank_of(p.phase), p.transfer_time.value_or(0.0), p.variant, p.label);
        });
        run.study = read_if_there(folder / "study.json");
        run.scene = asked_scene(run);
        for (PhaseFolder& each : run.phases)  // a task that has not begun: the study's scene
            if (!each.scene.is_object()) each.scene = run.scene;
        const json about = read_if_there(folder / "run.json");
        const json results = read_if_there(folder / "results.json");
        take_errors(results, run.phases);
        if (results.is_object()) {
            run.means = results.value("means", json::array());
            run.without_transfer = results.value("without_transfer", json::array());
            run.not_reached = rows_not_reached(results, run.study);
            run.same_results = results.value("same_results", json::array());
        }
        run.uncertainty = read_if_there(folder / "uncertainty.json");
        run.envelopes = read_if_there(folder / "envelopes.json");
        run.motions = read_if_there(folder / "motions.json");
        run.name = run.scene.at("name");
        run.title = run.scene.value("title", run.name);
        if (about.is_object()) {
            run.name = about.value("name", run.name);
            run.id = about.value("id", "");
            run.state = about.value("state", "");
            if (const json at = about.value("finished", json()); at.is_string()) run.finished = at;
            if (!about.value("title", "").empty()) run.title = about.at("title");
        }
        // Phases run by hand: the whole scene was not checked before.
        run.warnings =
            about.is_object() && about.contains("warnings")
                ? about.at("warnings")
                : findings::as_json(
                      check::checked_document(run.scene, "scene", folder, {}).scene.warnings);
        return run;
    } catch (const json::exception& error) {
        throw fault::BadInput(folder.string(), {{"", error.what(), "export the run again"}});
    }
}

std::vector<const PhaseFolder*> phases_named(const Run& run, const std::string& phase) {
    std::vector<const PhaseFolder*> found;
    for (const PhaseFolder& each : run.phases) {
        if (each.phase == phase) found.push_back(&each);
    }
    return found;
}

std::vector<const PhaseFolder*> draws_of(const Run& run, const json& mean) {
    std::vector<const PhaseFolder*> found;
    if (!run.study.is_object()) return found;
    for (const json& variant : run.study.value("variants", json::array())) {
        if (json(repeated_variant(variant)) != mean.at("variant")) continue;
        for (const PhaseFolder* each : phases_named(run, phases::mpm.program))
            if (json(each->variant) == variant.at("name") && is_at(*each, mean.at("transfer_time")))
                found.push_back(each);
    }
    return found;
}

const PhaseFolder* phase_named(const Run& run, const std::string& phase) {
    const auto found = phases_named(run, phase);
    return found.empty() ? nullptr : found.front();
}

const PhaseFolder* source_of(const Run& run, const PhaseFolder& phase) {
    if (!phase.result.is_object()) return nullptr;
    const json inputs = phase.result.value("/provenance/inputs"_json_pointer, json::array());
    const auto first = [&](const auto& made) {
        const auto found = std::ranges::find_if(run.phases, made);
        return found == run.phases.end() ? nullptr : &*found;
    };
    for (const json& input : inputs) {
        const std::string sha256 = input.at("sha256");
        if (const PhaseFolder* by_content = first([&](const PhaseFolder& each) {
                return std::ranges::find(each.artifacts, sha256) != each.artifacts.end();
            }))
            return by_content;
        const std::string label =
            label_of(fs::path(input.at("path").get<std::string>()).parent_path());
        if (const PhaseFolder* by_folder =
                first([&](const PhaseFolder& each) { return each.label == label; }))
            return by_folder;
    }
    return nullptr;
}

bool is_static(const Run& run) {
    return !phase_named(run, phases::fem.program) &&
           std::ranges::none_of(run.phases, [](const PhaseFolder& each) {
               return each.phase == phases::transfer.program || each.transfer_time;
           });
}

bool is_shaken(const Run& run) {
    return std::ranges::any_of(phases_named(run, phases::fem.program), [](const auto* each) {
        return each->scene.contains(json::json_pointer("/fem/motion"));
    });
}

bool has_telemetry(const PhaseFolder& phase) {
    return fs::is_regular_file(phase.files / phases::files::telemetry);
}

std::vector<TimedFile> timed_files(const fs::path& folder, const std::string& prefix) {
    std::vector<TimedFile> found;
    for (const auto& each : fs::directory_iterator(folder)) {
        const std::string name = each.path().filename();
        if (!name.starts_with(prefix) || !name.ends_with(phases::files::snapshot_extension))
            continue;
        const auto time = leading_number(std::string_view(name).substr(prefix.size()));
        if (time) found.push_back({*time, each.path()});
    }
    std::ranges::sort(found, {}, &TimedFile::time);
    return found;
}

}  // namespace breach::report
