// Points in blocks of register width. Compiled once per instruction set.
// The loops have no remainder loop: the last points of a span go through a copy (Tail), whose spare
// lanes repeat a valid point, so that no law sees undefined numbers.
#pragma once

#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <iterator>

#include "mpm_solver/loops/lane_memory.hpp"
#include "mpm_solver/loops/loops.hpp"

namespace breach::mpm {

/// A block: its points are `arrays` + p, `first` is the index of its first one; `count` lanes have
/// points.
struct Block {
    const PointArrays& arrays;
    std::size_t p;
    std::size_t first;
    int count;
};

/// The last points of a span, fewer than a block, in separate arrays; the other lanes repeat the
/// last point.
template <class Isa>
class Tail {
  public:
    [[gnu::noinline]] void read(const PointArrays& points, std::size_t first, int count) {
        double* to = values_[0];
        for (const auto& real : reals_of_points<double*>) {
            const double* from = points.*real.array;
            if (!from) continue;
            for (int k = 0; k < N; ++k) to[k] = from[first + (k < count ? k : count - 1)];
            arrays_.*real.array = to;
            to += N;
        }
        for (int k = 0; k < N; ++k) {
            cells_[k] = points.cell[first + (k < count ? k : count - 1)];
        }
        arrays_.cell = cells_;
    }
    [[gnu::noinline]] void write_back(const PointArrays& points, std::size_t first, int count) {
        for (const auto& real : reals_of_points<double*>) {
            double* to = points.*real.array;
            if (!to) continue;
            for (int k = 0; k < count; ++k) to[first + k] = (arrays_.*real.array)[k];
        }
        for (int k = 0; k < count; ++k) points.cell[first + k] = cells_[k];
    }
    [[gnu::always_inline]] const PointArrays& arrays() const { return arrays_; }

  private:
    static constexpr int N = Isa::lanes;
    double values_[std::size(reals_of_points<double*>)][N];
    std::int32_t cells_[N];
    PointArrays arrays_{};
};

/// Calls each(Block) for all points of the span.
template <class Isa, class Each>
[[gnu::always_inline]] inline void for_each_block(const PointArrays& points, Span span,
                                                  Each&& each) {
    constexpr std::size_t N = Isa::lanes;
    Tail<Isa> tail;
    for (std::size_t p = span.begin; p < span.end; p += N) {
        // A block never reaches past its span: the points beyond may be another thread's.
        const bool whole = p + N <= span.end;
        const int count = whole ? static_cast<int>(N) : static_cast<int>(span.end - p);
        if (!whole) tail.read(points, p, count);
        each(Block{whole ? points : tail.arrays(), whole ? p : 0, p, count});
        if (!whole) tail.write_back(points, p, count);
    }
}

/// Prefetches later points: they are in a dozen arrays, more than a CPU prefetches by itself, and
/// 20,000 points exceed its cache.
[[gnu::always_inline]] inline void ask_ahead(const Block& block,
                                             std::initializer_list<const double*> arrays) {
    constexpr std::size_t points = 32;
    for (const double* from : arrays) __builtin_prefetch(from + block.p + points);
}

/// 1 in lanes with points.
template <class Real>
[[gnu::always_inline]] inline materials::MaskOf<Real> own_lanes(const Block& block) {
    return counting<materials::LaneTraits<Real>::count>() < Real(block.count);
}

/// The weights of a block's points at their 3 x 3 nodes, for scalar reads.
template <int N>
struct Weights {
    double Nx[3][N];
    double dNx[3][N];
    double Ny[3][N];
    double dNy[3][N];
    std::int32_t node[N];  ///< first of the 3 x 3

    [[gnu::always_inline]] Weights(const Stencil<Lanes<N>>& sx, const Stencil<Lanes<N>>& sy,
                                   std::int32_t rows) {
        for (int i = 0; i < 3; ++i) {
            store(Nx[i], sx.N[i]);
            store(dNx[i], sx.dN[i]);
            store(Ny[i], sy.N[i]);
            store(dNy[i], sy.dN[i]);
        }
        store<N>(node, integers(sx.first * Lanes<N>(rows) + sy.first));
    }
};

}  // namespace breach::mpm
