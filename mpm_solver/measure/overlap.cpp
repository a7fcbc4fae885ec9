#include "mpm_solver/measure/overlap.hpp"

#include <algorithm>
#include <cmath>

namespace breach::mpm {

namespace {

/// Integral of every node's weight over the possible positions of a point, by the midpoint rule.
std::vector<double> capacities(const Body& body, const WallRows& walls, std::int32_t rows) {
    constexpr int samples = 200;  // per cell; the weights are quadratic
    std::vector<double> capacity(rows, 0.0);
    const GimpKernel kernel(body.gimp_half_size);
    for (std::int32_t cell = 1; cell < rows - 2; ++cell) {
        for (int k = 0; k < samples; ++k) {
            const auto s = kernel(cell + (k + 0.5) / samples, walls);
            double* node = &capacity[static_cast<std::size_t>(s.first)];
            for (int i = 0; i < 3; ++i) node[i] += s.N[i] * body.grid.h / samples;
        }
    }
    return capacity;
}

constexpr std::size_t points_of_task = 1024;

/// Calls visit(p, i, j, weight) for these points and each of their nodes.
template <class Visit>
void for_each_weight(const Body& body, Span span, Visit&& visit) {
    const Grid& grid = body.grid;
    const GimpKernel kernel(body.gimp_half_size);
    for (std::size_t p = span.begin; p < span.end; ++p) {
        const auto sx = kernel(grid.xi(body.points.x[p]), grid.walls_x);
        const auto sy = kernel(grid.eta(body.points.y[p]), grid.walls_y);
        const auto first_i = static_cast<std::int32_t>(sx.first);
        const auto first_j = static_cast<std::int32_t>(sy.first);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                visit(p, first_i + i, first_j + j, sx.N[i] * sy.N[j]);
            }
        }
    }
}

/// Over all points, on several threads: `work` writes only points in its span.
template <class Work>
void for_spans(const Body& body, Work&& work) {
    const std::size_t points = body.points.size();
    body.team->share((points + points_of_task - 1) / points_of_task, [&](std::size_t task) {
        const std::size_t begin = task * points_of_task;
        work(Span{begin, std::min(begin + points_of_task, points)});
    });
}

}  // namespace

OverlapMeter::OverlapMeter(const Body& body, double thickness)
    : capacity_x_(capacities(body, body.grid.walls_x, body.grid.columns)),
      capacity_y_(capacities(body, body.grid.walls_y, body.grid.rows)),
      thickness_(thickness) {}

void OverlapMeter::fill_nodes(const Body& body, std::vector<double>& fill) const {
    fill.assign(body.grid.nodes(), 0.0);
    const Points& points = body.points;
    const std::int32_t rows = body.grid.rows;
    // On one thread: a node's sum must not depend on the number of threads.
    for_each_weight(body, {0, points.size()},
                    [&](std::size_t p, std::int32_t i, std::int32_t j, double N) {
                        fill[i * rows + j] += points.V[p] * N;
                    });
    for (std::int32_t i = 0; i < body.grid.columns; ++i) {
        for (std::int32_t j = 0; j < rows; ++j) {
            double& node = fill[i * rows + j];
            if (node == 0.0) continue;
            // Capacities are integrals of the same kernel: uniformly filled soil has a fill of 1
            // beside a wall, too.
            const double capacity = capacity_x_[i] * capacity_y_[j] * thickness_;
            node = capacity > 0.0 ? node / capacity : 0.0;
        }
    }
}

double OverlapMeter::measure(const Body& body, const std::vector<std::uint8_t>& mobile) const {
    std::vector<double> fill;
    fill_nodes(body, fill);
    const Points& points = body.points;
    const std::int32_t rows = body.grid.rows;
    double excess = 0.0;
    for_each_weight(body, {0, points.size()},
                    [&](std::size_t p, std::int32_t i, std::int32_t j, double N) {
                        if (N > 0.0 && mobile[points.region[p]])
                            excess += points.V[p] * N * std::max(fill[i * rows + j] - 1.0, 0.0);
                    });
    double volume = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p)
        if (mobile[points.region[p]]) volume += points.V[p];
    return volume > 0.0 ? excess / volume : 0.0;
}

void OverlapMeter::mark(Body& body, double tolerance) {
    fill_nodes(body, fill_);
    Points& points = body.points;
    const std::int32_t rows = body.grid.rows;
    for_spans(body, [&](Span span) {
        std::fill(&points.excess[span.begin], points.excess.data() + span.end, 0.0);
        for_each_weight(body, span, [&](std::size_t p, std::int32_t i, std::int32_t j, double N) {
            if (N > 0.0)
                points.excess[p] += N * std::max(fill_[i * rows + j] - 1.0 - tolerance, 0.0);
        });
    });
}

void OverlapMeter::hold_gaps_to_room(Body& body) {
    fill_nodes(body, fill_);
    Points& points = body.points;
    fill_about_.assign(points.size(), 0.0);
    const std::int32_t rows = body.grid.rows;
    for_spans(body, [&](Span span) {
        for_each_weight(body, span, [&](std::size_t p, std::int32_t i, std::int32_t j, double N) {
            fill_about_[p] += N * fill_[i * rows + j];
        });
        for (std::size_t p = span.begin; p < span.end; ++p) {
            // At a fill of 1 the point's share is its own volume; crowded nodes leave it less.
            const double room = points.V[p] / fill_about_[p];
            if (points.gap[p] <= 0.0 || points.volume[p] <= room) continue;
            const double closing = std::min(std::log(points.volume[p] / room), points.gap[p]);
            points.gap[p] -= closing;
            // A gap is a logarithmic strain (Points::soil_volume).
            points.volume[p] *= std::exp(-closing);
        }
    });
}

}  // namespace breach::mpm
