// Inside core/check only: the checks, one for each subject of a scene. problems_of() calls them in
// turn with one list of problems, to which each adds. Each accepts an incomplete scene: absent
// parts, regions without polygon or material.
#pragma once

#include <string>

#include "core/check/check.hpp"

namespace breach::check {

inline void refuse(Problems& problems, std::string pointer, std::string cause, std::string remedy) {
    problems.faults.push_back({std::move(pointer), std::move(cause), std::move(remedy)});
}

inline void warn(Problems& problems, std::string code, std::string pointer, std::string message) {
    problems.warnings.push_back(
        {std::move(code), fault::Severity::warning, std::move(message), std::move(pointer)});
}

/// Adds a fault and returns false if the range of x lies outside the section.
bool check_beside(const scene::Scene& scene, double from, double to, const std::string& pointer,
                  Problems& problems);

bool has_soil(const scene::Scene& scene);

/// Gaps and slivers between regions.
void check_geometry(const scene::Scene& scene, Problems& problems);
/// /lem: ground under every slice, ends of the slip surfaces, loads and layers within the section.
void check_stability(const scene::Scene& scene, Problems& problems);
/// /fem: what the laws require of the stages and of the mesh file.
void check_stages(const scene::Scene& scene, Problems& problems);
/// /fem: supports, the edges that base and free-field columns need, the crest.
void check_supports(const scene::Scene& scene, Problems& problems);
/// Adds a fault and returns false unless the water table overlaps the section and lies above some
/// soil.
bool check_table(const scene::Scene& scene, const std::vector<scene::Vec2>& line,
                 const std::string& pointer, Problems& problems);
/// A line continues level beyond its ends. Warns where that continuation is above ground: it would
/// be free water that the user did not draw.
void warn_about_ends(const scene::Scene& scene, const std::vector<scene::Vec2>& line,
                     const std::string& pointer, Problems& problems);
/// /fem/water: saturated regions and the entries that they need, pressure boundaries, the
/// liquefaction watch.
void check_water(const scene::Scene& scene, Problems& problems);
/// /fem/motion: the file and its contents.
void check_motion(const scene::Scene& scene, Recordings& recordings, Problems& problems);
/// Warns of strengths of one soil that differ between phases, and of relations used outside their
/// range.
void check_strengths(const scene::Scene& scene, Problems& problems);
/// Soil that liquefies in the LEM or in the runout alone, and a phase without the water that another
/// one has.
void check_agreement(const scene::Scene& scene, Problems& problems);
/// Laws of the transfer's and the MPM's material points.
void check_soils(const scene::Scene& scene, Problems& problems);
/// /transfer: the FEM entries that it needs, and its window.
void check_transfer(const scene::Scene& scene, Problems& problems);
/// /mpm: the section inside the grid's terrain, walls and lid; the toe.
void check_ground(const scene::Scene& scene, Problems& problems);

}  // namespace breach::check
