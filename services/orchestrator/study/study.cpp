#include "services/orchestrator/study/study.hpp"

#include <algorithm>
#include <cmath>

#include "core/scene/file_paths.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/schema.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using fault::BadInput;
using fault::Fault;
using nlohmann::json;

namespace {

constexpr std::size_t most_transfers = 10000;
constexpr double microsecond = 1e-6;  // two times closer than this would share a snapshot's name

/// The double nearest to the spelt time: 0.1 + 0.2 becomes 0.3, so snapshot, override and row
/// agree.
double in_microseconds(double time) { return std::stod(spelt(time)); }

std::vector<double> even_range(const json& range, std::vector<Fault>& faults) {
    const double from = range.at("from");
    const double to = range.at("to");
    const double step = range.at("step");
    if (to < from) {
        faults.push_back({"/transfer_times/to", "the range ends before it begins",
                          "give to >= from, or a list of times"});
        return {};
    }
    if (step < microsecond) {
        faults.push_back({"/transfer_times/step", "the step is below one microsecond",
                          "give a step of at least 1e-6 s"});
        return {};
    }
    const double count = std::floor((to - from) / step + 1e-9) + 1;
    if (count > static_cast<double>(most_transfers)) {
        faults.push_back({"/transfer_times/step",
                          "the range holds more than " + std::to_string(most_transfers) + " times",
                          "give a larger step"});
        return {};
    }
    std::vector<double> times;
    for (double i = 0; i < count; ++i) times.push_back(from + i * step);
    return times;
}

std::vector<double> wanted_times(const json& entry, std::vector<Fault>& faults) {
    std::vector<double> times =
        entry.is_array() ? entry.get<std::vector<double>>() : even_range(entry, faults);
    for (double& time : times) time = in_microseconds(time);
    std::ranges::sort(times);
    const auto equal = std::ranges::adjacent_find(times);
    if (equal != times.end()) {
        faults.push_back({"/transfer_times", "the time " + spelt(*equal) + " s is given twice",
                          "give each transfer time once (they are told apart to 1e-6 s)"});
    }
    return times;
}

/// Length of the shaking and failure [s]: the clock of snapshots starts with the first dynamic
/// stage.
double dynamic_duration(const scene::Fem& fem) {
    double sum = 0.0;
    for (const scene::Stage& stage : fem.stages) sum += stage.duration;
    return sum;
}

void check_times(const std::vector<double>& times, const scene::Fem& fem,
                 std::vector<Fault>& faults) {
    if (times.empty()) return;
    const double end = dynamic_duration(fem);
    if (times.back() > end + microsecond) {
        faults.push_back({"/transfer_times",
                          "the transfer at " + spelt(times.back()) +
                              " s comes after the end of the dynamic stages at " + spelt(end) +
                              " s",
                          "transfer earlier or lengthen /scene/fem/stages"});
    }
}

void need_part(const json& scene, const std::string& part, std::vector<Fault>& faults) {
    if (scene.contains(part)) return;
    faults.push_back({"/scene/" + part, "a study needs this part of the scene, and it is missing",
                      "add \"" + part + "\" to the scene"});
}

/// The scene's own check, its faults moved below `prefix`. Nothing when it has faults.
std::optional<scene::Scene> checked_scene(const json& document, const std::string& prefix,
                                          const std::vector<std::string>& overrides,
                                          std::vector<Fault>& faults) {
    try {
        for (const std::string& key : scene::file_entries) {
            const json::json_pointer at(key);
            if (!document.contains(at) || !document[at].is_string() ||
                document[at].get_ref<const std::string&>().starts_with('/'))
                continue;
            faults.push_back({prefix + key,
                              "the path is relative, but a scene sent to the service has no folder",
                              "give the absolute path of the file on the service's machine"});
        }
        return scene::parse_scene(document.dump(), "scene", "/", overrides);
    } catch (const BadInput& error) {
        for (Fault each : error.faults()) {
            each.pointer = prefix + each.pointer;
            faults.push_back(std::move(each));
        }
        return std::nullopt;
    }
}

/// What makes transfers happen: times, and triggers that watch the FEM.
void read_triggers(const json& document, const scene::Fem& fem, Study& study,
                   std::vector<Fault>& faults) {
    const double span = dynamic_duration(fem);
    CheckedTriggers checked = check_triggers(document["triggers"], span, "/triggers", faults);
    std::vector<double> times;
    const auto take = [&](const json& entry) {
        const std::vector<double> more = wanted_times(entry, faults);
        times.insert(times.end(), more.begin(), more.end());
    };
    if (document.contains("transfer_times")) take(document["transfer_times"]);
    for (const json& each : checked.at_time) take(each);
    std::ranges::sort(times);
    const auto repeated = std::ranges::unique(times);
    times.erase(repeated.begin(), repeated.end());
    study.transfer_times = std::move(times);
    study.triggers = std::move(checked.live);
    study.snapshot_interval = checked.snapshot_interval;
    if (fem.snapshot_interval > 0.0 && study.snapshot_interval > fem.snapshot_interval)
        study.snapshot_interval = 0.0;  // the scene's own are finer
    if (faults.empty() && study.transfer_times.empty() && document["triggers"].empty()) {
        faults.push_back({"/transfer_times", "nothing says when to transfer",
                          "give \"transfer_times\", \"triggers\" or both"});
    }
}

/// Each variant's scene, checked and completed; faults are those of its overrides.
std::vector<Variant> checked_variants(const json& entries, const json& scene,
                                      std::vector<Fault>& faults) {
    if (entries.empty()) return {{.name = "", .overrides = {}, .scene = scene}};
    std::vector<Variant> variants;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string at = "/variants/" + std::to_string(i);
        Variant variant{.name = entries[i].at("name"),
                        .overrides = entries[i].at("overrides"),
                        .scene = nullptr};
        if (std::ranges::find(variants, variant.name, &Variant::name) != variants.end()) {
            faults.push_back({at + "/name", "the name \"" + variant.name + "\" is given twice",
                              "give each variant a name of its own"});
        }
        std::vector<Fault> found;
        const auto changed = checked_scene(scene, "", variant.overrides, found);
        for (const Fault& each : found)
            faults.push_back({at + "/overrides", each.pointer + ": " + each.cause, each.remedy});
        if (changed) variant.scene = json::parse(changed->completed);
        variants.push_back(std::move(variant));
    }
    return variants;
}

std::map<std::string, Resources> wanted_resources(const json& entries) {
    std::map<std::string, Resources> wanted;
    for (const auto& [phase, ask] : entries.items())
        wanted[phase] = {.cores = ask.at("cores"), .memory_mb = ask.at("memory_MB")};
    return wanted;
}

}  // namespace

Study read_study(std::string_view text) {
    json document = scene::parse_json(text, "study");
    std::vector<Fault> faults = scene::complete_and_check(document, scene::study_schema());
    if (document.is_object() && document.contains("scene") && document["scene"].is_string()) {
        faults.push_back({"/scene", "a study sent to the service cannot name a scene file",
                          "put the scene itself here (jq can: .scene = $scene[0])"});
    }
    const bool study_is_sound = faults.empty();
    Study study;
    std::optional<scene::Scene> scene;
    if (document.is_object() && document.contains("scene") && document["scene"].is_object()) {
        const auto overrides = study_is_sound
                                   ? document["overrides"].get<std::vector<std::string>>()
                                   : std::vector<std::string>{};
        for (const char* part : {"fem", "mpm"}) need_part(document["scene"], part, faults);
        scene = checked_scene(document["scene"], "/scene", overrides, faults);
    }
    if (study_is_sound && scene && scene->fem) {
        read_triggers(document, *scene->fem, study, faults);
        check_times(study.transfer_times, *scene->fem, faults);
    }
    if (faults.empty()) {
        study.scene = json::parse(scene->completed);
        study.variants = checked_variants(document["variants"], study.scene, faults);
        if (study.variants.size() * study.transfer_times.size() > most_transfers) {
            faults.push_back(
                {"/variants",
                 "variants times transfer times are more than " + std::to_string(most_transfers),
                 "split the study"});
        }
    }
    if (!faults.empty()) throw BadInput("study", std::move(faults));

    study.name = document["name"];
    study.title = document["title"];
    study.resources = wanted_resources(document["resources"]);
    study.priority = document["priority"];
    study.reuse = document["reuse"];
    study.stability = document["stability"].get<bool>() && scene->lem.has_value();
    document.erase("scene");
    study.document = std::move(document);
    return study;
}

json read_whole_scene(std::string_view text) {
    const json document = scene::parse_json(text, "scene");
    std::vector<Fault> faults;
    const auto scene = checked_scene(document, "", {}, faults);
    if (!faults.empty()) throw BadInput("scene", std::move(faults));
    return json::parse(scene->completed);
}

}  // namespace breach::orchestrator
