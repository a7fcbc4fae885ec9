#include "fem_solver/solve/memory.hpp"

#include <algorithm>
#include <sstream>

#include "fem_solver/model/place.hpp"

namespace breach::fem {

bool has_memory(const Model& model) {
    return std::ranges::any_of(model.zones,
                               [](const Zone& zone) { return materials::remembers(zone.law); });
}

std::string names_of_laws_with_memory(const Model& model) {
    std::vector<std::string> names;
    for (const Zone& zone : model.zones) {
        const std::string name = materials::traits(zone.law).name;
        const bool known = std::ranges::find(names, name) != names.end();
        if (materials::remembers(zone.law) && !known) names.push_back(name);
    }
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " and ") + name;
    return text;
}

StressBias stress_bias(const Model& model, const Motion& motion) {
    StressBias bias;
    for (std::size_t z = 0; z < motion.memory.size(); ++z) {
        materials::with_memory(model.zones[z].law, motion.memory[z],
                               [&](const auto& law, const auto& points) {
                                   for (const auto& each : points) {
                                       const double size = stress_outside(law, each);
                                       if (size == 0.0) continue;
                                       ++bias.points;
                                       bias.largest = std::max(bias.largest, size);
                                   }
                               });
    }
    return bias;
}

std::size_t fallen_points(const Model& model, const Motion& motion) {
    std::size_t count = 0;
    for (std::size_t z = 0; z < motion.memory.size(); ++z) {
        if (model.zones[z].first >= model.body.elements) continue;
        materials::with_memory(model.zones[z].law, motion.memory[z],
                               [&](const auto& law, const auto& points) {
                                   for (const auto& point : points)
                                       count += has_fallen(law, point) ? 1 : 0;
                               });
    }
    return count;
}

std::size_t points_with_memory(const Model& model, const Motion& motion) {
    std::size_t count = 0;
    for (std::size_t z = 0; z < motion.memory.size(); ++z)
        materials::with_memory(model.zones[z].law, motion.memory[z],
                               [&](const auto&, const auto& points) { count += points.size(); });
    return count;
}

StressBias begin_memory(const Model& model, Motion& motion) {
    if (!motion.memory.empty() || !has_memory(model)) return stress_bias(model, motion);
    StressBias cut;
    const Overburden overburden(model);
    for (const Zone& zone : model.zones) {
        motion.memory.push_back(
            materials::memory_for(zone.law, zone.count * model.points_per_element));
        std::size_t p = zone.first * model.points_per_element;
        materials::with_memory(zone.law, motion.memory.back(), [&](const auto& law, auto& points) {
            for (auto& each : points) {
                // Compression positive, as the void ratio needs it; plane strain has no third
                // component.
                const double epsilon_v = -(motion.strain[p][0] + motion.strain[p][1]);
                each = first_memory(at_point(law, overburden, model, p), motion.points[p].sigma,
                                    epsilon_v);
                Voigt& sigma = motion.points[p++].sigma;
                const Voigt held = materials::stress(law, each);
                Voigt lost = held - sigma;
                lost[2] = 0.0;  // sigma_zz acts on no node, and PM4Sand has none
                const double size = lost.cwiseAbs().maxCoeff();
                if (size > 1e-9 * held.cwiseAbs().maxCoeff() && !model.is_absent(zone.first)) {
                    ++cut.cut_down;
                    cut.largest_cut = std::max(cut.largest_cut, size);
                }
                // State must mirror the memory; what the law could not hold is out of balance from
                // here.
                sigma = held;
            }
        });
    }
    StressBias bias = stress_bias(model, motion);
    bias.cut_down = cut.cut_down;
    bias.largest_cut = cut.largest_cut;
    return bias;
}

MemoryPass::MemoryPass(const Model& model, std::shared_ptr<numerics::Team> team)
    : model_(model), points_(model.points_per_element), team_(std::move(team)) {
    for (const Zone& zone : model.zones) {
        materials::if_remembers(zone.law, [&]<class Law>(const Law&) {
            auto& updates = std::get<Buffer<Law>>(buffers_).updates;
            updates.resize(std::max(updates.size(), zone.count * points_));
        });
    }
}

std::size_t MemoryPass::first_too_large(std::span<const Voigt> d_epsilon) {
    const auto found = std::ranges::find_if(d_epsilon, [](const Voigt& each) {
        // Negated: a NaN is too large as well.
        return !(each.cwiseAbs().maxCoeff() <= largest_strain);
    });
    return static_cast<std::size_t>(found - d_epsilon.begin());
}

MemoryPass::Answer MemoryPass::refuse(Refusal::Why why, const char* law, const Zone& zone,
                                      std::size_t point, const Voigt& d_epsilon) {
    refusal_ = {why, law, zone.first + point / points_, d_epsilon.cwiseAbs().maxCoeff()};
    return Answer::refused;
}

std::string in_words(const MemoryPass::Refusal& refusal) {
    std::ostringstream text;
    text << refusal.law << " refused the strain increment of element " << refusal.element << ", "
         << refusal.largest;
    if (refusal.why == MemoryPass::Refusal::Why::strain) {
        text << ": beyond the limit of " << MemoryPass::largest_strain
             << " (a trial that diverges)";
    } else {
        text << ": its evaluations were used up, below the strain limit of "
             << MemoryPass::largest_strain;
    }
    return text.str();
}

}  // namespace breach::fem
