// Cost and error of a call of PM4Sand: one thread, CPU time. A zone of points of tailings and
// foundation soil is sheared at constant volume in cycles of increasing amplitude; error: largest
// difference of shear stress from a fine run, over the initial vertical stress. A table without
// limits.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "core/materials/pm4sand/pm4sand.hpp"

namespace {

using namespace breach::materials::pm4sand;
using breach::mechanics::Voigt;

constexpr double sigma_v = 100e3;

double cpu_seconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Shear strain at pseudo-time t in [0, 1]: cycles up to `amplitude`.
std::vector<double> path(double amplitude, double step) {
    std::vector<double> increments;
    double gamma = 0.0;
    for (const double share : {0.2, -0.2, 0.4, -0.4, 0.7, -0.7, 1.0, -1.0, 1.0}) {
        const double way = share * amplitude - gamma;
        const long n = std::max(1L, std::lround(std::abs(way) / step));
        for (long i = 0; i < n; ++i) increments.push_back(way / static_cast<double>(n));
        gamma = share * amplitude;
    }
    return increments;
}

/// Amplitudes of points differ by a few per cent, so that their sub-steps differ.
double share_of(std::size_t k) { return 1.0 + 0.1 * std::sin(1.7 * static_cast<double>(k)); }

enum class Way { single, batch };

struct Setting {
    Ready law;
    Options options;
    double amplitude;
    double step;
};

struct Cost {
    double us_per_call;
    double evaluations;
    std::vector<double> tau;  ///< of point 0 at the turning points
};

Cost run(const Setting& setting, Way way, std::size_t points, Width width) {
    const auto increments = path(setting.amplitude, setting.step);
    const State start = initialise(setting.law, Voigt(-0.5 * sigma_v, -sigma_v, 0.0, 0.0));
    std::vector<State> states(points, start);
    std::vector<Voigt> strain(points);
    std::vector<Update> updates(points);
    Cost cost{0.0, 0.0, {}};
    double seconds = 0.0;
    for (std::size_t step = 0; step < increments.size(); ++step) {
        for (std::size_t k = 0; k < points; ++k) {
            strain[k] = Voigt(0.0, 0.0, 0.0, share_of(k) * increments[step]);
        }
        const double before = cpu_seconds();
        if (way == Way::batch) {
            integrate(setting.law, states, strain, setting.options, updates, width);
        } else {
            for (std::size_t k = 0; k < points; ++k) {
                updates[k] = integrate(setting.law, states[k], strain[k], setting.options);
            }
        }
        seconds += cpu_seconds() - before;
        for (std::size_t k = 0; k < points; ++k) {
            states[k] = updates[k].state;
            cost.evaluations += updates[k].counts.evaluations;
        }
        const bool turns =
            step + 1 == increments.size() || increments[step] * increments[step + 1] < 0.0;
        if (turns) cost.tau.push_back(stress(setting.law, states[0])[3]);
    }
    const double calls = static_cast<double>(points * increments.size());
    cost.us_per_call = 1e6 * seconds / calls;
    cost.evaluations /= calls;
    return cost;
}

double error_of(const std::vector<double>& tau, const std::vector<double>& fine) {
    double worst = 0.0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        worst = std::max(worst, std::abs(tau[i] - fine[i]));
    }
    return worst / sigma_v;
}

void table(const char* name, const Parameters& parameters) {
    const Ready law = ready(parameters);
    std::printf("\n%s\n%8s %-10s %8s %9s %12s %12s %12s %12s %12s\n", name, "step", "scheme",
                "tolerance", "eval/call", "single us", "avx512 us", "avx2 us", "portable us",
                "error/sigma_v");
    const struct {
        double step, amplitude;
        std::size_t points;
    } rows[] = {{1e-5, 2e-3, 64}, {1e-4, 1e-2, 64}, {1e-3, 5e-2, 64}};
    for (const auto& row : rows) {
        const Setting fine{law, {.tolerance = 1e-7}, row.amplitude, row.step / 20.0};
        const auto truth = run(fine, Way::single, 1, Width::widest).tau;
        for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
            const Setting setting{law, {.tolerance = tolerance}, row.amplitude, row.step};
            const Cost single = run(setting, Way::single, row.points, Width::widest);
            const Cost widest = run(setting, Way::batch, row.points, Width::avx512);
            const Cost wide = run(setting, Way::batch, row.points, Width::avx2);
            const Cost portable = run(setting, Way::batch, row.points, Width::portable);
            std::printf("%8.0e %-10s %8.0e %9.2f %12.3f %12.3f %12.3f %12.3f %12.1e\n", row.step,
                        "adaptive", tolerance, single.evaluations, single.us_per_call,
                        widest.us_per_call, wide.us_per_call, portable.us_per_call,
                        error_of(single.tau, truth));
        }
        const Setting reference{law, {.scheme = Scheme::reference}, row.amplitude, row.step};
        const Cost cost = run(reference, Way::single, 4, Width::widest);
        std::printf("%8.0e %-10s %8s %9.2f %12.3f %12s %12s %12s %12.1e\n", row.step, "reference",
                    "-", cost.evaluations, cost.us_per_call, "-", "-", "-",
                    error_of(cost.tau, truth));
    }
}

}  // namespace

int main() {
    std::printf(
        "us per call and point, one thread, CPU time; a width that this CPU lacks is the next "
        "one\n");
    Parameters calibrated = defaults(0.35, 476.0, 2.70);
    calibrated.Q = 11.998;
    calibrated.R = 3.75;
    table("calibrated tailings", calibrated);
    table("default tailings", defaults(0.35, 476.0, 0.53));
    table("foundation", defaults(0.75, 890.0, 0.63));
}
