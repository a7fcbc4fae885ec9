// Integrates many points of one zone, one per lane of a vector register; a finished point is
// replaced by the next. Compiled once per instruction set, chosen at run time. A law provides the
// functions of calls.hpp.
#pragma once

#include <array>
#include <cassert>
#include <span>

#include "core/materials/calls.hpp"
#include "core/materials/lanes.hpp"
#include "core/materials/point.hpp"
#include "core/materials/width.hpp"

namespace breach::materials {

namespace side_by_side {

template <class Calls>
struct Job {
    const typename Calls::Ready& law;
    std::span<const typename Calls::State> old;
    std::span<const Voigt> d_epsilon;
    const typename Calls::Options& options;
    std::span<typename Calls::Update> updates;
    std::size_t next = 0;  ///< first point not yet begun
};

/// The point in one lane.
template <class Calls>
struct Seat {
    typename Calls::Task task{};
    std::size_t point = 0;
    bool busy = false;
};

/// Closes the point in a lane.
template <class Calls>
void leave(const Job<Calls>& job, Seat<Calls>& seat) {
    finish_call(job.law, job.old[seat.point], Calls::strain(job.d_epsilon[seat.point]), seat.task);
    seat.busy = false;
}

/// Opens points until one needs plastic steps; elastic ones are complete at once.
template <class Calls>
void take_next(Job<Calls>& job, Seat<Calls>& seat) {
    seat.busy = false;
    while (job.next < job.old.size() && !seat.busy) {
        seat.point = job.next++;
        const typename Calls::Strain d = Calls::strain(job.d_epsilon[seat.point]);
        const typename Calls::State& old = job.old[seat.point];
        seat.task.update = &job.updates[seat.point];
        if (!may_be_tried(d, job.options)) {
            job.updates[seat.point] = {old, decltype(Calls::Update::outcome)::refused, {}};
            continue;
        }
        seat.busy = open_call(job.law, old, d, seat.task);
        if (!seat.busy) finish_call(job.law, old, d, seat.task);
    }
}

template <int N>
[[gnu::always_inline]] inline MaskOf<Lanes<N>> mask_of(const std::array<bool, N>& flags) {
    MaskOf<Lanes<N>> mask;
    for (int i = 0; i < N; ++i) mask.m[i] = flags[i] ? -1 : 0;
    return mask;
}

template <int N, class Calls>
[[gnu::always_inline]] inline void walk_side_by_side(Job<Calls>& job) {
    typename Calls::template Walk<Lanes<N>> walk(job.law, job.options);
    std::array<Seat<Calls>, N> seats;
    std::array<bool, N> moving{};
    for (Seat<Calls>& seat : seats) take_next(job, seat);
    if (!seats[0].busy) return;
    // Empty lanes repeat the first point: valid numbers that are never used.
    for (int i = 0; i < N; ++i) load(seats[seats[i].busy ? i : 0].task, i, walk);

    const auto refill = [&](int i) {
        leave(job, seats[i]);
        take_next(job, seats[i]);
        if (seats[i].busy) load(seats[i].task, i, walk);
    };
    for (;;) {
        bool anyone = false;
        for (int i = 0; i < N; ++i) anyone |= moving[i] = seats[i].busy;
        if (!anyone) return;
        const auto unloads = walk.begin(mask_of<N>(moving));
        if (lanes::any(unloads)) {
            for (int i = 0; i < N; ++i) {
                if (!lanes::lane(unloads, i)) continue;
                const Next next = after_unloading(job.law, i, walk, seats[i].task);
                moving[i] = next == Next::walk;
                // Evaluations limit a lane that unloads repeatedly without progress.
                const bool spent =
                    next == Next::again && ends(i, walk, false, job.options, seats[i].task);
                if (spent) store(job.law, i, walk, seats[i].task);
                if (spent || next == Next::leave) refill(i);
            }
        }
        const auto lost = walk.advance(mask_of<N>(moving));
        for (int i = 0; i < N; ++i) {
            if (!moving[i]) continue;
            if (!ends(i, walk, lanes::lane(lost, i), job.options, seats[i].task)) continue;
            store(job.law, i, walk, seats[i].task);
            refill(i);
        }
    }
}

template <class Calls>
void walk_portable(Job<Calls>& job) {
    walk_side_by_side<2>(job);
}

#if defined(__x86_64__)
template <class Calls>
[[gnu::target("avx2")]] void walk_avx2(Job<Calls>& job) {
    walk_side_by_side<4>(job);
}
template <class Calls>
[[gnu::target("avx512f,avx512dq")]] void walk_avx512(Job<Calls>& job) {
    walk_side_by_side<8>(job);
}

template <class Calls>
void walk(Job<Calls>& job, Width width) {
    const bool wide = width == Width::widest || width == Width::avx512;
    if (wide && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
        return walk_avx512(job);
    }
    if (width != Width::portable && __builtin_cpu_supports("avx2")) return walk_avx2(job);
    walk_portable(job);
}
#else
template <class Calls>
void walk(Job<Calls>& job, Width) {
    walk_portable(job);
}
#endif

}  // namespace side_by_side

/// updates[i]: the call of old[i] with d_epsilon[i].
template <class Calls>
void call_side_by_side(const typename Calls::Ready& law, std::span<const typename Calls::State> old,
                       std::span<const Voigt> d_epsilon, const typename Calls::Options& options,
                       std::span<typename Calls::Update> updates, Width width) {
    assert(old.size() == d_epsilon.size() && old.size() == updates.size());
    side_by_side::Job<Calls> job{law, old, d_epsilon, options, updates};
    side_by_side::walk(job, width);
}

}  // namespace breach::materials
