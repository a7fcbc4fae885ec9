// Public functions of both schemes, and the tangents.
#include "core/materials/pm4sand/pm4sand.hpp"

#include <algorithm>
#include <cmath>

#include "core/materials/pm4sand/adaptive.hpp"
#include "core/materials/pm4sand/call.hpp"
#include "core/materials/pm4sand/explicit.hpp"

namespace breach::materials::pm4sand {

Update integrate(const Ready& law, const State& old, const Voigt& d_epsilon,
                 const Options& options) {
    const Strain<double> d = inward(d_epsilon);
    if (!is_finite(d)) return {old, Outcome::refused, {}};
    if (options.scheme == Scheme::reference) return integrate_reference(law, old, d, options);
    return integrate_adaptive(law, old, d, options);
}

namespace {

/// C_e of section 1.4, with the out-of-plane row that the model lacks.
Matrix4 elastic_matrix(double G, double K) {
    const double M = K + 4.0 / 3.0 * G, lambda = K - 2.0 / 3.0 * G;
    Matrix4 C = Matrix4::Zero();
    C.topLeftCorner<3, 3>().setConstant(lambda);
    C.diagonal() << M, M, M, G;
    return C;
}

}  // namespace

Matrix4 elastic_tangent(const Ready& law, const State& state) {
    return elastic_matrix(state.G, law.K_over_G * state.G);
}

Matrix4 plastic_tangent(const Ready& law, const State& state, const Voigt& d_epsilon) {
    Matrix4 elastic = elastic_tangent(law, state);
    const Strain<double> d = inward(d_epsilon);
    const Stress sigma{state.p, state.s};
    const Stress change = elastic_change(law, state.G, d);
    if (elastic_fraction(law, sigma, state.alpha, change) >= 1.0) return elastic;

    const double G = state.G, K = law.K_over_G * G;
    Fixed<double> fixed = fixed_of<double>(state);
    prepare(law, fixed);
    const Plane n = normal(law, sigma, state.alpha);
    const Point<double> at{state.p, state.alpha, n, state.z, G, state.M_cur};
    const double p_hat = std::max(state.p, state.p_min);
    const auto surface = surfaces(law, p_hat, density(law, state.epsilon_v));
    const auto plastic = flow(law, fixed, at, surface);
    const double nr = dot(n, state.s) / state.p;
    const double Hd = plastic.K_p + 2.0 * G - K * plastic.D * nr;
    if (!(Hd > 0.0) || 2.0 * G * dot(n, d.e) - K * nr * d.v <= 0.0) return elastic;
    // Signs of stress and strain cancel. zz is elastic and follows the mean stress.
    const InPlane N = components(n);
    const Voigt direction(2.0 * G * N.xx + K * plastic.D, 2.0 * G * N.yy + K * plastic.D,
                          K * plastic.D, 2.0 * G * N.xy);
    const Voigt gradient(2.0 * G * N.xx - K * nr, 2.0 * G * N.yy - K * nr, -K * nr, 2.0 * G * N.xy);
    return elastic - direction * gradient.transpose() / Hd;
}

}  // namespace breach::materials::pm4sand
