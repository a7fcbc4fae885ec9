#include "fem_solver/model/element.hpp"

#include <Eigen/LU>
#include <cmath>

namespace breach::fem {

const std::array<Vec2, gauss_points>& gauss_positions() {
    static const double a = 1.0 / std::sqrt(3.0);
    static const std::array<Vec2, gauss_points> positions{Vec2(-a, -a), Vec2(a, -a), Vec2(a, a),
                                                          Vec2(-a, a)};
    return positions;
}

void evaluate_gradients(const Corners& x, double thickness, Gradients& out) {
    // The same for every element: in natural coordinates the points have fixed places.
    static const std::array<Gradient, gauss_points> natural = [] {
        std::array<Gradient, gauss_points> all;
        for (std::size_t g = 0; g < gauss_points; ++g) {
            all[g] = geometry::shape_gradients(gauss_positions()[g]);
        }
        return all;
    }();
    for (std::size_t g = 0; g < gauss_points; ++g) {
        const mechanics::Matrix2 J = natural[g] * x.transpose();
        const double det_J = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
        mechanics::Matrix2 inverse;
        inverse << J(1, 1), -J(0, 1), -J(1, 0), J(0, 0);
        out.dN[g].noalias() = (inverse / det_J) * natural[g];
        out.weight[g] = det_J * thickness;
    }
}

void evaluate_quadrature(const Gradients& gradients, Quadrature& out) {
    Gradient mean = Gradient::Zero();
    double volume = 0.0;
    for (std::size_t g = 0; g < gauss_points; ++g) {
        mean += gradients.weight[g] * gradients.dN[g];
        volume += gradients.weight[g];
    }
    mean /= volume;
    for (std::size_t g = 0; g < gauss_points; ++g) {
        const Gradient& dN = gradients.dN[g];
        StrainOperator& B = out.B[g];
        for (int i = 0; i < 4; ++i) {
            const double nx = dN(0, i), ny = dN(1, i);
            const double shift_x = 0.5 * (mean(0, i) - nx), shift_y = 0.5 * (mean(1, i) - ny);
            B(0, 2 * i) = nx + shift_x;
            B(0, 2 * i + 1) = shift_y;
            B(1, 2 * i) = shift_x;
            B(1, 2 * i + 1) = ny + shift_y;
            B(2, 2 * i) = ny;
            B(2, 2 * i + 1) = nx;
        }
        out.weight[g] = gradients.weight[g];
    }
}

Eigen::Vector4d nodal_volumes(const Corners& x, double thickness) {
    Gradients gradients;
    evaluate_gradients(x, thickness, gradients);
    Eigen::Vector4d volumes = Eigen::Vector4d::Zero();
    for (std::size_t g = 0; g < gauss_points; ++g) {
        volumes += gradients.weight[g] * shape_functions(gauss_positions()[g]);
    }
    return volumes;
}

}  // namespace breach::fem
