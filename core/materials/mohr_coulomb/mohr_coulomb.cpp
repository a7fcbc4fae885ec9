#include "core/materials/mohr_coulomb/mohr_coulomb.hpp"

#include <array>

namespace breach::materials {

namespace {

Tension tension_of(const MohrCoulomb& law) { return {law.tension_cutoff, law.tension_share}; }

/// Interpolates c and tan(phi) between peak and residual.
template <class Strain>
Strength softened(const Strength& peak, const Strength& residual, const Strain& of,
                  double epsilon_q) {
    const double way = std::clamp(
        (epsilon_q - of.epsilon_q_start) / (of.epsilon_q_end - of.epsilon_q_start), 0.0, 1.0);
    return {peak.c + way * (residual.c - peak.c),
            peak.tan_phi + way * (residual.tan_phi - peak.tan_phi)};
}

Softens softens_of(const MohrCoulomb& law) {
    if (!law.softening) return Softens::never;
    return law.softening->driver == SofteningDriver::total ? Softens::with_total_strain
                                                           : Softens::with_plastic_strain;
}

/// In-plane principal stresses and the direction of the larger.
struct PlanePrincipal {
    double centre;
    double radius;
    double normal;
    double cos_2a;
    double sin_2a;
};

PlanePrincipal plane_principal(const Voigt& sigma) {
    const double half = 0.5 * (sigma[0] - sigma[1]);
    const double radius = std::sqrt(half * half + sigma[3] * sigma[3]);
    const double centre = 0.5 * (sigma[0] + sigma[1]);
    if (radius == 0.0) return {centre, 0.0, sigma[2], 1.0, 0.0};
    return {centre, radius, sigma[2], half / radius, sigma[3] / radius};
}

/// Position of the in-plane major, in-plane minor and out-of-plane axis among the sorted ones.
struct Order {
    int major;
    int minor;
    int normal;
};

Order order_of(const PlanePrincipal& p) {
    if (p.normal > p.centre + p.radius) return {1, 2, 0};
    if (p.normal < p.centre - p.radius) return {0, 1, 2};
    return {0, 2, 1};
}

/// A trial stress, its return, and their common axes.
struct Turned {
    PlanePrincipal trial;
    Order order;
    PrincipalReturn back;
};

Turned turn_back(const MohrCoulombNumbers& law, const Cone& cone, const Voigt& sigma) {
    Turned turned{plane_principal(sigma), {}, {}};
    const PlanePrincipal& p = turned.trial;
    turned.order = order_of(p);
    Triple sorted;
    sorted[turned.order.major] = p.centre + p.radius;
    sorted[turned.order.minor] = p.centre - p.radius;
    sorted[turned.order.normal] = p.normal;
    turned.back = return_to_cone(cone, law.moduli, sorted);
    return turned;
}

Return kind_of(const Cone& cone, Facet facet) {
    switch (facet) {
        case Facet::cone_plane:
            return Return::plane;
        case Facet::cone_edge_major:
            return Return::edge_major;
        case Facet::cone_edge_minor:
            return Return::edge_minor;
        case Facet::tip:
            return cone.tip == Cone::Tip::apex ? Return::apex : Return::tension;
        case Facet::cut_plane:
        case Facet::cut_edge:
        case Facet::cut_cone_edge:
        case Facet::cut_cone_corner_major:
        case Facet::cut_cone_corner_minor:
            break;
    }
    return Return::tension;
}

Update update_from(const MohrCoulombNumbers& law, const Cone& cone, const State& trial,
                   const Turned& turned) {
    const auto& [p, order, back] = turned;
    const Triple& s = back.sigma;
    const Triple& e = back.d_epsilon_plastic;
    const double centre = 0.5 * (s[order.major] + s[order.minor]);
    const double radius = 0.5 * (s[order.major] - s[order.minor]);
    const double e_centre = 0.5 * (e[order.major] + e[order.minor]);
    const double e_radius = 0.5 * (e[order.major] - e[order.minor]);
    Update update{{{centre + radius * p.cos_2a, centre - radius * p.cos_2a, s[order.normal],
                    radius * p.sin_2a},
                   trial.epsilon_q},
                  {e_centre + e_radius * p.cos_2a, e_centre - e_radius * p.cos_2a, e[order.normal],
                   2.0 * e_radius * p.sin_2a},
                  kind_of(cone, back.facet)};
    if (law.softens != Softens::with_total_strain) {
        const Triple deviator = e.array() - e.sum() / 3.0;
        update.state.epsilon_q += std::sqrt(2.0 / 3.0 * deviator.squaredNorm());
    }
    return update;
}

/// Shear stiffness in the trial's principal axes, which turn with the trial stress. A shear strain
/// changes the returned stress by (s_major - s_minor) / (trial major - trial minor) times the
/// change of the trial.
double shear_tangent(const Moduli& moduli, const Turned& turned, const Matrix3& principal) {
    const auto& [p, order, back] = turned;
    const double apart = 2.0 * p.radius;
    const double scale = std::abs(p.centre) + p.radius + std::abs(p.normal);
    if (apart > 1e-9 * scale) {
        return moduli.G * (back.sigma[order.major] - back.sigma[order.minor]) / apart;
    }
    // Equal principal stresses: the ratio becomes a derivative.
    const int a = order.major;
    const int b = order.minor;
    return 0.25 * (principal(a, a) - principal(a, b) - principal(b, a) + principal(b, b));
}

/// From principal axes (major, minor, normal, in-plane shear) to x, y.
Matrix4 to_section_axes(const PlanePrincipal& p, const Matrix4& in_principal_axes) {
    const double C = p.cos_2a;
    const double S = p.sin_2a;
    Matrix4 strain;  // rows: strains along the principal axes from (xx, yy, zz, xy)
    strain << 0.5 * (1.0 + C), 0.5 * (1.0 - C), 0.0, 0.5 * S,  //
        0.5 * (1.0 - C), 0.5 * (1.0 + C), 0.0, -0.5 * S,       //
        0.0, 0.0, 1.0, 0.0,                                    //
        -S, S, 0.0, C;
    return strain.transpose() * in_principal_axes * strain;
}

Matrix4 plastic_tangent(const MohrCoulombNumbers& law, const Cone& cone, const Turned& turned) {
    const Matrix3 principal = principal_tangent(cone, law.moduli, turned.back.facet);
    const std::array<int, 3> sorted{turned.order.major, turned.order.minor, turned.order.normal};
    Matrix4 tangent = Matrix4::Zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) tangent(i, j) = principal(sorted[i], sorted[j]);
    }
    tangent(3, 3) = shear_tangent(law.moduli, turned, principal);
    return to_section_axes(turned.trial, tangent);
}

}  // namespace

MohrCoulombNumbers ready(const MohrCoulomb& law) {
    const double tan_phi = std::tan(law.phi);
    const double tan_psi = law.strength_of == StrengthOf::law
                               ? std::min(std::tan(law.psi), tan_phi)
                               : std::tan(law.psi);  // the phi of each point limits it
    const Softening softening = law.softening.value_or(Softening{});
    return {.moduli = make_moduli(law.elasticity),
            .c = law.c,
            .tan_phi = tan_phi,
            .tan_psi = tan_psi,
            .tension = tension_of(law),
            .softens = softens_of(law),
            .epsilon_q_start = softening.epsilon_q_start,
            .epsilon_q_end = softening.epsilon_q_end,
            .c_residual = softening.c_residual,
            .tan_phi_residual = softening.tan_phi_residual,
            .peak = make_cone(law.c, tan_phi, tan_psi, tension_of(law))};
}

Cone cone_at(const MohrCoulombNumbers& law, double epsilon_q) {
    if (law.softens == Softens::never || epsilon_q <= law.epsilon_q_start) return law.peak;
    const auto [c, tan_phi] =
        softened({law.c, law.tan_phi}, {law.c_residual, law.tan_phi_residual}, law, epsilon_q);
    return make_cone(c, tan_phi, std::min(law.tan_psi, tan_phi), law.tension);
}

Update return_from(const MohrCoulombNumbers& law, const Cone& cone, const State& trial) {
    return update_from(law, cone, trial, turn_back(law, cone, trial.sigma));
}

Update integrate(const MohrCoulombNumbers& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent) {
    const Cone cone = cone_at(law, old.epsilon_q);
    State trial{trial_stress(law.moduli, old.sigma, d_epsilon), old.epsilon_q};
    if (law.softens == Softens::with_total_strain) {
        trial.epsilon_q += mechanics::epsilon_q(d_epsilon);
    }
    if (lies_inside(cone, trial.sigma)) {
        tangent = elastic_stiffness(law.moduli);
        return {trial, Voigt::Zero(), Return::elastic};
    }
    const Turned turned = turn_back(law, cone, trial.sigma);
    tangent = plastic_tangent(law, cone, turned);
    return update_from(law, cone, trial, turned);
}

Strength strength(const MohrCoulomb& law, double epsilon_q) {
    const Strength peak{law.c, std::tan(law.phi)};
    if (!law.softening) return peak;
    const Softening& softening = *law.softening;
    return softened(peak, {softening.c_residual, softening.tan_phi_residual}, softening, epsilon_q);
}

Update integrate(const MohrCoulomb& law, const State& old, const Voigt& d_epsilon) {
    return integrate(ready(law), old, d_epsilon);
}

Update integrate(const MohrCoulomb& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent) {
    return integrate(ready(law), old, d_epsilon, tangent);
}

Traits traits(const MohrCoulomb& law) {
    return {.type = "mohr_coulomb",
            .name = "Mohr-Coulomb",
            .yields = true,
            .opens = true,
            .frictional = law.phi > 0.0,
            .c_and_phi = true,
            .symmetric_tangent = false,
            .tells_plastic_strain = true};
}

std::optional<Strength> limit_strength(const MohrCoulomb& law) {
    return Strength{law.c, std::tan(law.phi)};
}

Voigt return_to_surface(const MohrCoulomb& law, const State& state) {
    return integrate(law, state, Voigt::Zero()).state.sigma;
}

MohrCoulomb with_strength(MohrCoulomb law, const StrengthOfPoint<double>& strength) {
    law.c = strength.c;
    law.phi = std::atan(strength.tan_phi);
    if (!law.softening) return law;
    law.softening->c_residual = strength.c_residual;
    law.softening->tan_phi_residual = strength.tan_phi_residual;
    return law;
}

std::optional<LawLanes> for_particles(const MohrCoulomb& law) {
    MohrCoulombNumbers numbers = ready(law);
    if (law.strength_of == StrengthOf::point) {
        if (numbers.softens == Softens::with_total_strain)
            return MohrCoulombOfPointsLanes<Softens::with_total_strain>{numbers};
        if (numbers.softens == Softens::never) numbers.epsilon_q_end = 1.0;  // peak = residual
        return MohrCoulombOfPointsLanes<Softens::with_plastic_strain>{numbers};
    }
    switch (numbers.softens) {
        case Softens::never:
            return MohrCoulombLanes<Softens::never>{numbers};
        case Softens::with_plastic_strain:
            return MohrCoulombLanes<Softens::with_plastic_strain>{numbers};
        case Softens::with_total_strain:
            return MohrCoulombLanes<Softens::with_total_strain>{numbers};
    }
    return std::nullopt;
}

double yield_excess(const MohrCoulomb& law, const State& state) {
    const auto [c, tan_phi] = strength(law, state.epsilon_q);
    const PlanePrincipal p = plane_principal(state.sigma);
    const double s1 = std::max(p.centre + p.radius, p.normal);
    const double s3 = std::min(p.centre - p.radius, p.normal);
    const double cos_phi = 1.0 / std::sqrt(1.0 + tan_phi * tan_phi);
    const double sin_phi = tan_phi * cos_phi;
    const double cone = s1 - s3 + (s1 + s3) * sin_phi - 2.0 * c * cos_phi;
    return std::max(cone, s1 - make_cone(c, tan_phi, 0.0, tension_of(law)).T);
}

}  // namespace breach::materials
