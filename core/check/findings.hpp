// Inside core/check only: the checks by subject, and how they report findings. Each takes a scene
// that may be incomplete: absent parts, regions without polygon or material.
#pragma once

#include <string>

#include "core/check/check.hpp"

namespace breach::check {

inline void refuse(Findings& findings, std::string pointer, std::string cause, std::string remedy) {
    findings.faults.push_back({std::move(pointer), std::move(cause), std::move(remedy)});
}

inline void warn(Findings& findings, std::string code, std::string pointer, std::string message) {
    findings.warnings.push_back(
        {std::move(code), fault::Severity::warning, std::move(message), std::move(pointer)});
}

/// Refuses a range of x that lies beside the section; false then.
bool check_beside(const scene::Scene& scene, double from, double to, const std::string& pointer,
                  Findings& findings);

/// At least one region has a polygon.
bool has_soil(const scene::Scene& scene);

/// Gaps and slivers between regions.
void check_geometry(const scene::Scene& scene, Findings& findings);
/// /lem: ground under every slice, ends of the surfaces, loads and layers where there is soil.
void check_stability(const scene::Scene& scene, Findings& findings);
/// /fem: requirements of the laws on the stages and on the mesh file.
void check_stages(const scene::Scene& scene, Findings& findings);
/// /fem: supports, the edges that base and free-field columns need, the crest.
void check_supports(const scene::Scene& scene, Findings& findings);
/// A water table is drawn over the section and reaches some soil; false: it is refused.
bool check_table(const scene::Scene& scene, const std::vector<scene::Vec2>& line,
                 const std::string& pointer, Findings& findings);
/// Beyond its ends a line continues level: warns where it is then above ground, as undrawn water.
void warn_about_ends(const scene::Scene& scene, const std::vector<scene::Vec2>& line,
                     const std::string& pointer, Findings& findings);
/// /fem/water: what is wet, what wet soil needs, boundaries of pressure, the liquefaction watch.
void check_water(const scene::Scene& scene, Findings& findings);
/// /fem/motion: the file and what is in it.
void check_motion(const scene::Scene& scene, Recordings& recordings, Findings& findings);
/// Strengths of one soil that differ between phases, and relations outside their range.
void check_strengths(const scene::Scene& scene, Findings& findings);
/// Laws that points can have, for the transfer and the MPM.
void check_soils(const scene::Scene& scene, Findings& findings);
/// /transfer: what it needs from the FEM, and its window.
void check_transfer(const scene::Scene& scene, Findings& findings);
/// /mpm: the section between terrain, walls and lid of the grid; the toe.
void check_ground(const scene::Scene& scene, Findings& findings);

}  // namespace breach::check
