#include "fem_solver/choose.hpp"

#include <algorithm>

#include "core/scene/ground.hpp"
#include "core/words/number.hpp"
#include "fem_solver/monitors/watch.hpp"
#include "fem_solver/solve/plastic_gravity.hpp"

namespace breach::fem {

namespace {

using process::Decided;
using process::line_of;
using process::PlanLine;
using process::use_if;

using Question = bool (*)(const materials::Law&);

/// "Mohr-Coulomb in a, b; ...": laws with this property and their regions.
std::string laws_that(const scene::Scene& scene, Question question) {
    std::vector<std::pair<std::string, std::string>> found;
    for (const scene::Region& region : scene.section.regions) {
        const materials::Law& law = scene.materials[region.material].law;
        if (!question(law)) continue;
        const std::string name = materials::traits(law).name;
        const auto known =
            std::ranges::find(found, name, [](const auto& each) { return each.first; });
        if (known == found.end())
            found.emplace_back(name, region.name);
        else
            known->second += ", " + region.name;
    }
    std::string text;
    for (const auto& [name, regions] : found)
        text += (text.empty() ? "" : "; ") + name + " in " + regions;
    return text;
}

/// "a, b": regions whose material has this property.
template <class Question>
std::string regions_where(const scene::Scene& scene, const Question& question) {
    std::string names;
    for (const scene::Region& region : scene.section.regions) {
        if (!question(scene.materials[region.material])) continue;
        names += (names.empty() ? "" : ", ") + region.name;
    }
    return names;
}

bool softens(const scene::Material& material) {
    return materials::softening(material.law) != nullptr;
}

/// "1000 Pa s beside the law's stress in a; ...": every material with a viscosity and its regions.
std::string viscous_regions(const scene::Scene& scene) {
    std::string text;
    for (const scene::Material& material : scene.materials) {
        if (material.viscosity == 0.0) continue;
        const std::string names =
            regions_where(scene, [&](const scene::Material& each) { return &each == &material; });
        if (names.empty()) continue;
        text += (text.empty() ? "" : "; ") + words::text_of(material.viscosity) +
                " Pa s beside the law's stress in " + names;
    }
    return text;
}

/// "clay by 0.122 sigma'_v0, here about 1 to 38 kPa; ...": s_u of the regions that have one.
std::string undrained_regions(const scene::Scene& scene) {
    std::string text;
    const scene::Ground ground(scene);
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const scene::Region& region = scene.section.regions[r];
        const auto& s_u = scene.materials[region.material].dynamic_strength;
        if (!s_u) continue;
        std::vector<double> range;
        for (const Vec2& each : region.polygon)
            range.push_back(materials::strength_at(*s_u, ground.at(each, r)).c / 1e3);
        const auto [least, largest] = std::ranges::minmax(range);
        text += (text.empty() ? "" : "; ") + region.name + " with about " +
                words::text_of(least, 3) + " to " + words::text_of(largest, 3) +
                " kPa by the weight above it";
    }
    return text;
}

/// Laws with memory have their own line.
bool flows_without_memory(const materials::Law& law) {
    return materials::traits(law).yields && !materials::remembers(law);
}

Decided<std::optional<std::int64_t>> memory_of(const scene::Scene& scene) {
    const std::string feature = "laws with memory", pointer = "/materials";
    const std::string laws = laws_that(scene, materials::remembers);
    const auto& stages = scene::fem_of(scene).stages;
    const auto first = std::ranges::find(stages, scene::StageLaws::scene, &scene::Stage::laws);
    if (laws.empty())
        return {std::nullopt, {feature, process::Use::left_out, "no material has one", pointer}};
    if (first == stages.end())
        return {std::nullopt,
                {feature, process::Use::left_out, laws + ", but every stage is elastic", pointer}};
    return {first - stages.begin(),
            {feature, process::Use::on, laws + "; elastic until the first stage with its laws",
             pointer}};
}

Decided<MemoryStart> memory_start_of(const scene::Fem& fem,
                                     const std::optional<std::int64_t>& stage) {
    const bool rests = stage && rests_first(fem.stages[static_cast<std::size_t>(*stage)], *stage);
    const std::string without =
        stage ? "no static stage of the scene's laws follows elastic gravity; what lies outside "
                "their surfaces stays as a constant stress"
              : "no law with memory begins";
    return {rests ? MemoryStart::at_rest_with_friction : MemoryStart::as_they_are,
            line_of("friction before laws with memory", use_if(rests),
                    {"a static stage begins them: gravity's stresses are brought inside their "
                     "surfaces first",
                     without},
                    "/fem/stages")};
}

Decided<bool> free_ground_of(const scene::Fem& fem) {
    const bool known = fem.base && fem.motion && fem.free_field;
    return {known, line_of("motion of the free ground", use_if(known),
                           {"the columns alone to the end of the motion, before the mesh moves: "
                            "snapshots carry it for runouts that are shaken on",
                            fem.motion ? "there are no columns: no runout can be shaken on after "
                                         "the transfer"
                                       : "no motion is given"},
                           "/fem/free_field")};
}

}  // namespace

RunDecisions decide_run(const scene::Scene& scene) {
    const scene::Fem& fem = scene::fem_of(scene);
    const auto memory = memory_of(scene);
    return {
        .memory = memory,
        .memory_start = memory_start_of(fem, memory.value),
        .free_ground = free_ground_of(fem),
        .snapshot_times = {fem.snapshot_times,
                           line_of("snapshots on the way", use_if(!fem.snapshot_times.empty()),
                                   {std::to_string(fem.snapshot_times.size()) + " times",
                                    "stored only at the end and when requested"},
                                   "/fem/snapshot_times")},
        .snapshot_interval = {fem.snapshot_interval,
                              line_of("regular snapshots", use_if(fem.snapshot_interval > 0.0),
                                      {"one per " + words::text_of(fem.snapshot_interval) + " s",
                                       "no interval is given"},
                                      "/fem/snapshot_interval")},
        .liquefaction = liquefaction_watch(fem),
        .largest_step_error = {fem.largest_step_error,
                               line_of("step size from its error",
                                       use_if(fem.largest_step_error > 0.0),
                                       {"steps are cut and grown to keep it",
                                        "steps follow the iterations alone"},
                                       "/fem/largest_step_error")},
    };
}

Decisions decide(const scene::Scene& scene) {
    return {mesher_of(scene), decide_model(scene), decide_run(scene)};
}

process::Plan plan_of(const Decisions& decided, const scene::Scene& scene) {
    const ModelDecisions& model = decided.model;
    const RunDecisions& run = decided.run;
    const std::string plastic = laws_that(scene, flows_without_memory);
    const std::string softening = regions_where(scene, softens);
    const std::string nonlocal = regions_where(scene, [](const scene::Material& material) {
        return softens(material) && material.nonlocal_length;
    });
    const std::string viscous = viscous_regions(scene);
    const std::string undrained = undrained_regions(scene);
    const bool moves = std::ranges::any_of(scene::fem_of(scene).stages, [](const auto& stage) {
        return stage.kind == scene::StageKind::dynamic;
    });
    return {
        model.gravity.line,
        run.memory.line,
        run.memory_start.line,
        line_of("plasticity", use_if(!plastic.empty()), {plastic, "no material flows plastically"},
                "/materials"),
        line_of("softening", use_if(!softening.empty()),
                {"in " + softening + "; explicit per step", "no law softens"}, "/materials"),
        line_of("nonlocal softening", use_if(!nonlocal.empty()),
                {"in " + nonlocal + ": growth of each step averaged over the region's elements",
                 "no softening material has a nonlocal_length: bands are as wide as an element"},
                "/materials"),
        line_of("undrained strength in motion", use_if(!undrained.empty() && moves),
                {undrained, undrained.empty() ? "no region's material has a dynamic_strength"
                                              : "no stage moves"},
                "/materials"),
        line_of("inertia (Newmark)", use_if(moves), {"a stage is dynamic", "every stage is static"},
                "/fem/stages"),
        model.element.line,
        model.damping.line,
        line_of("viscosity", use_if(!viscous.empty() && moves),
                {viscous, viscous.empty() ? "no region's material has one" : "no stage moves"},
                "/materials"),
        decided.mesher.line,
        run.snapshot_times.line,
        run.snapshot_interval.line,
        model.water.line,
        model.base.line,
        model.motion.line,
        model.free_field.line,
        run.free_ground.line,
        run.liquefaction.line,
        model.surcharge.line,
        run.largest_step_error.line,
    };
}

}  // namespace breach::fem
