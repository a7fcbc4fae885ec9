// The terrain below the flow, a polyline through square cells: the nodes near it and their normals.
// make_grid computes the contacts of all nodes once; the step applies them (rub). Cells need not
// follow the ground: nothing is meshed.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace breach::mpm {

using mechanics::Vec2;

/// Contact condition of a node at the terrain: v . normal >= 0 for one normal, or for the two of a
/// valley, with Coulomb friction along each.
struct Contact {
    Vec2 normal;
    std::optional<Vec2> second;
    double friction;  ///< [-]; infinite: no slip
};

class Terrain {
  public:
    /// `profile` ascends in x; its first and last segments are extrapolated.
    explicit Terrain(const std::vector<Vec2>& profile);

    /// y of the ground at x [m].
    double level(double x) const;
    /// Distance from the ground, positive above [m].
    double distance(const Vec2& place) const;

    /// Contact of a node at most `reach` above the ground, or anywhere below; none higher up. In a
    /// valley within reach of both slopes a node has both normals; at a ridge one normal that
    /// rotates from the left to the right slope's within `reach` of the vertex.
    std::optional<Contact> contact(const Vec2& node, double reach, double friction) const;

  private:
    struct Edge {
        Vec2 from;
        Vec2 to;
        Vec2 normal;  ///< upwards
    };
    /// Segments that may be nearest to a place: those within `width` of x.
    std::pair<std::size_t, std::size_t> beside(double x, double width) const;
    bool near(const Vec2& place, double reach) const;
    Vec2 ridge_normal(const Vec2& node, double nearest, double reach) const;

    std::vector<Edge> edges_;
};

/// Applies the contact to the velocity v; returns the work of friction: impulse x (v_before + v) /
/// 2 [J], exact for the node's kinetic energy.
double rub(const Contact& contact, double m, const Vec2& v_before, Vec2& v);

}  // namespace breach::mpm
