// Published relations between a sounding and the strength of liquefied soil. Equations, sources and
// ranges: docs/reference/methods/strength.md.
#pragma once

#include <array>
#include <optional>

namespace breach::materials {

enum class Relation {
    weber_2015,                                ///< SPT (N1)60cs
    kramer_wang_2015,                          ///< SPT (N1)60
    olson_stark_2002_spt,                      ///< SPT (N1)60
    olson_stark_2002_cpt,                      ///< CPT q_c1 [MPa]
    idriss_boulanger_2008_spt,                 ///< SPT (N1)60cs-Sr, void redistribution negligible
    idriss_boulanger_2008_spt_redistribution,  ///< the same, significant
    idriss_boulanger_2008_cpt,                 ///< CPT q_c1Ncs-Sr, void redistribution negligible
    idriss_boulanger_2008_cpt_redistribution,  ///< the same, significant
};

/// Sounding and range of a relation. Soundings outside the range take the nearest end's strength.
/// Stress above largest_stress is not limited; the caller must report it.
struct RelationFacts {
    const char* name;             ///< for display
    const char* sounding;         ///< measured quantity, with unit
    std::array<double, 2> range;  ///< of the sounding
    double largest_stress;        ///< largest sigma'_v0 of its case histories [Pa]
    const char* source;
};
const RelationFacts& facts_of(Relation relation);

/// Residual strength s_r [Pa] for this sounding and sigma'_v0 [Pa]; at least 0.
double residual_strength(Relation relation, double sounding, double sigma_v0);

}  // namespace breach::materials
