// Zones of PM4Sand in the mesh: the one switch from the elastic stages to the law, and the pass
// over a zone's points. Their memory (Motion::sand) stands beside State, which mirrors its stress.
#pragma once

#include <span>
#include <vector>

#include "fem_solver/model/model.hpp"

namespace breach::fem {

bool has_sand(const Model& model);

/// What the switch left as a constant stress because it lay below p_min or outside the surfaces.
struct StressBias {
    std::size_t points = 0;
    double largest = 0.0;  ///< largest component [Pa]
};

/// Initialises every point of every PM4Sand zone from the stress and the volumetric strain that the
/// elastic stages left in `motion`. Does nothing where that was done before: exactly one call per
/// point in a run.
StressBias begin_sand(const Model& model, Motion& motion);

/// The bias that `motion` carries now.
StressBias stress_bias(const Motion& motion);

/// Runs the law over zones; its buffer is as large as the largest of them.
class SandPass {
  public:
    explicit SandPass(const Model& model);

    enum class Answer {
        done,
        refused,  ///< a strain increment beyond `largest_strain` or not finite, or a point that
                  ///< used up its evaluations: the step must be cut
    };
    /// New states and stresses of a zone after the strain increments [points of the zone].
    Answer integrate(const materials::PM4Sand& law, const Zone& zone,
                     std::span<const Voigt> d_epsilon, const Motion& old, Motion& trial);

    /// Strain increments beyond this belong to a diverged trial [-]. Asking the law would cost much
    /// and tell nothing.
    static constexpr double largest_strain = 0.05;

    const materials::pm4sand::Counts& counts() const { return counts_; }

    /// Per element
  private:
    std::size_t points_;
    std::vector<materials::pm4sand::Update> updates_;
    materials::pm4sand::Counts counts_;
};

}  // namespace breach::fem
