// Converts a FEM snapshot to material points, step by step, without files.
// Called by run.cpp, tests and benchmarks. Docs: docs/reference/methods/transfer.md, *Steps*.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "transfer_tool/gauss_fields.hpp"
#include "transfer_tool/laws.hpp"
#include "transfer_tool/ledger.hpp"
#include "transfer_tool/points.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {

/// By columns only.
struct LiquefiedColumns {
    scene::LiquefiedWhen when;  ///< at_transfer too if the snapshot has no earlier maximum
    std::size_t nodes;          ///< liquefied
    double deepest_level;       ///< of the liquefied nodes, undeformed [m]; +infinity: none
    double closed_width;        ///< of walls that were too narrow [m]
    std::vector<LiquefiedGap> gaps;
};

struct LiquefactionReport {
    std::map<std::string, double> share;  ///< of the mass of each region that can liquefy [-]
    std::optional<LiquefiedColumns> columns;
};

struct Transferred {
    exchange::ParticleState state;
    exchange::Ledger ledger;
    std::vector<RebuiltElement> rebuilt;
    std::optional<CellSupply> supply;
    std::vector<SoilOfPoints> soils;
    std::vector<SoilShare> shares;
    std::vector<SofteningShare> softening;
    std::optional<LiquefactionReport> liquefaction;
    std::optional<CollapseReport> collapse;
    GaussFieldReport gauss_fields;
    YieldReport yield;
    double base_displacement = 0.0;  ///< subtracted [m]
};

/// `file`: for messages. None if stopped by the watch. Throws Breakdown if the mesh is entangled,
/// BadInput if mesh and scene do not match. The caller checks the ledger (refuse_losses).
std::optional<Transferred> transfer(const exchange::MeshSnapshot& mesh, const scene::Scene& scene,
                                    const Work& work, const std::string& file);

}  // namespace breach::transfer
