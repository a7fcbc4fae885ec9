// Cost of a step: that of ten, without what precedes the first.
// Called for --plan --measure. Two analyses, with ten dynamic steps and with none: the difference
// is the steps' cost, without meshing and gravity.
#include "fem_solver/solve/trial.hpp"

#include <algorithm>

#include "fem_solver/analysis.hpp"
#include "fem_solver/model/build_model.hpp"
#include "fem_solver/run.hpp"

namespace breach::fem {

namespace {

constexpr double steps_of_trial = 10.0;

/// The scene up to `steps` steps into its first dynamic stage, without output.
scene::Scene shortened(scene::Scene scene, double steps) {
    scene::Fem& fem = *scene.fem;
    fem.snapshot_times.clear();
    fem.snapshot_interval = 0.0;
    const auto first =
        std::ranges::find(fem.stages, scene::StageKind::dynamic, &scene::Stage::kind);
    if (first == fem.stages.end()) return scene;
    // Steps may be cut in the trial, too: cost.steps counts those that were taken.
    first->duration = std::min(first->duration, steps * first->time_step);
    fem.stages.erase(steps > 0.0 ? first + 1 : first, fem.stages.end());
    return scene;
}

nlohmann::json facts_of(const process::Session& asked, double steps) {
    process::SessionSettings settings = asked.settings();
    settings.output = asked.output(std::to_string(static_cast<int>(steps)) + "_steps");
    settings.switches.insert(trial_switch);
    std::filesystem::create_directories(settings.output);
    process::Session session(settings, shortened(asked.scene(), steps));
    const scene::Scene& scene = session.scene();
    Course course(session, build_model(scene, build_mesh(scene, settings.output)));
    analyse(course);
    return session.result();
}

}  // namespace

process::Cost measure(process::Session& session) {
    const auto& stages = scene::fem_of(session.scene()).stages;
    const bool begins_at_once = stages.front().kind == scene::StageKind::dynamic;
    const nlohmann::json before = begins_at_once ? nlohmann::json() : facts_of(session, 0.0);
    const nlohmann::json after = facts_of(session, steps_of_trial);
    const auto more = [&](const char* kind) {
        const double spent = after["seconds"][kind];
        return before.is_null() ? spent
                                : std::max(spent - before["seconds"][kind].get<double>(), 0.0);
    };
    process::Cost cost;
    for (const char* what : {"elements", "nodes", "unknowns", "pressure_unknowns"})
        cost.counts.emplace_back(what, after[what].get<std::int64_t>());
    // Of both analyses and the building of their models; gmsh is a process of its own.
    if (const auto megabytes = session.peak_memory())
        cost.memory.emplace_back("the program at its most", 1e6 * *megabytes);
    const auto steps_of = [](const nlohmann::json& facts) {
        return facts.is_null() ? 0 : facts["steps"].get<std::int64_t>();
    };
    cost.steps = steps_of(after) - steps_of(before);
    for (const char* kind : {"assembly", "law", "factor", "solve", "output"})
        cost.seconds.emplace_back(kind, more(kind));
    return cost;
}

}  // namespace breach::fem
