// Converts between lanes and memory, in which points are stored by component and the values of a
// node together. Compiled once per instruction set, therefore always inline.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/materials/lanes.hpp"

namespace breach::mpm {

using materials::Lanes;

/// Four numbers in two registers, for CPUs with registers of two: a vector of four would be split
/// through memory, with a stall each time.
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
/// The four values of a node or point, for registers of N.
template <int N>
using Quad = typename QuadFor<N>::Type;

template <int N>
using Integers [[gnu::vector_size(N * sizeof(std::int32_t))]] = std::int32_t;

/// Numbers in memory, with the alignment of one. Accessed through this struct, because GCC 12
/// copies bytes through memory even from a register. Packed, because clang ignores a smaller
/// alignment of the vector type.
template <int N>
struct [[gnu::packed, gnu::may_alias]] InMemory {
    typename Lanes<N>::Vector v;
};

template <class Real>
[[gnu::always_inline]] inline Real load(const double* from) {
    if constexpr (std::is_same_v<Real, Pairs>) {
        return {load<Lanes<2>>(from), load<Lanes<2>>(from + 2)};
    } else {
        constexpr int N = materials::LaneTraits<Real>::count;
        return Real(reinterpret_cast<const InMemory<N>*>(from)->v);
    }
}
template <int N>
[[gnu::always_inline]] inline void store(double* to, const Lanes<N>& a) {
    reinterpret_cast<InMemory<N>*>(to)->v = a.v;
}
[[gnu::always_inline]] inline void store(double* to, const Pairs& a) {
    store(to, a.low);
    store(to + 2, a.high);
}

/// Truncates to integers.
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

/// Rows to columns, in place, in every group of four lanes.
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
[[gnu::always_inline]] inline void transpose(Lanes<8>& a, Lanes<8>& b, Lanes<8>& c, Lanes<8>& d) {
    const auto ab_low = __builtin_shufflevector(a.v, b.v, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto ab_high = __builtin_shufflevector(a.v, b.v, 1, 9, 3, 11, 5, 13, 7, 15);
    const auto cd_low = __builtin_shufflevector(c.v, d.v, 0, 8, 2, 10, 4, 12, 6, 14);
    const auto cd_high = __builtin_shufflevector(c.v, d.v, 1, 9, 3, 11, 5, 13, 7, 15);
    a.v = __builtin_shufflevector(ab_low, cd_low, 0, 1, 8, 9, 4, 5, 12, 13);
    b.v = __builtin_shufflevector(ab_high, cd_high, 0, 1, 8, 9, 4, 5, 12, 13);
    c.v = __builtin_shufflevector(ab_low, cd_low, 2, 3, 10, 11, 6, 7, 14, 15);
    d.v = __builtin_shufflevector(ab_high, cd_high, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// Lanes of both, one after the other.
[[gnu::always_inline]] inline Lanes<8> joined(const Lanes<4>& low, const Lanes<4>& high) {
    return Lanes<8>(__builtin_shufflevector(low.v, high.v, 0, 1, 2, 3, 4, 5, 6, 7));
}
[[gnu::always_inline]] inline Lanes<8> twice(const Lanes<4>& a) { return joined(a, a); }
[[gnu::always_inline]] inline Lanes<4> low_four(const Lanes<8>& a) {
    return Lanes<4>(__builtin_shufflevector(a.v, a.v, 0, 1, 2, 3));
}
[[gnu::always_inline]] inline Lanes<4> high_four(const Lanes<8>& a) {
    return Lanes<4>(__builtin_shufflevector(a.v, a.v, 4, 5, 6, 7));
}

/// Four components over N points to N points of four components.
[[gnu::always_inline]] inline void to_points(Lanes<4> a, Lanes<4> b, Lanes<4> c, Lanes<4> d,
                                             Lanes<4>* points) {
    transpose(a, b, c, d);
    points[0] = a, points[1] = b, points[2] = c, points[3] = d;
}
[[gnu::always_inline]] inline void to_points(Lanes<8> a, Lanes<8> b, Lanes<8> c, Lanes<8> d,
                                             Lanes<4>* points) {
    transpose(a, b, c, d);
    points[0] = low_four(a), points[1] = low_four(b);
    points[2] = low_four(c), points[3] = low_four(d);
    points[4] = high_four(a), points[5] = high_four(b);
    points[6] = high_four(c), points[7] = high_four(d);
}
/// And the inverse.
[[gnu::always_inline]] inline void from_points(const Lanes<4>* points, Lanes<4>& a, Lanes<4>& b,
                                               Lanes<4>& c, Lanes<4>& d) {
    a = points[0], b = points[1], c = points[2], d = points[3];
    transpose(a, b, c, d);
}
[[gnu::always_inline]] inline void from_points(const Lanes<4>* points, Lanes<8>& a, Lanes<8>& b,
                                               Lanes<8>& c, Lanes<8>& d) {
    a = joined(points[0], points[4]), b = joined(points[1], points[5]);
    c = joined(points[2], points[6]), d = joined(points[3], points[7]);
    transpose(a, b, c, d);
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
