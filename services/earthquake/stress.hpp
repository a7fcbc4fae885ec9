// Vertical effective stress in a section's layers.
#pragma once

#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace breach::earthquake {

using geometry::Polygon;
using mechanics::Vec2;
using Line = std::vector<Vec2>;  ///< ascending in x

/// A region of the scene.
struct Region {
    std::string name, material;
    Polygon polygon;
    int layer = 0;              ///< below the phreatic line, from 1; 0: soil that does not liquefy
    double sigma_v0_kPa = 0.0;  ///< mean vertical effective stress of the layer
};

/// The soil and water above a place.
struct Overburden {
    const Line& ground;
    const Line& phreatic;
    double density;  ///< of all soil [kg/m3]
};

/// The largest vertical effective stress at the polygon's vertices [kPa].
double largest_sigma_v0(const Polygon& polygon, const Overburden& above);

struct Sum {
    double stress_area = 0.0;  ///< [kPa m2]
    double area = 0.0;         ///< [m2]
};

/// Adds the part of the polygon right of `from`, sampled on a lattice.
void add(Sum& sum, const Polygon& polygon, const Overburden& above, double from);

/// Means over each layer right of `from`, where it can slide; else over the whole layer.
void find_stresses(std::vector<Region>& regions, const Overburden& above, double from);

}  // namespace breach::earthquake
