#include "fem_solver/pore_water.hpp"

#include <numeric>

namespace breach::fem {

PorousElement porous_element(std::size_t element, const SspGeometry& geometry, const Corners& x,
                             double skeleton_modulus, const Fluid& fluid, const Vec2& body) {
    const Gradient& dN = geometry.dN;
    const double V = geometry.volume;
    PorousElement result;
    result.element = element;
    for (int i = 0; i < 4; ++i) result.Q.segment<2>(2 * i) = 0.25 * V * dN.col(i);
    const Vec2 extent = x.rowwise().maxCoeff() - x.rowwise().minCoeff();
    Vec2 alpha = extent.array().square() / (4.0 * skeleton_modulus);
    if (fluid.stabilisation) alpha.setConstant(*fluid.stabilisation);
    const double storage = V * fluid.porosity / fluid.bulk_modulus / 16.0;
    result.S = V * dN.transpose() * alpha.asDiagonal() * dN;
    result.S.array() += storage;
    result.H = V * dN.transpose() * fluid.mobility.asDiagonal() * dN;
    result.flux = V * fluid.density * dN.transpose() * fluid.mobility.cwiseProduct(body);
    return result;
}

namespace {

/// Smallest node of the connected saturated body that each node belongs to.
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
            parent[std::max(a, b)] = std::min(a, b);
        }
    }
    for (std::size_t i = 0; i < parent.size(); ++i) {
        parent[i] = root(static_cast<std::int32_t>(i));
    }
    return parent;
}

void check_drainage(const Model& model, const PoreWater& water, const std::vector<bool>& drained) {
    const auto body = bodies_of(model, water);
    std::vector<bool> has_drain(body.size(), false);
    for (std::size_t i = 0; i < body.size(); ++i) {
        if (drained[i]) has_drain[body[i]] = true;
    }
    for (const PorousElement& each : water.elements) {
        if (has_drain[body[model.mesh.quads[each.element][0]]]) continue;
        const Vec2 where = corners_of(model.mesh, each.element).rowwise().mean();
        throw fault::BadInput("scene",
                              {{"/fem",
                                "the saturated soil around (" + std::to_string(where.x()) + ", " +
                                    std::to_string(where.y()) +
                                    ") has no node with a prescribed pressure: constant pressure "
                                    "and checkerboard would be free",
                                "drain an edge of it"}});
    }
}

}  // namespace

PoreWater build_pore_water(const Model& model, const std::vector<std::optional<Fluid>>& fluids,
                           const std::vector<bool>& drained, const Vec2& body) {
    PoreWater water;
    std::vector<bool> wet(model.mesh.nodes.size(), false);
    for (std::size_t z = 0; z < model.zones.size(); ++z) {
        if (!fluids[z]) continue;
        const Zone& zone = model.zones[z];
        const mechanics::Elasticity& soil = materials::elasticity(zone.law);
        const double G = soil.shear_modulus(), nu = soil.nu;
        const double modulus = 2.0 * G * (1.0 - nu) / (1.0 - 2.0 * nu);  // K + 4G/3
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e) {
            water.elements.push_back(porous_element(
                e, model.hourglass[e], corners_of(model.mesh, e), modulus, *fluids[z], body));
            for (const std::int32_t node : model.mesh.quads[e]) wet[node] = true;
        }
    }
    check_drainage(model, water, drained);
    water.unknown_of_node.assign(model.mesh.nodes.size(), -1);
    for (std::size_t i = 0; i < wet.size(); ++i) {
        if (wet[i] && !drained[i]) water.unknown_of_node[i] = water.unknowns++;
    }
    return water;
}

}  // namespace breach::fem
