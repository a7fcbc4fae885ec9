// Entanglement of a mesh: in failed soil, which is how the analysis of a failing dam regularly ends,
// or at one bad corner, which has nothing to do with the dam.
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
    double time;  ///< of the step in which the corner folded; the last good state is older [s]
    std::size_t element;
    std::size_t region;  ///< index in the section
    std::string region_name;
    Vec2 where;             ///< centre of the undeformed element [m]
    double least_ratio;     ///< |J_t| / |J_0| of the folded corner [-]
    double mean_epsilon_q;  ///< of the elements that share a node with it, by volume [-]
    std::size_t failure_surfaces;
    Kind kind;
    scene::AtEntanglement then;  ///< the scene's choice
};

/// Evaluated in the last good state, which is the last snapshot. Band: the elements around the
/// folded one are strained beyond `/fem/failure_surfaces/epsilon_q` on average, or one of them (or
/// it) belongs to a failure surface. The element's own strain does not count: it is large because
/// the corner has folded.
Entanglement entanglement_of(const scene::Section& section, const Model& model, const Watch& watch,
                             const Motion& last_good, const Distortion& folded, double time,
                             scene::AtEntanglement then);

/// `entanglement` of result.json.
nlohmann::json as_json(const Entanglement& what);
/// Inverse of as_json, for an analysis of this section.
Entanglement entanglement_from(const nlohmann::json& facts, const scene::Section& section);

/// One sentence: element, time, place, and state of the soil around it.
std::string in_words(const Entanglement& what);

/// `entangled` (warning) or `entangled_corner` (questionable).
fault::Flag flag_of(const Entanglement& what);

}  // namespace breach::fem
