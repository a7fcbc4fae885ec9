// The four phases: program, part of the scene, names for display. Services, dashboard and report
// use this table.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace breach::phases {

struct Phase {
    const char* program;   ///< the executable; also its name in records, results and the API
    const char* part;      ///< its part of the scene, and the prefix of its tasks' labels
    const char* one;       ///< "the FEM"
    const char* analyses;  ///< plural of the analysis
    const char* results;   ///< plural of the result
    const char* frames;    ///< what its snapshots show: "mesh", "particles"
    bool has_default_part = false;  ///< a scene without this part gets it by default
};

inline constexpr Phase lem{
    "lem_tool", "lem", "the limit equilibrium", "stability analyses", "results of lem_tool",
    "particles"};
inline constexpr Phase fem{"fem_solver", "fem", "the FEM", "FEM analyses", "FEM results", "mesh"};
inline constexpr Phase transfer{
    "transfer_tool", "transfer", "the transfer", "transfers", "transfers", "particles", true};
inline constexpr Phase mpm{"mpm_solver", "mpm", "the runout", "runouts", "runouts", "particles"};

/// In the order of their dependence.
inline constexpr std::array all{lem, fem, transfer, mpm};

constexpr const Phase* named(std::string_view program) {
    const auto found = std::ranges::find(all, program, &Phase::program);
    return found == all.end() ? nullptr : &*found;
}

}  // namespace breach::phases
