#include "transfer_tool/gauss_fields.hpp"

#include <algorithm>
#include <memory>
#include <mutex>
#include <nanoflann.hpp>
#include <optional>
#include <thread>

#include "core/fault/fault.hpp"

namespace breach::transfer {
namespace {

using exchange::MeshSnapshot;

constexpr std::size_t largest_dense_system = 16384;  // 2 GiB of coefficients

std::vector<Vec2> gauss_places(const MeshSnapshot& mesh) {
    std::vector<Vec2> places;
    places.reserve(mesh.stress.size());
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        const Corners x = deformed_corners(mesh, e);
        for (const Vec2& xi : mesh.gauss_positions) places.emplace_back(x * shape_functions(xi));
    }
    return places;
}

/// The Gauss points of one region as nanoflann wants to see them.
struct Cloud {
    std::vector<std::size_t> gauss;  ///< numbers in the mesh
    const std::vector<Vec2>* places;

    std::size_t kdtree_get_point_count() const { return gauss.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t direction) const {
        return (*places)[gauss[i]][static_cast<Eigen::Index>(direction)];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

class Neighbourhoods {
  public:
    Neighbourhoods(const MeshSnapshot& mesh, const std::vector<Vec2>& places, std::size_t wanted)
        : clouds_(mesh.regions.size()), wanted_(wanted) {
        const std::size_t per_element = mesh.gauss_positions.size();
        for (Cloud& cloud : clouds_) cloud.places = &places;
        for (std::size_t e = 0; e < mesh.quads.size(); ++e)
            for (std::size_t g = 0; g < per_element; ++g)
                clouds_[mesh.region_of_element[e]].gauss.push_back(e * per_element + g);
        for (const Cloud& cloud : clouds_) trees_.push_back(std::make_unique<Tree>(2, cloud));
    }

    /// Numbers of the Gauss points of `region` nearest to `place`, ascending.
    std::vector<std::size_t> nearest(std::size_t region, const Vec2& place) const {
        std::vector<std::size_t> found(std::min(wanted_, clouds_[region].gauss.size()));
        std::vector<double> distance(found.size());
        found.resize(
            trees_[region]->knnSearch(place.data(), found.size(), found.data(), distance.data()));
        for (std::size_t& i : found) i = clouds_[region].gauss[i];
        std::ranges::sort(found);
        return found;
    }

  private:
    using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>,
                                                     Cloud, 2, std::size_t>;
    std::vector<Cloud> clouds_;
    std::size_t wanted_;
    std::vector<std::unique_ptr<Tree>> trees_;
};

/// Number of the mesh's Gauss point at these natural coordinates, or -1.
int coinciding_gauss(const MeshSnapshot& mesh, const Vec2& xi) {
    for (std::size_t g = 0; g < mesh.gauss_positions.size(); ++g)
        if ((mesh.gauss_positions[g] - xi).cwiseAbs().maxCoeff() < 1e-12)
            return static_cast<int>(g);
    return -1;
}

/// Work on [0, count) shared among threads: part(begin, end).
template <typename Part>
void share(std::size_t count, int threads, Part part) {
    const auto n = static_cast<std::size_t>(std::max(1, threads));
    std::vector<std::jthread> workers;
    for (std::size_t t = 1; t < n; ++t)
        workers.emplace_back([=] { part(count * t / n, count * (t + 1) / n); });
    part(std::size_t{0}, count / n);
}

/// Where the values come from.
struct Source {
    const MeshSnapshot& mesh;
    const Values& at_gauss;
    const std::vector<Vec2>& places;
};

LocalInterpolant interpolant_of(const Source& from, const Neighbourhoods& neighbourhoods,
                                std::size_t element, GaussFieldReport& report) {
    const Vec2 middle = deformed_corners(from.mesh, element).rowwise().mean();
    const std::vector<std::size_t> near =
        neighbourhoods.nearest(from.mesh.region_of_element[element], middle);
    std::vector<Vec2> where;
    Values value(static_cast<Eigen::Index>(near.size()), from.at_gauss.cols());
    for (const std::size_t g : near) {
        value.row(static_cast<Eigen::Index>(where.size())) =
            from.at_gauss.row(static_cast<Eigen::Index>(g));
        where.push_back(from.places[g]);
    }
    const Centres centres = merge_coincident(where, value);
    report.merged_centres += centres.merged;
    report.smallest_neighbourhood =
        std::min(report.smallest_neighbourhood, centres.position.size());
    return LocalInterpolant(centres);
}

void carry_element(const Source& from, const Neighbourhoods& neighbourhoods, const Points& points,
                   std::size_t element, Values& to, GaussFieldReport& report) {
    std::optional<LocalInterpolant> interpolant;
    for (std::size_t p = points.first[element]; p < points.first[element + 1]; ++p) {
        auto value = to.row(static_cast<Eigen::Index>(p));
        const int gauss = coinciding_gauss(from.mesh, points.xi[p]);
        if (gauss >= 0) {
            const std::size_t first = element * from.mesh.gauss_positions.size();
            value = from.at_gauss.row(static_cast<Eigen::Index>(first) + gauss);
            continue;
        }
        if (!interpolant)
            interpolant.emplace(interpolant_of(from, neighbourhoods, element, report));
        interpolant->at(points.state.position[p], value);
    }
}

Interpolated interpolate_locally(const Source& from, std::size_t neighbours, int threads,
                                 const Points& points) {
    const Neighbourhoods neighbourhoods(from.mesh, from.places, neighbours);
    Interpolated result{Values(static_cast<Eigen::Index>(points.xi.size()), from.at_gauss.cols()),
                        {.smallest_neighbourhood = from.places.size()}};
    std::mutex reporting;
    share(from.mesh.quads.size(), threads, [&](std::size_t begin, std::size_t end) {
        GaussFieldReport own{.smallest_neighbourhood = from.places.size()};
        for (std::size_t e = begin; e < end; ++e)
            carry_element(from, neighbourhoods, points, e, result.value, own);
        const std::lock_guard lock(reporting);
        result.report.merged_centres += own.merged_centres;
        result.report.smallest_neighbourhood =
            std::min(result.report.smallest_neighbourhood, own.smallest_neighbourhood);
    });
    return result;
}

void refuse_too_many(std::size_t centres) {
    if (centres <= largest_dense_system) return;
    throw fault::BadInput(
        "scene", {{"/transfer/interpolation",
                   "\"paper\" solves one dense system of all " + std::to_string(centres) +
                       " Gauss points (at most " + std::to_string(largest_dense_system) + ")",
                   "use \"local\""}});
}

Interpolated interpolate_globally(const Source& from, int threads, const Points& points) {
    refuse_too_many(from.places.size());
    Centres centres = merge_coincident(from.places, from.at_gauss);
    Interpolated result{
        Values(static_cast<Eigen::Index>(points.xi.size()), from.at_gauss.cols()),
        {.merged_centres = centres.merged, .smallest_neighbourhood = centres.position.size()}};
    const GlobalInterpolant interpolant(std::move(centres));
    share(points.xi.size(), threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p)
            interpolant.at(points.state.position[p],
                           result.value.row(static_cast<Eigen::Index>(p)));
    });
    return result;
}

/// epsilon_q is a norm: what the interpolant lets swing below zero is set to zero.
std::vector<double> not_negative(const Values& values, Eigen::Index column, std::size_t& raised) {
    std::vector<double> result(static_cast<std::size_t>(values.rows()));
    for (Eigen::Index p = 0; p < values.rows(); ++p) {
        if (values(p, column) < 0.0) ++raised;
        result[p] = std::max(0.0, values(p, column));
    }
    return result;
}

}  // namespace

Interpolated interpolate(const MeshSnapshot& mesh, const Values& at_gauss,
                         const scene::Transfer& settings, int threads, const Points& points) {
    const std::vector<Vec2> places = gauss_places(mesh);
    const Source from{mesh, at_gauss, places};
    if (settings.interpolation == scene::Interpolation::paper)
        return interpolate_globally(from, threads, points);
    return interpolate_locally(from, static_cast<std::size_t>(settings.neighbours), threads,
                               points);
}

GaussFieldReport carry_gauss_fields(const MeshSnapshot& mesh, const scene::Transfer& settings,
                                    int threads, Points& points) {
    Values at_gauss(static_cast<Eigen::Index>(mesh.stress.size()), 6);
    for (Eigen::Index g = 0; g < at_gauss.rows(); ++g)
        at_gauss.row(g) << mesh.stress[g].transpose(), mesh.epsilon_q[g], mesh.epsilon_q_plastic[g];
    Interpolated carried = interpolate(mesh, at_gauss, settings, threads, points);
    exchange::ParticleState& s = points.state;
    s.stress.resize(s.size());
    for (Eigen::Index p = 0; p < carried.value.rows(); ++p)
        s.stress[p] = carried.value.row(p).head<4>();
    s.epsilon_q = not_negative(carried.value, 4, carried.report.raised_strains);
    s.epsilon_q_plastic = not_negative(carried.value, 5, carried.report.raised_strains);
    return carried.report;
}

}  // namespace breach::transfer
