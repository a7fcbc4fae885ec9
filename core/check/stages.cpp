#include <algorithm>
#include <array>
#include <optional>

#include "core/check/mesh_file.hpp"
#include "core/check/section.hpp"
#include "core/check/subjects.hpp"

namespace breach::check {

namespace {

/// Type of a law whose points have a memory, among the regions; null: none.
const char* name_of_law_with_memory(const scene::Scene& scene) {
    for (const scene::Region& region : scene.section.regions) {
        const scene::Material* material = material_of(scene, region);
        if (material != nullptr && materials::remembers(material->law))
            return materials::traits(material->law).name;
    }
    return nullptr;
}

/// Refuses an elastic stage after the law has begun: the memory of points would be lost.
void check_memory(const scene::Scene& scene, const std::string& law, Problems& problems) {
    const scene::Fem& fem = *scene.fem;
    bool began = false;
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        const bool elastic = fem.stages[i].laws == scene::StageLaws::elastic;
        if (began && elastic)
            refuse(problems, "/fem/stages/" + std::to_string(i) + "/laws",
                   "is elastic after " + law + " has begun",
                   "put elastic stages first: the soil's memory would be lost");
        began = began || !elastic;
    }
}

/// Warns of sudden changes in a dynamic stage: without a ramp they act as an impact.
void warn_about_blows(const scene::Fem& fem, Problems& problems) {
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        const scene::Stage& stage = fem.stages[i];
        const bool changes =
            !stage.activates.empty() || !stage.removes.empty() || !stage.releases.empty();
        if (stage.kind != scene::StageKind::dynamic || !changes || stage.ramp > 0.0) continue;
        warn(problems, "sudden_change", "/fem/stages/" + std::to_string(i),
             "places or removes soil or supports at once, which shakes the body like an impact; "
             "give the stage a ramp");
    }
}

constexpr const char* mesh_pointer = "/fem/msh_file";
/// Checks the head of the mesh file: its format, and a surface for every region.
void check_mesh_file(const scene::Scene& scene, const std::filesystem::path& file,
                     Problems& problems) {
    MeshHead head;
    try {
        head = read_mesh_head(file);
    } catch (const fault::IoError& error) {
        refuse(problems, mesh_pointer, error.what(),
               "give a path relative to the scene file, or the absolute path on the machine that "
               "computes");
        return;
    } catch (const fault::BadInput& error) {
        for (const fault::Fault& each : error.faults())
            refuse(problems, mesh_pointer, each.cause, each.remedy);
        return;
    }
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const std::string& name = scene.section.regions[r].name;
        if (head.surfaces.contains(name)) continue;
        refuse(problems, region_pointer(r),
               "\"" + name + "\" has no physical surface in " + file.string(),
               "add a physical surface of that name to the mesh");
    }
}

/// Undrained stages need water at rest before them, and no changes that need drainage.
void check_undrained(const scene::Scene& scene, Problems& problems) {
    const scene::Fem& fem = *scene.fem;
    const bool remembers = name_of_law_with_memory(scene) != nullptr;
    bool began = false;
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        const scene::Stage& stage = fem.stages[i];
        const std::string pointer = "/fem/stages/" + std::to_string(i);
        const bool begins = !began && stage.laws == scene::StageLaws::scene;
        began = began || begins;
        if (stage.undrained.empty()) continue;
        if (!fem.water)
            refuse(problems, pointer + "/undrained", "has no water that could be held back",
                   "give /fem/water, or leave it out");
        if (i == 0)
            refuse(problems, pointer + "/undrained",
                   "is the first stage's: no pressure is there yet",
                   "put a drained stage before it");
        if (begins && remembers)
            refuse(problems, pointer + "/undrained",
                   "is of the stage in which the scene's laws begin",
                   "put a drained stage with \"laws\": \"scene\" before it");
        if (stage.phreatic_line)
            refuse(problems, pointer + "/phreatic_line", "moves in a stage that does not drain",
                   "move the water in a stage of its own");
    }
}

/// A strength of dynamic stages replaces c and phi, and needs the stress of static stages before.
/// cause and remedy; none: the region's soil can have it.
std::optional<std::array<std::string, 2>> why_no_dynamic_strength(const scene::Scene& scene,
                                                                  std::size_t r,
                                                                  const materials::Law& law) {
    const auto& stages = scene.fem->stages;
    const auto moving = std::ranges::find(stages, scene::StageKind::dynamic, &scene::Stage::kind);
    const auto places = [&](const scene::Stage& each) {
        return std::ranges::find(each.activates, r) != each.activates.end();
    };
    using Why = std::array<std::string, 2>;
    if (!materials::has_c_and_phi(law))
        return Why{std::string("is of ") + materials::traits(law).name +
                       ", which has no c and phi that it could replace",
                   "leave it out, or give the material a law of type " +
                       materials::types_of_laws_that(materials::has_c_and_phi)};
    if (materials::softening(law))
        return Why{"replaces a strength that softens, and does not soften itself",
                   "leave out the softening, or the dynamic_strength"};
    if (moving == stages.end()) return std::nullopt;
    if (moving == stages.begin() || std::any_of(moving, stages.end(), places))
        return Why{"is a share of sigma'_v0, and no static stage gives one to \"" +
                       scene.section.regions[r].name + "\"",
                   "put a static stage with this region before the first dynamic stage"};
    if (!scene.fem->water)
        return Why{"is of undrained soil, and the scene has no water",
                   "give /fem/water, or write the strength in the law: c_kPa = s_u, phi_deg = 0"};
    return std::nullopt;
}

void check_dynamic_strengths(const scene::Scene& scene, Problems& problems) {
    const bool moves = std::ranges::any_of(scene.fem->stages, [](const scene::Stage& each) {
        return each.kind == scene::StageKind::dynamic;
    });
    std::vector<const scene::Material*> told;
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        const scene::Material* soil = material_of(scene, scene.section.regions[r]);
        if (soil == nullptr || !soil->dynamic_strength ||
            std::ranges::find(told, soil) != told.end())
            continue;
        const std::string pointer = "/materials/" + soil->name + "/dynamic_strength";
        const auto why = why_no_dynamic_strength(scene, r, soil->law);
        if (why) refuse(problems, pointer, why->at(0), why->at(1));
        if (!why && !moves)
            warn(problems, "implausible", pointer,
                 "has no effect, because no stage of /fem/stages is dynamic; leave it out, or add "
                 "such a stage");
        if (why || !moves) told.push_back(soil);
    }
}

/// Softening by region needs a law with a state parameter.
void check_softening(const scene::Scene& scene, const scene::Stage& stage,
                     const std::string& pointer, Problems& problems) {
    for (std::size_t r = 0; r < stage.S_of_region.size(); ++r) {
        const scene::Material* material = material_of(scene, scene.section.regions[r]);
        if (!stage.S_of_region[r] || material == nullptr ||
            materials::has_state_parameter(material->law))
            continue;
        refuse(problems, pointer,
               "softens \"" + scene.section.regions[r].name + "\", which is of " +
                   materials::traits(material->law).name,
               "name regions of NorSand");
    }
}

/// Warns of S in a stage with drainage: S is the additional softening of undrained soil.
void check_drained_softening(const scene::Scene& scene, const scene::Stage& stage,
                             const std::string& pointer, Problems& problems) {
    if (stage.kind != scene::StageKind::static_equilibrium) return;
    const auto softens = [&](std::size_t r) {
        const auto of_region =
            r < stage.S_of_region.size() ? stage.S_of_region[r] : std::optional<double>();
        if (of_region) return *of_region > 0.0 && std::ranges::count(stage.undrained, r) == 0;
        return stage.undrained.empty() && stage.S.value_or(0.0) > 0.0;
    };
    for (std::size_t r = 0; r < scene.section.regions.size(); ++r) {
        if (!softens(r)) continue;
        warn(problems, "drained_softening", pointer,
             "softens \"" + scene.section.regions[r].name +
                 "\", which drains in this stage: S is of undrained soil; name its region in "
                 "/undrained, or leave S to the stages in motion");
        return;
    }
}

/// Each region may be placed and removed once, in a possible order.
void check_changes(const scene::Scene& scene, Problems& problems) {
    const scene::Fem& fem = *scene.fem;
    if (!fem.changes_the_body()) return;
    const auto& regions = scene.section.regions;
    std::vector<bool> there(regions.size(), true);
    for (const scene::Stage& stage : fem.stages)
        for (const std::size_t r : stage.activates)
            if (r < there.size()) there[r] = false;
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        const scene::Stage& stage = fem.stages[i];
        const std::string pointer = "/fem/stages/" + std::to_string(i);
        if (stage.changes_the_body() && fem.free_field)
            refuse(problems, pointer, "changes the body between free-field columns",
                   "leave out /fem/free_field: it is for shaking");
        if (stage.phreatic_line && !fem.water)
            refuse(problems, pointer + "/phreatic_line", "moves water that the scene does not have",
                   "give /fem/water with the line before this stage");
        for (std::size_t k = 0; k < stage.activates.size(); ++k) {
            const std::size_t r = stage.activates[k];
            if (r >= there.size()) continue;
            const std::string here = pointer + "/activate/" + std::to_string(k);
            if (there[r])
                refuse(problems, here, "\"" + regions[r].name + "\" is there already",
                       "activate a region once");
            there[r] = true;
            const scene::Material* material = material_of(scene, regions[r]);
            if (material != nullptr && materials::remembers(material->law) &&
                stage.laws == scene::StageLaws::scene)
                refuse(problems, here,
                       "places \"" + regions[r].name + "\" with " +
                           materials::traits(material->law).name +
                           ", which cannot begin without stress",
                       "place it in an elastic stage, or give it another law");
        }
        for (std::size_t k = 0; k < stage.removes.size(); ++k) {
            const std::size_t r = stage.removes[k];
            if (r >= there.size()) continue;
            if (!there[r])
                refuse(problems, pointer + "/remove/" + std::to_string(k),
                       "\"" + regions[r].name + "\" is not there in this stage",
                       "remove a region that is there, once");
            there[r] = false;
        }
        if (std::ranges::find(there, true) == there.end())
            refuse(problems, pointer, "leaves no region", "keep one");
    }
}

void check_surcharges(const scene::Scene& scene, const std::vector<scene::Surcharge>& loads,
                      const std::string& pointer, Problems& problems) {
    for (std::size_t k = 0; k < loads.size(); ++k)
        check_beside(scene, loads[k].from, loads[k].to, pointer + "/surcharge/" + std::to_string(k),
                     problems);
}

}  // namespace

void check_stages(const scene::Scene& scene, Problems& problems) {
    check_surcharges(scene, scene.fem->surcharge, "/fem", problems);
    if (const char* law = name_of_law_with_memory(scene)) check_memory(scene, law, problems);
    check_undrained(scene, problems);
    check_dynamic_strengths(scene, problems);
    for (std::size_t i = 0; i < scene.fem->stages.size(); ++i) {
        const scene::Stage& stage = scene.fem->stages[i];
        const std::string pointer = "/fem/stages/" + std::to_string(i);
        check_softening(scene, stage, pointer + "/S", problems);
        check_drained_softening(scene, stage, pointer + "/S", problems);
        if (stage.surcharge) check_surcharges(scene, *stage.surcharge, pointer, problems);
    }
    check_changes(scene, problems);
    warn_about_blows(*scene.fem, problems);
    if (scene.fem->mesh.msh_file) check_mesh_file(scene, *scene.fem->mesh.msh_file, problems);
}

}  // namespace breach::check
