// The list of all constitutive laws and the one way to call them. Laws are pure: (parameters,
// state, strain increment) -> (new state[, tangent]); no I/O, nothing hidden. Dispatch is per zone:
// visit the Law once, then loop over the zone's points with the concrete law.
#pragma once

#include <optional>
#include <variant>

#include "core/materials/pm4sand/pm4sand.hpp"
#include "core/mechanics/elasticity.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::materials {

using mechanics::Matrix4;
using mechanics::Voigt;

struct LinearElastic {
    mechanics::Elasticity elasticity;
};

/// Which epsilon_q drives softening: plastic deviatoric strain, or total deviatoric strain.
enum class SofteningDriver { plastic, total };

/// c and tan(phi) fall linearly from their peak at `start` to the residual values at `end` (Sordo
/// et al. 2024).
struct Softening {
    double epsilon_q_start;   ///< [-]
    double epsilon_q_end;     ///< [-], > start
    double c_residual;        ///< [Pa]
    double tan_phi_residual;  ///< [-]
    SofteningDriver driver = SofteningDriver::plastic;
};

/// Mohr-Coulomb with tension cut-off; sigma_1 - sigma_3 + (sigma_1 + sigma_3) sin phi <= 2 c cos
/// phi, tension positive.
struct MohrCoulomb {
    mechanics::Elasticity elasticity;
    double c;               ///< peak cohesion [Pa]
    double phi;             ///< peak friction angle [rad]
    double psi;             ///< dilatancy angle [rad]
    double tension_cutoff;  ///< largest principal stress allowed [Pa], clipped to the cone's apex c
                            ///< / tan(phi)
    std::optional<Softening> softening;
};

/// PM4Sand (pm4sand.hpp). Its points remember more than State holds: whoever runs it keeps a
/// pm4sand::State beside it, whose stress State mirrors. There is no `integrate` for it here.
struct PM4Sand {
    mechanics::Elasticity elasticity;  ///< of the stages before pm4sand::initialise: G = G_0 p_atm
    pm4sand::Ready ready;
    pm4sand::Options options;
};

using Law = std::variant<LinearElastic, MohrCoulomb, PM4Sand>;

/// What a point remembers. epsilon_q accumulates sqrt(2/3 de:de) of the law's softening driver
/// (plastic strain unless the law says total).
struct State {
    Voigt sigma;             ///< effective stress [Pa]
    double epsilon_q = 0.0;  ///< accumulated equivalent deviatoric strain [-]
};

/// Where on the yield surface a return ended.
enum class Return { elastic, plane, edge_major, edge_minor, apex, tension };

struct Update {
    State state;
    Voigt d_epsilon_plastic;  ///< plastic strain of the increment, engineering shear [-]
    Return kind;
};

/// Strength in force at a given epsilon_q.
struct Strength {
    double c;        ///< [Pa]
    double tan_phi;  ///< [-]
};
Strength strength(const MohrCoulomb& law, double epsilon_q);

/// New state after the strain increment d_epsilon; softening is explicit (strength at the old
/// epsilon_q).
Update integrate(const LinearElastic& law, const State& old, const Voigt& d_epsilon);
Update integrate(const MohrCoulomb& law, const State& old, const Voigt& d_epsilon);

/// The same, and the consistent tangent d sigma / d epsilon [Pa] at fixed strength (not symmetric
/// when psi != phi).
Update integrate(const LinearElastic& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent);
Update integrate(const MohrCoulomb& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent);

/// Amount by which sigma lies outside the yield surface at this epsilon_q [Pa]; <= 0 inside.
double yield_excess(const MohrCoulomb& law, const State& state);

const mechanics::Elasticity& elasticity(const Law& law);

}  // namespace breach::materials
