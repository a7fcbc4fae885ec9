#include "core/materials/linear_elastic.hpp"

namespace breach::materials {

Update integrate(const LinearElastic& law, const State& old, const Voigt& d_epsilon) {
    return {{old.sigma + mechanics::elastic_stress(law.elasticity, d_epsilon), old.epsilon_q},
            Voigt::Zero(),
            Return::elastic};
}

Update integrate(const LinearElastic& law, const State& old, const Voigt& d_epsilon,
                 Matrix4& tangent) {
    tangent = mechanics::elastic_stiffness(law.elasticity);
    return integrate(law, old, d_epsilon);
}

}  // namespace breach::materials
