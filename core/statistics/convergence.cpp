#include "core/statistics/convergence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/statistics/quantiles.hpp"
#include "core/words/words.hpp"

namespace breach::statistics {

static constexpr auto words_of(Course) {
    using enum Course;
    return words::in_order<Course>({{too_few, "too_few"},
                                    {monotone, "monotone"},
                                    {oscillating, "oscillating"},
                                    {not_falling, "not_falling"},
                                    {below_noise, "below_noise"},
                                    {no_effect, "no_effect"}});
}

namespace {

constexpr double highest_order = 20.0;
constexpr double factor_of_safety = 1.25;        // Roache, three grids
constexpr double factor_of_safety_of_two = 3.0;  // Roache, two grids
constexpr double told = 0.95;                    // two-sided confidence level

/// change_coarse / change_fine for value = limit + C size^p; increases with p.
double ratio_of_changes(double p, double ratio_coarse, double ratio_fine) {
    return std::pow(ratio_fine, p) * std::expm1(p * std::log(ratio_coarse)) /
           std::expm1(p * std::log(ratio_fine));
}

std::optional<Noise> noise_of_rungs(std::span<const Rung> rungs) {
    std::vector<Repeats> values;
    for (const Rung& each : rungs) values.push_back(each.value);
    return pooled_noise(values);
}

double spread_of(std::span<const Rung> rungs) {
    const auto [least, most] =
        std::ranges::minmax_element(rungs, {}, [](const Rung& each) { return each.value.mean; });
    return most->value.mean - least->value.mean;
}

}  // namespace

std::string_view name_of(Course course) { return words::name_of(course); }

bool rests_on_sizes(Course course) {
    return course != Course::oscillating && course != Course::no_effect;
}

std::optional<double> observed_order(double ratio_coarse, double ratio_fine, double change_coarse,
                                     double change_fine) {
    const double wanted = change_coarse / change_fine;
    if (!std::isfinite(wanted)) return std::nullopt;
    double low = 0.0;  // the ratio tends to ln(ratio_coarse) / ln(ratio_fine)
    double high = highest_order;
    if (wanted <= std::log(ratio_coarse) / std::log(ratio_fine)) return std::nullopt;
    if (wanted > ratio_of_changes(high, ratio_coarse, ratio_fine)) return std::nullopt;
    while (high - low > 1e-12 * high) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (ratio_of_changes(middle, ratio_coarse, ratio_fine) < wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double smallest_told_difference(const Noise& noise, std::size_t repeats) {
    return student_factor(told, noise.freedom) * noise.deviation *
           std::sqrt(2.0 / static_cast<double>(repeats));
}

namespace {

/// The three finest rungs and their differences.
struct Ending {
    const Rung& coarse;
    const Rung& middle;
    const Rung& fine;
    double change_coarse = middle.value.mean - coarse.value.mean;
    double change_fine = fine.value.mean - middle.value.mean;
    double ratio_coarse = coarse.size / middle.size;
    double ratio_fine = middle.size / fine.size;
};

/// Whether two rungs differ by no more than the noise.
bool is_noise(const Rung& one, const Rung& other, const std::optional<Noise>& noise) {
    const std::size_t repeats = std::min(one.value.count, other.value.count);
    return noise &&
           std::abs(other.value.mean - one.value.mean) < smallest_told_difference(*noise, repeats);
}

double two_grid_error(double change, double ratio) {
    return factor_of_safety_of_two * std::abs(change) / (ratio - 1.0);
}

/// The last difference exceeds the noise, so it stays positive minus one standard error.
Range order_by_noise(const Ending& e, const Noise& noise) {
    const std::size_t repeats =
        std::min({e.coarse.value.count, e.middle.value.count, e.fine.value.count});
    const double off = noise.deviation * std::sqrt(2.0 / static_cast<double>(repeats));
    const double coarse = std::abs(e.change_coarse);
    const double fine = std::abs(e.change_fine);
    const auto order = [&](double change_coarse, double change_fine) {
        return observed_order(e.ratio_coarse, e.ratio_fine, change_coarse, change_fine);
    };
    return {.low = order(coarse - off, fine + off).value_or(0.0),
            .high = order(coarse + off, fine - off).value_or(highest_order)};
}

/// Error of the finest rung in the unit of the value; sets order and limit if they exist.
double judge(const Ending& e, const std::optional<Noise>& noise, Convergence& found) {
    if (e.change_coarse * e.change_fine < 0.0) {
        found.course = Course::oscillating;
        const auto [least, most] =
            std::minmax({e.coarse.value.mean, e.middle.value.mean, e.fine.value.mean});
        return 0.5 * (most - least);
    }
    found.order = observed_order(e.ratio_coarse, e.ratio_fine, e.change_coarse, e.change_fine);
    if (!found.order) {
        found.course = Course::not_falling;
        return two_grid_error(e.change_fine, e.ratio_fine);
    }
    const auto left = [&](double order) {
        return e.change_fine / std::expm1(order * std::log(e.ratio_fine));
    };
    found.course = Course::monotone;
    found.limit = e.fine.value.mean + left(*found.order);
    if (noise) found.order_by_noise = order_by_noise(e, *noise);
    return factor_of_safety * std::abs(left(std::min(*found.order, highest_formal_order)));
}

/// Error of the finest rung if its difference from the one before is below the noise: that
/// difference. For size ratios below 2, close rungs agree at any error; then the first-order error
/// from that difference, or from the third rung's if that is below the noise too.
double hidden_error(std::span<const Rung> ending, const Noise& noise) {
    const Rung& fine = ending.back();
    const auto off = [&](const Rung& other) {
        return std::abs(fine.value.mean - other.value.mean);
    };
    const auto left = [&](const Rung& other) {
        return off(other) / std::min(other.size / fine.size - 1.0, 1.0);
    };
    const Rung& middle = ending[ending.size() - 2];
    if (ending.size() == 3 && is_noise(ending.front(), fine, noise))
        return std::max(off(middle), left(ending.front()));
    return left(middle);
}

}  // namespace

Convergence convergence_of(std::span<const Rung> rungs) {
    Convergence found;
    found.noise = noise_of_rungs(rungs);
    if (!rungs.empty()) found.spread = spread_of(rungs);
    if (rungs.size() < 2) return found;
    const Rung& fine = rungs[rungs.size() - 1];
    const Rung& middle = rungs[rungs.size() - 2];
    double error = two_grid_error(fine.value.mean - middle.value.mean, middle.size / fine.size);
    // Only the finest rungs: coarse ones scatter more.
    const auto ending = rungs.last(std::min<std::size_t>(rungs.size(), 3));
    const auto noise = noise_of_rungs(ending);
    if (*found.spread == 0.0 && fine.value.mean != 0.0) {
        found.course = Course::no_effect;
    } else if (is_noise(middle, fine, noise)) {
        found.course = Course::below_noise;
        error = hidden_error(ending, *noise);
    } else if (rungs.size() >= 3) {
        error = judge({ending.front(), middle, fine}, noise, found);
    }
    if (fine.value.mean == 0.0) return found;
    found.error_of_finest = error / std::abs(fine.value.mean);
    if (found.order) found.gci = found.error_of_finest;
    return found;
}

double sum_of(std::span<const Share> shares) {
    double told = 0.0;
    double squares = 0.0;
    for (const Share& each : shares) {
        if (each.told)
            told += each.error;
        else
            squares += each.error * each.error;
    }
    return told + std::sqrt(squares);
}

std::vector<bool> pareto_front(std::span<const Offer> offers) {
    std::vector<bool> front(offers.size(), true);
    for (std::size_t i = 0; i < offers.size(); ++i) {
        front[i] = std::ranges::none_of(offers, [&](const Offer& other) {
            return other.cpu_seconds <= offers[i].cpu_seconds && other.error <= offers[i].error &&
                   (other.cpu_seconds < offers[i].cpu_seconds || other.error < offers[i].error);
        });
    }
    return front;
}

std::optional<std::size_t> cheapest_within(std::span<const Offer> offers, double asked) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < offers.size(); ++i) {
        if (!(offers[i].error <= asked)) continue;
        const bool better = !best || offers[i].cpu_seconds < offers[*best].cpu_seconds ||
                            (offers[i].cpu_seconds == offers[*best].cpu_seconds &&
                             offers[i].error < offers[*best].error);
        if (better) best = i;
    }
    return best;
}

double error_of_one_run(double bias, const Repeats& value, double reference) {
    return std::hypot(bias, value.deviation.value_or(0.0) / std::abs(reference));
}

}  // namespace breach::statistics
