// Reads folders as `breachline findings` gets them: of `breach export`, of a service's data folder,
// or of programs that were started by hand with any folder name. Names and results say what each
// one is, so that report_questions.cpp can store them as if a service had run them.
#include "services/orchestrator/phase_folders.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <tuple>

#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"

namespace breach::orchestrator {

using nlohmann::json;
namespace fs = std::filesystem;

/// A file that exists and cannot be parsed is a fault, not an absent one: a report that leaves out
/// a damaged result would look whole.
json read_if_there(const fs::path& file) {
    if (!fs::is_regular_file(file)) return {};
    std::ifstream stream(file);
    try {
        return json::parse(stream);
    } catch (const json::exception& error) {
        throw fault::BadInput(file.string(), {{"", error.what(), "run the phase again"}});
    }
}

namespace {

/// The order of the table of phases is that of the chain: lem, fem, post_seismic, transfer, mpm.
std::size_t rank_of(const std::string& phase) {
    const auto found = std::ranges::find(phases::all, phase, &phases::Phase::program);
    return static_cast<std::size_t>(found - phases::all.begin());
}

/// A time as in labels, "13.000000"; nothing for another word, such as "20" of a variant "20_kpa".
std::optional<double> spelt_time(const std::string& word) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_time = error == std::errc() && std::isfinite(value) && value >= 0.0;
    return is_time && phases::files::spelt(value) == word ? std::optional(value) : std::nullopt;
}

/// Takes time and variant from "mpm_13.000000_softened"; both may be missing.
void read_label(TaskPlan& plan) {
    const std::size_t first = plan.label.find('_');
    if (first == std::string::npos) return;
    const std::string rest = plan.label.substr(first + 1);
    const std::size_t next = rest.find('_');
    plan.transfer_time = spelt_time(rest.substr(0, next));
    if (!plan.transfer_time) {
        plan.variant = rest;
    } else if (next != std::string::npos) {
        plan.variant = rest.substr(next + 1);
    }
    // These have no transfer time; a number in their name is the variant's.
    if (plan.phase != phases::transfer.program && plan.phase != phases::mpm.program)
        plan.transfer_time.reset();
}

/// The folder's name, or its parent's when the folder is the service's "output".
std::string label_of(const fs::path& folder) {
    const fs::path name = folder.filename();
    return name == "output" ? folder.parent_path().filename().string() : name.string();
}

/// The result knows its phase; the name decides only for a phase that left none.
std::string phase_of(const std::string& label, const json& result) {
    if (result.is_object() && result.contains("phase")) return result.at("phase");
    for (const phases::Phase& each : phases::all)
        if (label.starts_with(each.part)) return each.program;
    return {};
}

std::optional<PhaseFolder> read_phase(const fs::path& files) {
    PhaseFolder phase{.plan = {},
                      .files = files,
                      .scene = read_if_there(files / phases::files::scene),
                      .result = read_if_there(files / phases::files::result),
                      .fault = {}};
    phase.plan.label = label_of(files);
    phase.plan.phase = phase_of(phase.plan.label, phase.result);
    // A scene in a folder that is no phase's: left out, not a fault.
    if (rank_of(phase.plan.phase) == phases::all.size()) return {};
    read_label(phase.plan);
    if (phase.result.is_object()) return phase;
    const json fault = read_if_there(files / phases::files::fault);
    // A killed phase leaves neither a result nor a fault: it counts as not ended.
    phase.fault = fault.is_object() ? fault.value("summary", "") : "it has not ended";
    return phase;
}

std::vector<fs::path> folders_with_scenes(const fs::path& folder) {
    std::vector<fs::path> found;
    const auto is_phase = [](const fs::path& at) {
        return fs::is_regular_file(at / phases::files::scene);
    };
    if (is_phase(folder)) found.push_back(folder);
    for (fs::recursive_directory_iterator it(folder); it != fs::recursive_directory_iterator();
         ++it) {
        // Deep enough for runs/<run>/<task>/output; a data folder's frames and attempts are not
        // searched.
        if (it.depth() >= 2) it.disable_recursion_pending();
        if (it->is_directory() && is_phase(it->path())) found.push_back(it->path());
    }
    return found;
}

/// By the name of the folder that the input came from: its path may be of another machine.
void find_parent(PhaseFolder& phase, const std::vector<PhaseFolder>& all) {
    if (!phase.result.is_object()) return;
    const json inputs = phase.result.value("/provenance/inputs"_json_pointer, json::array());
    for (const json& input : inputs) {
        const std::string label =
            label_of(fs::path(input.at("path").get<std::string>()).parent_path());
        // Parents are sorted before their children, so only those before this one can be meant.
        for (std::size_t i = 0; i < all.size() && &all[i] != &phase; ++i)
            if (all[i].plan.label == label) phase.plan.parent = i;
    }
}

}  // namespace

std::vector<PhaseFolder> phases_in(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw fault::IoError(
            folder.string() +
            ": is no folder; give the folder of a run, as breach export writes it");
    std::vector<PhaseFolder> found;
    for (const fs::path& each : folders_with_scenes(folder))
        if (auto phase = read_phase(each)) found.push_back(std::move(*phase));
    if (found.empty())
        throw fault::BadInput(
            folder.string(), {{"", "no phase's folder is in it",
                               "give a run exported by breach export, or the folder that holds the "
                               "phases' output folders"}});
    // Sorted for the same report at each call: folders come in any order from the file system.
    std::ranges::sort(found, {}, [](const PhaseFolder& p) {
        return std::tuple(rank_of(p.plan.phase), p.plan.transfer_time.value_or(0.0), p.plan.variant,
                          p.plan.label);
    });
    std::set<std::string> labels;
    for (PhaseFolder& each : found) {
        if (!labels.insert(each.plan.label).second)
            throw fault::BadInput(folder.string(),
                                  {{"", "two phases in it are named " + each.plan.label,
                                    "give a folder with the phases of one run"}});
        find_parent(each, found);
    }
    return found;
}

}  // namespace breach::orchestrator
