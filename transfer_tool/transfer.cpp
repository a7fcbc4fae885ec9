// The method on one screen. The order is part of it: soils decide which stress points carry, the
// stress and the softening decide the yield surface, the stress after the return decides V_0, and
// the ledger compares what is left.
#include "transfer_tool/transfer.hpp"

#include <algorithm>
#include <utility>

#include "core/fault/fault.hpp"

namespace breach::transfer {
namespace {

Sampling sampling_of(const std::vector<Corners>& shapes, const scene::Scene& scene) {
    const scene::Transfer& settings = scene::transfer_of(scene);
    if (!settings.points_per_cell)
        return equal_numbers(shapes.size(), settings.points_per_direction);
    const scene::Mpm& mpm = scene::mpm_of(scene);
    return sampling_for_cells(shapes, {.cell_size = mpm.cell_size,
                                       .origin = {mpm.domain_x[0], mpm.floor.level},
                                       .points_per_cell = *settings.points_per_cell,
                                       .least_per_direction = settings.points_per_direction,
                                       .shift = settings.point_shift});
}

std::map<std::string, double> liquefied_shares(const SoilMap& map,
                                               const exchange::MeshSnapshot& mesh,
                                               const Points& points) {
    std::map<std::string, double> all, liquefied;
    for (std::size_t e = 0; e + 1 < points.first.size(); ++e)
        for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p) {
            const auto has = map.liquefied_at(e, points.xi[p]);
            if (!has) continue;
            const std::string& region = mesh.regions[mesh.region_of_element[e]];
            all[region] += points.state.mass[p];
            liquefied[region] += *has ? points.state.mass[p] : 0.0;
        }
    for (auto& [region, mass] : liquefied) mass /= all[region];
    return liquefied;
}

std::optional<LiquefactionReport> liquefaction_of(const SoilMap& map,
                                                  const exchange::MeshSnapshot& mesh,
                                                  const Points& points,
                                                  scene::LiquefiedWhen asked) {
    LiquefactionReport report{liquefied_shares(map, mesh, points), std::nullopt};
    if (report.share.empty()) return std::nullopt;
    if (map.columns()) {
        const liquefied::LiquefiedZone& zone = *map.columns();
        const scene::LiquefiedWhen when =
            mesh.excess_pressure_max.empty() ? scene::LiquefiedWhen::at_transfer : asked;
        report.columns = {when, zone.liquefied_nodes(), zone.deepest_level(), zone.closed_width(),
                          zone.gaps()};
    }
    return report;
}

}  // namespace

std::optional<Transferred> transfer(const exchange::MeshSnapshot& mesh, const scene::Scene& scene,
                                    const Work& work, const std::string& file) {
    const scene::Transfer& settings = scene::transfer_of(scene);
    const SoilMap map(mesh, scene, file);
    const std::vector<materials::Law> laws = laws_of(map.soils());
    Transferred t;

    Shapes shapes = shapes_of_elements(mesh, settings.entangled, file);
    t.rebuilt = std::move(shapes.rebuilt);
    const Sampling sampling = sampling_of(shapes.corners, scene);
    t.supply = sampling.supply;
    Points points = place_points(mesh, std::move(shapes.corners), sampling, settings.point_shift);
    carry_nodal_fields(mesh, points);
    const auto gauss_fields = carry_gauss_fields(mesh, settings, work, points);
    if (!gauss_fields) return std::nullopt;
    t.gauss_fields = *gauss_fields;

    assign_soils(map, points);
    settle_stress(map, points);
    if (settings.sigma_zz == scene::OutOfPlaneStress::zero)
        // Before the return, which then counts what this leaves outside the yield surface.
        for (mechanics::Voigt& stress : points.state.stress) stress[2] = 0.0;
    start_softening(laws, points.state);
    start_at_state(map, points);
    t.yield = return_to_yield_surface(laws, points.state);
    find_reference_volumes(laws, points.state);

    t.ledger = ledger_of(mesh, points, map, scene, file);
    t.soils = map.soils();
    t.shares = shares_of_soils(map, points.state);
    t.softening = softening_of(laws, points.state);
    if (settings.liquefied)
        t.liquefaction = liquefaction_of(map, mesh, points, settings.liquefied->when);
    t.collapse = collapse_report(map, points);
    t.state = std::move(points.state);
    // For /mpm/shaking: the runout's ground moves on with it.
    t.state.base_motion = mesh.base_motion;
    t.state.steady_pressure = map.steady_pressure();
    if (settings.base_displacement == scene::BaseDisplacement::subtracted) {
        // After the ledger, which compares with the mesh where it is.
        t.base_displacement = liquefied::displacement_of_base(mesh);
        for (mechanics::Vec2& place : t.state.position) place.x() -= t.base_displacement;
    }
    return t;
}

}  // namespace breach::transfer
