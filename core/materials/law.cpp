#include "core/materials/law.hpp"

#include <cmath>
#include <vector>

namespace breach::materials {

namespace {

template <class... Each>
std::vector<Law> one_of_each(const std::variant<Each...>*) {
    return {Law(Each{})...};
}

}  // namespace

std::string types_of_laws_that(bool (*does)(const Law&)) {
    std::vector<std::string> types;
    for (const Law& law : one_of_each(static_cast<const Law*>(nullptr)))
        if (does(law)) types.emplace_back(traits(law).type);
    std::string list;
    for (std::size_t i = 0; i < types.size(); ++i) {
        const bool last = i + 1 == types.size();
        list += (i == 0 ? "" : last ? " or " : ", ") + types[i];
    }
    return list;
}

Law with_strength(Law law, const StrengthOfPoint<double>& strength) {
    if (!has_strength_of_points(law)) return law;
    return with_strength(std::get<MohrCoulomb>(law), strength);
}

Law with_plasticity(const Law& law, const Plastic& strength) {
    const auto& [c, phi, psi, tension_cutoff, strength_of] = strength;
    return MohrCoulomb{elasticity(law), c, phi, psi, tension_cutoff, {}, strength_of};
}

Law adapted(Law law, const mechanics::Elasticity& elasticity, double softening_strains) {
    std::visit([&](auto& each) { each.elasticity = elasticity; }, law);
    if (Softening* softens = softening(law)) {
        softens->epsilon_q_start *= softening_strains;
        softens->epsilon_q_end *= softening_strains;
    }
    return law;
}

Law with_tension_share(Law law, double share) {
    if (auto* cone = std::get_if<MohrCoulomb>(&law)) cone->tension_share = share;
    if (auto* cone = std::get_if<DruckerPrager>(&law)) {
        const double q = 2.0 * cone->c * std::cos(cone->phi) / (1.0 - std::sin(cone->phi));
        // of the mean stress
        cone->tension_cutoff = std::max(cone->tension_cutoff, share * q / 3.0);
    }
    return law;
}

}  // namespace breach::materials
