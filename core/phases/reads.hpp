// The parts of a scene that each phase reads, each defined once. They form the key of its cached
// result, and a phase is given no others, so that a result cannot depend on an entry that its key
// lacks.
//
//     lem_tool       /gravity /materials /section /lem
//     fem_solver     /gravity /thickness /materials /section /fem    (with all snapshot times: the
//                    FEM's steps end on them)
//     transfer_tool  /gravity /materials /transfer, the grid of /mpm, names and materials of
//                    /section/regions
//     mpm_solver     /gravity /thickness /materials /mpm, names and materials of /section/regions
//                    (the shapes come with the particles); without a FEM /transfer and all of
//                    /section
//
// Where a strength depends on stress, the last two read /lem for its water.
#pragma once

#include <nlohmann/json.hpp>

#include "core/phases/phases.hpp"

namespace breach::phases {

/// The part of a completed scene that a phase reads beside its input file.
nlohmann::json part_read_by(const Phase& phase, const nlohmann::json& scene);

/// A scene with only what this phase and those before it read: everything its result depends on;
/// for the transfer the whole of /mpm, without which its grid would be faulty.
nlohmann::json scene_known_to(const Phase& phase, const nlohmann::json& scene);

}  // namespace breach::phases
