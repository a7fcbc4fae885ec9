// Ties and supports are resolved before any equation: a tied group has one number, a held one none.
// The matrix needs no multipliers, which would make it indefinite.
#include "fem_solver/model/constraints.hpp"

#include <algorithm>
#include <numeric>

namespace breach::fem {
namespace {

struct Found {
    bool any = false, x = false, y = false;
};

bool is_on(const scene::Support& support, const Vec2& node, double tolerance) {
    return geometry::distance_to_segment(node, support.from, support.to) <= tolerance;
}

void hold(const scene::Fem& fem, const Mesh& mesh, double tolerance, std::vector<bool>& held,
          std::vector<fault::Fault>& faults) {
    bool holds_x = false, holds_y = false;
    for (std::size_t s = 0; s < fem.supports.size(); ++s) {
        const scene::Support& support = fem.supports[s];
        bool found = false;
        for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
            if (!is_on(support, mesh.nodes[i], tolerance)) continue;
            found = true;
            if (support.fixes_x) held[2 * i] = true;
            if (support.fixes_y) held[2 * i + 1] = true;
        }
        if (!found) {
            faults.push_back({"/fem/supports/" + std::to_string(s),
                              "support '" + support.name + "' holds no node of the mesh",
                              "let its segment run along an edge of a region"});
        }
        holds_x = holds_x || (found && support.fixes_x);
        holds_y = holds_y || (found && support.fixes_y);
    }
    // set_stage checks bodies that change, stage by stage: displaced edges hold them as well.
    if ((!holds_x || !holds_y) && !fem.changes_the_body()) {
        faults.push_back({"/fem/supports",
                          std::string("nothing holds the body in ") + (holds_x ? "y" : "x"),
                          "add a support that fixes this direction"});
    }
}

std::vector<bool> lowest_nodes(const Mesh& mesh, double tolerance) {
    double lowest = mesh.nodes.front().y();
    for (const Vec2& x : mesh.nodes) lowest = std::min(lowest, x.y());
    std::vector<bool> is_lowest;
    for (const Vec2& x : mesh.nodes) is_lowest.push_back(x.y() <= lowest + tolerance);
    return is_lowest;
}

void check_ties(const Constraints& c, const Mesh& mesh, const std::vector<Tie>& ties,
                const std::vector<bool>& is_lowest, std::vector<fault::Fault>& faults) {
    for (const auto& [master, slave] : ties) {
        for (const std::int32_t node : {master, slave}) {
            const auto dof = 2 * static_cast<std::size_t>(node);
            if (is_lowest[node] || !(c.held[dof] || c.held[dof + 1])) continue;
            const Vec2& x = mesh.nodes[node];
            faults.push_back({"/fem/supports",
                              "a support holds (" + std::to_string(x.x()) + ", " +
                                  std::to_string(x.y()) + "), where a free-field column stands",
                              "hold only the base of a side that has a column"});
            return;
        }
    }
}

}  // namespace

std::int32_t root_of(const std::vector<std::int32_t>& masters, std::int32_t i) {
    while (masters[i] != i) i = masters[i];
    return i;
}

void tie(std::vector<std::int32_t>& masters, std::int32_t master, std::int32_t slave) {
    const std::int32_t a = root_of(masters, master), b = root_of(masters, slave);
    // A group's root is its smallest index, in any order of its ties.
    masters[std::max(a, b)] = std::min(a, b);
}

Constraints unconstrained(std::size_t nodes) {
    Constraints c;
    c.held.assign(2 * nodes, false);
    c.master.resize(2 * nodes);
    c.pressure_master.resize(nodes);
    std::iota(c.master.begin(), c.master.end(), 0);
    std::iota(c.pressure_master.begin(), c.pressure_master.end(), 0);
    return c;
}

Constraints constraints_of(const scene::Fem& fem, const std::optional<scene::ElasticBase>& base,
                           const Mesh& mesh, const std::vector<Tie>& ties,
                           const std::vector<Tie>& pressure_ties) {
    const double tolerance = 1e-6 * quality_of(mesh).shortest_edge;
    Constraints c = unconstrained(mesh.nodes.size());
    std::vector<fault::Fault> faults;
    hold(fem, mesh, tolerance, c.held, faults);
    const std::vector<bool> is_lowest = lowest_nodes(mesh, tolerance);
    check_ties(c, mesh, ties, is_lowest, faults);
    if (!faults.empty()) throw fault::BadInput("scene", std::move(faults));
    for (const auto& [master, slave] : ties) {
        tie(c.master, 2 * master, 2 * slave);
        tie(c.master, 2 * master + 1, 2 * slave + 1);
    }
    for (const auto& [master, slave] : pressure_ties) tie(c.pressure_master, master, slave);
    if (!base) return c;
    c.is_base = is_lowest;
    const auto first = std::find(is_lowest.begin(), is_lowest.end(), true) - is_lowest.begin();
    for (std::size_t i = 0; i < is_lowest.size(); ++i) {
        if (!is_lowest[i]) continue;
        tie(c.master, 2 * static_cast<std::int32_t>(first), 2 * static_cast<std::int32_t>(i));
    }
    return c;
}

std::vector<std::size_t> nodes_on(const Mesh& mesh, const Vec2& from, const Vec2& to) {
    const double tolerance = 1e-6 * quality_of(mesh).shortest_edge;
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        if (geometry::distance_to_segment(mesh.nodes[i], from, to) <= tolerance) found.push_back(i);
    return found;
}

std::size_t hold_nodes(const scene::Support& support, const Mesh& mesh,
                       const std::vector<bool>& lonely, std::vector<bool>& held) {
    std::size_t found = 0;
    for (const std::size_t i : nodes_on(mesh, support.from, support.to)) {
        found += lonely[i] ? 0 : 1;
        if (support.fixes_x) held[2 * i] = true;
        if (support.fixes_y) held[2 * i + 1] = true;
    }
    return found;
}

Unknowns number_unknowns(const Constraints& c, const std::vector<bool>& pressure_is_unknown,
                         Solved solved) {
    // Statics hold the base in x. The first dynamic stage replaces this support by its reaction
    // (beginning.cpp).
    const bool base_is_free = solved == Solved::motion_and_pressure && !c.is_base.empty();
    std::vector<bool> held(c.held.size(), false);  // [masters]
    for (std::size_t d = 0; d < held.size(); ++d) {
        const bool released = base_is_free && d % 2 == 0 && c.is_base[d / 2];
        if (c.held[d] && !released) held[root_of(c.master, static_cast<std::int32_t>(d))] = true;
    }
    Unknowns unknowns;
    unknowns.of_dof.assign(held.size(), -1);
    for (std::size_t d = 0; d < held.size(); ++d) {
        const std::int32_t master = root_of(c.master, static_cast<std::int32_t>(d));
        if (held[master]) continue;
        std::int32_t& number = unknowns.of_dof[master];
        if (number < 0) number = unknowns.displacements++;
        unknowns.of_dof[d] = number;
    }
    unknowns.count = unknowns.displacements;
    if (solved == Solved::displacement || pressure_is_unknown.empty()) return unknowns;
    unknowns.of_pressure.assign(pressure_is_unknown.size(), -1);
    for (std::size_t i = 0; i < pressure_is_unknown.size(); ++i) {
        if (!pressure_is_unknown[i]) continue;
        const std::int32_t master = root_of(c.pressure_master, static_cast<std::int32_t>(i));
        std::int32_t& number = unknowns.of_pressure[master];
        if (number < 0) number = unknowns.count++;
        unknowns.of_pressure[i] = number;
    }
    return unknowns;
}

}  // namespace breach::fem
