// Locates a fault in the section: by the coordinates in its text, or those of the entry that it
// points at.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/scene/scene.hpp"

namespace breach::drawing {

/// A place (one point) or a line (several) [m].
using Trace = std::vector<mechanics::Vec2>;

/// Coordinates in the cause come first ("a gap of 0.3 m at (12, 4)"), then those of the entry or of
/// the nearest entry above it, then the regions of a material. Empty: the fault has no location.
/// `document`: as sent, with overrides; `scene`: its valid parts.
std::vector<Trace> places_of(const fault::Fault& fault, const nlohmann::json& document,
                             const scene::Scene& scene);

}  // namespace breach::drawing
