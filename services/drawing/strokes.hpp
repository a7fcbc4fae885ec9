// Style of lines and marks over a section. Private to the section's drawing.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "services/drawing/canvas.hpp"

namespace breach::drawing {

using Line = std::vector<Vec2>;

constexpr const char* blue = "#0b5fa5";
constexpr const char* violet = "#7a1fa2";
constexpr const char* brown = "#5d4037";
constexpr const char* green = "#00695c";
constexpr const char* dark_red = "#b3261e";

/// Attributes of an outline [px].
std::string stroke(const std::string& colour, double width, const std::string& more = "");
std::string shape(const std::string& path, const std::string& look);
/// A line with a white border, visible on every fill.
void draw_line(Canvas& canvas, const std::string& name, const Line& line, const std::string& colour,
               const std::string& dashes = "");
Key line_key(const std::string& colour, const std::string& text, const std::string& dashes = "");
/// "(12, 4)"
std::string place(const Vec2& at);
/// The line extended beyond its ends over the whole panel.
Line across(const Panel& panel, const Line& line, geometry::Level level);
/// Draws loads as arrows on the ground; `of`: the phase of the loads.
void draw_loads(Canvas& canvas, const scene::Scene& scene,
                const std::vector<scene::Surcharge>& loads, const std::string& of);

}  // namespace breach::drawing
