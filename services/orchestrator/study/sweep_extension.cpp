// A run grows by reading its study again with more times or samples, planning all of it, and
// keeping what it lacks; tasks are matched by their labels. Called by requests to extend a run or
// to add a trigger, and by BatchWatch.
#include "services/orchestrator/study/sweep_extension.hpp"

#include <algorithm>
#include <map>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/study/graph.hpp"
#include "services/orchestrator/study/read_study.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Reads the document with the run's scene, which includes the study's overrides: applied again, an
/// override that appends would append twice.
Study read_again(json document, const RunSoFar& run, const DataFolder& data) {
    json overrides = document.value("overrides", json::array());
    document["overrides"] = json::array();
    document["scene"] = json::parse(run.scene);
    Study study = read_study_document(std::move(document), {data.root()});
    study.document["overrides"] = std::move(overrides);
    return study;
}

std::vector<std::string> names_of_variants(const json& study) {
    std::vector<std::string> names;
    for (const json& each : study.value("variants", json::array()))
        names.push_back(each.at("name"));
    return names;
}

/// The submitted study with these times.
Study study_with(const RunSoFar& run, const DataFolder& data, const json& times) {
    json document = run.study;
    document["transfer_times"] = times;
    Study study = read_again(std::move(document), run, data);
    // Else tasks would be matched with those of other variants.
    if (names_of_variants(study.document) != names_of_variants(run.study))
        throw fault::BadInput(
            "request", {{"/transfer_times",
                         "the run's variants cannot be made again from what an earlier version "
                         "has stored of its study",
                         "submit the study with all its times: what was computed is not computed "
                         "again"}});
    return study;
}

bool contains(const std::vector<double>& times, std::optional<double> time) {
    return time && std::ranges::find(times, *time) != times.end();
}

/// "fem_2": the first label of this stem that the run does not have.
std::string free_label(const std::map<std::string, Task>& present, const std::string& stem) {
    int number = 2;
    while (present.contains(stem + "_" + std::to_string(number))) ++number;
    return stem + "_" + std::to_string(number);
}

/// Adds tasks that the run lacks; repeats FEMs without a snapshot of the new times.
/// Parents come first in the graph, so a parent is known when its children are looked at.
void add_missing_tasks(TaskGraph graph, const std::map<std::string, Task>& present,
                       const DataFolder& data, Extension& extension) {
    extension.recipes = std::move(graph.recipes);
    const auto has_snapshots = [&](const Task& fem) {
        return std::ranges::all_of(extension.times, [&](double time) {
            return std::filesystem::exists(data.output(fem) / snapshot_name(time));
        });
    };
    std::map<std::size_t, std::size_t> added;     // index in the list, by index in the graph
    std::map<std::size_t, std::string> existing;  // task id, by index in the graph
    for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
        TaskPlan& plan = graph.tasks[i];
        const auto same = present.find(plan.label);
        const bool fem_again = plan.phase == phases::fem.program && same != present.end() &&
                               !extension.times.empty() && !has_snapshots(same->second);
        if (same != present.end() && !fem_again) {
            existing[i] = same->second.id;
            continue;
        }
        // The first FEM keeps its label and its results; transfers of the old times stay below it.
        if (fem_again) plan.label = free_label(present, plan.label);
        AddedTask task{.plan = std::move(plan), .parent = std::nullopt};
        if (task.plan.parent) {
            const auto known_parent = existing.find(*task.plan.parent);
            if (known_parent != existing.end()) {
                task.parent = known_parent->second;
                task.plan.parent.reset();
            } else {
                task.plan.parent = added.at(*task.plan.parent);
            }
        }
        added[i] = extension.tasks.size();
        extension.tasks.push_back(std::move(task));
    }
}

}  // namespace

Extension plan_extension(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                         const json& wanted) {
    std::map<std::string, Task> present;
    for (const Task& each : run.tasks) present.emplace(each.label, each);
    // Without times that a trigger found in one variant: they are not times of the others.
    const std::vector<double> known = read_again(run.study, run, data).transfer_times;
    Extension extension;
    for (const double time : study_with(run, data, wanted).transfer_times)
        if (!contains(known, time)) extension.times.push_back(time);
    std::vector<double> all = known;
    all.insert(all.end(), extension.times.begin(), extension.times.end());
    std::ranges::sort(all);

    const Study study = study_with(run, data, all);
    extension.study = study.document;
    extension.warnings = study.warnings;
    add_missing_tasks(plan_tasks(study, numerics), present, data, extension);
    return extension;
}

/// Never fewer than there are: an extension does not remove.
Extension plan_more_samples(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                            std::size_t drawn, std::size_t asked) {
    json document = run.study;
    if (!document.contains("uncertainty"))
        throw fault::BadInput("request", {{"/samples", "the run is of no uncertainty study",
                                           "extend it by transfer_times, or submit a study with "
                                           "\"uncertainty\""}});
    json& entry = document["uncertainty"];
    const std::size_t before = entry.at("drawn");
    entry["samples"] = std::max<std::size_t>(asked, entry.at("samples"));
    entry["drawn"] = std::max(drawn, before);
    return plan_more_variants(run, data, numerics, entry);
}

Extension plan_more_variants(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                             const json& entry) {
    json document = run.study;
    const std::size_t before = document.at("variants").size();
    document["uncertainty"] = entry;
    const Study study = read_again(std::move(document), run, data);
    std::map<std::string, Task> present;
    for (const Task& each : run.tasks) present.emplace(each.label, each);
    Extension extension;
    extension.study = study.document;
    extension.warnings = study.warnings;
    for (std::size_t i = before; i < study.variants.size(); ++i)
        extension.samples.push_back(study.variants[i].name);
    TaskGraph graph = plan_tasks(study, numerics);
    extension.firing_plan = std::move(graph.one_more_transfer);
    extension.triggers = study.triggers;
    add_missing_tasks(std::move(graph), present, data, extension);
    return extension;
}

/// Planned as if the trigger had been there from the start: where that needs a FEM more than the
/// run has, the run cannot take the trigger.
bool shares_fems_too_widely(const RunSoFar& run, const DataFolder& data, const Numerics& numerics,
                            const TriggerPlan& trigger) {
    const Work work = work_of(trigger);
    if (std::ranges::none_of(stability_fields,
                             [&](const StabilityField& each) { return asks_for(work, each); }))
        return false;
    Study study = read_again(run.study, run, data);
    study.triggers.push_back(trigger);
    const std::vector<TaskPlan> wanted = plan_tasks(study, numerics).tasks;
    return std::ranges::any_of(wanted, [&](const TaskPlan& each) {
        return each.phase == phases::fem.program &&
               std::ranges::find(run.tasks, each.label, &Task::label) == run.tasks.end();
    });
}

}  // namespace breach::orchestrator
