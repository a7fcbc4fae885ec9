// From the scene's words to what the model is made of: each choice once. The model is built from
// the values, the plan prints the lines.
#pragma once

#include "core/process/plan.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// How hourglass modes are held; none: the element has none.
using ElementChoice = std::optional<HourglassModulus>;

/// Where a value is a part of the scene, its absence leaves it out.
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
