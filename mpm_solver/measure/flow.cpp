#include "mpm_solver/measure/flow.hpp"

#include <algorithm>
#include <cmath>

#include "mpm_solver/measure/runout.hpp"

namespace breach::mpm {

namespace {

/// Weighted volume, mass and momentum.
struct Sums {
    double V = 0.0;
    double m = 0.0;
    double mv = 0.0;
    std::int32_t count = 0;

    void add(const Points& points, std::size_t p, double weight) {
        V += weight * points.soil_volume(p);
        m += weight * points.m[p];
        mv += weight * points.m[p] * points.vx[p];
        ++count;
    }
    void add(const Sums& part) {
        V += part.V;
        m += part.m;
        mv += part.mv;
        count += part.count;
    }
    Flow over(double area) const { return {V / area, m > 0.0 ? mv / m : 0.0, count}; }
};

/// Integral of the hat function about x within the grid [m].
/// Half a hat at an end of the grid: without this, depths there would read half.
double hat_width(const FlowView& view, double x) {
    const auto half = [&](double room) {
        const double s = std::clamp(room / view.width, 0.0, 1.0);
        return view.width * s * (1.0 - 0.5 * s);
    };
    return half(x - view.low) + half(view.high - x);
}

std::size_t columns(const FlowView& view) {
    return static_cast<std::size_t>(std::lround((view.high - view.low) / view.width)) + 1;
}

}  // namespace

FlowView flow_view(const scene::Scene& scene, const Grid& grid) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    return {mobile_regions(scene), grid.h, scene.thickness, mpm.domain_x[0], mpm.domain_x[1]};
}

Flow flow_at(const Points& points, const FlowView& view, double x) {
    Sums sums;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double weight = 1.0 - std::abs(points.x[p] - x) / view.width;
        if (weight > 0.0 && view.mobile[points.region[p]]) sums.add(points, p, weight);
    }
    return sums.over(hat_width(view, x) * view.thickness);
}

std::vector<Flow> flow_profile(const Points& points, const FlowView& view) {
    std::vector<Sums> sums(columns(view));
    const auto last_cell = static_cast<std::int32_t>(sums.size()) - 2;
    const double per_width = 1.0 / view.width;
    // Sums of the cell between two columns: successive points are mostly in the same one.
    std::int32_t cell = 0;
    Sums to_left;
    Sums to_right;
    // Nearly all additions stay in two local sums instead of the two columns' entries.
    const auto keep = [&] {
        sums[cell].add(to_left);
        sums[cell + 1].add(to_right);
        to_left = to_right = {};
    };
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!view.mobile[points.region[p]]) continue;
        const double xi = (points.x[p] - view.low) * per_width;
        const std::int32_t here = std::clamp(static_cast<std::int32_t>(xi), 0, last_cell);
        if (here != cell) {
            keep();
            cell = here;
        }
        const double share = std::clamp(xi - static_cast<double>(here), 0.0, 1.0);
        to_left.add(points, p, 1.0 - share);
        to_right.add(points, p, share);
    }
    keep();
    const std::vector<double> places = profile_places(view);
    std::vector<Flow> profile;
    for (std::size_t k = 0; k < sums.size(); ++k) {
        profile.push_back(sums[k].over(hat_width(view, places[k]) * view.thickness));
    }
    return profile;
}

Flow without_grains(const Flow& flow) {
    return flow.points < fewest_points_of_a_flow ? Flow{} : flow;
}

std::vector<Flow> without_grains(std::vector<Flow> profile) {
    for (Flow& flow : profile) flow = without_grains(flow);
    return profile;
}

double fastest_of(const std::vector<double>& depths, const std::vector<double>& velocities,
                  double depth) {
    double fastest = 0.0;
    for (std::size_t k = 0; k < depths.size(); ++k)
        if (depths[k] >= depth) fastest = std::max(fastest, std::abs(velocities[k]));
    return fastest;
}

std::vector<double> profile_places(const FlowView& view) {
    std::vector<double> places(columns(view));
    for (std::size_t k = 0; k < places.size(); ++k) {
        places[k] = view.low + static_cast<double>(k) * view.width;
    }
    return places;
}

std::vector<double> ground_profile(const Points& points, const FlowView& view,
                                   std::vector<double> bottom) {
    FlowView standing = view;
    for (std::uint8_t& counts : standing.mobile) counts = counts ? 0 : 1;
    const std::vector<Flow> stands = flow_profile(points, standing);
    for (std::size_t k = 0; k < bottom.size(); ++k) bottom[k] += stands[k].depth;
    return bottom;
}

std::vector<double> surface_profile(const Points& points, const FlowView& view,
                                    std::vector<double> ground) {
    for (std::size_t p = 0; p < points.size(); ++p) {
        // Upper edge of a square of the point's volume.
        const double top = points.y[p] + 0.5 * std::sqrt(points.soil_volume(p) / view.thickness);
        const auto k = static_cast<std::size_t>(std::lround((points.x[p] - view.low) / view.width));
        ground[k] = std::max(ground[k], top);
    }
    return ground;
}

double front_of(const std::vector<Flow>& profile, const FlowView& view, double depth) {
    for (std::size_t k = profile.size(); k-- > 0;) {
        if (profile[k].depth < depth) continue;
        const double x = view.low + static_cast<double>(k) * view.width;
        if (k + 1 == profile.size()) return x;
        return x +
               view.width * (profile[k].depth - depth) / (profile[k].depth - profile[k + 1].depth);
    }
    return nowhere;
}

void Profiles::add(double time, const std::vector<Flow>& profile) {
    times.push_back(time);
    for (const Flow& flow : profile) {
        depths.push_back(flow.depth);
        velocities.push_back(flow.velocity);
    }
}

void store(const Profiles& profiles, const FlowView& view, const std::string& prefix,
           exchange::Archive& archive) {
    const auto put = [&](const char* name, const char* unit, const std::vector<double>& values) {
        archive.reals[prefix + "profile." + name] = values;
        archive.units[prefix + "profile." + name] = unit;
    };
    put("x", "m", profile_places(view));
    put("times", "s", profiles.times);
    put("depths", "m", profiles.depths);
    put("velocities", "m/s", profiles.velocities);
}

Profiles load_profiles(const exchange::Archive& archive, const std::string& prefix) {
    return {archive.reals.at(prefix + "profile.times"), archive.reals.at(prefix + "profile.depths"),
            archive.reals.at(prefix + "profile.velocities")};
}

}  // namespace breach::mpm
