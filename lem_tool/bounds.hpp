// What bounds the search, not the soil: ranges, floor, lowest level, least depth and the section's
// end. A bound leaves surfaces out; where a lower factor of safety lies among those, a flag says so.
#pragma once

#include "lem_tool/answer.hpp"

namespace breach::lem {

/// One state of the soil that was searched.
struct State {
    std::string name;  ///< "", or " with 2 layers liquefied"
    const Model& model;
    const Families& families;
    const nlohmann::json& answer;
};

/// That a lower factor was left out; that the tension crack is deeper than soil can stand open, or
/// than lowers the factor; that the surface in front begins within one slope's height of the
/// section's upstream end; that lower factors are not valid. Appended to `flags`; a bound that is
/// flagged there already, of an earlier state, is not looked at again.
void add_flags_of_state(const scene::Scene& scene, const State& state, int threads,
                        std::vector<fault::Flag>& flags);

}  // namespace breach::lem
