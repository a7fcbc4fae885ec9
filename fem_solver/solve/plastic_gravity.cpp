#include "fem_solver/solve/plastic_gravity.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace breach::fem {
namespace {

namespace pm4sand = materials::pm4sand;

constexpr double first_cohesion = 16e3, last_cohesion = 0.25e3;  // [Pa]
constexpr double smallest_cut = 0.9;  // a level nearer to the last one is not worth a try

/// Least M_b of a zone under the stress it has.
double least_bounding_ratio(const Model& model, const materials::PM4Sand& law, const Zone& zone,
                            const Motion& motion) {
    double least = 2.0;
    const std::size_t begin = zone.first * model.points_per_element;
    for (std::size_t p = begin; p < begin + zone.count * model.points_per_element; ++p) {
        least = std::min(least, pm4sand::initialise(law.ready, motion.points[p].sigma).M_b);
    }
    return least;
}

/// The zones' laws with friction in place of PM4Sand; its cohesion is still to come.
std::vector<materials::Law> frictional_laws(const Model& model, const Motion& motion) {
    std::vector<materials::Law> laws;
    for (const Zone& zone : model.zones) {
        const auto* sand = std::get_if<materials::PM4Sand>(&zone.law);
        if (sand == nullptr) {
            laws.push_back(zone.law);
            continue;
        }
        const double phi = std::asin(0.5 * least_bounding_ratio(model, *sand, zone, motion));
        laws.emplace_back(materials::MohrCoulomb{.elasticity = sand->elasticity,
                                                 .c = first_cohesion,
                                                 .phi = phi,
                                                 .psi = phi,
                                                 .tension_cutoff = 0.0,
                                                 .softening = {}});
    }
    return laws;
}

void set_cohesion(const Model& model, double c, std::vector<materials::Law>& laws) {
    for (std::size_t z = 0; z < laws.size(); ++z) {
        if (!std::holds_alternative<materials::PM4Sand>(model.zones[z].law)) continue;
        auto& law = std::get<materials::MohrCoulomb>(laws[z]);
        law.c = c;
        law.tension_cutoff = c / std::tan(law.phi);
    }
}

}  // namespace

bool rests_first(const scene::Stage& stage, std::int64_t place) {
    return stage.kind == scene::StageKind::static_equilibrium && place > 0;
}

FrictionalRest rest_with_friction(Newton& newton, const Model& model, Motion& motion,
                                  Prediction& prediction, Motion& trial) {
    FrictionalRest rest;
    std::vector<materials::Law> laws = frictional_laws(model, motion);
    const Eigen::VectorXd start = motion.force;
    double share = 0.5;  // of the last cohesion
    for (double c = first_cohesion; c >= last_cohesion && share < smallest_cut;
         c = share * rest.cohesion) {
        set_cohesion(model, c, laws);
        newton.forget_matrix();
        const NewtonOutcome outcome =
            static_step(newton, model, laws, 1.0, start, motion, prediction, trial);
        rest.iterations += outcome.iterations;
        if (outcome.end != NewtonOutcome::End::converged) {
            if (!rest.converged) {
                rest.cohesion = c;
                rest.residual = outcome.residual;
                break;
            }
            share = std::sqrt(share);
            continue;
        }
        std::swap(motion, trial);
        rest.converged = true;
        rest.cohesion = c;
        rest.residual = outcome.residual;
    }
    return rest;
}

std::string in_words(const FrictionalRest& rest) {
    std::ostringstream text;
    text << std::setprecision(3);
    if (rest.converged) {
        text << "friction alone rests with " << rest.cohesion / 1e3 << " kPa in " << rest.iterations
             << " iterations, out of balance " << std::scientific << std::setprecision(2)
             << rest.residual;
        return text.str();
    }
    text << "friction alone does not rest: nothing converged, not even with " << rest.cohesion / 1e3
         << " kPa of cohesion added (" << rest.iterations << " iterations, out of balance "
         << std::scientific << std::setprecision(2) << rest.residual
         << " of the weight). PM4Sand begins from the elastic stresses; what lies outside its "
            "surfaces stays as a constant stress. Does the slope stand at rest? Ask lem_tool for "
            "its factor of safety before motion; if that is well above 1, raise "
            "/fem/largest_iterations or refine the mesh at the steepest face";
    return text.str();
}

}  // namespace breach::fem
