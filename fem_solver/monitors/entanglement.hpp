// Entanglement of a mesh: in failed soil, the usual end of a failing dam's analysis, or at a single
// bad corner, independent of the failure.
// Made by the dynamic stage that ends with it; facts.cpp writes it to result.json, a checkpoint
// keeps it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/fault/flag.hpp"
#include "fem_solver/monitors/watch.hpp"

namespace breach::fem {

struct Entanglement {
    enum class Kind {
        band,   ///< the soil around the folded element has failed
        corner  ///< it has not failed
    };
    double time;  ///< of the step in which the corner folded; later than the last good state [s]
    std::size_t element;
    std::size_t region;  ///< index in the section
    std::string region_name;
    Vec2 where;             ///< centre of the undeformed element [m]
    double least_ratio;     ///< |J_t| / |J_0| of the folded corner [-]
    double mean_epsilon_q;  ///< of the elements that share a node with it, by volume [-]
    std::size_t failure_surfaces;
    Kind kind;
};

/// Evaluates the last good state, which is the last snapshot. band: the elements around the folded
/// one have a mean epsilon_q above `/fem/failure_surfaces/epsilon_q`, or one of them, or itself,
/// belongs to a failure surface. Its own strain does not count: it is large because the corner
/// folded.
Entanglement entanglement_of(const scene::Section& section, const Model& model, const Watch& watch,
                             const Motion& last_good, const Distortion& folded, double time);

nlohmann::json as_json(const Entanglement& what);
/// Inverse of as_json, for the same section.
Entanglement entanglement_from(const nlohmann::json& facts, const scene::Section& section);

/// One sentence: element, time, place, and state of the soil around it.
std::string in_words(const Entanglement& what);

/// `entangled` (warning) or `entangled_corner` (questionable).
fault::Flag flag_of(const Entanglement& what);

}  // namespace breach::fem
