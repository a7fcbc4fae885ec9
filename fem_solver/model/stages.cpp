#include "fem_solver/model/stages.hpp"

#include "fem_solver/model/build_model.hpp"
#include "fem_solver/model/ground.hpp"

namespace breach::fem {
namespace {

/// [regions] not there in this stage: yet to be placed, or removed.
std::vector<bool> regions_gone(const scene::Scene& scene, std::size_t stage) {
    const auto& stages = scene::fem_of(scene).stages;
    std::vector<bool> gone(scene.section.regions.size(), false);
    for (const scene::Stage& each : stages)
        for (const std::size_t r : each.activates) gone[r] = true;
    for (std::size_t s = 0; s <= stage; ++s) {
        for (const std::size_t r : stages[s].activates) gone[r] = false;
        for (const std::size_t r : stages[s].removes) gone[r] = true;
    }
    return gone;
}

/// [nodes] of no element that is there.
std::vector<bool> lonely_nodes(const Model& model) {
    std::vector<bool> lonely(model.mesh.nodes.size(), true);
    for (std::size_t e = 0; e < model.mesh.quads.size(); ++e) {
        if (model.is_absent(e)) continue;
        for (const std::int32_t node : model.mesh.quads[e]) lonely[node] = false;
    }
    return lonely;
}

/// Water does not come and go with soil: what is placed or removed must be above it.
void refuse_wet(const scene::Scene& scene, const Model& model) {
    if (!model.water.any()) return;
    for (std::size_t e = 0; e < model.mesh.quads.size(); ++e) {
        if (!model.is_absent(e)) continue;
        for (const std::int32_t node : model.mesh.quads[e]) {
            if (!model.water.is_unknown[node] && model.water.prescribed[node] <= 0.0) continue;
            const auto& region = scene.section.regions[model.mesh.region_of_element[e]];
            throw fault::BadInput(
                "scene",
                {{"/fem/stages",
                  "region '" + region.name + "' is placed or removed, and water stands in it",
                  "draw /fem/water/line below it, or keep it for the whole run"}});
        }
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
    bool holds_x = false, holds_y = false;
    for (std::size_t k = 0; k < fem.supports.size(); ++k) {
        const scene::Support& support = fem.supports[k];
        if (released[k]) continue;
        const std::size_t found = hold_nodes(support, model.mesh, lonely, held);
        holds_x = holds_x || (found > 0 && support.fixes_x);
        holds_y = holds_y || (found > 0 && support.fixes_y);
        if (found > 0 || fem.stages[stage].removes.empty()) continue;
        throw fault::BadInput("scene", {{pointer + "/remove",
                                         "takes away all that support '" + support.name + "' holds",
                                         "release the support in this stage, or keep the region"}});
    }
    if (!holds_x || !holds_y)
        throw fault::BadInput("scene", {{pointer,
                                         std::string("leaves nothing that holds the body in ") +
                                             (holds_x ? "y" : "x"),
                                         "keep a support that fixes this direction"}});
    for (std::size_t i = 0; i < lonely.size(); ++i)
        if (lonely[i]) held[2 * i] = held[2 * i + 1] = true;
    model.constraints.held = std::move(held);
}

}  // namespace

void set_stage(const scene::Scene& scene, const ModelDecisions& decided, std::size_t stage,
               Model& model) {
    const std::vector<bool> gone = regions_gone(scene, stage);
    model.absent.assign(model.mesh.quads.size(), 0);
    for (std::size_t e = 0; e < model.absent.size(); ++e)
        model.absent[e] = gone[model.mesh.region_of_element[e]] ? 1 : 0;
    refuse_wet(scene, model);
    hold_what_is_left(scene, stage, model);
    set_weights(decided.gravity.value, model);
    ModelDecisions now = decided;
    for (std::size_t s = 0; s <= stage; ++s)
        if (const auto& loads = scene::fem_of(scene).stages[s].surcharge)
            now.surcharge.value = *loads;
    add_ground_loads(now, model);
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
}

}  // namespace breach::fem
