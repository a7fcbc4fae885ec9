// What both integrators share around their sub-steps, for one point: the reversal test, the elastic
// part of the path, and the closing of a call (sections 10, 11, 13.1, 13.3, 14).
#pragma once

#include "core/materials/pm4sand_functions.hpp"

namespace breach::materials::pm4sand {

/// Stress of one point.
struct Stress {
    double p;
    Plane s;
};

/// Compression positive strain increment of a tension positive one.
Strain<double> inward(const Voigt& d_epsilon);

/// Largest component of a strain increment as given, max |d_i| with engineering shear.
double largest_component(const Strain<double>& d);

inline Stress elastic_change(const Ready& law, double G, const Strain<double>& d) {
    return {law.K_over_G * G * d.v, (2.0 * G) * d.e};
}

/// Yield function f [Pa].
inline double yield_function(const Ready& law, const Stress& sigma, const Plane& alpha) {
    return norm(sigma.s - sigma.p * alpha) - law.parameters.m * inverse_sqrt2 * sigma.p;
}

/// Normal of section 4 with its degenerate cases.
Plane normal(const Ready& law, const Stress& sigma, const Plane& alpha);

/// Section 11, once per call: detects a reversal and moves the initial back-stress ratios.
void detect_reversal(const Ready& law, const Strain<double>& d, State& state);

/// How much of a call is elastic.
struct ElasticPart {
    double fraction;  ///< in [0, 1]; the rest is plastic
};

/// Sections 13.1 and 13.3 from (sigma, alpha): fraction 1 when the whole increment is elastic.
ElasticPart elastic_part(const Ready& law, const Stress& sigma, const Plane& alpha,
                         const Stress& change);

/// Section 14: moduli at the final stress, return to the bounding surface, fabric sums. `state`
/// holds the new p, s, alpha and M_b; z is the new fabric.
void close_call(const Ready& law, const Plane& z, State& state, Counts& counts);

bool is_finite(const Strain<double>& d);
bool is_finite(const State& state);

}  // namespace breach::materials::pm4sand
