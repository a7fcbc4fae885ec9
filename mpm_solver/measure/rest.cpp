#include "mpm_solver/measure/rest.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <sstream>
#include <unordered_map>

namespace breach::mpm {

namespace {

/// Growth of the kinetic energy from the first to the second half of the window that counts as
/// acceleration.
constexpr double growth = 1.5;

struct Cluster {
    double mass = 0.0;
    double momentum = 0.0;  ///< mass times speed
    double moment = 0.0;    ///< mass times x
};

using Clusters = std::unordered_map<std::int32_t, Cluster>;  ///< by cell

Clusters fast_soil(const Body& body, const std::vector<std::uint8_t>& counts, double speed) {
    const Points& points = body.points;
    const Grid& grid = body.grid;
    Clusters clusters;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!counts[points.region[p]]) continue;
        const double v = std::hypot(points.vx[p], points.vy[p]);
        if (v <= speed) continue;
        Cluster& cluster = clusters[grid.cell(grid.xi(points.x[p]), grid.eta(points.y[p]))];
        cluster.mass += points.m[p];
        cluster.momentum += points.m[p] * v;
        cluster.moment += points.m[p] * points.x[p];
    }
    return clusters;
}

/// Removes the connected cells from `clusters` and returns their sum.
/// Cells of the ghost rows hold no points, so that +- 1 does not join the ends of two columns.
Cluster flood(Clusters& clusters, std::int32_t rows) {
    Cluster whole;
    std::vector<std::int32_t> open{clusters.begin()->first};
    while (!open.empty()) {
        const std::int32_t cell = open.back();
        open.pop_back();
        const auto found = clusters.find(cell);
        if (found == clusters.end()) continue;
        whole.mass += found->second.mass;
        whole.momentum += found->second.momentum;
        whole.moment += found->second.moment;
        clusters.erase(found);
        for (const std::int32_t column : {-rows, 0, rows}) {
            for (const std::int32_t row : {-1, 0, 1}) open.push_back(cell + column + row);
        }
    }
    return whole;
}

std::string per_cent(double share) {
    std::ostringstream text;
    text.precision(2);
    text << 100.0 * share << " %";
    return text.str();
}

std::string number(double value) {
    std::ostringstream text;
    text.precision(3);
    text << value;
    return text.str();
}

/// The last window.
struct Window {
    double early = 0.0;   ///< largest kinetic energy of the mobile soil in its first half [J]
    double late = 0.0;    ///< the same in its second half [J]
    double change = 0.0;  ///< largest distance of a percentile from its present value [m]
};

Window window_of(const History& history, double from) {
    const Row& now = history.back();
    Window window;
    for (const Row& row : std::views::reverse(history)) {
        double& half = row.time > 0.5 * (from + now.time) ? window.late : window.early;
        half = std::max(half, row.kinetic_mobile);
        window.change = std::max({window.change, std::abs(row.runout - now.runout),
                                  std::abs(row.runout_beyond_toe - now.runout_beyond_toe)});
        // The last row before the window counts, too: it is the state at the window's beginning.
        if (row.time <= from) break;
    }
    return window;
}

double largest_kinetic(const History& history) {
    return std::ranges::max_element(history, {}, &Row::kinetic_mobile)->kinetic_mobile;
}

std::string within(const scene::Rest& rest) {
    return " within the last " + number(rest.window) + " s";
}

/// Checks both limits of the kinetic energy.
std::optional<std::string> reason_to_go_on(const History& history, const Window& window,
                                           double scale, double mass, const scene::Rest& rest) {
    const double kinetic = std::max(window.early, window.late);
    if (kinetic > rest.kinetic_share * scale) {
        return "its kinetic energy was up to " + per_cent(kinetic / scale) +
               " of the energy released" + within(rest) + " (at rest " +
               per_cent(rest.kinetic_share) + ")";
    }
    const double peak = largest_kinetic(history);
    const bool slow = kinetic <= 0.5 * mass * rest.speed * rest.speed;
    const bool grows = window.late > growth * window.early;
    if (kinetic > rest.peak_share * peak && (!slow || grows)) {
        return "its kinetic energy was up to " + per_cent(kinetic / peak) + " of its peak" +
               within(rest) + " (at rest " + per_cent(rest.peak_share) + ")";
    }
    return std::nullopt;
}

}  // namespace

MovingBody heaviest_moving_body(const Body& body, const std::vector<std::uint8_t>& counts,
                                double speed) {
    Clusters clusters = fast_soil(body, counts, speed);
    Cluster heaviest;
    while (!clusters.empty()) {
        const Cluster each = flood(clusters, body.grid.rows);
        if (each.mass > heaviest.mass) heaviest = each;
    }
    if (heaviest.mass == 0.0) return {};
    return {heaviest.mass, heaviest.momentum / heaviest.mass, heaviest.moment / heaviest.mass};
}

double energy_scale(const scene::Rest& rest, double released, double mobile_mass) {
    return std::max(released, 0.5 * mobile_mass * rest.speed * rest.speed / rest.kinetic_share);
}

std::optional<std::string> why_moving(const History& history, const Energy& start, const Body& body,
                                      const std::vector<std::uint8_t>& counts,
                                      const scene::Rest& rest) {
    if (history.empty()) return "not checked yet";
    const Row& now = history.back();
    const double from = now.time - rest.window;
    if (now.time < rest.earliest || from < history.front().time) {
        return "it was not followed for " + number(std::max(rest.earliest, rest.window)) +
               " s, the least that can tell";
    }
    // The moving bodies come last: finding them costs most.
    const double mass = mass_of(body.points, counts);
    const Energy then{.gravitational = now.gravitational_energy, .shaking = now.shaking_work};
    const double scale = energy_scale(rest, released(start, then), mass);
    const Window window = window_of(history, from);
    if (auto reason = reason_to_go_on(history, window, scale, mass, rest)) return reason;
    if (window.change > rest.change) {
        return "its front moved by " + number(window.change) + " m" + within(rest) + " (at rest " +
               number(rest.change) + " m)";
    }
    const MovingBody moving = heaviest_moving_body(body, counts, rest.speed);
    if (moving.mass > rest.body_share * mass) {
        return "a connected body of " + per_cent(moving.mass / mass) +
               " of it around x = " + number(moving.x) + " m moves at " + number(moving.speed) +
               " m/s (at rest " + number(rest.speed) + " m/s)";
    }
    return std::nullopt;
}

}  // namespace breach::mpm
