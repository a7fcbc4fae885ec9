#include "fem_solver/solve/largest.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/quad.hpp"
#include "fem_solver/model/element.hpp"

namespace breach::fem {

namespace {

void raise(double& largest, double now) { largest = std::max(largest, now); }

/// Engineering shear strain in the plane's worst direction, the difference of principal strains.
double shear_strain(const mechanics::Voigt& e) { return std::hypot(e[0] - e[1], e[3]); }

}  // namespace

void keep_largest(const Model& model, const Motion& motion, const Beginning& beginning,
                  const std::vector<double>& excess, Largest& largest) {
    const std::size_t per_element = model.points_per_element;
    const std::size_t points = model.body.elements * per_element;
    if (largest.excess_pressure.empty()) largest.excess_pressure = excess;
    largest.r_u.resize(points);
    largest.shear_strain.resize(points);
    for (std::size_t i = 0; i < excess.size(); ++i) raise(largest.excess_pressure[i], excess[i]);
    std::vector<Eigen::Vector4d> N;  // of every element's points
    for (std::size_t g = 0; g < per_element; ++g)
        N.push_back(
            geometry::shape_functions(per_element == 1 ? Vec2(0.0, 0.0) : gauss_positions()[g]));
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        const auto& quad = model.mesh.quads[e];
        for (std::size_t g = 0; g < per_element; ++g) {
            const std::size_t p = e * per_element + g;
            double d_u = 0.0;
            for (int k = 0; k < 4; ++k) d_u += N[g][k] * excess[static_cast<std::size_t>(quad[k])];
            if (const double sigma = beginning.sigma_v0_points[p]; sigma > 0.0)
                raise(largest.r_u[p], d_u / sigma);
            raise(largest.shear_strain[p], shear_strain(motion.strain[p]));
        }
    }
}

}  // namespace breach::fem
