#include "mpm_solver/measure/guard.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace breach::mpm {

namespace {

/// Soil that has opened everywhere (spray) may reach this multiple of its volume; more is
/// numerical.
constexpr double largest_volume_ratio = 2.5;
/// Multiple of wave speed plus free fall through the whole grid.
constexpr double runaway_factor = 3.0;

std::string place(const Points& points, std::size_t p) {
    std::ostringstream text;
    text << "point " << points.number[p] << " at (" << points.x[p] << ", " << points.y[p]
         << ") m, velocity (" << points.vx[p] << ", " << points.vy[p] << ") m/s";
    return text.str();
}

std::string lost_where(const Grid& grid, double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return "is nowhere (not a number)";
    if (x < grid.low.x()) return "reached the left end of the grid; enlarge /mpm/domain_x";
    if (x > grid.high.x()) return "reached the right end of the grid; enlarge /mpm/domain_x";
    if (y > grid.high.y()) return "reached the top of the grid; enlarge /mpm/domain_y";
    return "went through the floor";
}

std::size_t worst_point(const Points& points) {
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!std::isfinite(points.vx[p]) || !std::isfinite(points.vy[p])) return p;
    }
    std::size_t worst = 0;
    for (std::size_t p = 1; p < points.size(); ++p) {
        if (std::hypot(points.vx[p], points.vy[p]) >
            std::hypot(points.vx[worst], points.vy[worst])) {
            worst = p;
        }
    }
    return worst;
}

}  // namespace

Limits limits_of(const Body& body, const scene::Mpm& mpm, const Energy& start, double swing) {
    const double g = body.gravity.norm();
    const double fall = std::sqrt(2.0 * g * (body.grid.high - body.grid.low).norm());
    const double mass = std::accumulate(body.points.m.begin(), body.points.m.end(), 0.0);
    return {.speed = runaway_factor * (wave_speed(body) + fall + body.tally.fastest + swing),
            .energy_gain = mpm.largest_energy_gain,
            // A stable slope releases almost nothing: at least a fall of a hundredth of a cell, and
            // the energy that the soil starts with, are the scale of a gain.
            .energy_floor = start.elastic + start.kinetic + 0.01 * mass * g * body.grid.h,
            .volume_ratio = largest_volume_ratio};
}

std::optional<std::string> step_complaint(const Body& body, const Limits& limits) {
    const Points& points = body.points;
    if (body.tally.lost != Tally::none) {
        const std::size_t p = body.tally.lost;
        return place(points, p) + " " + lost_where(body.grid, points.x[p], points.y[p]);
    }
    if (!std::isfinite(body.tally.kinetic)) {
        return place(points, worst_point(points)) + " has a velocity that is not a number";
    }
    if (body.tally.fastest > limits.speed) {
        std::ostringstream text;
        text << place(points, worst_point(points)) << " has run away: no point should exceed "
             << limits.speed << " m/s; try a smaller /mpm/cfl";
        return text.str();
    }
    return std::nullopt;
}

std::optional<std::string> ground_complaint(const Body& body) {
    if (!body.grid.terrain) return std::nullopt;
    const Points& points = body.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (body.grid.terrain->distance({points.x[p], points.y[p]}) >= -body.grid.h) continue;
        return place(points, p) + " sank into the terrain; try smaller cells or /mpm/cfl";
    }
    return std::nullopt;
}

std::optional<std::string> budget_complaint(const Limits& limits, const Energy& start,
                                            const Energy& now, double volume_ratio) {
    const double gain = -numerical_loss(start, now);
    const double scale = std::max(released(start, now), limits.energy_floor);
    std::ostringstream text;
    if (!(gain <= limits.energy_gain * scale)) {
        text << "the scheme made " << gain << " J, " << gain / scale
             << " of the energy released (/mpm/largest_energy_gain allows " << limits.energy_gain
             << ")";
        return text.str();
    }
    if (!(volume_ratio < limits.volume_ratio && volume_ratio > 1.0 / limits.volume_ratio)) {
        text << "the soil's volume is " << volume_ratio << " of what it was";
        return text.str();
    }
    return std::nullopt;
}

}  // namespace breach::mpm
