// Bounds of the search: ranges, floor, lowest level, least depth and the section's end. They
// exclude surfaces; a flag reports a lower factor of safety among those.
// Each state (the sound slope, each stage) calls add_flags_of_state after its answer.
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

/// Flags: a bound excludes a lower factor; the tension crack is deeper than soil can stand, or than
/// lowers the factor; the critical surface begins within one slope height of the section's upstream
/// end; lower factors are invalid. Appends to `flags`; skips bounds flagged for an earlier state.
void add_flags_of_state(const scene::Scene& scene, const State& state, int threads,
                        std::vector<fault::Flag>& flags);

}  // namespace breach::lem
