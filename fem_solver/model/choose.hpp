// Decides the parts of the model from the scene, each choice once. The model is built from the
// values, the plan prints the lines.
#pragma once

#include "core/process/plan.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Hourglass control; none: the element has none.
using ElementChoice = std::optional<HourglassModulus>;

/// A decision without a value leaves that part of the model out.
struct ModelDecisions {
    process::Decided<double> gravity;  ///< [m/s2]
    process::Decided<scene::Kinematics> kinematics;
    process::Decided<ElementChoice> element;  ///< single-point quads, or 2 x 2 mean dilatation
    process::Decided<Rayleigh> damping;
    process::Decided<std::optional<scene::GroundWater>> water;
    process::Decided<std::optional<scene::ElasticBase>> base;
    process::Decided<std::optional<scene::BaseMotion>> motion;
    process::Decided<std::optional<scene::FreeField>> free_field;
    process::Decided<std::vector<scene::Surcharge>> surcharge;
};

ModelDecisions decide_model(const scene::Scene& scene);

}  // namespace breach::fem
