// Position of integration points below the ground, for laws that vary in space.
// Used when laws with memory begin (solve/memory.cpp) and for the friction before them
// (plastic_gravity.cpp), not during steps.
#pragma once

#include "fem_solver/model/ground.hpp"

namespace breach::fem {

/// The present ground surface.
class Overburden {
  public:
    explicit Overburden(const Model& model) : edges_(ground_edges(model)) {}
    /// Place of an integration point, with sigma_v0 = 0.
    materials::Place place(const Model& model, std::size_t point) const;

  private:
    std::vector<GroundEdge> edges_;
};

template <class Law>
Law at_point(const Law& law, const Overburden& overburden, const Model& model, std::size_t point) {
    return at_place(law, [&] { return overburden.place(model, point); });
}

}  // namespace breach::fem
