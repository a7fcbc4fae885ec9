// How deep a surface ends in the tension crack: as deep as lowers the factor of safety most.
#pragma once

#include <functional>

#include "lem_tool/search.hpp"

namespace breach::lem {

/// A search and the model it was made on.
struct Searched {
    Model model;
    SearchResult found;
    std::vector<scene::Vec2> floor;  ///< of a surface along a weak layer; empty: the scene's own
    /// With the crack all the way down; infinite: no surface has one
    double factor_with_whole_crack;

    double factor() const;  ///< Bishop's; infinite: nothing was found
};

/// Below the tension zone soil presses on both walls of a crack. A surface that ended deeper would
/// leave that thrust out and be too safe, so the scene's depth is the most that is taken.
Searched with_worst_crack(const Model& model, const std::vector<scene::Vec2>& floor,
                          const std::function<SearchResult(const Model&, Effort)>& look);

/// How deep soil as that at the surface's upper end can stand open: 2 c / gamma tan(45 + phi / 2) [m].
double tension_zone(const Model& model, const Surface& surface);

}  // namespace breach::lem
