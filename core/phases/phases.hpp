// The phases: program, part of the scene, names for display. Services, dashboard and report
// use this table.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace breach::phases {

struct Phase {
    const char* program;   ///< its name in records, results and the API
    const char* part;      ///< its own part of the scene, if any, and the prefix of its labels
    const char* one;       ///< "the FEM"
    const char* analyses;  ///< plural of the analysis
    const char* results;   ///< plural of the result
    const char* frames;    ///< what its snapshots show: "mesh", "particles"
    bool has_default_part = false;     ///< a scene without this part gets it by default
    const char* executable = program;  ///< one program may be two phases
};

inline constexpr Phase lem{
    "lem_tool", "lem", "the limit equilibrium", "stability analyses", "results of lem_tool",
    "particles"};
inline constexpr Phase fem{"fem_solver", "fem", "the FEM", "FEM analyses", "FEM results", "mesh"};
inline constexpr Phase transfer{
    "transfer_tool", "transfer", "the transfer", "transfers", "transfers", "particles", true};
inline constexpr Phase mpm{"mpm_solver", "mpm", "the runout", "runouts", "runouts", "particles"};
/// lem_tool on the snapshots of a FEM: stability with the strengths that the shaking has left.
inline constexpr Phase post_seismic{.program = "post_seismic",
                                    .part = "postseismic",
                                    .one = "the post-seismic stability",
                                    .analyses = "post-seismic stability analyses",
                                    .results = "post-seismic factors of safety",
                                    .frames = "particles",
                                    .executable = "lem_tool"};

/// In the order of their dependence.
inline constexpr std::array all{lem, fem, post_seismic, transfer, mpm};

constexpr const Phase* named(std::string_view program) {
    const auto found = std::ranges::find(all, program, &Phase::program);
    return found == all.end() ? nullptr : &*found;
}

}  // namespace breach::phases
