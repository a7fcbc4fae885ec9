// Many points of one zone, several side by side, as PM4Sand's batch does it: a point in each lane
// of a vector register, and one that is finished makes room for the next. The same text is compiled
// once per instruction set and chosen when the program runs.
#include <array>
#include <cassert>

#include "core/materials/norsand/call.hpp"

namespace breach::materials::norsand {

namespace {

struct Job {
    const Ready& law;
    std::span<const State> old;
    std::span<const Voigt> d_epsilon;
    const Options& options;
    std::span<Update> updates;
    std::size_t next = 0;  ///< first point that nobody has taken
};

/// One lane's point.
struct Seat {
    Errand errand{};
    std::size_t point = 0;
    bool busy = false;
};

void leave(const Job& job, Seat& seat) {
    finish_call(job.law, job.old[seat.point], inward(job.d_epsilon[seat.point]), seat.errand);
    seat.busy = false;
}

/// Opens points until one has plastic strain to walk through; elastic ones are done at once.
void take_next(Job& job, Seat& seat) {
    seat.busy = false;
    while (job.next < job.old.size() && !seat.busy) {
        seat.point = job.next++;
        const Strain d = inward(job.d_epsilon[seat.point]);
        const State& old = job.old[seat.point];
        seat.errand.update = &job.updates[seat.point];
        if (!may_be_tried(d, job.options)) {
            job.updates[seat.point] = {old, Outcome::refused, {}};
            continue;
        }
        seat.busy = open_call(job.law, old, d, job.options, seat.errand);
        if (!seat.busy) finish_call(job.law, old, d, seat.errand);
    }
}

template <int N>
[[gnu::always_inline]] inline MaskOf<Lanes<N>> mask_of(const std::array<bool, N>& flags) {
    MaskOf<Lanes<N>> mask;
    for (int i = 0; i < N; ++i) mask.m[i] = flags[i] ? -1 : 0;
    return mask;
}

template <int N>
[[gnu::always_inline]] inline void walk_side_by_side(Job& job) {
    Walk<Lanes<N>> walk(job.law, job.options);
    std::array<Seat, N> seats;
    std::array<bool, N> moving{};
    for (Seat& seat : seats) take_next(job, seat);
    if (!seats[0].busy) return;
    // Empty seats repeat the first point: their numbers are harmless and never read.
    for (int i = 0; i < N; ++i) load(seats[seats[i].busy ? i : 0].errand, i, walk);

    const auto refill = [&](int i) {
        leave(job, seats[i]);
        take_next(job, seats[i]);
        if (seats[i].busy) load(seats[i].errand, i, walk);
    };
    for (;;) {
        bool anyone = false;
        for (int i = 0; i < N; ++i) anyone |= moving[i] = seats[i].busy;
        if (!anyone) return;
        const auto unloads = walk.begin(mask_of<N>(moving));
        if (lanes::any(unloads)) {
            for (int i = 0; i < N; ++i) {
                if (!lanes::lane(unloads, i)) continue;
                const Next next = after_unloading(job.law, job.options, i, walk, seats[i].errand);
                moving[i] = next == Next::walk;
                if (next == Next::leave) refill(i);
            }
        }
        const auto lost = walk.advance(mask_of<N>(moving));
        for (int i = 0; i < N; ++i) {
            if (!moving[i]) continue;
            if (!ends(i, walk, lanes::lane(lost, i), job.options, seats[i].errand)) continue;
            store(i, walk, seats[i].errand);
            refill(i);
        }
    }
}

void walk_portable(Job& job) { walk_side_by_side<2>(job); }

#if defined(__x86_64__)
[[gnu::target("avx2")]] void walk_avx2(Job& job) { walk_side_by_side<4>(job); }
[[gnu::target("avx512f,avx512dq")]] void walk_avx512(Job& job) { walk_side_by_side<8>(job); }

void walk(Job& job, Width width) {
    const bool wide = width == Width::widest || width == Width::avx512;
    if (wide && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) {
        return walk_avx512(job);
    }
    if (width != Width::portable && __builtin_cpu_supports("avx2")) return walk_avx2(job);
    walk_portable(job);
}
#else
void walk(Job& job, Width) { walk_portable(job); }
#endif

}  // namespace

void integrate(const Ready& law, std::span<const State> old, std::span<const Voigt> d_epsilon,
               const Options& options, std::span<Update> updates, Width width) {
    assert(old.size() == d_epsilon.size() && old.size() == updates.size());
    Job job{law, old, d_epsilon, options, updates};
    walk(job, width);
}

}  // namespace breach::materials::norsand
