// Adds an earthquake to an imported section: adapts the drawing to the FEM, and adds the scene's
// FEM, transfer and materials by the rules of services/earthquake.
#pragma once

#include "services/earthquake/earthquake.hpp"
#include "services/import/document.hpp"

namespace breach::importing {

/// Moves vertices within `tolerance` of the lowest level, or of an end of the section, onto it: the
/// FEM needs a level base and vertical sides.
std::vector<Change> straightened(std::vector<Soil>& soils, double tolerance);

/// Why the FEM cannot shake this section; empty: it can.
std::vector<Fault> faults_of_shaking(const std::vector<Soil>& soils, const Lines& lines,
                                     const nlohmann::json& materials);

/// Along the section's base, then level from its right end. Needs a ground with a slope.
std::vector<Vec2> guessed_terrain(const std::vector<Soil>& soils);

struct Earthquake {
    earthquake::Motion motion;
    double layer_thickness;  ///< of the thinnest layer [m]
};
/// Needs a scene with /lem and /mpm, and no fault from faults_of_shaking.
void add_earthquake(const Earthquake& asked, const std::vector<Soil>& soils, const Lines& lines,
                    Document& document);

}  // namespace breach::importing
