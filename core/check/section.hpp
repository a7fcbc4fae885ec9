// Inside core/check only: queries on the cross-section as it is drawn.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/geometry/section.hpp"
#include "core/scene/scene.hpp"

namespace breach::check {

using geometry::abscissae;
using geometry::deepest_below;
using geometry::Depth;
using geometry::extent;
using geometry::ground_at;
using geometry::ground_over;
using geometry::in_soil;
using geometry::level_at;
using geometry::Side;
using geometry::sides_of;
using geometry::straight_level_at;
using geometry::strata_at;
using geometry::Stratum;
using scene::Vec2;

/// "12.4", "(3, -5)": written as in a scene.
std::string text(double value);
std::string text(const Vec2& point);
std::string metres(double value);

/// "the section's ground reaches from x = 0 to 60 m"
std::string reach_of_ground(const scene::Scene& scene);

std::string region_pointer(std::size_t region, const std::string& below = "");

/// The region's material; null if the scene does not define it.
const scene::Material* material_of(const scene::Scene& scene, const scene::Region& region);

/// Whether every region has a polygon and a material.
bool is_whole(const scene::Scene& scene);

/// Edge length of the region's elements [m]: sqrt(area / elements) of a block, else element_size.
double element_size(const scene::Region& region);
double least_element_size(const scene::Scene& scene);
double largest_element_size(const scene::Scene& scene);

}  // namespace breach::check
