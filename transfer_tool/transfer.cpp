#include "transfer_tool/transfer.hpp"

#include <utility>

namespace breach::transfer {
namespace {

void refuse_water(const exchange::MeshSnapshot& mesh, const std::string& file) {
    if (mesh.pore_pressure.empty()) return;
    throw fault::BadInput(file, {{"/VTKHDF/PointData/pore_pressure",
                                  "material points of this version carry no pore pressure",
                                  "give a snapshot of a dry or drained scene"}});
}

}  // namespace

Transferred transfer(const exchange::MeshSnapshot& mesh, const scene::Scene& scene, int threads,
                     const std::string& file) {
    const scene::Transfer& settings = scene::transfer_of(scene);
    const std::vector<materials::Law> laws = laws_of_regions(mesh, scene, file);
    refuse_water(mesh, file);
    refuse_entangled(mesh, file);

    Points points = place_points(mesh, settings.points_per_direction);
    carry_nodal_fields(mesh, points);
    const GaussFieldReport gauss_fields = carry_gauss_fields(mesh, settings, threads, points);
    start_softening(settings.softening_start, points.state);
    const YieldReport yield = return_to_yield_surface(laws, points.state);
    find_reference_volumes(laws, points.state);
    exchange::Ledger ledger = ledger_of(mesh, points.state, laws, scene.gravity, file);
    return {std::move(points.state), std::move(ledger), gauss_fields, yield};
}

}  // namespace breach::transfer
