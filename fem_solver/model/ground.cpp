#include "fem_solver/model/ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace breach::fem {

namespace {

struct OuterEdge {
    GroundEdge edge;
    std::size_t element;
};

/// Edges that two elements do not share, of those that are there.
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
            const Vec2 along = mesh.nodes[b] - mesh.nodes[a];
            outer.push_back({{a, b, model.thickness_of(e) * Vec2(along.y(), -along.x())}, e});
        }
    }
    return outer;
}

struct Sides {
    double left, right;  ///< x [m]
};

/// Of the body.
Sides sides_of(const Model& model) {
    Sides sides{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < model.body.nodes; ++i) {
        sides.left = std::min(sides.left, model.mesh.nodes[i].x());
        sides.right = std::max(sides.right, model.mesh.nodes[i].x());
    }
    return sides;
}

/// A column beside the section stands for the ground at its side.
bool lies_on(const scene::Surcharge& load, double a, double b, const Sides& sides) {
    const double middle = 0.5 * (a + b), x = std::clamp(middle, sides.left, sides.right);
    const double slack = x == middle ? 0.0 : 1e-6 * std::abs(a - b);
    return x >= load.from - slack && x <= load.to + slack;
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
        const bool within = e < model.body.elements && std::abs(along.x()) <= small &&
                            x > left + small && x < right - small;
        if (upwards || within) ground.push_back(edge);
    }
    return ground;
}

std::size_t add_edge_pressure(const scene::EdgePressure& load, Model& model) {
    std::vector<bool> on(model.mesh.nodes.size(), false);
    for (const std::size_t i : nodes_on(model.mesh, load.from, load.to)) on[i] = true;
    std::size_t found = 0;
    for (const auto& [edge, e] : outer_edges(model)) {
        if (!on[edge.a] || !on[edge.b]) continue;
        ++found;
        for (const std::int32_t node : {edge.a, edge.b})
            model.external_force.segment<2>(2 * static_cast<Eigen::Index>(node)) -=
                0.5 * load.pressure * edge.outwards;
    }
    return found;
}

double pond_pressure(const scene::GroundWater& water, double gravity, const Vec2& x) {
    return water.density * gravity * std::max(0.0, level_at(water.line, x.x()) - x.y());
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
            const double p_a = pond_pressure(*water, gravity, x_a);
            const double p_b = pond_pressure(*water, gravity, x_b);
            add(a, -(2.0 * p_a + p_b) / 6.0 * outwards);
            add(b, -(p_a + 2.0 * p_b) / 6.0 * outwards);
        }
        for (const scene::Surcharge& load : surcharge) {
            if (!lies_on(load, x_a.x(), x_b.x(), sides)) continue;
            const Vec2 force(0.0, -0.5 * load.pressure * outwards.y());
            add(a, force);
            add(b, force);
        }
    }
}

}  // namespace breach::fem
