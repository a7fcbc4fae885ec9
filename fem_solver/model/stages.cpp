// Changes accumulate: each function looks at all stages up to the present one and not at the model
// before it. A resumed run can therefore begin with any stage.
#include "fem_solver/model/stages.hpp"

#include <algorithm>

#include "fem_solver/model/build_model.hpp"
#include "fem_solver/model/ground.hpp"
#include "fem_solver/model/ground_water.hpp"

namespace breach::fem {
namespace {

/// [elements] of regions absent in a stage.
std::vector<bool> elements_gone(const scene::Scene& scene, std::size_t stage, const Mesh& mesh) {
    const auto gone = scene::fem_of(scene).regions_gone(scene.section.regions.size(), stage);
    std::vector<bool> elements;
    for (const std::int32_t region : mesh.region_of_element) elements.push_back(gone[region]);
    return elements;
}

/// Whether in some stage water covers absent soil.
bool floods_gaps(const scene::Scene& scene, const Mesh& mesh) {
    const scene::Fem& fem = scene::fem_of(scene);
    for (std::size_t s = 0; fem.water && s < fem.stages.size(); ++s) {
        const std::vector<bool> gone = elements_gone(scene, s, mesh);
        const std::vector<bool> below = elements_below(*fem.water_in(s), mesh);
        for (std::size_t e = 0; e < gone.size(); ++e)
            if (gone[e] && below[e]) return true;
    }
    return false;
}

/// Refuses changes of soil below water with steady seepage.
void refuse_wet_changes(const scene::Scene& scene, std::size_t stage, const Model& model) {
    const scene::Fem& fem = scene::fem_of(scene);
    const scene::Stage& now = fem.stages[stage];
    const std::string pointer = "/fem/stages/" + std::to_string(stage);
    if (!model.water.any())
        throw fault::BadInput("scene", {{pointer, "leaves no soil below the phreatic line",
                                         "keep wet soil, or leave out /fem/water"}});
    if (now.kind == scene::StageKind::static_equilibrium && now.undrained.empty()) return;
    const std::vector<bool> below = elements_below(*fem.water_in(stage), model.mesh);
    for (std::size_t e = 0; e < below.size(); ++e) {
        const auto region = static_cast<std::size_t>(model.mesh.region_of_element[e]);
        const bool changes = std::ranges::find(now.activates, region) != now.activates.end() ||
                             std::ranges::find(now.removes, region) != now.removes.end();
        if (!changes || !below[e]) continue;
        throw fault::BadInput("scene",
                              {{pointer,
                                "places or removes region '" + scene.section.regions[region].name +
                                    "', which holds water, without draining",
                                "do it in a static stage that drains, or draw the line below it"}});
    }
}

void hold_what_is_left(const scene::Scene& scene, std::size_t stage, Model& model) {
    const scene::Fem& fem = scene::fem_of(scene);
    const std::vector<bool> lonely = lonely_nodes(model);
    const std::string pointer = "/fem/stages/" + std::to_string(stage);
    std::vector<bool> released(fem.supports.size(), false);
    for (std::size_t s = 0; s <= stage; ++s)
        for (const std::size_t k : fem.stages[s].releases) released[k] = true;
    std::vector<bool> held(model.constraints.held.size(), false);
    for (std::size_t k = 0; k < fem.supports.size(); ++k) {
        const scene::Support& support = fem.supports[k];
        if (released[k]) continue;
        const std::size_t found = hold_nodes(support, model.mesh, lonely, held);
        if (found > 0 || fem.stages[stage].removes.empty()) continue;
        throw fault::BadInput(
            "scene",
            {{pointer + "/remove", "removes everything that support '" + support.name + "' holds",
              "release the support in this stage, or keep the region"}});
    }
    for (std::size_t i = 0; i < lonely.size(); ++i)
        // A node without soil has no stiffness: free, it would make the matrix singular.
        if (lonely[i]) held[2 * i] = held[2 * i + 1] = true;
    model.constraints.held = std::move(held);
}

/// Fixes the nodes displaced up to this stage, and sets the displacements of this one.
void displace(const scene::Fem& fem, std::size_t stage, Model& model) {
    const std::vector<bool> lonely = lonely_nodes(model);
    model.driven.clear();
    for (std::size_t s = 0; s <= stage; ++s) {
        for (std::size_t k = 0; k < fem.stages[s].displacements.size(); ++k) {
            const scene::Displacement& each = fem.stages[s].displacements[k];
            bool found = false;
            for (const std::size_t i : nodes_on(model.mesh, each.from, each.to)) {
                found = found || !lonely[i];
                for (const bool y : {false, true}) {
                    const auto& by = y ? each.y : each.x;
                    if (!by) continue;
                    // An edge stays where an earlier stage moved it.
                    model.constraints.held[2 * i + (y ? 1 : 0)] = true;
                    if (s == stage && !lonely[i])
                        model.driven.push_back(
                            {static_cast<Eigen::Index>(2 * i + (y ? 1 : 0)), *by});
                }
            }
            if (found || s < stage) continue;
            throw fault::BadInput(
                "scene", {{"/fem/stages/" + std::to_string(s) + "/displace/" + std::to_string(k),
                           "'" + each.name + "' holds no node of the soil that is there",
                           "let its segment run along an edge of a region"}});
        }
    }
}

/// Supports hold the body, and so do displaced edges.
void refuse_loose_body(std::size_t stage, const Model& model) {
    const std::vector<bool> lonely = lonely_nodes(model);
    bool holds[] = {false, false};
    for (std::size_t d = 0; d < model.constraints.held.size(); ++d)
        if (model.constraints.held[d] && !lonely[d / 2]) holds[d % 2] = true;
    if (holds[0] && holds[1]) return;
    throw fault::BadInput(
        "scene", {{"/fem/stages/" + std::to_string(stage),
                   std::string("leaves nothing that holds the body in ") + (holds[0] ? "y" : "x"),
                   "keep a support that fixes this direction, or displace an "
                   "edge in it"}});
}

/// Nodes with unknown pressure in undrained regions, except where they meet soil that drains. The
/// phreatic line is no boundary then.
void find_undrained(const scene::Fem& fem, std::size_t stage, Model& model) {
    model.undrained.clear();
    const auto& regions = fem.stages[stage].undrained;
    if (regions.empty()) return;
    model.undrained.resize(model.mesh.nodes.size(), false);
    // Twice: soil that drains takes back the nodes that it shares.
    for (const bool drains : {false, true}) {
        for (const PorousElement& each : model.water.elements) {
            const auto region =
                static_cast<std::size_t>(model.mesh.region_of_element[each.element]);
            if ((std::ranges::find(regions, region) == regions.end()) != drains) continue;
            for (const std::int32_t node : model.mesh.quads[each.element])
                model.undrained[node] = !drains;
        }
    }
    if (std::ranges::find(model.undrained, true) != model.undrained.end()) return;
    throw fault::BadInput("scene", {{"/fem/stages/" + std::to_string(stage) + "/undrained",
                                     "names regions without a node below the phreatic line that is "
                                     "not drained by its neighbours",
                                     "name regions with water in them, or leave it out"}});
}

void apply_pressures(const scene::Fem& fem, std::size_t stage, Model& model) {
    std::size_t from = 0;
    for (std::size_t s = 0; s <= stage; ++s)
        if (fem.stages[s].pressures) from = s;
    if (!fem.stages[from].pressures) return;
    for (std::size_t k = 0; k < fem.stages[from].pressures->size(); ++k) {
        const scene::EdgePressure& each = (*fem.stages[from].pressures)[k];
        if (add_edge_pressure(each, model) > 0) continue;
        throw fault::BadInput(
            "scene", {{"/fem/stages/" + std::to_string(from) + "/pressures/" + std::to_string(k),
                       "'" + each.name +
                           "' presses on no outer edge of the soil that is there in "
                           "stage " +
                           std::to_string(stage),
                       "let its segment run along the soil's outer edge"}});
    }
}

}  // namespace

std::vector<bool> lonely_nodes(const Model& model) {
    std::vector<bool> lonely(model.mesh.nodes.size(), true);
    for (std::size_t e = 0; e < model.mesh.quads.size(); ++e) {
        if (model.is_absent(e)) continue;
        for (const std::int32_t node : model.mesh.quads[e]) lonely[node] = false;
    }
    return lonely;
}

void set_stage(const scene::Scene& scene, const ModelDecisions& decided, std::size_t stage,
               Model& model) {
    const scene::Fem& fem = scene::fem_of(scene);
    const std::vector<bool> gone = elements_gone(scene, stage, model.mesh);
    model.absent.assign(gone.begin(), gone.end());
    ModelDecisions now = decided;
    now.water.value = fem.water_in(stage);
    for (std::size_t s = 0; s <= stage; ++s)
        if (const auto& loads = fem.stages[s].surcharge) now.surcharge.value = *loads;
    // Soil that is placed or removed below water changes the wet elements, even if no stage moves
    // water.
    const bool floods = floods_gaps(scene, model.mesh);
    if (fem.moves_the_water() || floods) model.water = ground_water(scene, *now.water.value, model);
    if (floods) refuse_wet_changes(scene, stage, model);
    hold_what_is_left(scene, stage, model);
    displace(fem, stage, model);
    refuse_loose_body(stage, model);
    find_undrained(fem, stage, model);
    double k_h = 0.0;
    for (std::size_t s = 0; s <= stage; ++s) k_h = fem.stages[s].seismic_coefficient.value_or(k_h);
    // Sets the external force anew, which the loads below are added to.
    set_weights(decided.gravity.value, k_h, model);
    add_ground_loads(now, model);
    apply_pressures(fem, stage, model);
}

void set_softening(const scene::Stage& stage, const Model& model,
                   std::vector<materials::Law>& laws) {
    for (std::size_t z = 0; z < laws.size(); ++z) {
        const auto region =
            static_cast<std::size_t>(model.mesh.region_of_element[model.zones[z].first]);
        const bool undrained = stage.kind == scene::StageKind::dynamic ||
                               std::ranges::find(stage.undrained, region) != stage.undrained.end();
        if (region < stage.S_of_region.size() && stage.S_of_region[region]) {
            laws[z] = materials::with_S(laws[z], *stage.S_of_region[region]);
            continue;
        }
        const bool asked = stage.S && (undrained || stage.undrained.empty());
        if (asked) laws[z] = materials::with_S(laws[z], *stage.S);
        if (!asked && !undrained) laws[z] = materials::with_S(laws[z], 0.0);
    }
}

void forget_absent(const Model& model, Motion& motion) {
    for (std::size_t e = 0; e < model.mesh.quads.size(); ++e) {
        if (!model.is_absent(e)) continue;
        for (std::size_t p = e * model.points_per_element; p < (e + 1) * model.points_per_element;
             ++p) {
            motion.points[p] = {Voigt::Zero(), 0.0};
            motion.strain[p].setZero();
        }
        if (motion.hourglass.empty()) continue;
        motion.hourglass[e].force.setZero();
        motion.hourglass[e].energy = 0.0;
    }
    // A dof attached to the moving base stays attached.
    const std::vector<std::int32_t> of_dof = model.unknowns(Solved::motion_and_pressure).of_dof;
    const std::vector<bool> lonely = lonely_nodes(model);
    for (std::size_t d = 0; d < of_dof.size(); ++d) {
        if (!lonely[d / 2] || of_dof[d] >= 0) continue;
        motion.v[static_cast<Eigen::Index>(d)] = motion.a[static_cast<Eigen::Index>(d)] = 0.0;
    }
}

}  // namespace breach::fem
