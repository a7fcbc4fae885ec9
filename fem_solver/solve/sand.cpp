#include "fem_solver/solve/sand.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "fem_solver/solve/ranges.hpp"

namespace breach::fem {

namespace pm4sand = materials::pm4sand;

bool has_sand(const Model& model) {
    return std::ranges::any_of(
        model.zones, [](const Zone& zone) { return materials::sand_in(zone.law) != nullptr; });
}

StressBias stress_bias(const Motion& motion) {
    StressBias bias;
    for (const pm4sand::State& each : motion.sand) {
        const auto& b = each.sigma_b;
        const double size = std::max({std::abs(b.xx), std::abs(b.yy), std::abs(b.xy)});
        // A stress that fits leaves the round-off of its own split into mean and deviator.
        if (size <= 1e-9 * each.p) continue;
        ++bias.points;
        bias.largest = std::max(bias.largest, size);
    }
    return bias;
}

StressBias begin_sand(const Model& model, Motion& motion) {
    if (!motion.sand.empty()) return stress_bias(motion);
    for (const Zone& zone : model.zones) {
        const auto* law = materials::sand_in(zone.law);
        if (law == nullptr) continue;
        const std::size_t begin = zone.first * model.points_per_element;
        const std::size_t end = begin + zone.count * model.points_per_element;
        for (std::size_t p = begin; p < end; ++p) {
            const double epsilon_v = -(motion.strain[p][0] + motion.strain[p][1]);
            motion.sand.push_back(
                pm4sand::initialise(law->ready, motion.points[p].sigma, epsilon_v));
            motion.points[p].sigma = pm4sand::stress(law->ready, motion.sand.back());
        }
    }
    return stress_bias(motion);
}

SandPass::SandPass(const Model& model, int threads)
    : points_(model.points_per_element), threads_(threads) {
    std::size_t largest = 0;
    for (const Zone& zone : model.zones) {
        if (!materials::sand_in(zone.law)) continue;
        largest = std::max(largest, zone.count * points_);
    }
    updates_.resize(largest);
}

SandPass::Answer SandPass::refuse(Refusal::Why why, const Zone& zone, std::size_t point,
                                  const Voigt& d_epsilon) {
    refusal_ = {why, zone.first + point / points_, d_epsilon.cwiseAbs().maxCoeff()};
    return Answer::refused;
}

std::string in_words(const SandPass::Refusal& refusal) {
    std::ostringstream text;
    text << "PM4Sand refused the strain increment of element " << refusal.element << ", "
         << refusal.largest;
    if (refusal.why == SandPass::Refusal::Why::strain) {
        text << ": beyond the limit of " << SandPass::largest_strain << " (a trial that diverges)";
    } else {
        text << ": its evaluations were used up, below the strain limit of "
             << SandPass::largest_strain;
    }
    return text.str();
}

SandPass::Answer SandPass::integrate(const materials::PM4Sand& law, const Zone& zone,
                                     std::span<const Voigt> d_epsilon, const Motion& old,
                                     Motion& trial) {
    for (std::size_t i = 0; i < d_epsilon.size(); ++i) {
        if (d_epsilon[i].cwiseAbs().maxCoeff() <= largest_strain) continue;
        return refuse(Refusal::Why::strain, zone, i, d_epsilon[i]);
    }
    trial.sand.resize(old.sand.size());
    const std::span from = std::span(old.sand).subspan(zone.first_sand, d_epsilon.size());
    const std::span to = std::span(updates_).first(d_epsilon.size());
    for_ranges(to.size(), threads_, [&](std::size_t begin, std::size_t end) {
        const std::size_t count = end - begin;
        pm4sand::integrate(law.ready, from.subspan(begin, count), d_epsilon.subspan(begin, count),
                           law.options, to.subspan(begin, count));
    });
    State* point = &trial.points[zone.first * points_];
    pm4sand::State* sand = &trial.sand[zone.first_sand];
    for (std::size_t i = 0; i < to.size(); ++i) {
        const pm4sand::Update& each = to[i];
        if (each.outcome != pm4sand::Outcome::done) {
            return refuse(Refusal::Why::evaluations, zone, i, d_epsilon[i]);
        }
        counts_ += each.counts;
        *sand++ = each.state;
        (point++)->sigma = pm4sand::stress(law.ready, each.state);
    }
    return Answer::done;
}

}  // namespace breach::fem
