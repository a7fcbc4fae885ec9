// The four phases, each defined once: its program, its part of the scene, and its names for people.
// Services, dashboard and report use this table.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace breach::phases {

struct Phase {
    const char* program;   ///< the executable; its name in records, results and the API
    const char* part;      ///< its part of the scene, and the first word of its tasks' labels
    const char* one;       ///< "the FEM"
    const char* analyses;  ///< several of them
    const char* results;   ///< several results
    const char* frames;    ///< what its snapshots show: "mesh", "particles"
    bool has_default_part = false;  ///< a scene that lacks the part is completed with it
};

inline constexpr Phase lem{
    "lem_tool", "lem", "the limit equilibrium", "stability analyses", "results of lem_tool",
    "particles"};
inline constexpr Phase fem{"fem_solver", "fem", "the FEM", "FEM analyses", "FEM results", "mesh"};
inline constexpr Phase transfer{
    "transfer_tool", "transfer", "the transfer", "transfers", "transfers", "particles", true};
inline constexpr Phase mpm{"mpm_solver", "mpm", "the runout", "runouts", "runouts", "particles"};

/// In the order in which their results build on each other.
inline constexpr std::array all{lem, fem, transfer, mpm};

/// The phase of this program; null: none.
constexpr const Phase* named(std::string_view program) {
    const auto found = std::ranges::find(all, program, &Phase::program);
    return found == all.end() ? nullptr : &*found;
}

}  // namespace breach::phases
