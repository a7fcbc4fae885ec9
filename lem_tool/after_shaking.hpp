// lem_tool with an --input: the factor of safety that the dam has with the strengths of a FEM's
// snapshot, residual where the soil has liquefied. Geometry and water are those of the scene.
// run() in analysis.cpp asks it for the snapshots and for the model of each.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "lem_tool/search.hpp"

namespace breach::lem {

/// The snapshot itself, or all that a FEM's frames.vtkhdf.series lists, by time. Throws BadInput for
/// a series that is damaged or empty.
std::vector<std::filesystem::path> snapshots_of(const std::filesystem::path& input);

/// Without the entries of /lem that say what a snapshot tells: liquefied layers, undrained regions,
/// random strengths.
scene::Scene without_states(scene::Scene scene);

/// A model with the strengths of one snapshot.
struct Shaken {
    double time;  ///< of the snapshot [s]
    Model model;
};
/// `whole`: the scene with /transfer, whose soils these are. Throws BadInput if the snapshot does
/// not match it.
Shaken shaken(Model model, const scene::Scene& whole, const std::filesystem::path& snapshot);

/// A row of the result's "after_shaking".
nlohmann::json row_of(double time, const nlohmann::json& answer);
std::string table_of_times(const nlohmann::json& rows);

}  // namespace breach::lem
