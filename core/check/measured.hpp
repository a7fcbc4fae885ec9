// Telemetry columns that the FEM of a scene measures. A condition on an unmeasured column would
// never be true.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/scene/scene.hpp"
#include "core/telemetry/columns.hpp"

namespace breach::check {

struct NotMeasured {
    std::string cause;
    const char* remedy;
};

/// Why the FEM does not measure the column; none: it does. The scene must have /fem.
std::optional<NotMeasured> why_not_measured(const scene::Scene& scene, telemetry::Needs needs);

/// One fault at `pointer` for each field of a condition that the scene's FEM does not measure.
std::vector<fault::Fault> unmeasured(const std::vector<std::string>& fields,
                                     const scene::Scene& scene, const std::string& pointer);

}  // namespace breach::check
