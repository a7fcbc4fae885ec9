// Assumed soils and the scene materials made from them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/mechanics/tensor.hpp"

namespace breach::earthquake {

using Json = nlohmann::ordered_json;
using mechanics::Vec2;

constexpr double g = 9.81;              // m/s2
constexpr double atmosphere = 101.325;  // kPa, to which strengths by stress refer
constexpr double water_density = 1000;  // kg/m3
/// Residual strength of liquefied tailings over sigma'_v0, where nothing else is given.
constexpr double usual_residual_ratio = 0.08;

/// Assumed properties of a soil.
struct Soil {
    std::string name;
    double density, void_ratio, permeability;
    double D_R, G_0, h_po;  ///< PM4Sand
    double c_kPa, phi_deg;
    double c_residual_kPa, phi_residual_deg;  ///< where it fails
    double E_MPa, nu;                         ///< in the runout
};

inline const Soil tailings{"tailings", 1850, 0.95, 1e-7, 0.35, 476, 2.7, 1, 31, 1, 31, 20, 0.3};
inline const Soil embankment{"embankment", 1900, 0.7, 1e-6, 0.55, 677, 0.4, 10, 35, 1, 28, 40, 0.3};
inline const Soil foundation{"foundation", 2000, 0.6, 1e-6, 0.75, 890, 0.63,
                             20,           36,   20,  36,   200,  0.3};
/// Undrained; its strength is an option.
inline const Soil clay{"clay", 1800, 1.0, 1e-9, 0, 0, 0, 0, 0, 0, 0, 20, 0.49};

double millimetres(double value);
double nanometres(double value);
/// Three significant digits.
double rounded(double value);
/// Coordinates of a vertex. A vertex within a neighbour's side must lie on it exactly.
Json corner(const Vec2& place);
Json points(const std::vector<Vec2>& line);

/// Drained Mohr-Coulomb.
Json frictional(const Soil& soil, const std::string& note);
Json undrained(const Soil& soil, double c_kPa, const std::string& note);
/// PM4Sand, for the FEM.
Json sand(const Soil& soil, const std::string& note);
/// The material that transfer_of gives to liquefied layers.
Json liquefied(const Soil& soil, double residual_ratio);

}  // namespace breach::earthquake
