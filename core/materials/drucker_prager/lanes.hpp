// Drucker-Prager with a cut-off of mean tension for one point or several side by side: closed-form
// return to the cone. Includes neither Eigen nor containers: it is compiled once per instruction
// set.
#pragma once

#include "core/materials/lane_law.hpp"

namespace breach::materials {

/// Constants of the law. With q = sqrt(J_2) and the mean stress p, tension positive: yield q + 3
/// alpha p <= k and p <= T; the flow potential on the cone is q + 3 beta p.
struct DruckerPragerNumbers {
    Moduli moduli;
    double alpha;  ///< [-]
    double beta;   ///< [-], <= alpha
    double k;      ///< [Pa]
    double T;      ///< largest mean stress [Pa]: the lower of cut-off and apex
    double Q;      ///< q at which cone and cut-off intersect [Pa]; 0 at the apex
};

/// Invariants of a stress before and after the return.
template <class Real>
struct ConeReturnOf {
    Real p, q;          ///< of the trial stress [Pa]
    Real p_new, q_new;  ///< [Pa]
    MaskOf<Real> outside;
    MaskOf<Real> at_cut_off;  ///< ended on the cut-off, its rim or the apex
};

/// Koiter's rule in the (p, q) plane. Returns to the cone; if that point lies beyond the cut-off,
/// to the cut-off or to the rim where both meet (the apex if the cut-off lies beyond it).
template <class Real>
[[gnu::always_inline]] inline ConeReturnOf<Real> return_to_cone(const DruckerPragerNumbers& law,
                                                                const StressOf<Real>& trial) {
    using namespace lanes;
    const auto& [G, K, lambda] = law.moduli;
    const Real p = (trial.xx + trial.yy + trial.zz) * Real(1.0 / 3.0);
    const Real xx = trial.xx - p;
    const Real yy = trial.yy - p;
    const Real zz = trial.zz - p;
    const Real q = root(Real(0.5) * (xx * xx + yy * yy + zz * zz) + trial.xy * trial.xy);
    const Real T(law.T);
    const Real f = q + Real(3.0 * law.alpha) * p - Real(law.k);
    const Real multiplier = positive(f) * Real(1.0 / (G + 9.0 * K * law.alpha * law.beta));
    const Real p_cone = p - Real(3.0 * K * law.beta) * multiplier;
    const MaskOf<Real> outside = (f > Real(0.0)) | (p > T);
    const MaskOf<Real> at_cut_off = p_cone > T;
    return {p,
            q,
            select(at_cut_off, T, p_cone),
            select(at_cut_off, smaller(q, Real(law.Q)), q - Real(G) * multiplier),
            outside,
            at_cut_off};
}

/// Remaining share of the trial deviator [-].
template <class Real>
[[gnu::always_inline]] inline Real deviator_left(const ConeReturnOf<Real>& r) {
    const auto has_deviator = r.q > Real(0.0);
    return lanes::select(has_deviator, r.q_new / lanes::select(has_deviator, r.q, Real(1.0)),
                         Real(0.0));
}

/// The law in a loop; see LinearElasticLanes.
struct DruckerPragerLanes {
    using Numbers = DruckerPragerNumbers;
    static constexpr bool yields = true;
    static constexpr Softens softens = Softens::never;

    Numbers numbers;

    template <class Isa>
    class InLoop {
        using Real = Lanes<Isa::lanes>;

      public:
        [[gnu::always_inline]] explicit InLoop(const Numbers& numbers) : numbers_(numbers) {}
        [[gnu::always_inline]] UpdateOf<Real> update(const StressOf<Real>& trial, const Real&) {
            using namespace lanes;
            UpdateOf<Real> update = elastic_update(trial);
            const ConeReturnOf<Real> r = return_to_cone(numbers_, trial);
            if (!any(r.outside)) return update;
            const Real none(0.0);
            const Real left = deviator_left(r);
            const Real volume = (r.p - r.p_new) * Real(1.0 / numbers_.moduli.K);
            update.sigma = {select(r.outside, (trial.xx - r.p) * left + r.p_new, trial.xx),
                            select(r.outside, (trial.yy - r.p) * left + r.p_new, trial.yy),
                            select(r.outside, (trial.zz - r.p) * left + r.p_new, trial.zz),
                            select(r.outside, trial.xy * left, trial.xy)};
            update.plastic_work = select(
                r.outside,
                r.p_new * volume + r.q_new * (r.q - r.q_new) * Real(1.0 / numbers_.moduli.G), none);
            update.opened = select(r.at_cut_off, positive(volume), none);
            return update;
        }

      private:
        const Numbers numbers_;
    };
};

}  // namespace breach::materials
