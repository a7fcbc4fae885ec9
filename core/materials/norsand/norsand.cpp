// Public functions: integration and tangents.
#include "core/materials/norsand/norsand.hpp"

#include "core/materials/norsand/call.hpp"

namespace breach::materials::norsand {

namespace {

/// Surface and flow of a state for loading in the direction d.
struct There {
    Place<double> place;
    Surface<double> surface;
    Flow<double> flow;
};
There look(const Ready& law, const State& state, const Strain& d) {
    There out{{stress_of(state), state.p_i, state.e, state.chi_i}, {}, {}};
    out.surface = surface_at(law, out.place, direction_of(d));
    out.flow = flow_at(law, out.place, out.surface);
    return out;
}

Matrix4 elastic_matrix(double G, double K) {
    Matrix4 D = Matrix4::Zero();
    D.topLeftCorner<3, 3>().setConstant(K - 2.0 / 3.0 * G);
    D.diagonal() << Voigt(K + 4.0 / 3.0 * G, K + 4.0 / 3.0 * G, K + 4.0 / 3.0 * G, G);
    return D;
}

}  // namespace

Update integrate(const Ready& law, const State& old, const Voigt& d_epsilon,
                 const Options& options) {
    const Strain d = inward(d_epsilon);
    if (!may_be_tried(d, options)) return {old, Outcome::refused, {}};
    return call_alone<Calls>(law, old, d, options);
}

Matrix4 elastic_tangent(const Ready& law, const State& state) {
    const double G = read(law, state).G;
    return elastic_matrix(G, law.K_over_G * G);
}

Matrix4 plastic_tangent(const Ready& law, const State& state, const Voigt& d_epsilon) {
    const Strain d = inward(d_epsilon);
    const auto [place, surface, flow] = look(law, state, d);
    Matrix4 elastic_part = elastic_matrix(flow.G, flow.K);
    const bool inside = surface.F < -1e-7 * surface.p;
    if (inside || !(flow.A > 0.0) || loading(flow, state.e, d) <= 0.0) return elastic_part;
    // Signs of stress and strain cancel.
    const Components<double> back = elastic(flow.G, flow.K, flow.r, flow.D);
    const double mean = flow.K * flow.D - (1.0 + state.e) * flow.F_e;
    const double twice = 2.0 * flow.G;
    const Voigt direction(back.xx, back.yy, back.zz, back.xy);
    const Voigt gradient(mean + twice * flow.n.xx, mean + twice * flow.n.yy,
                         mean + twice * flow.n.zz, flow.G * flow.n.xy);
    return elastic_part - direction * gradient.transpose() / flow.A;
}

}  // namespace breach::materials::norsand
