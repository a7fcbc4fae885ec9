// The last step of a submission that computes: from here on a run is rows in the store. Nothing is
// checked any more: read_study has refused what is wrong.
#include "services/orchestrator/study/new_run.hpp"

#include <algorithm>

#include "core/scene/file_paths.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/study/graph.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// Batches::spec of a study with "until" or "target"; null for others.
json batches_of(const Study& study) {
    if (study.target) return {{"target", study.target->question.target}};
    if (!study.uncertainty || !study.uncertainty->batch) return nullptr;
    return {{"batch", *study.uncertainty->batch}};
}

}  // namespace

NewRun new_run(const Study& study, const Numerics& numerics) {
    TaskGraph graph = plan_tasks(study, numerics);
    std::vector<std::string> files;
    // A sent file stays as long as a run names it (Transaction::forget_file).
    for (const auto& each : scene::references_in({study.scene, study.document}))
        files.push_back(each.sha256);
    const std::size_t states = std::max<std::size_t>(1, study.transfer_times.size());
    return {.id = new_run_id(),
            .name = study.name,
            .title = study.title,
            .study = study.document.dump(),
            .scene = study.scene.dump(),
            .tasks = std::move(graph.tasks),
            .recipes = std::move(graph.recipes),
            .triggers = study.triggers,
            .firing_plan = std::move(graph.one_more_transfer),
            .batches = batches_of(study),
            .warnings = study.warnings,
            .priority = study.priority,
            .sweep = study.variants.size() * states > 1,
            .files = std::move(files)};
}

}  // namespace breach::orchestrator
