// Nonlocal softening of the FEM: the growth of the softening strain in a step is averaged over the
// elements around, so that a length of the soil and not the element sets the width of a shear band.
// The mesh keeps its drawn shape, so the weights are computed once (build_model).
// Method: docs/reference/methods/softening.md.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "fem_solver/model/model.hpp"

namespace breach::fem {

class NonlocalSoftening {
  public:
    explicit NonlocalSoftening(const Model& model);
    bool is_on() const { return !groups_.empty(); }
    /// Replaces the growth from `old` to `trial` of every softening point by that of its
    /// neighbourhood, over the scale of its strains. For each converged step (step.cpp).
    void share(const Model& model, const Motion& old, Motion& trial) const;

  private:
    /// The elements of one zone: strains of another region do not soften this one. Elements and not
    /// points: a sixteenth of the pairs, for bands that differ by 1 %.
    struct Group {
        std::size_t first;              ///< element
        double spent;                   ///< epsilon_q from which elements do not take part [-]
        double scale;                   ///< of softening strains
        std::vector<std::size_t> rows;  ///< [elements + 1] where each one's neighbours begin
        std::vector<std::int32_t> neighbours;
        std::vector<double> weights;
        std::size_t count() const { return rows.size() - 1; }
    };
    static Group group_of(const Model& model, const Zone& zone);

    void share(const Group& group, const Model& model, const Motion& old, Motion& trial) const;

    std::vector<Group> groups_;
};

/// None if no zone softens over a length.
std::shared_ptr<const NonlocalSoftening> nonlocal_softening(const Model& model);

}  // namespace breach::fem
