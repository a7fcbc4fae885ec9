// Shared by both integration schemes, for one point: reversals, the elastic part of the path, and
// the closing of a call (sections 10, 11, 13.1, 13.3, 14).
#pragma once

#include "core/materials/pm4sand/functions.hpp"

namespace breach::materials::pm4sand {

struct Stress {
    double p;
    Plane s;
};

/// The strain increment with compression positive, from one with tension positive.
Strain<double> inward(const Voigt& d_epsilon);

/// Largest component max |d_i|, with engineering shear.
double largest_component(const Strain<double>& d);

/// Plane strain: stiffness of the in-plane mean stress is K + G/3.
inline Stress elastic_change(const Ready& law, double G, const Strain<double>& d) {
    return {(law.K_over_G + 1.0 / 3.0) * G * d.v, (2.0 * G) * d.e};
}

/// Yield function f [Pa].
inline double yield_function(const Ready& law, const Stress& sigma, const Plane& alpha) {
    return norm(sigma.s - sigma.p * alpha) - law.parameters.m * inverse_sqrt2 * sigma.p;
}

/// Unit normal of section 4, with its degenerate cases.
Plane normal(const Ready& law, const Stress& sigma, const Plane& alpha);

/// Section 11: sets the initial back-stress ratios for a reversal towards n, at the state's p,
/// alpha and z.
void reverse(const Plane& n, State& state);

/// Sections 13.1 and 13.3: share of the stress change from (sigma, alpha) that is elastic.
double elastic_fraction(const Ready& law, const Stress& sigma, const Plane& alpha,
                        const Stress& change);

/// The last share in (0, 1] at which the elastic path meets the yield cone; 0 if it does not.
double last_crossing(const Ready& law, const Stress& sigma, const Plane& alpha,
                     const Stress& change);

/// Section 14: moduli at the final stress, return to the bounding surface, fabric sums. `state` has
/// the new p, s, alpha and M_b; z is the new fabric.
void close_call(const Ready& law, const Plane& z, State& state, Counts& counts);

bool is_finite(const Strain<double>& d);
bool is_finite(const State& state);

}  // namespace breach::materials::pm4sand
