#include "core/geometry/quad.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "core/geometry/polyline.hpp"

namespace breach::geometry {
namespace {

constexpr int side_xi[4] = {-1, 1, 1, -1};
constexpr int side_eta[4] = {-1, -1, 1, 1};

}  // namespace

Eigen::Vector4d shape_functions(const Vec2& xi) {
    Eigen::Vector4d N;
    for (int i = 0; i < 4; ++i)
        N[i] = 0.25 * (1.0 + side_xi[i] * xi.x()) * (1.0 + side_eta[i] * xi.y());
    return N;
}

Corners shape_gradients(const Vec2& xi) {
    Corners dN;
    for (int i = 0; i < 4; ++i) {
        dN(0, i) = 0.25 * side_xi[i] * (1.0 + side_eta[i] * xi.y());
        dN(1, i) = 0.25 * side_eta[i] * (1.0 + side_xi[i] * xi.x());
    }
    return dN;
}

Matrix2 jacobian(const Corners& x, const Vec2& xi) {
    // Relative to a corner: 500 km from the origin the sum would lose the digits of an element's
    // size.
    return (x.colwise() - x.col(0)) * shape_gradients(xi).transpose();
}

Eigen::Vector4d corner_jacobians(const Corners& x) {
    Eigen::Vector4d J;
    for (int k = 0; k < 4; ++k) {
        const Vec2 ahead = x.col((k + 1) % 4) - x.col(k);
        const Vec2 back = x.col((k + 3) % 4) - x.col(k);
        J[k] = 0.25 * cross(ahead, back);
    }
    return J;
}

std::optional<Vec2> natural_coordinates(const Corners& x, const Vec2& place) {
    constexpr double rounding = 1e-6;
    Vec2 xi = Vec2::Zero();
    for (int i = 0; i < 12; ++i) {  // Newton; one step for a parallelogram
        const Matrix2 J = jacobian(x, xi);
        if (!(std::abs(J.determinant()) > 0.0)) return std::nullopt;
        xi -= J.inverse() * (x * shape_functions(xi) - place);
    }
    if (!(xi.cwiseAbs().maxCoeff() <= 1.0 + rounding)) return std::nullopt;
    return xi;
}

// In one direction the two linear functions (1 -+ xi)/2 give 2/3 (same) or 1/3 (different) for a
// product of two, and 1/2 (all the same) or 1/6 for a product of three.
double integral(int i, int k) {
    const auto along = [](int a, int b) { return a == b ? 2.0 / 3.0 : 1.0 / 3.0; };
    return along(side_xi[i], side_xi[k]) * along(side_eta[i], side_eta[k]);
}

double integral(int i, int j, int k) {
    const auto along = [](int a, int b, int c) { return a == b && b == c ? 0.5 : 1.0 / 6.0; };
    return along(side_xi[i], side_xi[j], side_xi[k]) * along(side_eta[i], side_eta[j], side_eta[k]);
}

GaussRule gauss_legendre(int n) {
    GaussRule rule{std::vector<double>(n), std::vector<double>(n)};
    for (int i = 0; i < n; ++i) {
        // Newton on P_n from Tricomi's estimate of its root; P_n by the three-term recurrence.
        double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double slope = 1.0;
        for (int iteration = 0; iteration < 10; ++iteration) {
            double P = x;
            double P_before = 1.0;
            for (int k = 2; k <= n; ++k) {
                const double P_next = ((2.0 * k - 1.0) * x * P - (k - 1.0) * P_before) / k;
                P_before = P;
                P = P_next;
            }
            slope = n * (x * P - P_before) / (x * x - 1.0);
            x -= P / slope;
        }
        rule.position[i] = x;
        rule.weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

namespace {

/// Points and weights from eigenvalues and first eigenvector components of the Jacobi matrix (Golub
/// & Welsch 1969). The shift changes its last diagonal entry (Golub 1973, for Radau's rule).
GaussRule moved_rule(int n, double shift) {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
    for (int k = 1; k < n; ++k) J(k, k - 1) = J(k - 1, k) = k / std::sqrt(4.0 * k * k - 1.0);
    J(n - 1, n - 1) = shift * n / (2.0 * n - 1.0);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(J);
    GaussRule rule;
    for (int i = 0; i < n; ++i) {
        rule.position.push_back(solver.eigenvalues()[i]);
        rule.weight.push_back(2.0 * solver.eigenvectors()(0, i) * solver.eigenvectors()(0, i));
    }
    return rule;
}

}  // namespace

GaussRule shifted_rule(int n, double shift) {
    return shift == 0.0 ? gauss_legendre(n) : moved_rule(n, shift);
}

GaussRule even_rule(int n, double shift) {
    if (n <= 3) return shifted_rule(n, shift);
    const GaussRule two = shifted_rule(2, shift), three = shifted_rule(3, shift);
    const int parts = n / 2;
    GaussRule rule;
    double from = -1.0;
    for (int p = 0; p < parts; ++p) {
        const GaussRule& part = n % 2 == 1 && p == parts / 2 ? three : two;
        const double share = static_cast<double>(part.position.size()) / n;
        for (std::size_t i = 0; i < part.position.size(); ++i) {
            rule.position.push_back(from + share * (part.position[i] + 1.0));
            rule.weight.push_back(share * part.weight[i]);
        }
        from += 2.0 * share;
    }
    return rule;
}

}  // namespace breach::geometry
