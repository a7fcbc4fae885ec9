// Interface of a law in a loop over several points side by side (lanes.hpp): constants and one
// formula from elastic trial stress to stress. Includes neither Eigen nor containers: it is
// compiled once per instruction set.
#pragma once

#include "core/materials/lanes.hpp"

namespace breach::materials {

/// Moduli of isotropic elasticity [Pa].
struct Moduli {
    double G;
    double K;
    double lambda;
};

template <class Real>
struct StressOf {
    Real xx, yy, zz, xy;
};

/// Which strain drives softening.
enum class Softens { never, with_plastic_strain, with_total_strain };

/// Source of a law's strength: the law itself, or each point.
enum class StrengthOf { law, point };

/// Strength of a point before and after softening.
template <class Real>
struct StrengthOfPoint {
    Real c, tan_phi, c_residual, tan_phi_residual;
};

/// Result of a law for a trial stress.
template <class Real>
struct UpdateOf {
    StressOf<Real> sigma;
    Real plastic_work;  ///< sigma : d_epsilon_plastic [Pa]; 0 where elastic
    Real d_epsilon_q;   ///< sqrt(2/3 e:e) of the plastic strain; 0 where elastic or `never`
    Real opened;        ///< volume strain opened by the tension cut-off or at the apex [-]
};

/// Copies number by number: GCC 12 copies the whole struct through memory in halves of a register.
template <class Real>
[[gnu::always_inline]] inline UpdateOf<Real> copy_of(const UpdateOf<Real>& update) {
    const StressOf<Real>& sigma = update.sigma;
    return {{sigma.xx, sigma.yy, sigma.zz, sigma.xy},
            update.plastic_work,
            update.d_epsilon_q,
            update.opened};
}

/// The result where nothing yields.
template <class Real>
[[gnu::always_inline]] inline UpdateOf<Real> elastic_update(const StressOf<Real>& trial) {
    return {{trial.xx, trial.yy, trial.zz, trial.xy}, Real(0.0), Real(0.0), Real(0.0)};
}

/// The simplest law, and an example of the members that a law needs: `numbers`, whether it yields
/// and softens, and InLoop for an instruction set (`Isa::lanes` points side by side). A loop makes
/// one InLoop per call; it updates one block of points at their softening variable epsilon_q.
struct LinearElasticLanes {
    struct Numbers {};
    static constexpr bool yields = false;
    static constexpr Softens softens = Softens::never;

    Numbers numbers{};

    template <class Isa>
    class InLoop {
        using Real = Lanes<Isa::lanes>;

      public:
        [[gnu::always_inline]] explicit InLoop(const Numbers&) {}
        [[gnu::always_inline]] UpdateOf<Real> update(const StressOf<Real>& trial, const Real&) {
            return elastic_update(trial);
        }
    };
};

}  // namespace breach::materials
