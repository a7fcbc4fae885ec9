#include "mpm_solver/overlap.hpp"

#include <algorithm>

namespace breach::mpm {

namespace {

/// Integral of every node's weight over the places a point can take, by the midpoint rule.
std::vector<double> capacities(const GimpKernel& kernel, const WallRows& walls, std::int32_t rows,
                               double h) {
    constexpr int samples = 200;  // per cell; the weights are quadratic
    std::vector<double> capacity(rows, 0.0);
    for (std::int32_t cell = 1; cell < rows - 2; ++cell) {
        for (int k = 0; k < samples; ++k) {
            const Stencil s = kernel(cell + (k + 0.5) / samples, walls);
            for (int i = 0; i < 3; ++i) capacity[s.first + i] += s.N[i] * h / samples;
        }
    }
    return capacity;
}

template <class Visit>
void for_each_weight(const Body& body, std::size_t p, Visit&& visit) {
    const GimpKernel kernel(body.gimp_half_size);
    const Grid& grid = body.grid;
    const Stencil sx = kernel(grid.xi(body.points.x[p]), grid.walls_x);
    const Stencil sy = kernel(grid.eta(body.points.y[p]), grid.walls_y);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            visit(sx.first + i, sy.first + j, sx.N[i] * sy.N[j]);
        }
    }
}

}  // namespace

OverlapMeter::OverlapMeter(const Body& body, double thickness)
    : capacity_x_(capacities(GimpKernel(body.gimp_half_size), body.grid.walls_x, body.grid.columns,
                             body.grid.h)),
      capacity_y_(capacities(GimpKernel(body.gimp_half_size), body.grid.walls_y, body.grid.rows,
                             body.grid.h)),
      thickness_(thickness),
      filled_(body.grid.mass.size(), 0.0) {}

void OverlapMeter::fill_nodes(const Body& body) {
    std::fill(filled_.begin(), filled_.end(), 0.0);
    const Points& points = body.points;
    const std::int32_t rows = body.grid.rows;
    for (std::size_t p = 0; p < points.size(); ++p) {
        for_each_weight(body, p, [&](std::int32_t i, std::int32_t j, double N) {
            filled_[i * rows + j] += points.V[p] * N;
        });
    }
}

double OverlapMeter::fill_at(std::int32_t i, std::int32_t j) const {
    const double capacity = capacity_x_[i] * capacity_y_[j] * thickness_;
    const auto rows = static_cast<std::int32_t>(capacity_y_.size());
    return capacity > 0.0 ? filled_[i * rows + j] / capacity : 0.0;
}

double OverlapMeter::measure(const Body& body) {
    fill_nodes(body);
    const Points& points = body.points;
    double excess = 0.0;
    double volume = 0.0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        for_each_weight(body, p, [&](std::int32_t i, std::int32_t j, double N) {
            if (N > 0.0) excess += points.V[p] * N * std::max(fill_at(i, j) - 1.0, 0.0);
        });
        volume += points.V[p];
    }
    return volume > 0.0 ? excess / volume : 0.0;
}

void OverlapMeter::mark(Body& body, double tolerance) {
    fill_nodes(body);
    for (std::size_t p = 0; p < body.points.size(); ++p) {
        double excess = 0.0;
        for_each_weight(body, p, [&](std::int32_t i, std::int32_t j, double N) {
            if (N > 0.0) excess += N * std::max(fill_at(i, j) - 1.0 - tolerance, 0.0);
        });
        body.points.excess[p] = excess;
    }
}

}  // namespace breach::mpm
