// What a template draws: a section in parts with its water, before it is a scene. x points downstream,
// the toe lies at (0, 0), the foundation's surface at y = 0.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"
#include "services/templates/options.hpp"

namespace breach::templates {

using geometry::Polygon;
using mechanics::Vec2;
using Line = std::vector<Vec2>;  ///< ascending in x

struct Part {
    std::string name;
    std::string material;
    Polygon polygon;  ///< counter-clockwise
};

struct Outline {
    std::vector<Part> parts;  ///< they touch, without gaps; above the foundation
    Line ground;              ///< from the model's left end to the toe
    Line phreatic;            ///< from the left end to beyond the toe
    std::string wet;          ///< the part whose soil below the phreatic line can liquefy
    Vec2 crest;               ///< its downstream edge
    double crest_from;        ///< x of its upstream edge
    double left;              ///< x of the model's left end
};

/// Dupuit's parabola from `from` to `exit` (h^2 linear in x), nowhere above the ground; level on
/// either side. [m]
Line drained_line(const Vec2& from, double exit, double left, double right, const Line& ground);

/// The material of the starter dam.
inline std::string starter_fill(const Values& values) {
    return values.is_on("rockfill_starter") ? "rockfill" : "embankment";
}

/// The option, and what it says, of the soil's surface where the model ends: too low is refused.
Outline upstream_dam(const Values& values);
Outline downstream_dam(const Values& values);
Outline slope(const Values& values);
Outline heap(const Values& values);

}  // namespace breach::templates
