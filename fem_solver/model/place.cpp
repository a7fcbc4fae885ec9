#include "fem_solver/model/place.hpp"

#include <algorithm>

namespace breach::fem {

materials::Place Overburden::place(const Model& model, std::size_t point) const {
    const std::size_t e = point / model.points_per_element;
    const Corners x = corners_of(model.mesh, e);
    const Vec2 at =
        model.points_per_element == 1
            ? Vec2(x.rowwise().mean())
            : Vec2(x * shape_functions(gauss_positions()[point % model.points_per_element]));
    // The highest ground above the point: below an overhang or a pond's floor there are several
    // edges.
    double top = at.y();
    for (const GroundEdge& edge : edges_) {
        Vec2 a = model.mesh.nodes[edge.a], b = model.mesh.nodes[edge.b];
        if (a.x() > b.x()) std::swap(a, b);
        if (at.x() < a.x() || at.x() > b.x() || a.x() == b.x()) continue;
        const double share = (at.x() - a.x()) / (b.x() - a.x());
        top = std::max(top, a.y() + share * (b.y() - a.y()));
    }
    return {.depth = top - at.y(), .elevation = at.y(), .sigma_v0 = 0.0};
}

}  // namespace breach::fem
