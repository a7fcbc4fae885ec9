// The water of a mesh. Which elements are wet and which pressures are prescribed is decided in
// ground_water.cpp; the operators of one element are in porous_element.cpp.
#include "fem_solver/model/pore_water.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace breach::fem {
namespace {

/// Smallest node of each node's connected saturated body.
std::vector<std::int32_t> bodies_of(const Model& model, const PoreWater& water) {
    std::vector<std::int32_t> parent(model.mesh.nodes.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t node) {
        while (parent[node] != node) node = parent[node] = parent[parent[node]];
        return node;
    };
    for (const PorousElement& each : water.elements) {
        for (const std::int32_t node : model.mesh.quads[each.element]) {
            const std::int32_t a = root(model.mesh.quads[each.element][0]), b = root(node);
            // Union by the smaller node: elements that share nodes are one body of water.
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    for (std::size_t i = 0; i < parent.size(); ++i) {
        parent[i] = root(static_cast<std::int32_t>(i));
    }
    return parent;
}

void check_drainage(const Model& model, const PoreWater& water,
                    const std::vector<std::optional<double>>& prescribed) {
    const auto body = bodies_of(model, water);
    std::vector<bool> has_drain(body.size(), false);
    for (std::size_t i = 0; i < body.size(); ++i) {
        if (prescribed[i]) has_drain[body[i]] = true;
    }
    for (const PorousElement& each : water.elements) {
        // Refused here with a place: the factorisation would fail without one.
        if (has_drain[body[model.mesh.quads[each.element][0]]]) continue;
        const Vec2 where = corners_of(model.mesh, each.element).rowwise().mean();
        throw fault::BadInput("scene",
                              {{"/fem/water",
                                "the saturated soil around (" + std::to_string(where.x()) + ", " +
                                    std::to_string(where.y()) +
                                    ") has no node with a prescribed pressure: constant pressure "
                                    "and checkerboard would be free",
                                "drain an edge of it: lower the line, or add a boundary"}});
    }
}

double constrained_modulus(const mechanics::Elasticity& soil) {
    return 2.0 * soil.shear_modulus() * (1.0 - soil.nu) / (1.0 - 2.0 * soil.nu);  // K + 4G/3
}

/// Integrals of N_j over the part with positive depth, over the whole; depth is linear along eta.
Eigen::Vector4d shares_below(const Corners& x, const Eigen::Vector4d& depth) {
    if (depth.minCoeff() >= 0.0) return Eigen::Vector4d::Ones();
    constexpr int slices = 8;  // of xi: inclined lines to 0.1 % of the element
    const double a = 1.0 / std::sqrt(3.0);
    Eigen::Vector4d below = Eigen::Vector4d::Zero(), whole = below;
    const auto add = [&](double xi, double from, double to, Eigen::Vector4d& sum) {
        for (const double at : {-a, a}) {
            const Vec2 local(xi, 0.5 * (from + to) + 0.5 * at * (to - from));
            const mechanics::Matrix2 J = geometry::shape_gradients(local) * x.transpose();
            sum += 0.5 * (to - from) * J.determinant() * shape_functions(local);
        }
    };
    for (int i = 0; i < 2 * slices; ++i) {
        const int middle = i - i % 2 + 1;  // of the slice, in half slices
        const double xi = (middle + (i % 2 == 0 ? -a : a)) / slices - 1.0;
        const double foot = shape_functions({xi, -1.0}).dot(depth);
        const double top = shape_functions({xi, 1.0}).dot(depth);
        add(xi, -1.0, 1.0, whole);
        if (foot <= 0.0 && top <= 0.0) continue;
        // Where the depth is 0 on this line of constant xi, in eta from -1 to 1.
        const double zero = foot * top < 0.0 ? (foot + top) / (foot - top) : 1.0;
        add(xi, foot >= 0.0 ? -1.0 : zero, top >= 0.0 ? 1.0 : zero, below);
    }
    return below.cwiseQuotient(whole);
}

void draw_line(const Mesh& mesh, const Wetness& wetness, const Fluid& fluid,
               PorousElement& porous) {
    const Corners x = corners_of(mesh, porous.element);
    Eigen::Vector4d depth;
    for (int i = 0; i < 4; ++i) depth[i] = wetness.depth[mesh.quads[porous.element][i]];
    porous.below = shares_below(x, depth);
    if (!wetness.rests_as_drawn) return;
    const Eigen::Vector4d level = depth + x.row(1).transpose();
    porous.level = -fluid.density * wetness.body.y() * (level.array() - level[0]);
    if (porous.level.cwiseAbs().maxCoeff() <
        1e-9 * fluid.density * std::abs(wetness.body.y()) * depth.cwiseAbs().maxCoeff())
        porous.level.setZero();
}

}  // namespace

PoreWater build_pore_water(const Model& model, Wetness wetness) {
    PoreWater water;
    std::vector<bool> touched(model.mesh.nodes.size(), false);
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        if (!wetness.fluids[z]) continue;
        const Zone& zone = model.zones[z];
        // Until the first dynamic stage, which sets the modulus at its stress
        // (apply_to_model).
        const double modulus = constrained_modulus(materials::elasticity(zone.law));
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
            if (!wetness.wet[e]) continue;
            PorousElement& porous = water.elements.emplace_back();
            porous.element = e;
            porous.zone = z;
            porous.skeleton_modulus = modulus;
            porous.density = zone.density;
            if (!wetness.depth.empty()) draw_line(model.mesh, wetness, *wetness.fluids[z], porous);
            for (const std::int32_t node : model.mesh.quads[e]) touched[node] = true;
        }
    }
    if (water.elements.empty()) return water;
    check_drainage(model, water, wetness.prescribed);
    water.fluids = std::move(wetness.fluids);
    water.body = wetness.body;
    water.is_unknown.assign(touched.size(), false);
    water.prescribed = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(touched.size()));
    for (std::size_t i = 0; i < touched.size(); ++i) {
        const auto& p = wetness.prescribed[i];
        // Nodes of dry soil alone have no pressure at all, not a pressure of 0 to solve for.
        water.is_unknown[i] = touched[i] && !p;
        if (touched[i] && p) water.prescribed[static_cast<Eigen::Index>(i)] = *p;
    }
    evaluate_pore_water(model, water);
    return water;
}

void evaluate_pore_water(const Model& model, PoreWater& water) {
    for (PorousElement& each : water.elements) {
        const std::size_t e = each.element;
        const Corners x = corners_of(model.mesh, e);
        const Fluid& fluid = *water.fluids[each.zone];
        if (model.hourglass.empty()) {
            Gradients gradients;
            evaluate_gradients(x, model.thickness_of(e), gradients);
            evaluate_porous(gradients, x, fluid, water.body, each);
        } else {
            SspGeometry geometry;
            evaluate_ssp(x, model.thickness_of(e), geometry);
            evaluate_porous(geometry, x, fluid, water.body, each);
        }
    }
}

Eigen::VectorXd without_suction(const PoreWater& water, const Eigen::VectorXd& p) {
    return (water.prescribed.array() < 0.0).select(p.cwiseMax(0.0), p);
}

void add_pressure_force(const Model& model, const Eigen::VectorXd& p, Eigen::VectorXd& f) {
    for (const PorousElement& each : model.water.elements) {
        const Quad& quad = model.mesh.quads[each.element];
        const Eigen::Vector4d local(p[quad[0]], p[quad[1]], p[quad[2]], p[quad[3]]);
        const Dofs8 force = each.Q * local;
        for (int i = 0; i < 4; ++i) {
            f.segment<2>(2 * static_cast<Eigen::Index>(quad[i])) += force.segment<2>(2 * i);
        }
    }
}

Eigen::VectorXd steady_pressure(const Model& model) {
    const PoreWater& water = model.water;
    Eigen::VectorXd p = water.prescribed;
    const Unknowns unknowns = model.unknowns(Solved::motion_and_pressure);
    const auto number = [&](std::int32_t node) {
        const std::int32_t i = unknowns.of_pressure[node];
        return i < 0 ? -1 : i - unknowns.displacements;
    };
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns.pressures());
    std::vector<Eigen::Triplet<double>> entries;
    for (const PorousElement& each : water.elements) {
        const Quad& quad = model.mesh.quads[each.element];
        for (int i = 0; i < 4; ++i) {
            const std::int32_t row = number(quad[i]);
            if (row < 0) continue;
            right[row] += each.flux[i];
            for (int j = 0; j < 4; ++j) {
                const std::int32_t column = number(quad[j]);
                if (column >= 0) {
                    entries.emplace_back(row, column, each.H(i, j));
                } else {
                    right[row] -= each.H(i, j) * p[quad[j]];
                }
            }
        }
    }
    Eigen::SparseMatrix<double> H(right.size(), right.size());
    H.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(H);
    // An indeterminate pressure shows as a pivot within the round-off of its row.
    constexpr double lost = 1e-13;
    const bool determined =
        right.size() == 0 || (factors.info() == Eigen::Success &&
                              factors.vectorD().minCoeff() > lost * H.diagonal().minCoeff());
    if (!determined) {
        throw fault::BadInput("scene", {{"/fem/water",
                                         "the prescribed pressures do not determine the steady "
                                         "seepage: a pressure checkerboard is free",
                                         "prescribe the pressure along an edge"}});
    }
    const Eigen::VectorXd solved = factors.solve(right);
    for (std::size_t i = 0; i < water.is_unknown.size(); ++i) {
        if (water.is_unknown[i]) {
            p[static_cast<Eigen::Index>(i)] = solved[number(static_cast<std::int32_t>(i))];
        }
    }
    return p;
}

}  // namespace breach::fem
