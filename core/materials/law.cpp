#include "core/materials/law.hpp"

namespace breach::materials {

Law scaled(Law law, double stiffness, double softening_strains) {
    std::visit([&](auto& each) { each.elasticity.E *= stiffness; }, law);
    if (Softening* softens = softening(law)) {
        softens->epsilon_q_start *= softening_strains;
        softens->epsilon_q_end *= softening_strains;
    }
    return law;
}

}  // namespace breach::materials
