// One element whose law starts from a uniform stress, with prescribed displacements.
#pragma once

#include <algorithm>
#include <utility>

#include "fem_solver/solve/memory.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem::bench {

struct BegunElement {
    Model model;
    Seconds seconds;
    InternalForce force;
    std::vector<materials::Law> laws;
    Motion now, trial;

    BegunElement(const json& scene, const Voigt& sigma)
        : model(model_of(parse(scene))),
          force(model, seconds),
          laws(laws_for(model, scene::StageLaws::scene)),
          now(at_rest(model)) {
        for (State& point : now.points) point.sigma = sigma;
        begin_memory(model, now);
        trial = now;
    }
    /// displacement_at(x): of a node [m]. Nothing changes if the geometry is degenerate.
    template <class DisplacementAt>
    Geometry move(DisplacementAt displacement_at) {
        for (std::size_t i = 0; i < model.mesh.nodes.size(); ++i)
            trial.u.segment<2>(static_cast<Eigen::Index>(2 * i)) =
                displacement_at(model.mesh.nodes[i]);
        const Geometry geometry = force.evaluate(laws, now, trial);
        if (geometry == Geometry::sound) std::swap(now, trial);
        return geometry;
    }
};

}  // namespace breach::fem::bench
