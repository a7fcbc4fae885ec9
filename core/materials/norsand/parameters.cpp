// Derived parameters, initial state, and quantities read from a state.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/materials/norsand/image.hpp"

namespace breach::materials::norsand {

Ready ready(const Parameters& parameters) {
    const double M_tc = parameters.M_tc;
    const double nu = parameters.nu;
    return {.parameters = parameters,
            .K_over_G = 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu)),
            .M_te = 3.0 * M_tc / (3.0 + M_tc),
            .M_fall = M_tc * M_tc / (3.0 + M_tc),
            .ln_p_ref = std::log(parameters.p_ref / kPa),
            .ln_C_ref = parameters.curved ? std::log(parameters.curved->p_ref / kPa) : 0.0};
}

double critical_void_ratio(const Ready& law, double p) {
    return critical_line(law, std::log(p / kPa)).e_c;
}

double critical_slope(const Ready& law, double p) {
    return critical_line(law, std::log(p / kPa)).lambda;
}

double critical_pressure(const Ready& law, double e) {
    const Parameters& par = law.parameters;
    if (par.semi_log) return kPa * std::exp((par.semi_log->Gamma - e) / par.semi_log->lambda);
    const CurvedLine& line = *par.curved;
    return e < line.C_a ? line.p_ref * std::pow((line.C_a - e) / line.C_b, 1.0 / line.C_c) : 0.0;
}

double critical_ratio(const Ready& law, double theta) {
    return law.parameters.M_tc - law.M_fall * std::cos(1.5 * theta + std::numbers::pi / 4.0);
}

double plane_critical_angle(const Ready& law) {
    switch (law.parameters.flow) {
        case FlowRule::js:
            // z_3 = -1 between -1/2 and -2: cos(3 theta / 2 + 45 deg) = 1/3.
            return (std::acos(1.0 / 3.0) - std::numbers::pi / 4.0) / 1.5;
        case FlowRule::radial:
            return 0.0;
        case FlowRule::normal:
            break;
    }
    // tan theta = M' / M, which falls from a positive to a negative difference.
    double low = 0.0, high = std::numbers::pi / 6.0;
    for (int round = 0; round < 60; ++round) {
        const double theta = 0.5 * (low + high);
        const double slope = 1.5 * law.M_fall * std::sin(1.5 * theta + std::numbers::pi / 4.0);
        (slope > std::tan(theta) * critical_ratio(law, theta) ? low : high) = theta;
    }
    return low;
}

Counts& Counts::operator+=(const Counts& other) {
    evaluations += other.evaluations;
    sub_steps += other.sub_steps;
    rejected += other.rejected;
    guarded += other.guarded;
    floored += other.floored;
    cut_off += other.cut_off;
    return *this;
}

Voigt stress(const State& state) { return {-state.xx, -state.yy, -state.zz, -state.xy}; }

double image_share(const Ready& law, double chi_i, double psi_i) {
    const Parameters& par = law.parameters;
    return std::max(1.0 - par.N / par.M_tc * chi_i * std::abs(psi_i), least_f);
}

double limiting_share(const Ready& law, double chi_i, double psi_i) {
    return chi_i * psi_i / (law.parameters.M_tc * image_share(law, chi_i, psi_i));
}

double image_size(const Ready& law, const Bullet& at) {
    const double ln_p = std::log(at.p / kPa);
    const auto over = [&](double x) {
        const double psi_i = at.e - critical_line(law, ln_p + x).e_c;
        return at.eta / (at.M * image_share(law, at.chi_i, psi_i)) - 1.0;
    };
    double x = at.eta / at.M - 1.0;
    for (int round = 0; round < 60; ++round) {
        const double next = over(x);
        const bool settled = std::abs(next - x) < 1e-15 * (1.0 + std::abs(x));
        x = next;
        if (settled) return at.p * std::exp(x);
    }
    // Steep lines: the iteration diverges; bisect, as the sign changes between tip and guard.
    double low = -1.0, high = at.eta / (least_f * at.M);
    for (int round = 0; round < 200; ++round) {
        x = 0.5 * (low + high);
        (x - over(x) > 0.0 ? high : low) = x;
    }
    return at.p * std::exp(x);
}

double capped_size(const Ready& law, double p, double e, double chi_i, double p_i) {
    const double ln_p = std::log(p / kPa);
    const auto above = [&](double ln_size) {
        const double psi_i = e - critical_line(law, ln_size).e_c;
        return ln_size - ln_p + limiting_share(law, chi_i, psi_i);
    };
    double high = std::log(p_i / kPa);
    if (above(high) <= 0.0) return p_i;
    double step = 1.0, low = high - step;
    while (above(low) > 0.0 && step < 512.0) low = high - (step *= 2.0);
    for (int round = 0; round < 100; ++round) {
        const double middle = 0.5 * (low + high);
        (above(middle) > 0.0 ? high : low) = middle;
    }
    return kPa * std::exp(low);
}

namespace {

/// Section 9: the largest stress ratio that the image state of `at` allows.
double largest_ratio(const Ready& law, const Bullet& at) {
    const double psi_i = at.e - critical_void_ratio(law, image_size(law, at));
    const double M_i = at.M * image_share(law, at.chi_i, psi_i);
    return 0.98 * M_i * std::min(1.0, 1.0 - limiting_share(law, at.chi_i, psi_i));
}

}  // namespace

Beginning initialise(const Ready& law, const Voigt& sigma, double e_0, double R) {
    const Parameters& par = law.parameters;
    const Components<double> given{-sigma[0], -sigma[1], -sigma[2], -sigma[3]};
    const double p_given = trace(given) / 3.0;
    const double p = std::max(p_given, par.p_min);
    Components<double> s = deviator(given, p_given);
    const double q = shear_measure(s);
    const Axes<double> axes = axes_of(s);
    const double lambda = critical_slope(law, p);
    const double chi_i = par.chi_tc / (1.0 - lambda * par.chi_tc / par.M_tc);

    Bullet at{p, q / p, par.M_tc - law.M_fall * axes.half_cosine, e_0, chi_i};
    Beginning out{.state = {},
                  .eta = at.eta,
                  .eta_limit = largest_ratio(law, at),
                  .shrunk = false,
                  .raised = p_given < par.p_min,
                  .clipped = false};
    if (out.eta > out.eta_limit) {
        out.shrunk = true;
        for (int round = 0; round < 100; ++round) {
            at.eta = std::max(std::min(out.eta, largest_ratio(law, at)), 0.0);
        }
        out.eta_limit = largest_ratio(law, at);
    }
    const double size = image_size(law, at);
    const double wanted = R * size;
    const double p_i = R > 1.0 ? std::max(capped_size(law, p, e_0, chi_i, wanted), size) : size;
    out.clipped = p_i < wanted * (1.0 - 1e-12);

    const double left = q > 0.0 ? at.eta * p / q : 0.0;
    s = left * s;
    out.state.xx = p + s.xx;
    out.state.yy = p + s.yy;
    out.state.zz = p + s.zz;
    out.state.xy = s.xy;
    out.state.p_i = p_i;
    out.state.e = e_0;
    out.state.chi_i = chi_i;
    return out;
}

Reading read(const Ready& law, const State& state) {
    const Place<double> place{
        {state.xx, state.yy, state.zz, state.xy}, state.p_i, state.e, state.chi_i};
    const Surface<double> at = surface_at(law, place, {0.0, 0.0, 0.0, 0.0});
    const double share = limiting_share(law, state.chi_i, at.psi_i);
    const double theta = std::atan2(-std::numbers::sqrt3 * at.axes.m_2, at.axes.m_1 - at.axes.m_3);
    return {.p = at.p,
            .q = at.q,
            .theta = at.axes.isotropic ? 0.0 : theta,
            .psi = state.e - critical_line(law, at.ln_p_hat).e_c,
            .psi_i = at.psi_i,
            .M = at.M,
            .M_i = at.M_i,
            .p_mx = at.p * std::exp(-share),
            .eta_L = at.M_i * (1.0 - share),
            .D = -at.M_i * at.ln_ratio,
            .F = at.F,
            .G = shear_modulus(law, at.p_hat, at.ln_p_hat)};
}

}  // namespace breach::materials::norsand
