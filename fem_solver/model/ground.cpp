#include "fem_solver/model/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace breach::fem {

namespace {

struct OuterEdge {
    GroundEdge edge;
    std::size_t element;
};

/// Edges of present elements that no other element shares.
std::vector<OuterEdge> outer_edges(const Model& model) {
    const Mesh& mesh = model.mesh;
    std::map<std::array<std::int32_t, 2>, int> count;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        if (model.is_absent(e)) continue;
        const Quad& quad = mesh.quads[e];
        for (std::size_t k = 0; k < 4; ++k) {
            ++count[{std::min(quad[k], quad[(k + 1) % 4]), std::max(quad[k], quad[(k + 1) % 4])}];
        }
    }
    std::vector<OuterEdge> outer;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        if (model.is_absent(e)) continue;
        const Quad& quad = mesh.quads[e];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t a = quad[k], b = quad[(k + 1) % 4];
            if (count[{std::min(a, b), std::max(a, b)}] > 1) continue;
            // Counter-clockwise around its element, so that the normal to the right points
            // outwards.
            const Vec2 along = mesh.nodes[b] - mesh.nodes[a];
            outer.push_back({{a, b, model.thickness_of(e) * Vec2(along.y(), -along.x())}, e});
        }
    }
    return outer;
}

struct Sides {
    double left, right;  ///< x [m]
};

Sides sides_of(const Model& model) {
    Sides sides{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < model.body.nodes; ++i) {
        sides.left = std::min(sides.left, model.mesh.nodes[i].x());
        sides.right = std::max(sides.right, model.mesh.nodes[i].x());
    }
    return sides;
}

/// A part of an edge, in shares of its length from node a to node b.
struct Part {
    double from = 0.0, to = 0.0;

    double length() const { return to - from; }
    /// Nodal shares of a load that is uniform over the part.
    double on_b() const { return 0.5 * (from + to) * length(); }
    double on_a() const { return length() - on_b(); }
};

/// The part of an edge from a to b within [from, to], without slivers from round-off.
Part part_within(double a, double b, double from, double to) {
    constexpr double rounding = 1e-6;
    const auto share = [&](double x) {
        const double s = std::clamp((x - a) / (b - a), 0.0, 1.0);
        return s < rounding ? 0.0 : s > 1.0 - rounding ? 1.0 : s;
    };
    const Part part{std::min(share(from), share(to)), std::max(share(from), share(to))};
    return std::max(a, b) <= from || std::min(a, b) >= to ? Part{} : part;
}

/// A column beside the section gets the load at that side.
Part part_under(const scene::Surcharge& load, double a, double b, const Sides& sides) {
    // A load that reaches the section's side goes on beyond it: a free column beside a loaded edge
    // would settle differently.
    const double middle = 0.5 * (a + b), x = std::clamp(middle, sides.left, sides.right);
    if (x == middle) return a == b ? Part{} : part_within(a, b, load.from, load.to);
    const double slack = 1e-6 * std::abs(a - b);
    return x >= load.from - slack && x <= load.to + slack ? Part{0.0, 1.0} : Part{};
}

}  // namespace

std::vector<GroundEdge> ground_edges(const Model& model) {
    const Mesh& mesh = model.mesh;
    const auto [left, right] = sides_of(model);
    std::vector<GroundEdge> ground;
    for (const auto& [edge, e] : outer_edges(model)) {
        const Vec2 along = mesh.nodes[edge.b] - mesh.nodes[edge.a];
        const double small = 1e-6 * along.norm();
        const double x = 0.5 * (mesh.nodes[edge.a] + mesh.nodes[edge.b]).x();
        const bool upwards = -along.x() > small;
        // A vertical face within the section is ground (a cut, a removed part); the section's ends
        // are not.
        const bool within = e < model.body.elements && std::abs(along.x()) <= small &&
                            x > left + small && x < right - small;
        if (upwards || within) ground.push_back(edge);
    }
    return ground;
}

std::size_t add_edge_pressure(const scene::EdgePressure& load, Model& model) {
    const Vec2 along = (load.to - load.from).normalized();
    const double length = (load.to - load.from).norm();
    const double tolerance = 1e-6 * quality_of(model.mesh).shortest_edge;
    std::size_t found = 0;
    for (const auto& [edge, e] : outer_edges(model)) {
        const Vec2 a = model.mesh.nodes[edge.a] - load.from,
                   b = model.mesh.nodes[edge.b] - load.from;
        const auto off = [&](const Vec2& x) {
            return std::abs(along.x() * x.y() - along.y() * x.x());
        };
        if (off(a) > tolerance || off(b) > tolerance) continue;
        const Part part = part_within(along.dot(a), along.dot(b), 0.0, length);
        if (part.length() == 0.0) continue;
        ++found;
        const auto add_share = [&](std::int32_t node, double share) {
            model.external_force.segment<2>(2 * static_cast<Eigen::Index>(node)) -=
                share * load.pressure * edge.outwards;
        };
        add_share(edge.a, part.on_a());
        add_share(edge.b, part.on_b());
    }
    return found;
}

/// Depth of free water above a point of the ground; negative: dry [m].
static double depth_of_water(const scene::GroundWater& water, const Vec2& x) {
    return level_at(water.line, x.x()) - x.y();
}

static double pressure_at(const scene::GroundWater& water, double gravity, double depth) {
    return water.density * gravity * std::max(0.0, depth);
}

/// Nodal pressures of the water on an edge, per area [Pa].
static std::array<double, 2> carried(const scene::GroundWater& water, double gravity,
                                     const Vec2& x_a, const Vec2& x_b) {
    const double a = depth_of_water(water, x_a), b = depth_of_water(water, x_b);
    const double p_a = pressure_at(water, gravity, a), p_b = pressure_at(water, gravity, b);
    // Consistent nodal forces of a linear pressure; below, of the triangle on the wet part alone.
    if (a * b >= 0.0) return {(2.0 * p_a + p_b) / 6.0, (p_a + 2.0 * p_b) / 6.0};
    const double wet = std::max(a, b) / std::abs(a - b);  // of the edge's length
    const double on_dry = std::max(p_a, p_b) * wet * wet / 6.0;
    const double on_wet = 0.5 * std::max(p_a, p_b) * wet - on_dry;
    return a > b ? std::array{on_wet, on_dry} : std::array{on_dry, on_wet};
}

void add_ground_loads(const ModelDecisions& decided, Model& model) {
    const auto& water = decided.water.value;
    const auto& surcharge = decided.surcharge.value;
    const double gravity = decided.gravity.value;
    if (!water && surcharge.empty()) return;
    const auto add = [&](std::int32_t node, const Vec2& force) {
        model.external_force.segment<2>(2 * static_cast<Eigen::Index>(node)) += force;
    };
    const Sides sides = sides_of(model);
    for (const auto& [a, b, outwards] : ground_edges(model)) {
        const Vec2 &x_a = model.mesh.nodes[a], &x_b = model.mesh.nodes[b];
        if (water) {
            const auto [on_a, on_b] = carried(*water, gravity, x_a, x_b);
            add(a, -on_a * outwards);
            add(b, -on_b * outwards);
        }
        for (const scene::Surcharge& load : surcharge) {
            const Part part = part_under(load, x_a.x(), x_b.x(), sides);
            add(a, Vec2(0.0, -part.on_a() * load.pressure * outwards.y()));
            add(b, Vec2(0.0, -part.on_b() * load.pressure * outwards.y()));
        }
    }
}

}  // namespace breach::fem
