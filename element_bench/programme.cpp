// Drives a specimen through a test and records readings. `Test` holds the specimen and the record;
// the functions below it decide the next strain. Run by run.cpp for the tests of a document, by
// calibration.cpp for each evaluation of PM4Sand, and by triaxial.cpp for NorSand's curves. A law
// that cannot follow ends the test early, with the readings so far.
#include "element_bench/programme.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace breach::element_bench {

namespace {

/// A specimen in a test and its record. advance() moves the specimen; attempt() only tries, and
/// the caller decides by the trial whether to accept it. Both count as calls of the law.
class Test {
  public:
    Test(const Specimen& start, Boundary boundary, const Pace& pace)
        : boundary_(boundary),
          pace_(pace),
          held_(held_stress(start, boundary)),
          sigma_yy_0_(-stress(start)[1]) {
        record_.last = start;
        record_.peak = answer();
        read(0.0);
    }

    const Specimen& specimen() const { return record_.last; }
    double strain() const { return driven_strain(record_.last, boundary_); }
    double answer() const { return response(record_.last, boundary_); }
    /// By the vertical stress alone: at constant total stress, what it loses is excess pore
    /// pressure.
    double r_u() const {
        return sigma_yy_0_ != 0.0 ? 1.0 + stress(record_.last)[1] / sigma_yy_0_ : 0.0;
    }

    Trial attempt(double d) {
        Trial trial = driven(record_.last, boundary_, d, held_);
        record_.counts += trial.counts;
        ++record_.calls;
        return trial;
    }
    /// False if the specimen could not follow.
    bool accept(const Trial& trial) {
        if (trial.outcome == Ending::failed) {
            record_.outcome = Ending::failed;
            return false;
        }
        record_.last = trial.specimen;
        ++accepted_;
        note_peak(record_.last);
        return true;
    }
    bool advance(double d) { return accept(attempt(d)); }

    /// Rise of the response in a call of `d` at its initial slope [Pa].
    double rise(double d) {
        constexpr double share = 1e-3;  // of the call
        const Trial trial = attempt(share * d);
        return trial.outcome == Ending::done
                   ? (response(trial.specimen, boundary_) - answer()) / share
                   : 0.0;
    }
    /// For a call of `d` from `at` in which the response rises first and falls at the end: repeats
    /// it in tenths, and the tenths around the first peak again, until the peak converges.
    void refine_peak(Specimen at, double d) {
        constexpr double settled = 1e-5;
        for (int level = 0; level < 8; ++level) {
            const double known = record_.peak, part = 0.1 * d;
            Specimen before = at, here = at;
            for (int k = 0; k < 10; ++k) {
                Trial trial = driven(here, boundary_, part, held_);
                record_.counts += trial.counts;
                ++record_.calls;
                if (trial.outcome == Ending::failed) return;
                note_peak(trial.specimen);
                const bool falls = response(trial.specimen, boundary_) < response(here, boundary_);
                if (falls) break;
                before = std::exchange(here, std::move(trial.specimen));
            }
            if (level > 0 && record_.peak - known <= settled * std::abs(record_.peak)) return;
            at = std::move(before);
            d = 2.0 * part;
        }
    }
    double peak() const { return record_.peak; }

    /// Whether the pace asks for a reading after this many accepted calls.
    bool due() const { return pace_.every > 0 && accepted_ % pace_.every == 0; }
    void read(double cycles) {
        const Voigt sigma = stress(record_.last);
        record_.readings.push_back({.strain = strain(),
                                    .response = answer(),
                                    .sigma_xx = -sigma[0],
                                    .sigma_yy = -sigma[1],
                                    .sigma_zz = -sigma[2],
                                    .tau = sigma[3],
                                    .epsilon_v = record_.last.epsilon_v,
                                    .r_u = r_u(),
                                    .cycles = cycles,
                                    .norsand = {}});
        if (const NorSandPoint* point = norsand_in(record_.last)) {
            record_.readings.back().norsand = point->state;
        }
    }
    /// The last state is always read, whether the pace asks for it or not.
    Record finish(double cycles) {
        if (!due()) read(cycles);
        return std::move(record_);
    }

  private:
    /// Also called within refined steps: the peak is not bound to readings.
    void note_peak(const Specimen& specimen) {
        const double here = response(specimen, boundary_);
        if (!(here > record_.peak)) return;
        record_.peak = here;
        record_.peak_strain = driven_strain(specimen, boundary_);
    }

    Boundary boundary_;
    Pace pace_;
    double held_;
    double sigma_yy_0_;
    long accepted_ = 0;
    Record record_;
};

}  // namespace

/// Steps are equal and end on the target: about pace.step each.
Record monotonic(const Specimen& start, Boundary boundary, double target, const Pace& pace) {
    Test test(start, boundary, pace);
    const double way = target - driven_strain(start, boundary);
    const long steps = std::max(1L, std::lround(std::abs(way) / pace.step));
    const double d = way / static_cast<double>(steps);
    // A step can hide a peak: the response rises at its beginning and falls at its end. Its height
    // is at most the initial slope times the step, so that only steps which could exceed the known
    // peak are repeated in parts.
    double rise = test.rise(d);
    for (long i = 0; i < steps; ++i) {
        const Specimen before = test.specimen();
        const double bound = test.answer() + rise;
        if (!test.advance(d)) break;
        const bool rose = std::exchange(rise, test.rise(d)) > 0.0;
        if (rose && rise < 0.0 && bound > test.peak()) test.refine_peak(before, d);
        if (test.due()) test.read(0.0);
    }
    return test.finish(0.0);
}

namespace {

/// The step in (0, d] with the response `target`, by the Illinois method. Every trial starts from
/// the same specimen.
/// Illinois halves the old end's value: plain false position would keep one end throughout.
Trial step_onto(Test& test, Boundary boundary, double d, double target, double tolerance) {
    double a = 0.0, fa = test.answer() - target;
    double b = d;
    Trial trial = test.attempt(b);
    double fb = response(trial.specimen, boundary) - target;
    for (int pass = 0; pass < 60; ++pass) {
        if (std::abs(fb) <= tolerance || trial.outcome == Ending::failed) break;
        const double c = b - fb * (b - a) / (fb - fa);
        trial = test.attempt(c);
        const double fc = response(trial.specimen, boundary) - target;
        if (fc * fb < 0.0) {
            a = b;
            fa = fb;
        } else {
            fa *= 0.5;
        }
        b = c;
        fb = fc;
    }
    return trial;
}

}  // namespace

/// Strain is driven until the response passes the target; that step is repeated to end on it
/// (step_onto), and the direction turns.
/// N is read from the stress, not counted in steps: it is continuous, and a specimen that flows
/// stays at the phase that it reached.
CyclicResult cyclic_stress(const Specimen& start, Boundary boundary, const CyclicStress& load,
                           const Limit& limit, const Pace& pace) {
    CyclicResult result;
    Test test(start, boundary, pace);
    const double mean = load.mean.value_or(response(start, boundary));
    const double tolerance = 1e-9 * load.amplitude;
    double direction = 1.0;
    double N = 0.0;
    int half_cycles = 0;
    while (half_cycles <= 2 * limit.cycles) {
        const double target = mean + direction * load.amplitude;
        Trial trial = test.attempt(direction * pace.step);
        bool turns = false;
        if (trial.outcome == Ending::done &&
            direction * (response(trial.specimen, boundary) - target) >= -tolerance) {
            trial = step_onto(test, boundary, direction * pace.step, target, tolerance);
            turns = true;
        }
        if (!test.accept(trial)) break;

        // Phase of the equivalent sine: first a quarter, then half cycles.
        const double x = std::clamp((test.answer() - mean) / load.amplitude, -1.0, 1.0);
        const double phase = std::asin(x) / (2.0 * std::numbers::pi);
        N = std::max(N, 0.5 * half_cycles + direction * phase);
        const double r_u = test.r_u();
        result.largest_r_u = std::max(result.largest_r_u, r_u);
        // Turning points are always read: the ends of loops are what a figure needs.
        if (test.due() || turns) test.read(N);
        const double strain = std::abs(test.strain());
        if (result.N_1_percent < 0.0 && strain >= 0.01) result.N_1_percent = N;
        if (result.N_r_u < 0.0 && r_u >= 0.95) result.N_r_u = N;
        if (strain >= limit.strain) {
            result.N_strain = N;
            break;
        }
        if (r_u >= limit.r_u) break;
        if (turns) {
            direction = -direction;
            ++half_cycles;
        }
    }
    result.record = test.finish(N);
    return result;
}

/// A law that fails ends the test here; hysteresis() recognises it by the readings that are
/// missing.
Record cyclic_strain(const Specimen& start, Boundary boundary, double amplitude, int cycles,
                     const Pace& pace) {
    Test test(start, boundary, pace);
    double from = driven_strain(start, boundary);
    double N = 0.0;
    /// N counts quarters of a cycle by the way that the strain has gone.
    // Turning points: up after a quarter, down, up, ..., and back to the middle.
    for (int leg = 0; leg <= 2 * cycles; ++leg) {
        const double side = leg % 2 == 0 ? 1.0 : -1.0;
        const double to = leg == 2 * cycles ? 0.0 : side * amplitude;
        const long steps = std::max(1L, std::lround(std::abs(to - from) / pace.step));
        const double part = std::abs(to - from) / amplitude / 4.0 / static_cast<double>(steps);
        for (long i = 0; i < steps; ++i) {
            if (!test.advance((to - from) / static_cast<double>(steps))) return test.finish(N);
            N += part;
            if (test.due()) test.read(N);
        }
        from = to;
    }
    return test.finish(N);
}

/// Runs one cycle more than is read, as cyclic_strain() ends in the middle and not at a peak.
Loop hysteresis(const Specimen& start, Boundary boundary, double amplitude, int cycles, int steps) {
    const Record record = cyclic_strain(start, boundary, amplitude, cycles + 1,
                                        {.step = amplitude / steps, .every = 1});
    const auto& all = record.readings;
    // The last complete loop: from the previous positive peak to the last one.
    const std::size_t peak = static_cast<std::size_t>(steps) * (4 * (cycles - 1) + 1);
    const std::size_t next = peak + 4 * static_cast<std::size_t>(steps);
    if (next >= all.size()) return {amplitude, std::nullopt, std::nullopt};
    // The area by trapezoids: all[i] are a step apart, and the loop closes only if it has settled.
    double lost = 0.0, high = all[peak].response, low = high;
    for (std::size_t i = peak; i < next; ++i) {
        lost += 0.5 * (all[i].response + all[i + 1].response) * (all[i + 1].strain - all[i].strain);
        low = std::min(low, all[i + 1].response);
    }
    const double G = (high - low) / (2.0 * amplitude);
    const double damping = lost / (2.0 * std::numbers::pi * G * amplitude * amplitude);
    return {amplitude, G, std::isfinite(damping) ? std::optional(damping) : std::nullopt};
}

}  // namespace breach::element_bench
