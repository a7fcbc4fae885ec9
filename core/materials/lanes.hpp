// One formula for one point or several side by side: `double` and `Lanes<N>` have the same
// operations with the same bits in each lane, so that a batch gives exactly the results of single
// calls. exp, log, sine and cosine are our own because the C library has no vector versions with
// the same bits.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace breach::materials {

/// N doubles in a vector register (GCC and clang vector extensions; any CPU).
template <int N>
struct Lanes {
    using Vector [[gnu::vector_size(N * sizeof(double))]] = double;
    using Bits [[gnu::vector_size(N * sizeof(double))]] = std::int64_t;

    Vector v;

    Lanes() = default;
    [[gnu::always_inline]] explicit Lanes(const Vector& vector) : v(vector) {}
    /// The same number in every lane. `number - 0` compiles to a broadcast; `0 + number` to an
    /// addition, because -0 + 0 is 0.
    [[gnu::always_inline]] Lanes(double number) : v(number - Vector{}) {}

    [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) {
        return Lanes(a.v + b.v);
    }
    [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) {
        return Lanes(a.v - b.v);
    }
    [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) {
        return Lanes(a.v * b.v);
    }
    [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) {
        return Lanes(a.v / b.v);
    }
    [[gnu::always_inline]] friend Lanes operator-(const Lanes& a) { return Lanes(-a.v); }

    /// All bits of a lane are 1 where the condition is true.
    struct Mask {
        Bits m;
        [[gnu::always_inline]] friend Mask operator&(const Mask& a, const Mask& b) {
            return {a.m & b.m};
        }
        [[gnu::always_inline]] friend Mask operator|(const Mask& a, const Mask& b) {
            return {a.m | b.m};
        }
        [[gnu::always_inline]] friend Mask operator!(const Mask& a) { return {~a.m}; }
    };
    [[gnu::always_inline]] friend Mask operator<(const Lanes& a, const Lanes& b) {
        return {a.v < b.v};
    }
    [[gnu::always_inline]] friend Mask operator<=(const Lanes& a, const Lanes& b) {
        return {a.v <= b.v};
    }
    [[gnu::always_inline]] friend Mask operator>(const Lanes& a, const Lanes& b) {
        return {a.v > b.v};
    }
    [[gnu::always_inline]] friend Mask operator>=(const Lanes& a, const Lanes& b) {
        return {a.v >= b.v};
    }
};

template <class Real>
struct LaneTraits;

template <>
struct LaneTraits<double> {
    static constexpr int count = 1;
    using Mask = bool;
    using Bits = std::int64_t;
};

template <int N>
struct LaneTraits<Lanes<N>> {
    static constexpr int count = N;
    using Mask = typename Lanes<N>::Mask;
    using Bits = typename Lanes<N>::Bits;
};

template <class Real>
using MaskOf = typename LaneTraits<Real>::Mask;

namespace lanes {

[[gnu::always_inline]] inline double select(bool mask, double yes, double no) {
    return mask ? yes : no;
}
template <int N>
[[gnu::always_inline]] inline Lanes<N> select(const typename Lanes<N>::Mask& mask,
                                              const Lanes<N>& yes, const Lanes<N>& no) {
    return Lanes<N>(mask.m ? yes.v : no.v);
}

[[gnu::always_inline]] inline bool any(bool mask) { return mask; }
/// Uses one instruction if there is one; GCC 12 would test lane by lane.
template <class Mask>
[[gnu::always_inline]] inline bool any(const Mask& mask) {
#if defined(__AVX512DQ__)
    if constexpr (sizeof(mask.m) == 64) return _mm512_movepi64_mask((__m512i)mask.m) != 0;
#endif
#if defined(__AVX__)
    if constexpr (sizeof(mask.m) == 32) return _mm256_movemask_pd((__m256d)mask.m) != 0;
#endif
    std::int64_t all = 0;
    for (std::size_t i = 0; i < sizeof(mask.m) / sizeof(std::int64_t); ++i) all |= mask.m[i];
    return all != 0;
}

[[gnu::always_inline]] inline double lane(double a, int) { return a; }
template <int N>
[[gnu::always_inline]] inline double lane(const Lanes<N>& a, int i) {
    return a.v[i];
}
[[gnu::always_inline]] inline void set_lane(double& a, int, double value) { a = value; }
template <int N>
[[gnu::always_inline]] inline void set_lane(Lanes<N>& a, int i, double value) {
    a.v[i] = value;
}
[[gnu::always_inline]] inline bool lane(bool mask, int) { return mask; }
template <class Mask>
requires requires(Mask a) { a.m; }
[[gnu::always_inline]] inline bool lane(const Mask& mask, int i) { return mask.m[i] != 0; }

[[gnu::always_inline]] inline double root(double a) { return std::sqrt(a); }
template <int N>
[[gnu::always_inline]] inline Lanes<N> root(const Lanes<N>& a) {
    Lanes<N> out;
    for (int i = 0; i < N; ++i) out.v[i] = __builtin_sqrt(a.v[i]);
    return out;
}

[[gnu::always_inline]] inline std::int64_t bits_of(double a) {
    return std::bit_cast<std::int64_t>(a);
}
template <int N>
[[gnu::always_inline]] inline typename Lanes<N>::Bits bits_of(const Lanes<N>& a) {
    return (typename Lanes<N>::Bits)a.v;
}
template <class Real>
[[gnu::always_inline]] inline Real from_bits(const typename LaneTraits<Real>::Bits& bits) {
    if constexpr (LaneTraits<Real>::count == 1) {
        return std::bit_cast<double>(bits);
    } else {
        return Real((typename Real::Vector)bits);
    }
}

template <class Real>
[[gnu::always_inline]] inline Real larger(const Real& a, const Real& b) {
    return select(a > b, a, b);
}
template <class Real>
[[gnu::always_inline]] inline Real smaller(const Real& a, const Real& b) {
    return select(a < b, a, b);
}
/// Macaulay bracket <a>.
template <class Real>
[[gnu::always_inline]] inline Real positive(const Real& a) {
    return larger(a, Real(0.0));
}
template <class Real>
[[gnu::always_inline]] inline Real magnitude(const Real& a) {
    return larger(a, -a);
}

/// Adding this leaves the nearest integer in the low bits of the mantissa.
inline constexpr double to_integer = 0x1.8p52;

/// e^x to about 2 units in the last place; x is clamped to [-700, 700].
template <class Real>
[[gnu::always_inline]] inline Real exponential(const Real& argument) {
    const Real x = larger(smaller(argument, Real(700.0)), Real(-700.0));
    const Real shifted = x * Real(1.44269504088896340736) + Real(to_integer);
    const Real k = shifted - Real(to_integer);
    const Real r =
        (x - k * Real(6.93147180369123816490e-01)) - k * Real(1.90821492927058770002e-10);
    const Real r2 = r * r;
    const Real r4 = r2 * r2;
    // Taylor series for |r| <= ln(2) / 2, in short chains that the CPU can execute in parallel.
    const Real even =
        (Real(1.0) + r2 * Real(1.0 / 2)) +
        r4 * ((Real(1.0 / 24) + r2 * Real(1.0 / 720)) +
              r4 * ((Real(1.0 / 40320) + r2 * Real(1.0 / 3628800)) + r4 * Real(1.0 / 479001600)));
    const Real odd = (Real(1.0) + r2 * Real(1.0 / 6)) +
                     r4 * ((Real(1.0 / 120) + r2 * Real(1.0 / 5040)) +
                           r4 * (Real(1.0 / 362880) + r2 * Real(1.0 / 39916800)));
    const Real scale = from_bits<Real>((bits_of(shifted) << 52) + bits_of(Real(1.0)));
    return (even + r * odd) * scale;
}

/// ln x to about 2 units in the last place, x a positive normal number.
template <class Real>
[[gnu::always_inline]] inline Real logarithm(const Real& x) {
    // x = 2^k y with y in [sqrt(1/2), sqrt(2)).
    const auto offset = bits_of(x) - bits_of(Real(0.70710678118654752440));
    const auto exponent = (offset >> 52);
    const Real y = from_bits<Real>(bits_of(x) - (exponent << 52));
    const Real k = from_bits<Real>(exponent + bits_of(Real(to_integer))) - Real(to_integer);
    const Real s = (y - Real(1.0)) / (y + Real(1.0));
    const Real s2 = s * s;
    const Real s4 = s2 * s2;
    const Real s8 = s4 * s4;
    // (s^2/3 + s^4/5 + ...) / s^2, in short chains.
    const Real series =
        ((Real(1.0 / 3) + s2 * Real(1.0 / 5)) + s4 * (Real(1.0 / 7) + s2 * Real(1.0 / 9))) +
        s8 * (((Real(1.0 / 11) + s2 * Real(1.0 / 13)) +
               s4 * (Real(1.0 / 15) + s2 * Real(1.0 / 17))) +
              s8 * (Real(1.0 / 19) + s2 * Real(1.0 / 21)));
    const Real tail = s * s2 * series;
    return k * Real(6.93147180559945286227e-01) + Real(2.0) * (s + tail);
}

template <class Real>
struct Turn {
    Real cosine;
    Real sine;
};

/// Cosine and sine of an angle [rad], |angle| < 1e5.
template <class Real>
[[gnu::always_inline]] inline Turn<Real> turn(const Real& angle) {
    const Real shifted = angle * Real(0.63661977236758134308) + Real(to_integer);
    const Real k = shifted - Real(to_integer);
    const Real r =
        (angle - k * Real(1.57079632673412561417e+00)) - k * Real(6.07710050650619224932e-11);
    const Real r2 = r * r;
    const Real sine =
        r +
        r * r2 *
            (Real(-1.0 / 6) + r2 * (Real(1.0 / 120) +
                                    r2 * (Real(-1.0 / 5040) +
                                          r2 * (Real(1.0 / 362880) +
                                                r2 * (Real(-1.0 / 39916800) +
                                                      r2 * (Real(1.0 / 6227020800.0) +
                                                            r2 * Real(-1.0 / 1307674368000.0)))))));
    const Real cosine =
        Real(1.0) +
        r2 * (Real(-1.0 / 2) +
              r2 * (Real(1.0 / 24) + r2 * (Real(-1.0 / 720) +
                                           r2 * (Real(1.0 / 40320) +
                                                 r2 * (Real(-1.0 / 3628800) +
                                                       r2 * (Real(1.0 / 479001600) +
                                                             r2 * Real(-1.0 / 87178291200.0)))))));
    // Quarter turns: an odd number swaps sine and cosine, the second bit changes the sign.
    const auto quarters = bits_of(shifted);
    const Real odd = from_bits<Real>((quarters & 1) << 62);  // 0 or 2
    const auto swap = odd > Real(1.0);
    const Real sine_sign = from_bits<Real>(((quarters & 2) << 62) | bits_of(Real(1.0)));
    const Real cosine_sign = from_bits<Real>((((quarters + 1) & 2) << 62) | bits_of(Real(1.0)));
    return {select(swap, sine, cosine) * cosine_sign, select(swap, cosine, sine) * sine_sign};
}

}  // namespace lanes
}  // namespace breach::materials
