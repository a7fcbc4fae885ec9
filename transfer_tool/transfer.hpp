// Converts a FEM snapshot to material points: the steps in order. No files here.
#pragma once

#include <optional>

#include "transfer_tool/gauss_fields.hpp"
#include "transfer_tool/laws.hpp"
#include "transfer_tool/ledger.hpp"
#include "transfer_tool/points.hpp"
#include "transfer_tool/soils.hpp"

namespace breach::transfer {

/// The liquefied zone of a transfer.
struct LiquefactionReport {
    scene::LiquefiedWhen when;  ///< at_transfer too if the snapshot stores no earlier maximum
    std::size_t nodes;          ///< liquefied
    double deepest_level;       ///< of them, undeformed [m]; +infinity: none
    double closed_width;        ///< of walls too narrow to stay [m]
    std::vector<LiquefiedGap> gaps;
};

/// Points outside /transfer/keep.
struct LeftOut {
    std::size_t points = 0;
    double mass = 0.0;               ///< [kg]
    double largest_epsilon_q = 0.0;  ///< [-]
    mechanics::Vec2 place{};         ///< of the most strained [m]
};

/// Throws BadInput if a failing part is left out.
void refuse_cut(const LeftOut& out);

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
    std::optional<RoundTrip> round_trip;
    double base_displacement = 0.0;  ///< that was subtracted [m]
    std::optional<LeftOut> left_out;
};

/// `file` is named in messages. Nothing: the watch stopped it. Throws Breakdown when the mesh is
/// entangled, BadInput when mesh and scene do not fit. The caller checks the ledger
/// (refuse_losses).
std::optional<Transferred> transfer(const exchange::MeshSnapshot& mesh, const scene::Scene& scene,
                                    const Work& work, const std::string& file);

}  // namespace breach::transfer
