// The outline of a template: a section in parts with its water, before it becomes a scene. x points
// downstream; the toe is at (0, 0) on the foundation's surface.
#pragma once

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
    std::vector<Part> parts;  ///< adjacent, without gaps; above the foundation
    Line ground;              ///< from the model's left end to the toe
    Line phreatic;            ///< from the left end to beyond the toe
    std::string wet;          ///< the part with soil that can liquefy below the phreatic line
    Vec2 crest;               ///< downstream edge of the crest
    double crest_from;        ///< x of its upstream edge
    double left;              ///< x of the model's left end
};

/// The foundation's surface: level, or rising upstream of the toe and falling downstream of it.
struct Terrain {
    explicit Terrain(const Values& values)
        : rise(values.or_none("valley_slope")), fall(values.or_none("ground_slope")) {}
    double at(double x) const { return x < 0.0 ? -rise * x : -fall * x; }
    bool is_level() const { return rise == 0.0 && fall == 0.0; }
    double rise, fall;  ///< metres per metre
};

/// Adds a phreatic line to an outline: level from the left end to `from`, then down to the
/// foundation's surface at x = `exit`, by Dupuit's parabola (h^2 linear in x), or straight through
/// the piezometer's level where one is given. It is never above the ground, and on the foundation
/// beyond `exit`.
void add_water(const Values& values, const Vec2& from, double exit, Outline& outline);

/// Adds a fault where the ground rises into the upper half of the starter dam.
void check_heel(Refusal& refusal, double heel_level, double starter);

/// Divides the tailings into beach and slimes, if slimes are requested.
void part_slimes(const Values& values, const Vec2& contact, double heel, Outline& outline);

/// The material of the starter dam.
inline std::string starter_fill(const Values& values) {
    return values.is_on("rockfill_starter") ? "rockfill" : "embankment";
}

Outline upstream_dam(const Values& values);
Outline downstream_dam(const Values& values);
Outline slope(const Values& values);
Outline heap(const Values& values);

}  // namespace breach::templates
