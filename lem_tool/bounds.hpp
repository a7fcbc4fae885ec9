// Bounds of the search other than the soil: ranges, floor, lowest level, least depth and the
// section's end. They exclude surfaces; a flag reports a lower factor of safety among those.
#pragma once

#include "lem_tool/answer.hpp"

namespace breach::lem {

/// One state of the soil in the search.
struct State {
    std::string name;  ///< "", or " with 2 layers liquefied"
    const Model& model;
    const Families& families;
    const nlohmann::json& answer;
};

/// Flags that a lower factor was excluded; that the tension crack is deeper than soil can stand
/// open, or than lowers the factor; that the surface in front begins within one slope's height of
/// the section's upstream end; that lower factors are not valid. Appends to `flags`; a bound that
/// an earlier state has flagged already is not checked again.
void add_flags_of_state(const scene::Scene& scene, const State& state, int threads,
                        std::vector<fault::Flag>& flags);

}  // namespace breach::lem
