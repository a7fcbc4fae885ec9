// Decides the parts of the model from the scene. The model is built from the values, the plan
// prints the lines.
// Called by build_model, and again for each stage that changes the body (stages.hpp).
#pragma once

#include "core/process/plan.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Hourglass control of the single-point quad; none: 2 x 2 Gauss points.
using ElementChoice = std::optional<HourglassModulus>;

/// A part without a value is not in the model.
struct ModelDecisions {
    process::Decided<double> gravity;  ///< [m/s2]
    /// single-point quad, or 2 x 2 points with mean dilatation
    process::Decided<ElementChoice> element;
    process::Decided<Rayleigh> damping;
    process::Decided<std::optional<scene::GroundWater>> water;
    process::Decided<std::optional<scene::ElasticBase>> base;
    process::Decided<std::optional<scene::BaseMotion>> motion;
    process::Decided<std::optional<scene::FreeField>> free_field;
    process::Decided<std::vector<scene::Surcharge>> surcharge;
};

ModelDecisions decide_model(const scene::Scene& scene);

}  // namespace breach::fem
