// Between memory and lanes: points lie component by component, a node's four numbers lie side by
// side. Only for the loops that are compiled once per instruction set, hence always inline.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/materials/lanes.hpp"

namespace breach::mpm {

using materials::Lanes;
/// The four numbers of a node, or any four that belong to one point.
using Quad = Lanes<4>;
template <int N>
using Integers [[gnu::vector_size(N * sizeof(std::int32_t))]] = std::int32_t;

template <class Real>
[[gnu::always_inline]] inline Real load(const double* from) {
    Real a;
    std::memcpy(&a, from, sizeof(Real));
    return a;
}
template <class Real>
[[gnu::always_inline]] inline void store(double* to, const Real& a) {
    std::memcpy(to, &a, sizeof(Real));
}

/// Whole numbers toward zero.
template <int N>
[[gnu::always_inline]] inline Integers<N> integers(const Lanes<N>& a) {
    return __builtin_convertvector(a.v, Integers<N>);
}
template <int N>
[[gnu::always_inline]] inline void store(std::int32_t* to, const Integers<N>& a) {
    std::memcpy(to, &a, sizeof(a));
}

/// 0, 1, 2, ...
template <int N>
[[gnu::always_inline]] inline Lanes<N> counting() {
    Lanes<N> a;
    for (int i = 0; i < N; ++i) a.v[i] = i;
    return a;
}

template <int N>
[[gnu::always_inline]] inline double sum_of(const Lanes<N>& a) {
    double sum = 0.0;
    for (int i = 0; i < N; ++i) sum += a.v[i];
    return sum;
}
template <int N>
[[gnu::always_inline]] inline double largest_of(const Lanes<N>& a) {
    double largest = a.v[0];
    for (int i = 1; i < N; ++i) largest = a.v[i] > largest ? a.v[i] : largest;
    return largest;
}

/// Lanes 0, 1 of the first and 2, 3 of the second.
[[gnu::always_inline]] inline Quad halves(const Quad& first, const Quad& second) {
    return Quad(__builtin_shufflevector(first.v, second.v, 0, 1, 6, 7));
}
/// Lane 0 of a, 1 of b, 2 of c, then 0.
[[gnu::always_inline]] inline Quad first_of(const Quad& a, const Quad& b, const Quad& c) {
    const auto ab = __builtin_shufflevector(a.v, b.v, 0, 5, 2, 3);
    const auto abc = __builtin_shufflevector(ab, c.v, 0, 1, 6, 3);
    return Quad(__builtin_shufflevector(abc, Quad(0.0).v, 0, 1, 2, 7));
}
/// Lanes 0, 1 of both.
[[gnu::always_inline]] inline Quad low_halves(const Quad& first, const Quad& second) {
    return Quad(__builtin_shufflevector(first.v, second.v, 0, 1, 4, 5));
}

/// Rows to columns, in place.
[[gnu::always_inline]] inline void transpose(Quad& a, Quad& b, Quad& c, Quad& d) {
    const auto ab_low = __builtin_shufflevector(a.v, b.v, 0, 4, 2, 6);
    const auto ab_high = __builtin_shufflevector(a.v, b.v, 1, 5, 3, 7);
    const auto cd_low = __builtin_shufflevector(c.v, d.v, 0, 4, 2, 6);
    const auto cd_high = __builtin_shufflevector(c.v, d.v, 1, 5, 3, 7);
    a.v = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b.v = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    c.v = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    d.v = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Lanes 4 part .. 4 part + 3.
template <int N>
[[gnu::always_inline]] inline Quad quad_of(const Lanes<N>& a, int part) {
    Quad quad;
    std::memcpy(&quad, reinterpret_cast<const double*>(&a) + 4 * part, sizeof(Quad));
    return quad;
}
template <int N>
[[gnu::always_inline]] inline void set_quad(Lanes<N>& a, int part, const Quad& quad) {
    std::memcpy(reinterpret_cast<double*>(&a) + 4 * part, &quad, sizeof(Quad));
}

/// Four components over N points to N points of four components.
template <int N>
[[gnu::always_inline]] inline void to_points(const Lanes<N>& a, const Lanes<N>& b,
                                             const Lanes<N>& c, const Lanes<N>& d, Quad* points) {
    for (int part = 0; part < N / 4; ++part) {
        Quad q[4] = {quad_of(a, part), quad_of(b, part), quad_of(c, part), quad_of(d, part)};
        transpose(q[0], q[1], q[2], q[3]);
        for (int k = 0; k < 4; ++k) points[4 * part + k] = q[k];
    }
}
/// And back.
template <int N>
[[gnu::always_inline]] inline void from_points(const Quad* points, Lanes<N>& a, Lanes<N>& b,
                                               Lanes<N>& c, Lanes<N>& d) {
    for (int part = 0; part < N / 4; ++part) {
        const Quad* from = points + 4 * part;
        Quad q[4] = {from[0], from[1], from[2], from[3]};
        transpose(q[0], q[1], q[2], q[3]);
        set_quad(a, part, q[0]), set_quad(b, part, q[1]);
        set_quad(c, part, q[2]), set_quad(d, part, q[3]);
    }
}

}  // namespace breach::mpm
