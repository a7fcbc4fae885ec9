// Interface of a law in a loop over several points side by side (lanes.hpp): bare numbers and one formula
// from the elastic trial stress to the stress. Includes neither Eigen nor containers, so that it can be
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

/// Which strain accumulates and weakens the soil.
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

/// Number by number: as a whole, GCC 12 copies such a struct through memory in halves of a register.
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

/// The simplest law. It shows what each law must have: its `numbers`, whether it yields and softens, and
/// for an instruction set (`Isa::lanes` points side by side) an InLoop, which is made once per call of a
/// loop and gives every block its update at the memory epsilon_q.
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
