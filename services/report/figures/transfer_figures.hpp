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
    bool ever = false;                   ///< at any time before; else at that of the transfer
    std::vector<double> ends;            ///< of each layer [Pa]
    std::vector<std::string> materials;  ///< of each layer
};

/// Those of a completed scene; none when nothing liquefies in it. Throws nlohmann's exception when
/// the scene is not whole.
LayerColours layers_of(const nlohmann::json& scene);

/// A pair of figures: before and after.
struct BeforeAndAfter {
    Figure before;
    Figure after;
};

/// sigma'_v always; r_u where the points have it; layers where there are any. The mesh shows the
/// FEM's result: elements with mean r_u above the threshold, by their initial stress. The points
/// show the materials after the transfer: including soil above such elements.
std::vector<BeforeAndAfter> compare(const exchange::MeshSnapshot& mesh,
                                    const exchange::ParticleState& points,
                                    const LayerColours& layers);

/// All pairs in one SVG, before on the left and after on the right.
std::string side_by_side(const std::vector<BeforeAndAfter>& pairs);

/// Writes each figure, and all of them as before_and_after.svg. folder: holds particles.vtkhdf and
/// scene.completed.json; the snapshot is the file that the particles were made from, where it was,
/// or beside them. Throws IoError or BadInput.
void write_transfer_figures(const std::filesystem::path& folder,
                            const std::filesystem::path& output);

}  // namespace breach::report
