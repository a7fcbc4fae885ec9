#include "transfer_tool/gauss_fields.hpp"

#include <algorithm>
#include <cmath>

namespace breach::transfer {
namespace {

using exchange::MeshSnapshot;

constexpr double coinciding = 1e-12;        // in natural coordinates
constexpr double strain_round_off = 1e-12;  // of a strain

/// Index of the Gauss point at these natural coordinates, or -1.
int gauss_at(const MeshSnapshot& mesh, const Vec2& xi) {
    for (std::size_t g = 0; g < mesh.gauss_positions.size(); ++g)
        if ((mesh.gauss_positions[g] - xi).cwiseAbs().maxCoeff() < coinciding)
            return static_cast<int>(g);
    return -1;
}

/// Groups are elements: their regions and middles.
Targets element_groups(const MeshSnapshot& mesh, const Points& points) {
    Targets to;
    to.region = mesh.region_of_element;
    for (const Corners& x : points.shape) to.middle.emplace_back(x.rowwise().mean());
    return to;
}

Targets points_as_targets(const MeshSnapshot& mesh, const Points& points) {
    Targets to = element_groups(mesh, points);
    to.place = points.state.position;
    to.first = points.first;
    const auto per_element = static_cast<std::int64_t>(mesh.gauss_positions.size());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e)
        for (std::size_t p = points.first[e]; p < points.first[e + 1]; ++p) {
            // Where the FEM has 2 x 2 Gauss points, the default points lie on them: nothing is
            // interpolated then.
            const int gauss = gauss_at(mesh, points.xi[p]);
            to.same.push_back(gauss < 0 ? -1 : static_cast<std::int64_t>(e) * per_element + gauss);
        }
    return to;
}

/// epsilon_q is a norm: sets negative interpolated values to zero.
std::vector<double> not_negative(const Values& values, Eigen::Index column, std::size_t& raised) {
    std::vector<double> result(static_cast<std::size_t>(values.rows()));
    for (Eigen::Index p = 0; p < values.rows(); ++p) {
        if (values(p, column) < -strain_round_off) ++raised;
        result[p] = std::max(0.0, values(p, column));
    }
    return result;
}

}  // namespace

Sources gauss_points(const MeshSnapshot& mesh, const Points& points) {
    Sources from;
    from.regions = mesh.regions.size();
    from.place.reserve(mesh.stress.size());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e)
        // In the shapes of the points, which differ from the mesh where an element was rebuilt.
        for (const Vec2& xi : mesh.gauss_positions) {
            from.place.emplace_back(points.shape[e] * shape_functions(xi));
            from.region.push_back(mesh.region_of_element[e]);
        }
    return from;
}

std::optional<Interpolated> interpolate(const MeshSnapshot& mesh, const Values& at_gauss,
                                        const scene::Transfer& settings, const Work& work,
                                        const Points& points) {
    return interpolate(gauss_points(mesh, points), at_gauss, points_as_targets(mesh, points),
                       settings, work);
}

std::optional<GaussFieldReport> carry_gauss_fields(const MeshSnapshot& mesh,
                                                   const scene::Transfer& settings,
                                                   const Work& work, Points& points) {
    Values at_gauss(static_cast<Eigen::Index>(mesh.stress.size()), 6);
    for (Eigen::Index g = 0; g < at_gauss.rows(); ++g)
        at_gauss.row(g) << mesh.stress[g].transpose(), mesh.epsilon_q[g], mesh.epsilon_q_plastic[g];
    auto carried = interpolate(mesh, at_gauss, settings, work, points);
    if (!carried) return std::nullopt;
    exchange::ParticleState& s = points.state;
    points.effective_stress.resize(s.size());
    for (Eigen::Index p = 0; p < carried->value.rows(); ++p)
        // Effective stress is interpolated, total stress formed later (settle_stress): pore
        // pressure has values at the nodes and needs no interpolation between Gauss points.
        points.effective_stress[p] = carried->value.row(p).head<4>();
    s.epsilon_q = not_negative(carried->value, 4, carried->report.raised_strains);
    s.epsilon_q_plastic = not_negative(carried->value, 5, carried->report.raised_strains);
    return carried->report;
}

}  // namespace breach::transfer
