// NorSand (Jefferies 1993; Jefferies & Shuttle 2002-2011) for one material point: parameters, state,
// and the pure function from (parameters, state, strain increment) to a new state. Sections are
// those of docs/reference/methods/norsand.md. Whether water drains is the caller's business.
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

/// Section 5: how the plastic strain is divided among the principal directions.
enum class FlowRule {
    js,      ///< strain-rate ratios of Jefferies & Shuttle 2002
    radial,  ///< along the deviatoric stress
    normal,  ///< along the yield surface's gradient; has a vertex in triaxial compression
};

/// Section 4: what unloading inside the bullet does.
enum class Unloading {
    elastic,  ///< elasticity alone
    capped,   ///< the surface shrinks with the limiting hardness
};

/// Everything the model reads.
struct Parameters {
    std::optional<SemiLogLine> semi_log;  ///< one of the two lines
    std::optional<CurvedLine> curved;
    double M_tc;           ///< critical stress ratio q/p in triaxial compression [-]
    double N;              ///< volumetric coupling [-]
    double chi_tc;         ///< least dilatancy per state parameter [-]
    double H_0;            ///< plastic hardening [-]
    double H_psi = 0.0;    ///< its fall per state parameter [-]
    double G_ref;          ///< shear modulus at p_ref [Pa]
    double m = 1.0;        ///< exponent of the moduli [-]
    double p_ref = 100e3;  ///< [Pa]
    double nu;             ///< Poisson's ratio [-]
    double S = 0.0;        ///< additional softening of this stage, 0 drained to 1 undrained [-]
    FlowRule flow = FlowRule::js;
    Unloading unloading = Unloading::elastic;
    double p_min = 500.0;  ///< least mean effective stress [Pa]
};

/// Parameters with everything derived from them alone, computed once per zone and stage.
struct Ready {
    Parameters parameters;
    double K_over_G;  ///< 2 (1 + nu) / (3 (1 - 2 nu))
    double M_te;      ///< critical stress ratio in triaxial extension
    double M_fall;    ///< M_tc - M_te at most: M_tc^2 / (3 + M_tc)
    double ln_p_ref;  ///< ln(p_ref / 1 kPa)
    double ln_C_ref;  ///< the curved line's
};
Ready ready(const Parameters& parameters);

/// One point. Compression positive, stresses [Pa]; the rest dimensionless.
struct State {
    double xx, yy, zz, xy;    ///< effective stress
    double p_i;               ///< size of the yield surface: mean stress at its top [Pa]
    double e;                 ///< void ratio
    double chi_i;             ///< chi of the image state, constant
    double epsilon_q = 0.0;   ///< plastic deviatoric strain, conjugate to q
    double sub_step = 1e-5;   ///< size of the last sub-step [strain]; a guess for the next
    bool on_floor = false;    ///< p is held at p_min
    bool has_fallen = false;  ///< to its critical state, where no strain could be followed
};

/// Void ratio of the critical state line at p [Pa], and its slope -de/d(ln p).
double critical_void_ratio(const Ready& law, double p);
double critical_slope(const Ready& law, double p);
/// Mean stress of the critical state line at the void ratio e [Pa].
double critical_pressure(const Ready& law, double e);
/// Largest accepted lambda chi_tc / M_tc; at 1 the image state is singular.
inline constexpr double most_chi_lambda = 0.9;
/// Lode angle [rad] of the critical state in plane strain and simple shear.
double plane_critical_angle(const Ready& law);
/// M at a Lode angle [rad].
double critical_ratio(const Ready& law, double theta);

/// How the law read an initial stress.
struct Beginning {
    State state;
    double eta;        ///< q/p as given
    double eta_limit;  ///< section 9: the largest q/p that can be held, 0.98 min(eta_L, M_i)
    bool shrunk;       ///< the deviator was cut down to that limit
    bool raised;       ///< p was below p_min
    bool clipped;      ///< R was more than the limiting hardness allows
};

/// Section 9: the state that holds the effective stress sigma [Pa, tension positive] at the void
/// ratio e_0, overconsolidated by R >= 1. eta_limit <= 0: too loose for the law to carry any
/// stress, and the state is not usable.
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
    double p_mx;   ///< limiting size of the surface [Pa]
    double eta_L;  ///< limiting stress ratio: beyond it the state is past its instability line
    double D;      ///< dilatancy that goes with the surface, > 0 contracts
    double F;      ///< yield function [Pa]
    double G;      ///< [Pa]
};
Reading read(const Ready& law, const State& state);

struct Options {
    double tolerance = 1e-4;        ///< relative error of a sub-step
    double least_time_step = 1e-6;  ///< of a call; smaller ones end it
    int most_evaluations = 400;     ///< per call
    double largest_strain = 0.05;   ///< component of a strain increment that is not tried
};

enum class Outcome {
    done,
    refused,     ///< the increment is not finite or too large; the state is the old one
    unresolved,  ///< the increment cannot be integrated; the state is the old one: cut the step
};

/// Cost of a call, and how often a limit of the model applied.
struct Counts {
    int evaluations = 0;
    int sub_steps = 0;
    int rejected = 0;
    int guarded = 0;  ///< sub-steps with a guard of section 3 or 6 at work
    int floored = 0;  ///< calls that ended at p_min
    int cut_off = 0;  ///< calls whose least principal stress was tension

    Counts& operator+=(const Counts& other);
};

struct Update {
    State state;
    Outcome outcome;
    Counts counts;
};

/// New state after the strain increment [-, tension positive, engineering shear]. Pure: the same
/// answer for every call with the same arguments. Never returns a state with NaN.
Update integrate(const Ready& law, const State& old, const Voigt& d_epsilon,
                 const Options& options);

using materials::Width;

/// The same for many points of one zone: updates[i] = integrate(law, old[i], d_epsilon[i],
/// options), to the last bit and in any order.
void integrate(const Ready& law, std::span<const State> old, std::span<const Voigt> d_epsilon,
               const Options& options, std::span<Update> updates, Width width = Width::widest);

/// d sigma / d epsilon [Pa] of the elasticity at `state`.
Matrix4 elastic_tangent(const Ready& law, const State& state);

/// Continuum tangent at `state` if loading goes on in the direction d_epsilon, else the elastic
/// one. Not symmetric.
Matrix4 plastic_tangent(const Ready& law, const State& state, const Voigt& d_epsilon);

}  // namespace breach::materials::norsand
