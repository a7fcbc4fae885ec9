// From the scene's lines and boundaries to wet elements and prescribed pressures, of which
// pore_water.cpp makes the operators.
#include "fem_solver/model/ground_water.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/words/remedy.hpp"
#include "fem_solver/model/ground.hpp"
#include "fem_solver/model/pore_water.hpp"

namespace breach::fem {
namespace {

using scene::AboveWater;
using scene::GroundWater;

constexpr double free_drainage = 1.0;  // hydraulic conductivity [m/s]

const scene::Material& material_of(const scene::Scene& scene, const Model& model,
                                   const Zone& zone) {
    return scene.material_of(model.mesh.region_of_element[zone.first]);
}

/// Depth of each node below the phreatic line [m]: 0 within `tolerance`, negative above.
std::vector<double> depths_below(const GroundWater& water, const Mesh& mesh, double tolerance) {
    std::vector<double> depth;
    for (const Vec2& x : mesh.nodes) {
        const double below = level_at(water.line, x.x()) - x.y();
        depth.push_back(std::abs(below) <= tolerance ? 0.0 : below);
    }
    return depth;
}

/// Includes absent elements.
std::vector<bool> wet_elements(const Mesh& mesh, const std::vector<double>& depth) {
    std::vector<bool> wet(mesh.quads.size(), false);
    for (std::size_t e = 0; e < wet.size(); ++e)
        for (const std::int32_t node : mesh.quads[e]) wet[e] = wet[e] || depth[node] > 0.0;
    return wet;
}

/// No flow in a dry element; with AboveWater::dry also in one whose centre is above the line.
bool stands_still(const GroundWater& water, const Mesh& mesh, std::size_t element,
                  const std::vector<bool>& wet) {
    if (!wet[element] || water.above != AboveWater::dry) return !wet[element];
    const Vec2 centre = corners_of(mesh, element).rowwise().mean();
    return centre.y() >= level_at(water.line, centre.x());
}

void prescribe_boundaries(const GroundWater& water, const Mesh& mesh, double tolerance,
                          double weight, std::vector<std::optional<double>>& prescribed) {
    std::vector<fault::Fault> faults;
    for (std::size_t b = 0; b < water.boundaries.size(); ++b) {
        const scene::PressureBoundary& boundary = water.boundaries[b];
        bool found = false;
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
            const Vec2& x = mesh.nodes[i];
            if (geometry::distance_to_segment(x, boundary.from, boundary.to) > tolerance) continue;
            found = true;
            const double p = boundary.level ? weight * std::max(0.0, *boundary.level - x.y()) : 0.0;
            // A drained boundary does not overwrite the negative values above the line.
            if (p > 0.0 || !prescribed[i] || *prescribed[i] > 0.0) prescribed[i] = p;
        }
        if (found) continue;
        faults.push_back({"/fem/water/boundaries/" + std::to_string(b),
                          "boundary '" + boundary.name + "' holds no node of the mesh",
                          "let its segment run along an edge of a region"});
    }
    if (!faults.empty()) throw fault::BadInput("scene", std::move(faults));
}

/// p = 0 on the line, and above it values that make it 0 there; the pond's pressure on submerged
/// ground; the hydrostatic pressure between wet and dry elements.
std::vector<std::optional<double>> prescribed_pressures(
    const scene::Scene& scene, const GroundWater& water, const Model& model,
    const std::vector<double>& depth, const std::vector<bool>& wet, double tolerance) {
    const double weight = water.density * scene.gravity;
    std::vector<std::optional<double>> prescribed(depth.size());
    std::vector<bool> meets_dry(depth.size(), false);
    for (std::size_t e = 0; e < wet.size(); ++e) {
        if (!stands_still(water, model.mesh, e, wet)) continue;
        for (const std::int32_t node : model.mesh.quads[e]) meets_dry[node] = true;
    }
    for (std::size_t i = 0; i < depth.size(); ++i) {
        // Negative above the line: the interpolation in a cut element is then 0 on the line, on any
        // mesh.
        if (depth[i] <= 0.0 || meets_dry[i]) prescribed[i] = weight * depth[i];
    }
    for (const GroundEdge& edge : ground_edges(model)) {
        for (const std::int32_t node : {edge.a, edge.b}) {
            if (depth[node] > 0.0) prescribed[node] = weight * depth[node];
        }
    }
    prescribe_boundaries(water, model.mesh, tolerance, weight, prescribed);
    for (std::size_t i = 0; i < prescribed.size(); ++i) {
        // Both sides of a column have one pressure, and one prescription.
        const std::int32_t master = model.constraints.pressure_master[i];
        if (static_cast<std::size_t>(master) != i) prescribed[i] = prescribed[master];
    }
    return prescribed;
}

/// One per zone with a wet element.
std::vector<std::optional<Fluid>> fluids_of(const scene::Scene& scene, const GroundWater& water,
                                            const Model& model, const std::vector<bool>& wet) {
    std::vector<std::optional<Fluid>> fluids(model.zones.size());
    std::vector<fault::Fault> faults;
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        const Zone& zone = model.zones[z];
        bool any = false;
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) any = any || wet[e];
        // Only wet soil needs a void ratio and a permeability.
        if (!any) continue;
        const scene::Material& material = material_of(scene, model, zone);
        if (!material.void_ratio || !material.permeability) {
            faults.push_back({"/materials/" + material.name,
                              "lies below the phreatic line and lacks void_ratio or permeability",
                              "give both, or leave out /fem/water"});
            continue;
        }
        // Without mobility: each stage sets its own (set_permeability), an undrained one none.
        fluids[z] = Fluid{.bulk_modulus = water.bulk_modulus,
                          .density = water.density,
                          .mobility = Vec2::Zero(),
                          .porosity = *material.void_ratio / (1.0 + *material.void_ratio),
                          .stabilisation = water.pressure_stabilisation,
                          .integration = water.pressure_integration};
    }
    if (!faults.empty()) throw fault::BadInput("scene", std::move(faults));
    return fluids;
}

/// Unit weight of water that converts hydraulic conductivity to mobility; standard gravity if the
/// scene has none [N/m3].
double unit_weight(const scene::Scene& scene) {
    constexpr double standard_gravity = 9.80665;
    const double g = scene.gravity > 0.0 ? scene.gravity : standard_gravity;
    return scene::fem_of(scene).water->density * g;
}

}  // namespace

std::vector<bool> elements_below(const GroundWater& water, const Mesh& mesh) {
    const double tolerance = 1e-6 * quality_of(mesh).shortest_edge;
    return wet_elements(mesh, depths_below(water, mesh, tolerance));
}

std::string seepage_remedy(const scene::Scene& scene, std::size_t stage) {
    const scene::Fem& fem = scene::fem_of(scene);
    const auto water = fem.water_in(stage);
    if (!water || !water->boundaries.empty()) return "";
    const auto level = [](const Vec2& each) { return each.y(); };
    const auto [lowest, highest] = std::ranges::minmax(water->line, {}, level);
    if (highest.y() - lowest.y() <= 0.0) return "";
    const auto [low, high] = geometry::extent(scene.section);
    const double tolerance = 1e-9 * (high.x() - low.x());
    nlohmann::json boundaries = nlohmann::json::array();
    for (const double x : {low.x(), high.x()}) {
        const auto side = geometry::upright_at(scene.section, x, tolerance);
        const double head = geometry::level_at(water->line, x);
        if (!side.unbroken || head <= side.low) continue;
        boundaries.push_back({{"name", x == low.x() ? "left" : "right"},
                              {"from", {x, side.low}},
                              {"to", {x, std::min(side.high, head)}},
                              {"level", head}});
    }
    const std::string gives =
        boundaries.empty() ? "give /fem/water/boundaries the segments where water enters and leaves"
                           : words::set("/fem/water/boundaries", boundaries.dump());
    return "; or let water flow, because the phreatic line slopes and the pressure of water at "
           "rest below it pushes the soil sideways: " +
           gives +
           ", and \"permeability\": \"scene\" in the static stages where the permeability of the "
           "soils matters";
}

PoreWater ground_water(const scene::Scene& scene, const GroundWater& water, const Model& model) {
    const double tolerance = 1e-6 * quality_of(model.mesh).shortest_edge;
    std::vector<double> depth = depths_below(water, model.mesh, tolerance);
    for (std::size_t i = 0; i < depth.size(); ++i)
        depth[i] = depth[model.constraints.pressure_master[i]];
    std::vector<bool> wet = wet_elements(model.mesh, depth);
    for (std::size_t e = 0; e < wet.size(); ++e) wet[e] = wet[e] && !model.is_absent(e);
    auto fluids = fluids_of(scene, water, model, wet);
    auto prescribed = prescribed_pressures(scene, water, model, depth, wet, tolerance);
    return build_pore_water(model, {.fluids = std::move(fluids),
                                    .wet = std::move(wet),
                                    .prescribed = std::move(prescribed),
                                    .body = Vec2(0.0, -scene.gravity),
                                    .depth = std::move(depth),
                                    .rests_as_drawn = water.boundaries.empty()});
}

void set_permeability(const scene::Scene& scene, scene::StagePermeability permeability,
                      Model& model) {
    if (!model.water.any()) return;
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        auto& fluid = model.water.fluids[z];
        if (!fluid) continue;
        Vec2 conductivity = Vec2::Constant(free_drainage);
        if (permeability == scene::StagePermeability::scene) {
            const auto& own = *material_of(scene, model, model.zones[z]).permeability;
            conductivity = Vec2(own[0], own[1]);
        }
        fluid->mobility = conductivity / unit_weight(scene);
    }
    evaluate_pore_water(model, model.water);
}

void close_to_flow(Model& model) {
    for (auto& fluid : model.water.fluids)
        if (fluid) fluid->mobility.setZero();
    evaluate_pore_water(model, model.water);
}

}  // namespace breach::fem
