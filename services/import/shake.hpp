// Adds an earthquake to an imported section: adapts the drawing to the FEM, and adds the scene's
// FEM, transfer and materials by the rules of services/earthquake.
#pragma once

#include <functional>

#include "services/earthquake/earthquake.hpp"
#include "services/import/document.hpp"

namespace breach::importing {

/// Moves vertices within `tolerance` of the lowest level, or of an end of the section, onto it: the
/// FEM needs a level base and vertical sides.
std::vector<Change> straightened(std::vector<Soil>& soils, double tolerance);

/// Adds a fault unless the slope falls to the right. option: what the user can leave out instead.
void check_slope(const std::optional<Slope>& slope, const std::string& option,
                 std::vector<Fault>& faults);

/// Whether there is a phreatic line; else adds a fault.
bool has_phreatic(const Lines& lines, std::vector<Fault>& faults);

/// Adds a fault for each material of soil that liquefies and is not drained.
void check_drained(const std::vector<Soil>& soils, const nlohmann::json& materials,
                   std::vector<Fault>& faults, const std::function<bool(const Soil&)>& liquefies);

/// Why the FEM cannot shake this section; empty: it can.
std::vector<Fault> faults_of_shaking(const std::vector<Soil>& soils, const Lines& lines,
                                     const nlohmann::json& materials);

struct Earthquake {
    earthquake::Motion motion;
    double layer_thickness;  ///< of the thinnest layer [m]
};
/// Needs a scene with /lem and /mpm, and no fault from faults_of_shaking.
void add_earthquake(const Earthquake& asked, const std::vector<Soil>& soils, const Lines& lines,
                    Document& document);

}  // namespace breach::importing
