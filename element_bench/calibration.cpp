// Finds PM4Sand's free parameters for run.cpp's run_calibration(). Each evaluation simulates whole
// tests, and there are no derivatives: the search samples the box of the bounds first, descends
// from the three best samples, and ends with new simplices around the best. Everything is
// deterministic: the same document gives the same parameters.
#include "element_bench/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/numerics/simplex.hpp"

namespace breach::element_bench {

namespace pm4sand = materials::pm4sand;

namespace {

struct Named {
    const char* name;
    double SandParameters::*member;
};

constexpr Named named[] = {
    {"D_R", &SandParameters::D_R},     {"G_0", &SandParameters::G_0},
    {"h_po", &SandParameters::h_po},   {"h_0", &SandParameters::h_0},
    {"n_b", &SandParameters::n_b},     {"n_d", &SandParameters::n_d},
    {"c_z", &SandParameters::c_z},     {"c_epsilon", &SandParameters::c_epsilon},
    {"C_GD", &SandParameters::C_GD},   {"C_DR", &SandParameters::C_DR},
    {"C_Kaf", &SandParameters::C_Kaf}, {"Q", &SandParameters::Q},
    {"R", &SandParameters::R},         {"phi_cv", &SandParameters::phi_cv},
};

/// A specimen at rest, consolidated to sigma_v [Pa, compression positive] at K0; the law counts
/// tension positive.
Specimen specimen(const SandParameters& parameters, const pm4sand::Options& options, double sigma_v,
                  double K0) {
    const pm4sand::Ready law = pm4sand::ready(parameters);
    const Voigt sigma(-K0 * sigma_v, -sigma_v, 0.0, 0.0);
    return {SandPoint{law, options, pm4sand::initialise(law, sigma, 0.0, options.scheme)}};
}

/// For names of terms: whole kilopascals.
std::string kPa(double stress) { return std::to_string(std::lround(stress / 1e3)) + " kPa"; }

std::string two_digits(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", number);
    return text;
}

}  // namespace

std::vector<std::string> parameter_names() {
    std::vector<std::string> names;
    for (const Named& each : named) names.emplace_back(each.name);
    return names;
}

/// document.cpp has refused other names: this one can come from code alone.
double& parameter(SandParameters& parameters, const std::string& name) {
    for (const Named& each : named) {
        if (name == each.name) return parameters.*each.member;
    }
    throw std::invalid_argument("PM4Sand has no parameter " + name);
}

Calibration::Calibration(CalibrationProblem problem) : problem_(std::move(problem)) {
    for (const CyclicTarget& target : problem_.cyclic) {
        if (!target.N && !problem_.reference)
            throw std::invalid_argument("a cyclic target has neither cycles nor a reference soil");
        if (target.N)  // otherwise too strong a soil would have no deviation
            problem_.most_cycles =
                std::max(problem_.most_cycles, static_cast<int>(std::ceil(3.0 * *target.N)));
    }
    for (const CyclicTarget& target : problem_.cyclic)
        N_wanted_.push_back(target.N ? *target.N : cycles(*problem_.reference, target));
    // Slope of each target curve, by least squares in the logarithms. One point has no slope, and
    // repeats at one stress ratio give 0, for which every soil would fit.
    constexpr double usual_slope = -0.2;       // of sands
    constexpr double flattest_slope = -0.05;   // flatter ones are not used
    const double least_range = std::log(1.1);  // of CSR
    for (const CyclicTarget& target : problem_.cyclic) {
        double n = 0, x = 0, y = 0, xx = 0, xy = 0;
        double low = std::log(target.CSR), high = low;
        for (std::size_t k = 0; k < problem_.cyclic.size(); ++k) {
            const CyclicTarget& other = problem_.cyclic[k];
            // Measured points and those of the reference soil lie on curves of their own.
            const bool same_curve = other.sigma_v == target.sigma_v && other.K0 == target.K0 &&
                                    other.strain == target.strain &&
                                    other.N.has_value() == target.N.has_value();
            if (!same_curve || N_wanted_[k] <= 0.0) continue;
            const double ln_N = std::log(N_wanted_[k]), ln_CSR = std::log(other.CSR);
            n += 1, x += ln_N, y += ln_CSR, xx += ln_N * ln_N, xy += ln_N * ln_CSR;
            low = std::min(low, ln_CSR), high = std::max(high, ln_CSR);
        }
        const double spread = n * xx - x * x;
        const double own = spread > 1e-12 ? (n * xy - x * y) / spread : usual_slope;
        slope_.push_back(high - low >= least_range && own <= flattest_slope ? own : usual_slope);
    }
}

/// A soil that does not reach the strain counts as most_cycles: the misfit stays finite.
/// Without readings on the way (every = 0), as a search runs such tests hundreds of times.
double Calibration::cycles(const SandParameters& parameters, const CyclicTarget& target) const {
    const CyclicResult result =
        cyclic_stress(specimen(parameters, problem_.options, target.sigma_v, target.K0),
                      Boundary::undrained_shear, {.amplitude = target.CSR * target.sigma_v},
                      {.strain = target.strain, .cycles = problem_.most_cycles},
                      {.step = problem_.cyclic_step, .every = 0});
    return result.N_strain > 0.0 ? result.N_strain : problem_.most_cycles;
}

/// Logarithmic deviations, so that half and double the strength weigh the same. The floor of 1 Pa
/// keeps the logarithm finite for a soil that lost its strength.
std::vector<Term> Calibration::strength_terms(const SandParameters& parameters) const {
    std::vector<Term> terms;
    for (const StrengthTarget& target : problem_.strength) {
        const Record record =
            monotonic(specimen(parameters, problem_.options, target.sigma_v, target.K0),
                      Boundary::undrained_shear, target.strain,
                      {.step = problem_.monotonic_step, .every = 0});
        const double s_u = record.readings.back().response;
        const double deviation = std::log(std::max(s_u, 1.0) / target.s_u);
        terms.push_back({"s_u at " + kPa(target.sigma_v), target.s_u, s_u, deviation,
                         std::pow(deviation / problem_.strength_spread, 2)});
    }
    return terms;
}

/// A ratio of cycles becomes a ratio of stress: curves are flat, and a factor of two in N is about
/// 13 % in CSR at the usual slope.
std::vector<Term> Calibration::cyclic_terms(const SandParameters& parameters) const {
    std::vector<Term> terms;
    for (std::size_t k = 0; k < problem_.cyclic.size(); ++k) {
        const CyclicTarget& target = problem_.cyclic[k];
        const double N = cycles(parameters, target);
        // More cycles at the same stress ratio mean more resistance: minus the slope.
        const double deviation = -slope_[k] * std::log(N / N_wanted_[k]);
        terms.push_back({"N at " + kPa(target.sigma_v) + ", CSR " + two_digits(target.CSR),
                         N_wanted_[k], N, deviation,
                         target.weight * std::pow(deviation / problem_.cyclic_spread, 2)});
    }
    return terms;
}

SandParameters Calibration::with(const std::vector<double>& values) const {
    SandParameters parameters = problem_.start;
    for (std::size_t i = 0; i < values.size(); ++i) {
        parameter(parameters, problem_.free[i].name) = values[i];
    }
    return parameters;
}

/// The start values may lie outside the bounds of a document; the search begins at the nearest
/// allowed ones.
std::vector<double> Calibration::start() const {
    SandParameters parameters = problem_.start;
    std::vector<double> values;
    for (const FreeParameter& each : problem_.free) {
        values.push_back(std::clamp(parameter(parameters, each.name), each.least, each.most));
    }
    return values;
}

Fit Calibration::evaluate(const std::vector<double>& values) const {
    const SandParameters parameters = with(values);
    Fit fit{values, 0.0, strength_terms(parameters)};
    const std::vector<Term> cyclic = cyclic_terms(parameters);
    fit.terms.insert(fit.terms.end(), cyclic.begin(), cyclic.end());
    for (const Term& term : fit.terms) fit.misfit += term.share;
    return fit;
}

namespace {

/// A sample of the search, before any descent.
struct Start {
    std::vector<double> x;  ///< logarithms of the parameters
    double misfit;
};

/// Point k of Halton's sequence in the box of the bounds, in logarithms.
/// A lattice would waste points where one parameter matters little; random ones would need a seed.
std::vector<double> spread_point(int k, const std::vector<FreeParameter>& free) {
    constexpr int primes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43};
    std::vector<double> x;
    for (std::size_t i = 0; i < free.size(); ++i) {
        const int base = primes[i % std::size(primes)];
        double share = 0.0, digit = 1.0;
        for (int rest = k; rest > 0; rest /= base) {
            digit /= base;
            share += digit * (rest % base);
        }
        x.push_back(std::log(free[i].least) +
                    share * (std::log(free[i].most) - std::log(free[i].least)));
    }
    return x;
}

/// Logarithms of the free parameters: steps are relative, and values stay positive.
using Place = std::vector<double>;

/// Nelder-Mead with edges `size` around `start`, until all corners are within `least_size` of the
/// best or `most` evaluations are used. `f` records the best.
void descend(const std::function<double(const Place&)>& f, const Place& start, double size,
             double least_size, int most) {
    int evaluations = 0;
    const auto corner = [&](const Place& at) {
        ++evaluations;
        return numerics::Corner<Place>{at, f(at)};
    };
    std::vector<numerics::Corner<Place>> corners{corner(start)};
    for (std::size_t i = 0; i < start.size(); ++i) {
        Place at = start;
        at[i] += size;
        corners.push_back(corner(at));
    }
    numerics::Simplex<Place> simplex(std::move(corners));
    while (evaluations < most && simplex.extent() > least_size) simplex.move(corner);
}

}  // namespace

CalibrationResult calibrate(const Calibration& calibration,
                            const std::function<void(int, const Fit&)>& seen) {
    const auto& free = calibration.problem().free;
    CalibrationResult result{};
    // The simplex may leave the box; its corners are evaluated at the nearest allowed values.
    const auto values_at = [&](const std::vector<double>& x) {
        std::vector<double> values(x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            values[i] = std::clamp(std::exp(x[i]), free[i].least, free[i].most);
        }
        return values;
    };
    // Every evaluation passes here: counts it, keeps the best, and reports it to `seen`.
    const auto fit_at = [&](const std::vector<double>& x) {
        Fit fit = calibration.evaluate(values_at(x));
        ++result.evaluations;
        if (result.evaluations == 1) result.first = fit;
        if (result.evaluations == 1 || fit.misfit < result.best.misfit) {
            result.best = fit;
            result.path.push_back({fit.values, fit.misfit, {}});
        }
        if (seen) seen(result.evaluations, fit);
        return fit;
    };
    const auto misfit = [&](const std::vector<double>& x) { return fit_at(x).misfit; };
    const int most = calibration.problem().most_evaluations;

    // Q and R compensate each other along a curved valley: sample first, then descend.
    std::vector<double> x;
    for (const double value : calibration.start()) x.push_back(std::log(value));
    std::vector<Start> starts{{x, misfit(x)}};
    for (int k = 1; k <= most / 8; ++k) {
        const std::vector<double> at = spread_point(k, free);
        starts.push_back({at, misfit(at)});
    }
    // Stable: samples with equal misfits keep the order of the sequence.
    std::stable_sort(starts.begin(), starts.end(),
                     [](const Start& a, const Start& b) { return a.misfit < b.misfit; });
    // Three fifths of the evaluations at most: with the eighth for samples, a quarter is left for
    // the end.
    for (std::size_t k = 0; k < 3 && k < starts.size(); ++k) {
        descend(misfit, starts[k].x, 0.2, 5e-3, most / 5);
    }
    // New simplices around the best until one brings no improvement.
    double size = 0.1, before = 2.0 * result.best.misfit;
    while (result.evaluations < most && result.best.misfit < before * (1.0 - 1e-4)) {
        before = result.best.misfit;
        std::vector<double> best;
        for (const double value : result.best.values) best.push_back(std::log(value));
        descend(misfit, best, size, 2e-4, most - result.evaluations);
        // The sign turns: edges the other way find what the last simplex could not.
        size = -0.5 * size;
    }
    result.parameters = calibration.with(result.best.values);
    return result;
}

}  // namespace breach::element_bench
