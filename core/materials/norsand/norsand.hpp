// NorSand (Jefferies 1993; Jefferies & Shuttle 2002-2011) for one material point: parameters,
// state, and the pure function (parameters, state, strain increment) -> new state. Section numbers
// refer to docs/reference/methods/norsand.md. Drained or undrained: the caller decides by the
// strain.
#pragma once

#include <optional>
#include <span>

#include "core/materials/width.hpp"
#include "core/mechanics/elasticity.hpp"
#include "core/mechanics/tensor.hpp"

namespace breach::materials::norsand {

using mechanics::Matrix4;
using mechanics::Voigt;

/// Section 2: e_c = Gamma - lambda ln(p / 1 kPa), or e_c = C_a - C_b (p / p_ref)^C_c.
struct SemiLogLine {
    double Gamma;   ///< void ratio at 1 kPa [-]
    double lambda;  ///< per unit of the natural logarithm [-]
};
struct CurvedLine {
    double C_a, C_b, C_c;  ///< [-]
    double p_ref = 100e3;  ///< [Pa]
};

/// Section 5: ratios of the principal plastic strains.
enum class FlowRule {
    js,      ///< strain-rate ratios of Jefferies & Shuttle (2002)
    radial,  ///< along the deviatoric stress
    normal,  ///< along the yield surface's gradient; discontinuous in triaxial compression
};

/// Section 4: unloading inside the yield surface.
enum class Unloading {
    elastic,  ///< elastic
    capped,   ///< the surface shrinks with the limiting hardness
};

struct Parameters {
    std::optional<SemiLogLine> semi_log;  ///< give one of the two lines
    std::optional<CurvedLine> curved;
    double M_tc;    ///< critical stress ratio q/p in triaxial compression [-]
    double N;       ///< volumetric coupling [-]
    double chi_tc;  ///< minimum dilatancy per unit of state parameter, triaxial compression [-]
    double H_0;     ///< plastic hardening modulus at psi = 0 [-]
    double H_psi = 0.0;    ///< its decrease per unit of state parameter [-]
    double G_ref;          ///< shear modulus at p_ref [Pa]
    double m = 1.0;        ///< exponent of the moduli [-]
    double p_ref = 100e3;  ///< [Pa]
    double nu;             ///< Poisson's ratio [-]
    double S = 0.0;        ///< additional softening in this stage: 0 drained to 1 undrained [-]
    FlowRule flow = FlowRule::js;
    Unloading unloading = Unloading::elastic;
    double p_min = 500.0;  ///< least mean effective stress [Pa]
};

/// Parameters and constants derived from them, computed once per zone and stage.
struct Ready {
    Parameters parameters;
    double K_over_G;  ///< 2 (1 + nu) / (3 (1 - 2 nu))
    double M_te;      ///< critical stress ratio in triaxial extension
    double M_fall;    ///< largest M_tc - M_te: M_tc^2 / (3 + M_tc)
    double ln_p_ref;  ///< ln(p_ref / 1 kPa)
    double ln_C_ref;  ///< of the curved line
};
Ready ready(const Parameters& parameters);

/// One point. Compression positive, stresses [Pa]; the rest dimensionless.
struct State {
    double xx, yy, zz, xy;    ///< effective stress
    double p_i;               ///< size of the yield surface: mean stress at the image state [Pa]
    double e;                 ///< void ratio
    double chi_i;             ///< chi at the image state; constant
    double epsilon_q = 0.0;   ///< plastic deviatoric strain, conjugate to q
    double sub_step = 1e-5;   ///< size of the last sub-step [strain]; first guess of the next
    bool on_floor = false;    ///< p is held at p_min
    bool has_fallen = false;  ///< moved to its critical state: a strain could not be integrated
};

/// Void ratio of the critical state line at p [Pa], and its slope -de/d(ln p).
double critical_void_ratio(const Ready& law, double p);
double critical_slope(const Ready& law, double p);
/// Mean stress of the critical state line at the void ratio e [Pa].
double critical_pressure(const Ready& law, double e);
/// Upper limit of lambda chi_tc / M_tc; at 1 the image state is singular.
inline constexpr double most_chi_lambda = 0.9;
/// Lode angle [rad] of the critical state in plane strain and simple shear.
double plane_critical_angle(const Ready& law);
/// M at a Lode angle [rad].
double critical_ratio(const Ready& law, double theta);

/// How the law reads an initial stress.
struct Beginning {
    State state;
    double eta;        ///< q/p as given
    double eta_limit;  ///< section 9: largest usable q/p, 0.98 min(eta_L, M_i)
    bool shrunk;       ///< the deviator was reduced to that limit
    bool raised;       ///< p was below p_min
    bool clipped;      ///< R exceeded the limiting hardness and was reduced
};

/// Section 9: state with the effective stress sigma [Pa, tension positive] and void ratio e_0,
/// overconsolidated by R >= 1. eta_limit <= 0: too loose for the law to carry any stress; the state
/// is unusable.
Beginning initialise(const Ready& law, const Voigt& sigma, double e_0, double R = 1.0);

/// Effective stress [Pa, tension positive].
Voigt stress(const State& state);

/// Quantities derived from a state, sections 1 to 4.
struct Reading {
    double p, q;   ///< [Pa]
    double theta;  ///< Lode angle [rad], +30 deg in triaxial compression
    double psi;    ///< state parameter
    double psi_i;  ///< of the image state
    double M;      ///< critical stress ratio at this Lode angle
    double M_i;    ///< of the image state
    double p_mx;   ///< limiting size of the yield surface [Pa]
    double eta_L;  ///< limiting stress ratio; a larger q/p is beyond the instability line
    double D;      ///< dilatancy on the yield surface; > 0: contraction
    double F;      ///< yield function [Pa]
    double G;      ///< [Pa]
};
Reading read(const Ready& law, const State& state);

struct Options {
    double tolerance = 1e-4;        ///< relative error of a sub-step
    double least_time_step = 1e-6;  ///< a smaller sub-step ends the call [share of the call]
    int most_evaluations = 400;     ///< per call
    double largest_strain = 0.05;   ///< a strain increment with a larger component is refused
};

enum class Outcome {
    done,
    refused,     ///< increment not finite or too large; old state
    unresolved,  ///< cannot be integrated; old state: cut the time step
};

/// Cost of a call, and how often limits of the model applied.
struct Counts {
    int evaluations = 0;
    int sub_steps = 0;
    int rejected = 0;
    int guarded = 0;  ///< sub-steps with a guard of section 3 or 6
    int floored = 0;  ///< calls that ended at p_min
    int cut_off = 0;  ///< calls that ended with a tensile principal stress

    Counts& operator+=(const Counts& other);
};

struct Update {
    State state;
    Outcome outcome;
    Counts counts;
};

/// New state after the strain increment [-, tension positive, engineering shear]. Pure; never
/// returns a state with NaN.
Update integrate(const Ready& law, const State& old, const Voigt& d_epsilon,
                 const Options& options);

using materials::Width;

/// The same for many points of one zone: updates[i] = integrate(law, old[i], d_epsilon[i],
/// options), to the last bit and in any order.
void integrate(const Ready& law, std::span<const State> old, std::span<const Voigt> d_epsilon,
               const Options& options, std::span<Update> updates, Width width = Width::widest);

/// d sigma / d epsilon [Pa] of the elasticity at `state`.
Matrix4 elastic_tangent(const Ready& law, const State& state);

/// Continuum tangent at `state` for loading in the direction d_epsilon; the elastic one if that
/// unloads. Not symmetric.
Matrix4 plastic_tangent(const Ready& law, const State& state, const Voigt& d_epsilon);

}  // namespace breach::materials::norsand
