// Adds an earthquake to an imported section: what the FEM needs of the drawing, and the scene's FEM,
// transfer and materials. services/earthquake has the rules.
#pragma once

#include "services/earthquake/earthquake.hpp"
#include "services/import/document.hpp"

namespace breach::importing {

/// Moves vertices within `tolerance` of the lowest level, or of an end of the section, onto it: the
/// FEM's base is level, and its free-field columns stand at vertical sides.
std::vector<Change> straightened(std::vector<Soil>& soils, double tolerance);

/// Why the FEM cannot shake this section; empty: it can.
std::vector<Fault> faults_of_shaking(const std::vector<Soil>& soils, const Lines& lines,
                                     const nlohmann::json& materials);

/// Below the section, and level from its right end on. The ground has a slope.
std::vector<Vec2> guessed_terrain(const std::vector<Soil>& soils);

struct Earthquake {
    earthquake::Motion motion;
    double layer_thickness;  ///< of the thinnest layer [m]
};
/// The document's scene has /lem and /mpm, and faults_of_shaking found nothing.
void add_earthquake(const Earthquake& asked, const std::vector<Soil>& soils, const Lines& lines,
                    Document& document);

}  // namespace breach::importing
