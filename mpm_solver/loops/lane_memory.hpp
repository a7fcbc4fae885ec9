// Between memory and lanes: points lie component by component, a node's four numbers lie side by
// side. Only for the loops that are compiled once per instruction set, hence always inline.
#pragma once

#include <cstdint>
#include <cstring>

#include "core/materials/lanes.hpp"

namespace breach::mpm {

using materials::Lanes;

/// Four numbers in two registers, for CPUs whose registers hold two: a vector of four would be
/// taken apart through memory there, at the price of a stall each time.
struct Pairs {
    Lanes<2> low;
    Lanes<2> high;

    Pairs() = default;
    [[gnu::always_inline]] Pairs(const Lanes<2>& first, const Lanes<2>& second)
        : low(first), high(second) {}
    [[gnu::always_inline]] explicit Pairs(double number) : low(number), high(number) {}
    [[gnu::always_inline]] friend Pairs operator+(const Pairs& a, const Pairs& b) {
        return {a.low + b.low, a.high + b.high};
    }
    [[gnu::always_inline]] friend Pairs operator*(const Pairs& a, const Pairs& b) {
        return {a.low * b.low, a.high * b.high};
    }
};

template <int N>
struct QuadFor {
    using Type = Lanes<4>;
};
template <>
struct QuadFor<2> {
    using Type = Pairs;
};
/// The four numbers of a node, or any four that belong to one point, where registers hold N.
template <int N>
using Quad = typename QuadFor<N>::Type;

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
[[gnu::always_inline]] inline Lanes<4> halves(const Lanes<4>& first, const Lanes<4>& second) {
    return Lanes<4>(__builtin_shufflevector(first.v, second.v, 0, 1, 6, 7));
}
[[gnu::always_inline]] inline Pairs halves(const Pairs& first, const Pairs& second) {
    return {first.low, second.high};
}
/// Lane 0 of a, 1 of b, 2 of c, then 0.
[[gnu::always_inline]] inline Lanes<4> first_of(const Lanes<4>& a, const Lanes<4>& b,
                                                const Lanes<4>& c) {
    const auto ab = __builtin_shufflevector(a.v, b.v, 0, 5, 2, 3);
    const auto abc = __builtin_shufflevector(ab, c.v, 0, 1, 6, 3);
    return Lanes<4>(__builtin_shufflevector(abc, Lanes<4>(0.0).v, 0, 1, 2, 7));
}
[[gnu::always_inline]] inline Pairs first_of(const Pairs& a, const Pairs& b, const Pairs& c) {
    return {Lanes<2>(__builtin_shufflevector(a.low.v, b.low.v, 0, 3)),
            Lanes<2>(__builtin_shufflevector(c.high.v, Lanes<2>(0.0).v, 0, 3))};
}
/// Lanes 0, 1 of both.
[[gnu::always_inline]] inline Lanes<4> low_halves(const Lanes<4>& first, const Lanes<4>& second) {
    return Lanes<4>(__builtin_shufflevector(first.v, second.v, 0, 1, 4, 5));
}
[[gnu::always_inline]] inline Pairs low_halves(const Pairs& first, const Pairs& second) {
    return {first.low, second.low};
}

/// Rows to columns, in place.
[[gnu::always_inline]] inline void transpose(Lanes<4>& a, Lanes<4>& b, Lanes<4>& c, Lanes<4>& d) {
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
[[gnu::always_inline]] inline Lanes<4> quad_of(const Lanes<N>& a, int part) {
    Lanes<4> quad;
    std::memcpy(&quad, reinterpret_cast<const double*>(&a) + 4 * part, sizeof(quad));
    return quad;
}
template <int N>
[[gnu::always_inline]] inline void set_quad(Lanes<N>& a, int part, const Lanes<4>& quad) {
    std::memcpy(reinterpret_cast<double*>(&a) + 4 * part, &quad, sizeof(quad));
}

/// Four components over N points to N points of four components.
template <int N>
[[gnu::always_inline]] inline void to_points(const Lanes<N>& a, const Lanes<N>& b,
                                             const Lanes<N>& c, const Lanes<N>& d,
                                             Quad<N>* points) {
    static_assert(N % 4 == 0);
    for (int part = 0; part < N / 4; ++part) {
        Lanes<4> q[4] = {quad_of(a, part), quad_of(b, part), quad_of(c, part), quad_of(d, part)};
        transpose(q[0], q[1], q[2], q[3]);
        for (int k = 0; k < 4; ++k) points[4 * part + k] = q[k];
    }
}
/// And back.
template <int N>
[[gnu::always_inline]] inline void from_points(const Quad<N>* points, Lanes<N>& a, Lanes<N>& b,
                                               Lanes<N>& c, Lanes<N>& d) {
    for (int part = 0; part < N / 4; ++part) {
        const Lanes<4>* from = points + 4 * part;
        Lanes<4> q[4] = {from[0], from[1], from[2], from[3]};
        transpose(q[0], q[1], q[2], q[3]);
        set_quad(a, part, q[0]), set_quad(b, part, q[1]);
        set_quad(c, part, q[2]), set_quad(d, part, q[3]);
    }
}

[[gnu::always_inline]] inline void to_points(const Lanes<2>& a, const Lanes<2>& b,
                                             const Lanes<2>& c, const Lanes<2>& d, Pairs* points) {
    points[0] = {Lanes<2>(__builtin_shufflevector(a.v, b.v, 0, 2)),
                 Lanes<2>(__builtin_shufflevector(c.v, d.v, 0, 2))};
    points[1] = {Lanes<2>(__builtin_shufflevector(a.v, b.v, 1, 3)),
                 Lanes<2>(__builtin_shufflevector(c.v, d.v, 1, 3))};
}
[[gnu::always_inline]] inline void from_points(const Pairs* points, Lanes<2>& a, Lanes<2>& b,
                                               Lanes<2>& c, Lanes<2>& d) {
    a.v = __builtin_shufflevector(points[0].low.v, points[1].low.v, 0, 2);
    b.v = __builtin_shufflevector(points[0].low.v, points[1].low.v, 1, 3);
    c.v = __builtin_shufflevector(points[0].high.v, points[1].high.v, 0, 2);
    d.v = __builtin_shufflevector(points[0].high.v, points[1].high.v, 1, 3);
}

}  // namespace breach::mpm
