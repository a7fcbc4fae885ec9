// Thin weak layers, which a circle can only cross: floors of composite surfaces.
// Called by search_families. No entry of the scene asks for it: a user who does not know of a
// seam's effect would not ask.
#pragma once

#include <vector>

#include "lem_tool/search.hpp"

namespace breach::lem {

using Path = std::vector<scene::Vec2>;

/// The bottom of every layer that is weaker than the soil above and below it and thinner than a
/// tenth of its depth, within the search's ranges; extended to both sides of the section.
std::vector<Path> weak_lines(const Model& model, const scene::SlipSearch& ranges);

/// Whether a weaker layer is thicker than that.
bool has_thick_weak_layer(const Model& model, const scene::SlipSearch& ranges);

/// The higher of two lines at each x; the other if one is empty.
Path higher(const Path& one, const Path& other);

/// The model with this floor instead of the scene's.
Model over_floor(const scene::Scene& scene, const Model& model, const Path& floor);

}  // namespace breach::lem
