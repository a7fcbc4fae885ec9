// Draws the features over the regions of a section, one function per part of the scene. Private to
// the section's drawing.
#pragma once

#include <optional>
#include <string>

#include "core/scene/scene.hpp"
#include "services/drawing/canvas.hpp"

namespace breach::drawing {

/// Phreatic and piezometric lines of all phases, each once; standing water; held pressures.
void draw_water(Canvas& canvas, const scene::Scene& scene);
/// Liquefiable soil, tension crack, search ranges, given surfaces, floor, loads.
void draw_stability(Canvas& canvas, const scene::Scene& scene);
/// Supports, free-field columns, crest.
void draw_supports(Canvas& canvas, const scene::Scene& scene);
/// Toe and gauges.
void draw_runout_marks(Canvas& canvas, const scene::Scene& scene);
/// The grid's border, floor with its friction, terrain.
void draw_grid(Canvas& canvas, const scene::Scene& scene);

/// "motion synthetic.csv: PGA 0.3 g, ...", with the Arias intensity if it is an acceleration;
/// nothing: the scene has no readable motion.
std::optional<std::string> motion_line(const scene::Scene& scene);

}  // namespace breach::drawing
