// The depth at which a surface ends in the tension crack: that with the lowest factor of safety.
#pragma once

#include <functional>

#include "lem_tool/search.hpp"

namespace breach::lem {

/// A search and the model it was made on.
struct Searched {
    Model model;
    SearchResult found;
    std::vector<scene::Vec2> floor;  ///< of a surface along a weak layer; empty: the scene's own
    /// With the whole crack; infinite: no surface ends in it
    double factor_with_whole_crack;

    double factor() const;  ///< Bishop's; infinite: no surface was found
};

/// Below the tension zone soil presses on both walls of a crack. A surface that ended deeper would
/// omit that thrust and be unsafe, so the scene's depth is an upper bound.
Searched with_worst_crack(const Model& model, const std::vector<scene::Vec2>& floor,
                          const std::function<SearchResult(const Model&, Effort)>& look);

/// Depth to which soil as at the upper end can stand open: 2 c / gamma tan(45 + phi / 2) [m].
double tension_zone(const Model& model, const Surface& surface);

}  // namespace breach::lem
