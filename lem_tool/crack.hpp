// Depth at which a surface ends in the tension crack: the one with the lowest factor of safety.
// Called for the circles of each state and for each weak layer (answer.cpp). `look` is a search or
// the analysis of one given circle.
#pragma once

#include <functional>

#include "lem_tool/search.hpp"

namespace breach::lem {

/// `model` has the share of the crack that was found, so that facts and flags cut the same surface.
struct Searched {
    Model model;
    SearchResult found;
    std::vector<scene::Vec2> floor;  ///< along a weak layer; empty: the scene's floor
    /// with the whole crack; infinite: no surface
    double factor_with_whole_crack;

    double factor() const;  ///< Bishop's; infinite: no surface
};

/// Below the tension zone soil presses on both walls of a crack. A deeper end of the surface would
/// omit that thrust, which is unsafe: the scene's depth is therefore an upper limit.
Searched with_worst_crack(const Model& model, const std::vector<scene::Vec2>& floor,
                          const std::function<SearchResult(const Model&, Effort)>& look);

/// Depth to which a crack in the soil at the upper end stays open: 2 c / gamma tan(45 + phi / 2)
/// [m].
double tension_zone(const Model& model, const Surface& surface);

}  // namespace breach::lem
