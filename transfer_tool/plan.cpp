// --plan: which steps of the transfer this scene uses, and why. It knows the scene only: what a
// snapshot adds (water, other Gauss points) is said as such.
#include <algorithm>

#include "core/words/number.hpp"
#include "transfer_tool/run.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {
namespace {

using process::PlanLine;
using process::Use;

std::vector<const scene::Material*> materials_of_points(const scene::Scene& scene) {
    std::vector<const scene::Material*> materials;
    for (const scene::Soil& soil : scene::soils_of(scene)) {
        const scene::Material* material = &scene.materials[soil.material];
        if (materials::is_for_particles(material->law) &&
            std::ranges::find(materials, material) == materials.end())
            materials.push_back(material);
    }
    return materials;
}

bool yields(const scene::Material* material) { return materials::traits(material->law).yields; }

bool softens(const scene::Material* material) {
    return materials::softening(material->law) != nullptr;
}

/// "Mohr-Coulomb, ...": the laws that yield, each once.
std::string names_of_yielding(const scene::Scene& scene) {
    std::string names;
    for (const scene::Material* material : materials_of_points(scene)) {
        const std::string name = materials::traits(material->law).name;
        if (!yields(material) || names.find(name) != std::string::npos) continue;
        names += (names.empty() ? "" : ", ") + name;
    }
    return names;
}

PlanLine stress_line(const scene::Scene& scene) {
    if (scene.mpm && scene.mpm->water)
        return {"pore pressure", Use::on,
                "all points get sigma' + (p - u) I with the pressure p of still water",
                "/mpm/water"};
    const bool wet = scene.fem && scene.fem->water;
    if (!wet)
        return {"pore pressure", Use::left_out,
                "the scene's FEM has no water; a snapshot with water is carried all the same",
                "/fem/water"};
    const auto stays_effective = [&](const scene::Material* material) {
        return liquefied::measure_for(material->law, scene) == exchange::StressMeasure::effective;
    };
    if (std::ranges::none_of(materials_of_points(scene), stays_effective))
        return {"pore pressure", Use::on, "all points get the total stress sigma' - u I",
                "/transfer/stress"};
    return {"pore pressure", Use::on,
            "frictional materials keep the effective stress beside u, all others get the total one",
            "/transfer/stress"};
}

PlanLine cells_line(const scene::Transfer& settings) {
    if (!settings.points_per_cell)
        return {"points for the MPM's cells", Use::left_out,
                "every element gets its points per direction", "/transfer/points_per_cell"};
    return {
        "points for the MPM's cells", Use::on,
        std::to_string(*settings.points_per_cell) + " in a filled cell on the mean, half in each",
        "/transfer/points_per_cell"};
}

PlanLine collapse_line(const scene::Scene& scene) {
    if (!liquefied::judged_by(scene).state)
        return {"strengths of NorSand", Use::left_out, "no region of it is to liquefy",
                "/transfer/liquefied/regions"};
    return {"strengths of NorSand", Use::on,
            "wet points by stress and psi; residual where past the instability line and strained",
            "/transfer/liquefied/regions"};
}

PlanLine liquefied_line(const scene::Scene& scene, const scene::Transfer& settings) {
    if (!liquefied::judged_by(scene).pressure)
        return {"liquefied layers", Use::left_out, "the scene names none", "/transfer/liquefied"};
    if (settings.liquefied->by == scene::LiquefiedBy::point)
        return {"liquefied layers", Use::on,
                "each point below the water table by the largest r_u" +
                    std::string(settings.liquefied->shear_strain ? " or shear strain" : "") +
                    " of its Gauss point",
                "/transfer/liquefied/by"};
    if (settings.liquefied->layers.empty())
        return {"liquefied layers", Use::on,
                "each point above the deepest liquefied node at its own residual strength",
                "/transfer/liquefied"};
    const scene::LiquefiedZone& zone = *settings.liquefied;
    std::string reason =
        std::to_string(zone.layers.size()) + " layers above the deepest node with r_u > " +
        words::text_of(zone.r_u) +
        (zone.when == scene::LiquefiedWhen::ever ? ", at t_T or before" : ", at t_T");
    if (zone.narrowest_wall > 0.0)
        reason += "; walls narrower than " + words::text_of(zone.narrowest_wall) + " m count too";
    return {"liquefied layers", Use::on, reason, "/transfer/liquefied"};
}

PlanLine entangled_line(const scene::Transfer& settings) {
    if (settings.entangled == scene::Entangled::refuse)
        return {"rebuilding of inverted elements", Use::left_out, "they end the transfer",
                "/transfer/entangled"};
    return {"rebuilding of inverted elements", Use::on, "from their undistorted shape",
            "/transfer/entangled"};
}

PlanLine balance_line(const scene::Scene& scene) {
    return {"out-of-balance force", scene.mpm ? Use::on : Use::left_out,
            scene.mpm ? "of the points on the MPM's grid" : "the scene has no MPM grid", "/mpm"};
}

PlanLine interpolation_line(const scene::Transfer& settings) {
    if (settings.interpolation == scene::Interpolation::paper)
        return {"interpolation across region borders", Use::on,
                "\"paper\": one multiquadric through all Gauss points", "/transfer/interpolation"};
    return {"interpolation across region borders", Use::left_out,
            "\"local\": the " + std::to_string(settings.neighbours) +
                " nearest Gauss points of the same region",
            "/transfer/interpolation"};
}

PlanLine gauss_line(const scene::Transfer& settings) {
    const bool moved = settings.point_shift != std::array<double, 2>{};
    // Points on Gauss points take their values (gauss_fields.cpp); "paper" interpolates all the
    // same.
    const bool same = settings.interpolation == scene::Interpolation::local &&
                      settings.points_per_direction == 2 && !settings.points_per_cell && !moved;
    if (same)
        return {"radial basis functions", Use::left_out,
                "2 points per direction take the values of 2 x 2 Gauss points that lie there; a "
                "FEM with "
                "other Gauss points is interpolated",
                "/transfer/points_per_direction"};
    return {"radial basis functions", Use::on,
            std::to_string(settings.points_per_direction) + " points per direction" +
                (moved ? ", moved off the Gauss points" : ""),
            moved ? "/transfer/point_shift" : "/transfer/points_per_direction"};
}

PlanLine softening_line(const scene::Scene& scene) {
    if (std::ranges::none_of(materials_of_points(scene), softens))
        return {"softening carried over", Use::left_out, "no material softens", "/materials"};
    return {"softening carried over", Use::on, "the FEM's epsilon_q goes on", "/materials"};
}

}  // namespace

process::Plan plan(const scene::Scene& scene) {
    const scene::Transfer& settings = scene::transfer_of(scene);
    const std::string yielding = names_of_yielding(scene);
    return {{"return to the yield surface", yielding.empty() ? Use::left_out : Use::on,
             yielding.empty() ? "all materials are elastic" : "of " + yielding, "/materials"},
            softening_line(scene),
            gauss_line(settings),
            interpolation_line(settings),
            stress_line(scene),
            liquefied_line(scene, settings),
            collapse_line(scene),
            cells_line(settings),
            entangled_line(settings),
            balance_line(scene)};
}

}  // namespace breach::transfer
