#include "services/orchestrator/accuracy/convergence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace breach::orchestrator {

namespace {

constexpr double highest_order = 20.0;
constexpr double factor_of_safety = 1.25;  // Roache's for three grids
constexpr double two_sided_95 = 1.96;      // of the normal distribution

/// change_coarse / change_fine of value = limit + C size^p: rises with p.
double ratio_of_changes(double p, double ratio_coarse, double ratio_fine) {
    return std::pow(ratio_fine, p) * std::expm1(p * std::log(ratio_coarse)) /
           std::expm1(p * std::log(ratio_fine));
}

/// Of one run, over rungs that were repeated; each repeat beyond a rung's first counts once.
std::optional<double> pooled_noise(std::span<const Rung> rungs) {
    double squares = 0.0;
    std::size_t freedom = 0;
    for (const Rung& each : rungs) {
        if (!each.value.deviation) continue;
        const std::size_t of_rung = each.value.count - 1;
        squares += static_cast<double>(of_rung) * *each.value.deviation * *each.value.deviation;
        freedom += of_rung;
    }
    if (freedom == 0) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(freedom));
}

double spread_of(std::span<const Rung> rungs) {
    const auto [least, most] =
        std::ranges::minmax_element(rungs, {}, [](const Rung& each) { return each.value.mean; });
    return most->value.mean - least->value.mean;
}

}  // namespace

Repeats repeats_of(std::span<const double> values) {
    assert(!values.empty());
    Repeats repeats{.mean = 0.0, .deviation = std::nullopt, .count = values.size()};
    const auto n = static_cast<double>(values.size());
    for (const double each : values) repeats.mean += each / n;
    if (values.size() < 2) return repeats;
    double squares = 0.0;
    for (const double each : values) squares += (each - repeats.mean) * (each - repeats.mean);
    repeats.deviation = std::sqrt(squares / (n - 1.0));
    return repeats;
}

std::string_view name_of(Course course) {
    switch (course) {
        case Course::too_few:
            return "too_few";
        case Course::monotone:
            return "monotone";
        case Course::oscillating:
            return "oscillating";
        case Course::not_falling:
            return "not_falling";
        case Course::below_noise:
            break;
    }
    return "below_noise";
}

std::optional<double> observed_order(double ratio_coarse, double ratio_fine, double change_coarse,
                                     double change_fine) {
    const double wanted = change_coarse / change_fine;
    if (!std::isfinite(wanted)) return std::nullopt;
    double low = 0.0;  // there the ratio is ln(ratio_coarse) / ln(ratio_fine)
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

double smallest_told_difference(double noise, std::size_t repeats) {
    return two_sided_95 * noise * std::sqrt(2.0 / static_cast<double>(repeats));
}

Convergence convergence_of(std::span<const Rung> rungs) {
    Convergence found;
    found.noise = pooled_noise(rungs);
    if (!rungs.empty()) found.spread = spread_of(rungs);
    if (rungs.size() < 3) return found;
    const Rung& coarse = rungs[rungs.size() - 3];
    const Rung& middle = rungs[rungs.size() - 2];
    const Rung& fine = rungs[rungs.size() - 1];
    const double change_coarse = middle.value.mean - coarse.value.mean;
    const double change_fine = fine.value.mean - middle.value.mean;
    if (found.noise) {
        const std::size_t repeats =
            std::min({coarse.value.count, middle.value.count, fine.value.count});
        const double told = smallest_told_difference(*found.noise, repeats);
        if (std::abs(change_coarse) < told || std::abs(change_fine) < told) {
            found.course = Course::below_noise;
            return found;
        }
    }
    if (change_coarse * change_fine < 0.0) {
        found.course = Course::oscillating;
        return found;
    }
    const double ratio_fine = middle.size / fine.size;
    found.order = observed_order(coarse.size / middle.size, ratio_fine, change_coarse, change_fine);
    if (!found.order) {
        found.course = Course::not_falling;
        return found;
    }
    const double left = change_fine / std::expm1(*found.order * std::log(ratio_fine));
    found.course = Course::monotone;
    found.limit = fine.value.mean + left;
    if (fine.value.mean != 0.0) found.gci = factor_of_safety * std::abs(left / fine.value.mean);
    return found;
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

}  // namespace breach::orchestrator
