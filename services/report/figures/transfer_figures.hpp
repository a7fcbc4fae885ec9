// Figures of transfer_tool: vertical effective stress, pore pressure ratio and liquefied layers on
// the mesh (before) and on the points (after), with the same colours.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "services/report/chart/figure.hpp"

namespace breach::report {

/// Layers by initial vertical effective stress.
struct LayerColours {
    double r_u = 0.7;                    ///< liquefied above this
    bool ever = false;                   ///< at any time so far; else at the transfer
    std::vector<double> ends;            ///< of each layer [Pa]
    std::vector<std::string> materials;  ///< of each layer
};

/// The layers of a completed scene; empty when nothing liquefies in it. Throws nlohmann's exception
/// for an incomplete scene.
LayerColours layers_of(const nlohmann::json& scene);

/// A pair of figures: before and after.
struct BeforeAndAfter {
    Figure before;
    Figure after;
};

/// sigma'_v always; r_u where the points have it; layers where there are any. On the mesh, layers
/// are elements with mean r_u above the threshold, by their initial stress. On the points, layers
/// are the materials after the transfer, which also cover soil above such elements.
std::vector<BeforeAndAfter> compare(const exchange::MeshSnapshot& mesh,
                                    const exchange::ParticleState& points,
                                    const LayerColours& layers);

/// All pairs in one SVG, before on the left and after on the right.
std::string side_by_side(const std::vector<BeforeAndAfter>& pairs);

/// Writes each figure, and all of them as before_and_after.svg. folder: contains particles.vtkhdf
/// and scene.completed.json. The snapshot is looked up at its recorded path, else beside the
/// particles. Throws IoError or BadInput.
void write_transfer_figures(const std::filesystem::path& folder,
                            const std::filesystem::path& output);

}  // namespace breach::report
