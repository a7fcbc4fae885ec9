// Mohr-Coulomb with tension cut-off for several points side by side: the formulas of
// principal_return.hpp lane by lane. Includes neither Eigen nor containers: it is compiled once per
// instruction set. Equal to materials::integrate up to round-off.
#pragma once

#include "core/materials/lane_law.hpp"
#include "core/materials/mohr_coulomb/cone.hpp"

namespace breach::materials {

/// Constants of the law for a loop over points, here and in the FEM (mohr_coulomb.hpp) [Pa]; psi <=
/// phi.
struct MohrCoulombNumbers {
    Moduli moduli;
    double c, tan_phi, tan_psi;
    Tension tension;
    Softens softens;
    // unused without softening
    double epsilon_q_start, epsilon_q_end;
    double c_residual, tan_phi_residual;
    Cone peak;  ///< at peak strength
};

namespace mohr_coulomb_lanes {

/// As materials::Cone, with a mask for the tip.
template <class Real>
struct ConeOf {
    Real k, m, q, T;
    MaskOf<Real> tip_is_apex;
};

template <class Real>
[[gnu::always_inline]] inline ConeOf<Real> cone_of(const Real& c, const Real& tan_phi,
                                                   const Real& tan_psi, const Tension& tension) {
    using namespace lanes;
    const Real one(1.0);
    const Real least_psi = smaller(tan_psi, tan_phi);
    const Real root_k = tan_phi + root(one + tan_phi * tan_phi);
    const Real root_m = least_psi + root(one + least_psi * least_psi);
    const Real infinite(__builtin_inf());
    const auto has_apex = tan_phi > Real(0.0);
    const Real apex = select(has_apex, c / select(has_apex, tan_phi, one), infinite);
    const Real q = Real(2.0) * c * root_k;
    const Real cutoff = larger(Real(tension.cutoff), Real(tension.share) * q);
    return {root_k * root_k, root_m * root_m, q, smaller(cutoff, apex), !(cutoff < apex)};
}

/// Linear softening: 0 at peak, 1 at residual strength [-].
template <class Real>
[[gnu::always_inline]] inline Real softened_by(const MohrCoulombNumbers& law,
                                               const Real& epsilon_q) {
    using namespace lanes;
    const Real per_way(1.0 / (law.epsilon_q_end - law.epsilon_q_start));
    return smaller(positive((epsilon_q - Real(law.epsilon_q_start)) * per_way), Real(1.0));
}

/// The cone at the strength for epsilon_q.
template <Softens softens, class Real>
[[gnu::always_inline]] inline ConeOf<Real> cone_at(const MohrCoulombNumbers& law,
                                                   const Real& epsilon_q) {
    using namespace lanes;
    const Real c(law.c);
    const Real tan_phi(law.tan_phi);
    const Real tan_psi(law.tan_psi);
    if constexpr (softens == Softens::never) {
        return cone_of(c, tan_phi, tan_psi, law.tension);
    } else {
        const Real way = softened_by(law, epsilon_q);
        return cone_of(c + way * Real(law.c_residual - law.c),
                       tan_phi + way * Real(law.tan_phi_residual - law.tan_phi), tan_psi,
                       law.tension);
    }
}

/// The same for points with individual strengths.
template <class Real>
[[gnu::always_inline]] inline ConeOf<Real> cone_at(const MohrCoulombNumbers& law,
                                                   const StrengthOfPoint<Real>& of,
                                                   const Real& epsilon_q) {
    const Real way = softened_by(law, epsilon_q);
    return cone_of(of.c + way * (of.c_residual - of.c),
                   of.tan_phi + way * (of.tan_phi_residual - of.tan_phi), Real(law.tan_psi),
                   law.tension);
}

template <class Real>
struct TripleOf {
    Real a, b, c;  ///< sorted, a >= b >= c, tension positive
};

template <class Real>
[[gnu::always_inline]] inline Real largest(const Real& a, const Real& b, const Real& c) {
    return lanes::larger(a, lanes::larger(b, c));
}
template <class Real>
[[gnu::always_inline]] inline Real largest(const Real& a, const Real& b, const Real& c,
                                           const Real& d) {
    return lanes::larger(lanes::larger(a, b), lanes::larger(c, d));
}

/// The return to one facet, and by how much it violates that facet's conditions [Pa].
template <class Real>
struct CandidateOf {
    TripleOf<Real> sigma;
    TripleOf<Real> e;  ///< plastic strain
    Real violation;
};

/// Returns of trial points to the facets of their cones, one candidate after another
/// (principal_return.cpp).
template <class Real>
class CandidatesOf {
  public:
    [[gnu::always_inline]] CandidatesOf(const ConeOf<Real>& cone, const MohrCoulombNumbers& law,
                                        const TripleOf<Real>& trial)
        : cone_(cone),
          trial_(trial),
          lambda_(law.moduli.lambda),
          two_G_(2.0 * law.moduli.G),
          per_two_G_(0.5 / law.moduli.G),
          per_K_(1.0 / law.moduli.K),
          Q_(cone.k * cone.T - cone.q) {}

    [[gnu::always_inline]] CandidateOf<Real> cone_plane() const {
        const Real one(1.0);
        const Real& k = cone_.k;
        const Real& m = cone_.m;
        const Real volumetric = lambda_ * (m - one);
        const Real f = k * trial_.a - trial_.c - cone_.q;
        const Real multiplier = f / (lambda_ * (k - one) * (m - one) + two_G_ * (k * m + one));
        TripleOf<Real> sigma{trial_.a, trial_.b - multiplier * volumetric,
                             trial_.c - multiplier * (volumetric - two_G_)};
        sigma.a = (cone_.q + sigma.c) / k;
        return {sigma,
                {multiplier * m, Real(0.0), -multiplier},
                largest(sigma.b - sigma.a, sigma.c - sigma.b, sigma.a - cone_.T, -f)};
    }

    [[gnu::always_inline]] CandidateOf<Real> cone_edge_major() const {
        const Real one(1.0);
        const Real t = along_line({trial_.a, trial_.b, trial_.c + cone_.q}, {one, one, cone_.m},
                                  {one, one, cone_.k});
        CandidateOf<Real> each = from_stress({t, t, t * cone_.k - cone_.q});
        each.violation = largest(each.sigma.a - cone_.T, -two_G_ * each.e.a, -two_G_ * each.e.b);
        return each;
    }

    [[gnu::always_inline]] CandidateOf<Real> cone_edge_minor() const {
        const Real one(1.0);
        const Real t = along_line({trial_.a, trial_.b + cone_.q, trial_.c + cone_.q},
                                  {one, cone_.m, cone_.m}, {one, cone_.k, cone_.k});
        const Real lower = t * cone_.k - cone_.q;
        CandidateOf<Real> each = from_stress({t, lower, lower});
        each.violation = largest(each.sigma.a - cone_.T, two_G_ * each.e.b, two_G_ * each.e.c);
        return each;
    }

    [[gnu::always_inline]] CandidateOf<Real> cut_plane() const {
        const Real e = (trial_.a - cone_.T) / (lambda_ + two_G_);
        const TripleOf<Real> sigma{cone_.T, trial_.b - lambda_ * e, trial_.c - lambda_ * e};
        return {sigma,
                {e, Real(0.0), Real(0.0)},
                largest(-two_G_ * e, sigma.b - cone_.T, Q_ - sigma.c)};
    }

    [[gnu::always_inline]] CandidateOf<Real> cut_edge() const {
        const Real sum =
            (trial_.a + trial_.b - Real(2.0) * cone_.T) / (Real(2.0) * lambda_ + two_G_);
        const Real difference = (trial_.a - trial_.b) * per_two_G_;
        const TripleOf<Real> e{Real(0.5) * (sum + difference), Real(0.5) * (sum - difference),
                               Real(0.0)};
        const TripleOf<Real> sigma{cone_.T, cone_.T, trial_.c - lambda_ * sum};
        return {sigma, e, largest(-two_G_ * e.b, sigma.c - cone_.T, Q_ - sigma.c)};
    }

    [[gnu::always_inline]] CandidateOf<Real> cut_cone_edge() const {
        const Real sum = (trial_.a - cone_.T + trial_.c - Q_) / (Real(2.0) * lambda_ + two_G_);
        CandidateOf<Real> each = from_stress({cone_.T, trial_.b - lambda_ * sum, Q_});
        each.e.b = Real(0.0);
        each.violation = largest(each.sigma.b - cone_.T, Q_ - each.sigma.b, two_G_ * each.e.c,
                                 -two_G_ * (each.e.a + cone_.m * each.e.c));
        return each;
    }

    [[gnu::always_inline]] CandidateOf<Real> cut_cone_corner_major() const {
        CandidateOf<Real> each = from_stress({cone_.T, cone_.T, Q_});
        const TripleOf<Real>& e = each.e;
        each.violation = two_G_ * largest(-e.a, -e.b, e.c, -(e.a + e.b + cone_.m * e.c));
        return each;
    }

    [[gnu::always_inline]] CandidateOf<Real> cut_cone_corner_minor() const {
        CandidateOf<Real> each = from_stress({cone_.T, Q_, Q_});
        const TripleOf<Real>& e = each.e;
        each.violation = two_G_ * largest(e.b, e.c, -(e.a + cone_.m * (e.b + e.c)));
        return each;
    }

    [[gnu::always_inline]] CandidateOf<Real> tip() const {
        using namespace lanes;
        CandidateOf<Real> each = from_stress({cone_.T, cone_.T, cone_.T});
        const TripleOf<Real>& e = each.e;
        const Real none(0.0);
        const Real pulled = positive(e.a) + positive(e.b) + positive(e.c);
        const Real pushed = smaller(e.a, none) + smaller(e.b, none) + smaller(e.c, none);
        each.violation = select(cone_.tip_is_apex, -two_G_ * (pulled + cone_.m * pushed),
                                -two_G_ * smaller(e.a, smaller(e.b, e.c)));
        return each;
    }

  private:
    [[gnu::always_inline]] Real compliance_product(const TripleOf<Real>& u,
                                                   const TripleOf<Real>& v) const {
        const Real third(1.0 / 3.0);
        const Real mean_u = (u.a + u.b + u.c) * third;
        const Real mean_v = (v.a + v.b + v.c) * third;
        const Real deviators = (u.a - mean_u) * (v.a - mean_v) + (u.b - mean_u) * (v.b - mean_v) +
                               (u.c - mean_u) * (v.c - mean_v);
        return deviators * per_two_G_ + mean_u * mean_v * per_K_;
    }

    /// Point on an edge from which the flow vectors lead to the trial point.
    [[gnu::always_inline]] Real along_line(const TripleOf<Real>& from_base,
                                           const TripleOf<Real>& flow_direction,
                                           const TripleOf<Real>& direction) const {
        return compliance_product(flow_direction, from_base) /
               compliance_product(flow_direction, direction);
    }

    /// Plastic strain D^-1 (trial - sigma), from deviator and volume.
    [[gnu::always_inline]] CandidateOf<Real> from_stress(const TripleOf<Real>& sigma) const {
        const Real a = trial_.a - sigma.a;
        const Real b = trial_.b - sigma.b;
        const Real c = trial_.c - sigma.c;
        const Real mean = (a + b + c) * Real(1.0 / 3.0);
        const Real volume = mean * (per_K_ * Real(1.0 / 3.0));
        return {sigma,
                {(a - mean) * per_two_G_ + volume, (b - mean) * per_two_G_ + volume,
                 (c - mean) * per_two_G_ + volume},
                Real(0.0)};
    }

    ConeOf<Real> cone_;
    TripleOf<Real> trial_;
    Real lambda_, two_G_, per_two_G_, per_K_, Q_;
};

template <class Real>
[[gnu::always_inline]] inline void put(const MaskOf<Real>& where, const TripleOf<Real>& from,
                                       TripleOf<Real>& to) {
    using lanes::select;
    to = {select(where, from.a, to.a), select(where, from.b, to.b), select(where, from.c, to.c)};
}

template <class Real>
struct ReturnOf {
    TripleOf<Real> sigma;
    TripleOf<Real> e;
    MaskOf<Real> opens;  ///< ended on the cut-off or at the tip
};

/// Koiter's rule: takes the facet without violation, or the least violated one if round-off leaves
/// none. Lanes that are not `outside` may contain anything.
template <class Real>
[[gnu::always_inline]] inline ReturnOf<Real> return_to_cone(const ConeOf<Real>& cone,
                                                            const MohrCoulombNumbers& law,
                                                            const TripleOf<Real>& trial,
                                                            const MaskOf<Real>& outside) {
    using namespace lanes;
    const CandidatesOf<Real> facets(cone, law, trial);
    const Real tolerance = Real(1e-12) * (larger(magnitude(trial.a), magnitude(trial.c)) + cone.q);
    CandidateOf<Real> best = facets.cone_plane();
    MaskOf<Real> pending = outside & !(best.violation <= tolerance);
    MaskOf<Real> opens = outside & (Real(0.0) > Real(0.0));  // none yet
    if (!any(pending)) return {best.sigma, best.e, opens};
    const auto take = [&](const CandidateOf<Real>& next, const MaskOf<Real>& allowed)
        __attribute__((always_inline)) {
        const MaskOf<Real> better = pending & allowed & (next.violation < best.violation);
        put(better, next.sigma, best.sigma);
        put(better, next.e, best.e);
        best.violation = select(better, next.violation, best.violation);
        pending = pending & !(best.violation <= tolerance);
        return better;
    };
    const auto on_the_cone = [&](const CandidateOf<Real>& next) __attribute__((always_inline)) {
        opens = opens & !take(next, outside);
    };
    const auto opened = [&](const CandidateOf<Real>& next, const MaskOf<Real>& allowed)
        __attribute__((always_inline)) {
        opens = opens | take(next, allowed);
    };
    const MaskOf<Real> finite = cone.T < Real(__builtin_inf());
    opened(facets.tip(), finite);
    if (!any(pending)) return {best.sigma, best.e, opens};
    on_the_cone(facets.cone_edge_major());
    on_the_cone(facets.cone_edge_minor());
    const MaskOf<Real> cut = finite & !cone.tip_is_apex;
    if (!any(MaskOf<Real>(pending & cut))) return {best.sigma, best.e, opens};
    opened(facets.cut_plane(), cut);
    opened(facets.cut_edge(), cut);
    opened(facets.cut_cone_edge(), cut);
    opened(facets.cut_cone_corner_major(), cut);
    opened(facets.cut_cone_corner_minor(), cut);
    return {best.sigma, best.e, opens};
}

}  // namespace mohr_coulomb_lanes

/// Principal stresses, in-plane and sorted.
template <class Real>
struct PrincipalOf {
    Real centre, difference, radius;
    Real major, minor;
    mohr_coulomb_lanes::TripleOf<Real> sorted;

    [[gnu::always_inline]] explicit PrincipalOf(const StressOf<Real>& sigma)
        : centre(Real(0.5) * (sigma.xx + sigma.yy)),
          difference(Real(0.5) * (sigma.xx - sigma.yy)),
          radius(lanes::root(difference * difference + sigma.xy * sigma.xy)),
          major(centre + radius),
          minor(centre - radius),
          sorted{lanes::larger(major, sigma.zz),
                 lanes::larger(minor, lanes::smaller(major, sigma.zz)),
                 lanes::smaller(minor, sigma.zz)} {}
};

template <class Real>
[[gnu::always_inline]] inline MaskOf<Real> lies_outside(
    const mohr_coulomb_lanes::ConeOf<Real>& cone, const StressOf<Real>& sigma) {
    const PrincipalOf<Real> p(sigma);
    return !((cone.k * p.sorted.a - p.sorted.c <= cone.q) & (p.sorted.a <= cone.T));
}

/// The stress after a trial stress, at the strength of `cone`.
template <Softens softens, class Real>
[[gnu::always_inline]] inline UpdateOf<Real> return_from(
    const MohrCoulombNumbers& law, const mohr_coulomb_lanes::ConeOf<Real>& cone,
    const StressOf<Real>& trial) {
    using namespace lanes;
    using namespace mohr_coulomb_lanes;
    const Real none(0.0);
    const Real half(0.5);
    const MaskOf<Real> outside = lies_outside(cone, trial);
    const PrincipalOf<Real> p(trial);
    const Real& major = p.major;
    const Real& minor = p.minor;
    UpdateOf<Real> update = elastic_update(trial);
    const ReturnOf<Real> back = return_to_cone(cone, law, p.sorted, outside);
    const MaskOf<Real> normal_is_first = trial.zz > major;
    const MaskOf<Real> normal_is_last = trial.zz < minor;
    const auto major_of = [&](const TripleOf<Real>& t) __attribute__((always_inline)) {
        return select(normal_is_first, t.b, t.a);
    };
    const auto minor_of = [&](const TripleOf<Real>& t) __attribute__((always_inline)) {
        return select(normal_is_last, t.b, t.c);
    };
    const auto normal_of = [&](const TripleOf<Real>& t) __attribute__((always_inline)) {
        return select(normal_is_first, t.a, select(normal_is_last, t.c, t.b));
    };
    const MaskOf<Real> has_direction = p.radius > none;
    const Real per_radius = Real(1.0) / select(has_direction, p.radius, Real(1.0));
    const Real cos_2a = select(has_direction, p.difference * per_radius, Real(1.0));
    const Real sin_2a = select(has_direction, trial.xy * per_radius, none);
    const Real new_centre = half * (major_of(back.sigma) + minor_of(back.sigma));
    const Real new_radius = half * (major_of(back.sigma) - minor_of(back.sigma));
    update.sigma = {select(outside, new_centre + new_radius * cos_2a, trial.xx),
                    select(outside, new_centre - new_radius * cos_2a, trial.yy),
                    select(outside, normal_of(back.sigma), trial.zz),
                    select(outside, new_radius * sin_2a, trial.xy)};
    const TripleOf<Real>& s = back.sigma;
    const TripleOf<Real>& e = back.e;
    update.plastic_work = select(outside, s.a * e.a + s.b * e.b + s.c * e.c, none);
    const Real volume = e.a + e.b + e.c;
    update.opened = select(back.opens, positive(volume), none);
    if constexpr (softens == Softens::with_plastic_strain) {
        const Real mean = volume * Real(1.0 / 3.0);
        const Real squares =
            (e.a - mean) * (e.a - mean) + (e.b - mean) * (e.b - mean) + (e.c - mean) * (e.c - mean);
        update.d_epsilon_q = select(outside, root(Real(2.0 / 3.0) * squares), none);
    }
    return update;
}

/// Not inlined: it is long, and elastic blocks skip it.
template <class Isa, Softens softens>
[[gnu::noinline]] void return_block(const MohrCoulombNumbers& law,
                                    const mohr_coulomb_lanes::ConeOf<Lanes<Isa::lanes>>& cone,
                                    UpdateOf<Lanes<Isa::lanes>>& update) {
    update = return_from<softens>(law, cone, update.sigma);
}

/// The law in a loop; see LinearElasticLanes.
template <Softens softens_>
struct MohrCoulombLanes {
    using Numbers = MohrCoulombNumbers;
    static constexpr bool yields = true;
    static constexpr Softens softens = softens_;

    Numbers numbers;

    template <class Isa>
    class InLoop {
        using Real = Lanes<Isa::lanes>;

      public:
        [[gnu::always_inline]] explicit InLoop(const Numbers& numbers)
            : numbers_(numbers),
              cone_(mohr_coulomb_lanes::cone_at<Softens::never>(numbers_, Real(0.0))) {}
        [[gnu::always_inline]] UpdateOf<Real> update(const StressOf<Real>& trial,
                                                     const Real& epsilon_q) {
            if constexpr (softens != Softens::never) {
                cone_ = mohr_coulomb_lanes::cone_at<softens>(numbers_, epsilon_q);
            }
            if (!lanes::any(lies_outside(cone_, trial))) return elastic_update(trial);
            UpdateOf<Real> back = elastic_update(trial);
            return_block<Isa, softens>(numbers_, cone_, back);
            return copy_of(back);
        }

      private:
        const Numbers numbers_;
        mohr_coulomb_lanes::ConeOf<Real> cone_;
    };
};

/// The law with an individual strength for each point.
template <Softens softens_>
struct MohrCoulombOfPointsLanes {
    using Numbers = MohrCoulombNumbers;
    static constexpr bool yields = true;
    static constexpr Softens softens = softens_;
    static constexpr StrengthOf strength_of = StrengthOf::point;

    Numbers numbers;

    template <class Isa>
    class InLoop {
        using Real = Lanes<Isa::lanes>;

      public:
        [[gnu::always_inline]] explicit InLoop(const Numbers& numbers) : numbers_(numbers) {}
        [[gnu::always_inline]] UpdateOf<Real> update(const StressOf<Real>& trial,
                                                     const Real& epsilon_q,
                                                     const StrengthOfPoint<Real>& strength) {
            const auto cone = mohr_coulomb_lanes::cone_at(numbers_, strength, epsilon_q);
            if (!lanes::any(lies_outside(cone, trial))) return elastic_update(trial);
            UpdateOf<Real> back = elastic_update(trial);
            return_block<Isa, softens>(numbers_, cone, back);
            return copy_of(back);
        }

      private:
        const Numbers numbers_;
    };
};

}  // namespace breach::materials
