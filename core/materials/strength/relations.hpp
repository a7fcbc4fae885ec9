// Published relations between a sounding and the strength of liquefied soil. Their equations, sources
// and ranges: docs/reference/methods/strength.md.
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

/// Sounding and range of a relation. Values outside the range are held at its end. Nothing is held
/// beyond the largest stress; the caller must report it.
struct RelationFacts {
    const char* name;             ///< for people
    const char* sounding;         ///< what its number is, with the unit
    std::array<double, 2> range;  ///< of the sounding
    double largest_stress;        ///< sigma'_v0 of its case histories [Pa]
    const char* source;
};
const RelationFacts& facts_of(Relation relation);

/// Residual strength s_r [Pa] of soil with this sounding under sigma'_v0 [Pa], not below 0.
double residual_strength(Relation relation, double sounding, double sigma_v0);

}  // namespace breach::materials
