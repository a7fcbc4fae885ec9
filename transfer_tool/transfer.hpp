// From a FEM snapshot to material points: the verbs in order. No files here.
#pragma once

#include "transfer_tool/gauss_fields.hpp"
#include "transfer_tool/laws.hpp"
#include "transfer_tool/ledger.hpp"
#include "transfer_tool/points.hpp"

namespace breach::transfer {

struct Transferred {
    exchange::ParticleState state;
    exchange::Ledger ledger;
    GaussFieldReport gauss_fields;
    YieldReport yield;
};

/// `file` is named in messages. Throws Breakdown when the mesh is entangled, BadInput when mesh and
/// scene do not belong together. Whether the ledger is good enough is the caller's question
/// (refuse_losses).
Transferred transfer(const exchange::MeshSnapshot& mesh, const scene::Scene& scene, int threads,
                     const std::string& file);

}  // namespace breach::transfer
