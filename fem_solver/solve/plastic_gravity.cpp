#include "fem_solver/solve/plastic_gravity.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "fem_solver/model/place.hpp"

namespace breach::fem {
namespace {

constexpr double first_cohesion = 16e3, last_cohesion = 0.25e3;  // [Pa]
// ratio of successive levels; a smaller reduction is not tried
constexpr double smallest_cut = 0.9;

/// [zones] smallest friction angle of the surfaces of their points under the present stress; 0
/// without memory [rad].
std::vector<double> friction_angles(const Model& model, const Motion& motion) {
    std::vector<double> angles;
    const Overburden overburden(model);
    for (const Zone& zone : model.zones) {
        angles.push_back(0.0);
        const std::size_t begin = zone.first * model.points_per_element;
        materials::if_remembers(zone.law, [&](const auto& law) {
            double least = 1.0;
            for (std::size_t p = begin; p < begin + zone.count * model.points_per_element; ++p) {
                const auto first =
                    first_memory(at_point(law, overburden, model, p), motion.points[p].sigma, 0.0);
                // The smallest of the zone: apart from the cohesion, every point then lies inside
                // its own surface.
                least = std::min(least, friction(law, first));
            }
            angles.back() = std::asin(least);
        });
    }
    return angles;
}

/// Laws of the zones, with this friction and cohesion instead of laws with memory.
std::vector<materials::Law> frictional_laws(const Model& model, const std::vector<double>& phi,
                                            double c) {
    std::vector<materials::Law> laws;
    for (std::size_t z = 0; z < phi.size(); ++z) {
        const materials::Law& law = model.zones[z].law;
        laws.push_back(law);
        if (materials::remembers(law))
            laws.back() =
                // Dilatancy equals friction (associated flow); tension is cut at the apex, where it
                // changes nothing.
                materials::with_plasticity(law, {c, phi[z], phi[z], c / std::tan(phi[z])});
    }
    return laws;
}

}  // namespace

bool rests_first(const scene::Stage& stage, std::int64_t place) {
    return stage.kind == scene::StageKind::static_equilibrium && place > 0;
}

FrictionalRest rest_with_friction(Newton& newton, const Model& model, Motion& motion,
                                  Prediction& prediction, Motion& trial) {
    FrictionalRest rest;
    const std::vector<double> phi = friction_angles(model, motion);
    double share = 0.5;  // of the cohesion before
    for (double c = first_cohesion; c >= last_cohesion && share < smallest_cut;
         c = share * rest.cohesion) {
        const std::vector<materials::Law> laws = frictional_laws(model, phi, c);
        // Another level has another tangent, and the kept one is of a different surface.
        newton.forget_matrix();
        // All of the load, so the force to start from has no share.
        const NewtonOutcome outcome =
            static_step(newton, model, laws, 1.0, motion.force, motion, prediction, trial);
        rest.iterations += outcome.iterations;
        if (outcome.end != NewtonOutcome::End::converged) {
            if (!rest.converged) {
                rest.cohesion = c;
                rest.residual = outcome.residual;
                break;
            }
            // A smaller reduction of the cohesion next, down to a tenth.
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
        text << "equilibrium with friction alone and " << rest.cohesion / 1e3 << " kPa in "
             << rest.iterations << " iterations, out of balance " << std::scientific
             << std::setprecision(2) << rest.residual;
        return text.str();
    }
    text << "no equilibrium with friction alone: not converged, not even with "
         << rest.cohesion / 1e3 << " kPa of cohesion added (" << rest.iterations
         << " iterations, out of balance " << std::scientific << std::setprecision(2)
         << rest.residual
         << " of the weight). The soil's law begins from the elastic stresses; stress outside its "
            "yield surfaces stays as a constant stress. Check the factor of safety at rest with "
            "lem_tool; if it is well above 1, raise "
            "/fem/largest_iterations or refine the mesh at the steepest face";
    return text.str();
}

}  // namespace breach::fem
