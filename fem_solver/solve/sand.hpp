// Zones of PM4Sand in the mesh: the one switch from the elastic stages to the law, and the pass
// over a zone's points. Their memory (Motion::sand) stands beside State, which mirrors its stress.
#pragma once

#include <span>
#include <string>
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
    explicit SandPass(const Model& model, int threads = 1);

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

    /// Why and where the last step was refused.
    struct Refusal {
        enum class Why {
            strain,       ///< an increment beyond largest_strain, or not finite
            evaluations,  ///< more than the law may use
        };
        Why why = Why::strain;
        std::size_t element = 0;
        double largest = 0.0;  ///< component of its strain increment [-]
    };
    const Refusal& refusal() const { return refusal_; }

    const materials::pm4sand::Counts& counts() const { return counts_; }

  private:
    Answer refuse(Refusal::Why why, const Zone& zone, std::size_t point, const Voigt& d_epsilon);

    std::size_t points_;  ///< per element
    int threads_;
    Refusal refusal_;
    std::vector<materials::pm4sand::Update> updates_;
    materials::pm4sand::Counts counts_;
};

/// For people: whether the strain limit or the law's evaluations ended it, and where.
std::string in_words(const SandPass::Refusal& refusal);

}  // namespace breach::fem
