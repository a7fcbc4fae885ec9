// The parts of a scene that each phase reads: the key of its cached result. A phase gets no other
// parts, so that its result cannot depend on an entry outside the key.
//
//     lem_tool       /gravity /materials /section /lem
//     fem_solver     /gravity /thickness /materials /section /fem    (with all snapshot times: the
//                    FEM's steps end on them)
//     transfer_tool  /gravity /materials /transfer, the grid of /mpm, names and materials of
//                    /section/regions
//     post_seismic   /gravity /thickness /materials /section /lem /fem, the soils of /transfer,
//                    /mpm/water
//     mpm_solver     /gravity /thickness /materials /mpm, names and materials of /section/regions
//                    (the shapes come with the particles); without a FEM /transfer and all of
//                    /section
//
// If a strength depends on stress, the last two read /lem for its water.
#pragma once

#include <nlohmann/json.hpp>

#include "core/phases/phases.hpp"

namespace breach::phases {

/// The part of a completed scene that a phase reads besides its input file.
nlohmann::json part_read_by(const Phase& phase, const nlohmann::json& scene);

/// The scene reduced to what this phase and those before it read: all that its result depends on.
/// After a FEM it includes all of /mpm, because a part of its grid alone would be invalid.
nlohmann::json scene_known_to(const Phase& phase, const nlohmann::json& scene);

}  // namespace breach::phases
