// Columns are appended after the body's nodes and elements (free_field.cpp), so that their part of
// every array is its tail. Ties to the body are cut; ties among the columns get a new master.
#include "fem_solver/model/columns_alone.hpp"

#include <algorithm>
#include <map>

#include "fem_solver/model/nonlocal.hpp"

namespace breach::fem {
namespace {

/// The entries after the first `begin`.
template <class T>
std::vector<T> rest_of(const std::vector<T>& all, std::size_t begin) {
    if (all.empty()) return {};
    return {all.begin() + static_cast<std::ptrdiff_t>(begin), all.end()};
}

Eigen::VectorXd rest_of(const Eigen::VectorXd& all, std::size_t begin) {
    if (all.size() == 0) return {};
    return all.tail(all.size() - static_cast<Eigen::Index>(begin));
}

Mesh mesh_of(const Model& whole) {
    Mesh mesh{.nodes = rest_of(whole.mesh.nodes, whole.body.nodes),
              .quads = rest_of(whole.mesh.quads, whole.body.elements),
              .region_of_element = rest_of(whole.mesh.region_of_element, whole.body.elements)};
    for (Quad& quad : mesh.quads) {
        for (std::int32_t& node : quad) node -= static_cast<std::int32_t>(whole.body.nodes);
    }
    return mesh;
}

/// Ties from `begin` on, with the first of each group as master.
std::vector<std::int32_t> ties_of(const std::vector<std::int32_t>& masters, std::size_t begin) {
    std::map<std::int32_t, std::int32_t> first_of_group;
    std::vector<std::int32_t> own;
    for (std::size_t i = begin; i < masters.size(); ++i) {
        const auto here = static_cast<std::int32_t>(i - begin);
        const std::int32_t group = root_of(masters, static_cast<std::int32_t>(i));
        own.push_back(first_of_group.try_emplace(group, here).first->second);
    }
    return own;
}

/// A support of the mesh's edge also holds the columns tied to it.
std::vector<bool> held_of(const Constraints& whole, std::size_t begin) {
    std::vector<bool> group_is_held(whole.held.size(), false);
    for (std::size_t d = 0; d < whole.held.size(); ++d) {
        if (whole.held[d])
            group_is_held[root_of(whole.master, static_cast<std::int32_t>(d))] = true;
    }
    std::vector<bool> held;
    for (std::size_t d = begin; d < whole.held.size(); ++d) {
        held.push_back(group_is_held[root_of(whole.master, static_cast<std::int32_t>(d))]);
    }
    return held;
}

struct ZonePart {
    std::size_t zone;   ///< in the whole
    std::size_t first;  ///< element in the whole
    std::size_t count;
};

std::vector<ZonePart> zone_parts(const Model& whole) {
    std::vector<ZonePart> parts;
    for (std::size_t z = 0; z < whole.zones.size(); ++z) {
        const Zone& zone = whole.zones[z];
        const std::size_t first = std::max(zone.first, whole.body.elements);
        if (first < zone.first + zone.count)
            parts.push_back({z, first, zone.first + zone.count - first});
    }
    return parts;
}

PoreWater water_of(const Model& whole, const std::vector<ZonePart>& parts) {
    if (!whole.water.any()) return {};
    PoreWater water{.fluids = {},
                    .elements = {},
                    .is_unknown = rest_of(whole.water.is_unknown, whole.body.nodes),
                    .prescribed = rest_of(whole.water.prescribed, whole.body.nodes),
                    .body = whole.water.body};
    for (const ZonePart& part : parts) water.fluids.push_back(whole.water.fluids[part.zone]);
    for (PorousElement each : whole.water.elements) {
        if (each.element < whole.body.elements) continue;
        const auto part = std::ranges::find(parts, each.zone, &ZonePart::zone);
        each.zone = static_cast<std::size_t>(part - parts.begin());
        each.element -= whole.body.elements;
        water.elements.push_back(each);
    }
    return water;
}

materials::LawMemory part_of(const materials::Law& law, const materials::LawMemory& zone,
                             std::size_t first, std::size_t count) {
    materials::LawMemory part = materials::memory_for(law, 0);
    materials::with_memory(law, zone, [&]<class L>(const L&, const auto& points) {
        const auto begin = points.begin() + static_cast<std::ptrdiff_t>(first);
        std::get<materials::ZoneMemory<L>>(part).points.assign(
            begin, begin + static_cast<std::ptrdiff_t>(count));
    });
    return part;
}

}  // namespace

Model columns_alone(const Model& whole) {
    const std::size_t elements = whole.body.elements, nodes = whole.body.nodes;
    const std::vector<ZonePart> parts = zone_parts(whole);
    Model alone;
    alone.mesh = mesh_of(whole);
    alone.body = {alone.mesh.nodes.size(), alone.mesh.quads.size()};
    for (const ZonePart& part : parts) {
        const Zone& zone = whole.zones[part.zone];
        alone.zones.push_back({.first = part.first - elements,
                               .count = part.count,
                               .density = zone.density,
                               .law = zone.law,
                               .viscosity = zone.viscosity,
                               .nonlocal_length = zone.nonlocal_length,
                               .softening_scale = zone.softening_scale});
    }
    alone.s_u = rest_of(whole.s_u, elements * whole.points_per_element);
    // The columns become the body: their forces must keep the size that the copied state has.
    alone.thickness = whole.thickness * whole.column_thickness;
    alone.constraints = {.held = held_of(whole.constraints, 2 * nodes),
                         .master = ties_of(whole.constraints.master, 2 * nodes),
                         .pressure_master = ties_of(whole.constraints.pressure_master, nodes),
                         .is_base = rest_of(whole.constraints.is_base, nodes)};
    alone.water = water_of(whole, parts);
    alone.base = {rest_of(whole.base.dashpot, 2 * nodes), whole.base.outcrop};
    alone.nodal_mass = rest_of(whole.nodal_mass, nodes);
    alone.mass = rest_of(whole.mass, 2 * nodes);
    alone.external_force = rest_of(whole.external_force, 2 * nodes);
    alone.points_per_element = whole.points_per_element;
    alone.reference = rest_of(whole.reference, elements);
    alone.hourglass = rest_of(whole.hourglass, elements);
    alone.hourglass_modulus = whole.hourglass_modulus;
    alone.volume = rest_of(whole.volume, elements);
    alone.rayleigh = whole.rayleigh;
    alone.nonlocal = nonlocal_softening(alone);
    return alone;
}

Motion columns_alone(const Model& whole, const Motion& motion) {
    const std::size_t elements = whole.body.elements, nodes = whole.body.nodes;
    const std::size_t points = elements * whole.points_per_element;
    Motion alone{.u = rest_of(motion.u, 2 * nodes),
                 .v = rest_of(motion.v, 2 * nodes),
                 .a = rest_of(motion.a, 2 * nodes),
                 .force = rest_of(motion.force, 2 * nodes),
                 .p = rest_of(motion.p, nodes),
                 .p_rate = rest_of(motion.p_rate, nodes),
                 .points = rest_of(motion.points, points),
                 .strain = rest_of(motion.strain, points),
                 .memory = {},
                 .hourglass = rest_of(motion.hourglass, elements)};
    if (motion.memory.empty()) return alone;
    for (const ZonePart& part : zone_parts(whole)) {
        const std::size_t before =
            (part.first - whole.zones[part.zone].first) * whole.points_per_element;
        alone.memory.push_back(part_of(whole.zones[part.zone].law, motion.memory[part.zone], before,
                                       part.count * whole.points_per_element));
    }
    return alone;
}

}  // namespace breach::fem
