// PM4Sand (Boulanger & Ziotopoulou 2017) for one material point in plane strain: parameters, state,
// and the pure function (parameters, state, strain increment) -> new state. Elastic stages give the
// zone another law (`elastic_stage`).
#pragma once

#include <optional>
#include <span>

#include "core/materials/width.hpp"
#include "core/mechanics/elasticity.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::materials::pm4sand {

using mechanics::Matrix4;
using mechanics::Voigt;

/// Post-shaking reconsolidation: F_sed reduces the moduli.
enum class Reconsolidation { off, on };

/// Start from `defaults` and overwrite entries.
struct Parameters {
    double D_R;   ///< relative density [-]
    double G_0;   ///< shear modulus number [-], G = G_0 p_atm sqrt(p/p_atm)
    double h_po;  ///< contraction rate [-]

    double p_atm = 101.3e3;       ///< atmospheric pressure [Pa]; scales the absolute tolerances too
    double h_0;                   ///< plastic over elastic modulus [-]
    double e_max = 0.8;           ///< [-]
    double e_min = 0.5;           ///< [-]
    double n_b = 0.5;             ///< bounding surface exponent [-]
    double n_d = 0.1;             ///< dilatancy surface exponent [-]
    double c_z = 250.0;           ///< fabric growth [-]
    double c_epsilon;             ///< strain accumulation rate [-]
    double phi_cv;                ///< critical state friction angle [rad]
    double nu = 0.3;              ///< Poisson's ratio [-]
    double C_GD = 2.0;            ///< modulus degradation with fabric [-]
    double C_DR;                  ///< rotated dilatancy surface [-]
    double C_Kaf;                 ///< effect of static shear on K_p [-]
    double Q = 10.0;              ///< Bolton's critical state line [-]
    double R = 1.5;               ///< Bolton's critical state line [-]
    double m = 0.01;              ///< radius of the yield cone [-]
    double F_sed_min;             ///< [-]
    double p_sedo;                ///< [Pa]
    std::optional<double> A_do;   ///< dilatancy [-]; from the initial stress if not given
    std::optional<double> z_max;  ///< fabric limit [-]; from the initial stress if not given
    Reconsolidation reconsolidation = Reconsolidation::off;
};

/// Derives all secondary parameters from the three primary ones (docs/reference/methods/pm4sand.md,
/// section 2). Departs from: OpenSees, where C_DR falls to 0 and below for D_R < 0.15; here it is
/// at least 1.
Parameters defaults(double D_R, double G_0, double h_po);

/// h_po without calibration: the parabola through the three values of the manual (0.53, 0.40, 0.63
/// at D_R 0.35, 0.55, 0.75).
double default_h_po(double D_R);

/// Parameters and constants derived from them, computed once per zone.
struct Ready {
    Parameters parameters;
    double M_c;           ///< 2 sin(phi_cv)
    double K_over_G;      ///< 2 (1 + nu) / (3 (1 - 2 nu))
    double density_rate;  ///< d D_R' per compressive volumetric strain, (1 + e_0) / (e_max - e_min)
    double unit;          ///< 1 kPa [Pa] if p_atm is 101.3 kPa: the unit of the absolute tolerances
};
Ready ready(const Parameters& parameters);

/// A deviatoric in-plane tensor in orthonormal components ((xx - yy) / sqrt2, sqrt2 xy): the tensor
/// product a:b is the dot product.
template <class Real>
struct Deviator {
    Real d;
    Real x;
};
using Plane = Deviator<double>;

/// In-plane components, for histories that the model keeps by component.
struct InPlane {
    double xx, yy, xy;
};

/// One point. Compression positive throughout, stresses [Pa]; all else dimensionless.
struct State {
    double p;           ///< in-plane mean effective stress (xx + yy) / 2
    Plane s;            ///< deviatoric stress
    InPlane sigma_b;    ///< part of the initial stress that lay outside the surfaces; constant
    Plane alpha;        ///< back-stress ratio
    Plane z;            ///< fabric
    InPlane alpha_app;  ///< alpha_in, apparent
    Plane alpha_true;   ///< alpha_in, true
    Plane alpha_prev;   ///< alpha_in, apparent of the reversal before
    double alpha_prev_xy;
    Plane z_in;         ///< fabric at the last reversal
    InPlane alpha_max;  ///< component-wise history of alpha at reversals
    InPlane alpha_min;
    double z_cum;                       ///< accumulated |dz| / sqrt2
    double z_peak;                      ///< largest |z| / sqrt2
    double p_zp;                        ///< p at the largest product of |z| and p
    double zp_max;                      ///< that product
    bool p_zp_unset;                    ///< no reversal yet: the first one always sets p_zp
    double G;                           ///< shear modulus
    double M_b;                         ///< bounding ratio as last evaluated
    double M_cur;                       ///< stress ratio q / p
    double epsilon_v;                   ///< volumetric strain since `initialise`
    double A_do, z_max, p_min, p_min2;  ///< set by `initialise`
    double sub_step;  ///< size of the last accepted sub-step [strain]; first guess of the next
};

/// Effective stress [Pa, tension positive], sigma_b included. zz = nu (xx + yy), as the model has
/// none.
Voigt stress(const Ready& law, const State& state);

double void_ratio(const Ready& law, const State& state);

enum class Scheme {
    reference,  ///< as OpenSees: explicit, strain in parts of 1e-5 (compat: opensees)
    adaptive,   ///< linearly implicit with error control, no drift (compat: corrected)
};

/// State with the effective stress sigma [Pa, tension positive]. epsilon_v: compressive volumetric
/// strain of earlier stages, which the void ratio includes [-]. Stresses below p_min or outside the
/// surfaces are moved onto them; the difference stays as sigma_b, so that `stress` returns sigma
/// unchanged (except zz). In soil looser than critical a stress may lie beyond the bound, up to
/// M_d. Its initial reversal point alpha_in is alpha moved onto the bound (adaptive scheme) or
/// alpha itself (reference scheme). Call exactly once per point.
State initialise(const Ready& law, const Voigt& sigma, double epsilon_v = 0.0,
                 Scheme scheme = Scheme::adaptive);

struct Options {
    Scheme scheme = Scheme::adaptive;
    double tolerance = 1e-5;       ///< of an adaptive sub-step, in stress ratio [-]
    double least_sub_step = 1e-7;  ///< [strain]; a sub-step of this size is always accepted
    int most_evaluations = 4000;   ///< per call; reference scheme: per part of 1e-5
};

enum class Outcome {
    done,
    refused,     ///< increment not finite; old state
    unresolved,  ///< evaluations used up; old state: cut the time step
};

/// Cost of a call, and how often limits of the model applied.
struct Counts {
    int evaluations = 0;
    int sub_steps = 0;
    int rejected = 0;
    int forced = 0;  ///< sub-steps accepted at the smallest size although their error was too large
    int projected = 0;  ///< returns to the bounding surface
    int softened = 0;   ///< plastic multipliers with a denominator at or below its floor
    int stalled = 0;    ///< mean stress held at its floor

    Counts& operator+=(const Counts& other);
};

struct Update {
    State state;
    Outcome outcome;
    Counts counts;
};

/// New state after the strain increment [-, tension positive, engineering shear]; zz is ignored.
/// Pure; never returns a state with NaN.
Update integrate(const Ready& law, const State& old, const Voigt& d_epsilon,
                 const Options& options);

using materials::Width;

/// The same for many points of one zone: updates[i] = integrate(law, old[i], d_epsilon[i],
/// options), with the same bits and in any order. Vectorised; a finished point is replaced by the
/// next.
void integrate(const Ready& law, std::span<const State> old, std::span<const Voigt> d_epsilon,
               const Options& options, std::span<Update> updates, Width width = Width::widest);

/// d sigma / d epsilon [Pa] of the elastic predictor at `state`: symmetric positive definite.
Matrix4 elastic_tangent(const Ready& law, const State& state);

/// Continuum elastoplastic tangent at `state` for loading in the direction d_epsilon; the elastic
/// one if that unloads. Not symmetric.
Matrix4 plastic_tangent(const Ready& law, const State& state, const Voigt& d_epsilon);

/// The elastic law of the stages before `initialise`: constant G = G_0 p_atm.
mechanics::Elasticity elastic_stage(const Parameters& parameters, double nu);

}  // namespace breach::materials::pm4sand
