#include "fem_solver/model/model.hpp"

namespace breach::fem {

std::vector<materials::Law> laws_for(const Model& model, scene::StageLaws laws) {
    std::vector<materials::Law> result;
    for (const Zone& zone : model.zones) {
        const bool elastic = laws == scene::StageLaws::elastic;
        result.push_back(elastic ? materials::elastic_part(zone.law) : zone.law);
    }
    return result;
}

Motion at_rest(const Model& model) {
    Motion motion;
    motion.u = motion.v = motion.a = motion.force = Eigen::VectorXd::Zero(model.dofs());
    motion.p = model.water.prescribed;
    motion.p_rate = Eigen::VectorXd::Zero(motion.p.size());
    motion.points.assign(model.points(), State{Voigt::Zero(), 0.0});
    motion.strain.assign(model.points(), Voigt::Zero());
    for (const Zone& zone : model.zones) {
        if (model.hourglass.empty()) break;
        const double G = materials::elasticity(zone.law).shear_modulus();
        // 4 G: the modulus of isotropic elastic soil, until a first step gives a secant.
        motion.hourglass.insert(motion.hourglass.end(), zone.count, {Vec2::Zero(), 4.0 * G, 0.0});
    }
    return motion;
}

Dofs8 gather(const Quad& quad, const Eigen::VectorXd& values) {
    Dofs8 local;
    for (int k = 0; k < 4; ++k) {
        local.segment<2>(2 * k) = values.segment<2>(2 * static_cast<Eigen::Index>(quad[k]));
    }
    return local;
}

Corners displaced_corners(const Model& model, std::size_t element, const Eigen::VectorXd& u) {
    Corners x = corners_of(model.mesh, element);
    for (int k = 0; k < 4; ++k) {
        x.col(k) += u.segment<2>(2 * static_cast<Eigen::Index>(model.mesh.quads[element][k]));
    }
    return x;
}

}  // namespace breach::fem
