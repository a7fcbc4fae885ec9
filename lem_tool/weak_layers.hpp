// Thin weak layers, which a circle only crosses: the lines for composite surfaces.
#pragma once

#include <vector>

#include "lem_tool/search.hpp"

namespace breach::lem {

using Path = std::vector<scene::Vec2>;

/// The bottom line of every layer that is weaker than the soil above and below it and thinner than
/// a tenth of its depth, within the search's ranges; from side to side of the section.
std::vector<Path> weak_lines(const Model& model, const scene::SlipSearch& ranges);

/// There is a weaker layer that is thicker than that.
bool has_thick_weak_layer(const Model& model, const scene::SlipSearch& ranges);

/// The higher of the two lines; the other where one is empty.
Path higher(const Path& one, const Path& other);

/// The model with another floor than the scene's.
Model over_floor(const scene::Scene& scene, const Model& model, const Path& floor);

}  // namespace breach::lem
