// Cost of a call of NorSand compared with PM4Sand at equal error: one thread, CPU time, alternating
// rounds. A zone of points is sheared at constant volume; error: largest difference of shear stress
// from a fine run, over the initial vertical stress. No limits.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include "core/materials/norsand/norsand.hpp"
#include "core/materials/pm4sand/pm4sand.hpp"

namespace {

using breach::mechanics::Voigt;
namespace norsand = breach::materials::norsand;
namespace pm4sand = breach::materials::pm4sand;

constexpr double sigma_v = 100e3;
constexpr double K0 = 0.7;
constexpr std::size_t points = 64;
constexpr int rounds = 7;

double cpu_seconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct NorSandCase {
    using State = norsand::State;
    using Update = norsand::Update;
    norsand::Ready law;
    norsand::Options options;

    State start() const {
        const double p = (1.0 + 2.0 * K0) / 3.0 * sigma_v;
        return norsand::initialise(law, Voigt(-K0 * sigma_v, -sigma_v, -K0 * sigma_v, 0.0),
                                   0.05 + norsand::critical_void_ratio(law, p))
            .state;
    }
    double tau(const State& state) const { return norsand::stress(state)[3]; }
};

struct SandCase {
    using State = pm4sand::State;
    using Update = pm4sand::Update;
    pm4sand::Ready law;
    pm4sand::Options options;

    State start() const {
        return pm4sand::initialise(law, Voigt(-K0 * sigma_v, -sigma_v, 0.0, 0.0));
    }
    double tau(const State& state) const { return pm4sand::stress(law, state)[3]; }
};

enum class Way { single, batch };

struct Cost {
    double us_per_call, evaluations;
    std::vector<double> tau;  ///< of point 0 after each call
};

/// Shears all points in `steps` calls; the strains of points differ by a few per cent.
template <class Case>
Cost run(const Case& one, double strain, int steps, Way way, std::size_t count) {
    std::vector<typename Case::State> states(count, one.start());
    std::vector<Voigt> increments(count);
    std::vector<typename Case::Update> updates(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double share = 1.0 + 0.1 * std::sin(1.7 * static_cast<double>(k));
        increments[k] = Voigt(0.0, 0.0, 0.0, share * strain / steps);
    }
    Cost cost{0.0, 0.0, {}};
    double seconds = 0.0;
    for (int step = 0; step < steps; ++step) {
        const double before = cpu_seconds();
        if (way == Way::batch) {
            integrate(one.law, states, increments, one.options, updates);
        } else {
            for (std::size_t k = 0; k < count; ++k) {
                updates[k] = integrate(one.law, states[k], increments[k], one.options);
            }
        }
        seconds += cpu_seconds() - before;
        for (std::size_t k = 0; k < count; ++k) {
            states[k] = updates[k].state;
            cost.evaluations += updates[k].counts.evaluations;
        }
        cost.tau.push_back(one.tau(states[0]));
    }
    const double calls = static_cast<double>(count) * steps;
    cost.us_per_call = 1e6 * seconds / calls;
    cost.evaluations /= calls;
    return cost;
}

struct Row {
    double tolerance, error, evaluations;
    std::vector<double> single, batch;  ///< us per call, one per round
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Adds a round to every row.
template <class Case>
void add_round(Case one, double strain, int steps, std::vector<Row>& rows) {
    for (Row& row : rows) {
        one.options.tolerance = row.tolerance;
        const Cost single = run(one, strain, steps, Way::single, points);
        row.evaluations = single.evaluations;
        row.single.push_back(single.us_per_call);
        row.batch.push_back(run(one, strain, steps, Way::batch, points).us_per_call);
    }
}

template <class Case>
std::vector<Row> rows_of(Case one, double strain, int steps) {
    constexpr int finer = 20;
    const int usual = one.options.most_evaluations;
    one.options.tolerance = 1e-7;
    one.options.most_evaluations = 100000;
    const Cost fine = run(one, strain, finer * steps, Way::single, 1);
    one.options.most_evaluations = usual;
    std::vector<Row> rows;
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        one.options.tolerance = tolerance;
        const Cost cost = run(one, strain, steps, Way::single, 1);
        double worst = 0.0;
        for (int i = 0; i < steps; ++i) {
            worst = std::max(worst, std::abs(cost.tau[i] - fine.tau[finer * (i + 1) - 1]));
        }
        rows.push_back({tolerance, worst / sigma_v, 0.0, {}, {}});
    }
    return rows;
}

/// Median over the rounds of the cost relative to the cheapest other row with at most the same
/// error.
double ratio_at_equal_error(const Row& row, const std::vector<Row>& others) {
    const Row* match = nullptr;
    for (const Row& other : others) {
        if (other.error > row.error) continue;
        if (!match || median(other.single) < median(match->single)) match = &other;
    }
    if (!match) return std::nan("");
    std::vector<double> ratios;
    for (int k = 0; k < rounds; ++k) ratios.push_back(row.single[k] / match->single[k]);
    return median(ratios);
}

void print(const char* name, const std::vector<Row>& rows, const std::vector<Row>& others) {
    for (const Row& row : rows) {
        std::printf("%-10s %9.0e %9.1e %10.2f %10.3f %10.3f %10.2f\n", name, row.tolerance,
                    row.error, row.evaluations, median(row.single), median(row.batch),
                    ratio_at_equal_error(row, others));
    }
}

}  // namespace

int main() {
    norsand::Parameters loose{};
    loose.semi_log = {.Gamma = 1.2, .lambda = 0.06};
    loose.M_tc = 1.47, loose.N = 0.5, loose.chi_tc = 3.2, loose.H_0 = 75.0, loose.H_psi = 400.0;
    loose.G_ref = 20.97e6, loose.m = 0.5, loose.nu = 0.15, loose.S = 1.0;
    pm4sand::Parameters tailings = pm4sand::defaults(0.35, 476.0, 2.70);
    tailings.Q = 11.998, tailings.R = 3.75;
    const NorSandCase a{norsand::ready(loose), {}};
    const SandCase b{pm4sand::ready(tailings), {}};
    std::printf(
        "us per call and point, medians of %d rounds; ratio: single call over the cheapest\n"
        "of the other law that is no less exact\n",
        rounds);
    const struct {
        double step;
        int steps;
    } paths[] = {{1e-5, 300}, {1e-4, 200}, {1e-3, 100}};
    for (const auto& path : paths) {
        const double strain = path.step * path.steps;
        std::vector<Row> of_norsand = rows_of(a, strain, path.steps);
        std::vector<Row> of_sand = rows_of(b, strain, path.steps);
        for (int k = 0; k < rounds; ++k) {
            add_round(a, strain, path.steps, of_norsand);
            add_round(b, strain, path.steps, of_sand);
        }
        std::printf("\nstep %.0e\n%-10s %9s %9s %10s %10s %10s %10s\n", path.step, "law",
                    "tolerance", "error", "eval/call", "single us", "batch us", "ratio");
        print("NorSand", of_norsand, of_sand);
        print("PM4Sand", of_sand, of_norsand);
    }
}
