// Estimates the problem size of a scene for each phase without meshing or filling it, within about
// a third of the sizes that the phases report.
#pragma once

#include "core/scene/scene.hpp"

namespace breach::estimate {

/// Quads of each region [n_regions]: from the divisions of blocks, else from the element size.
std::vector<double> elements_of(const scene::Scene& scene);

/// Total area of the section's polygons [m2].
double soil_area(const scene::Scene& scene);

/// Steps that the FEM's stages plan, and duration of the dynamic ones.
struct FemSteps {
    double steps;
    double duration;
};
FemSteps steps_of(const scene::Fem& fem);
double snapshots_of(const scene::Fem& fem);

/// Material points of the transfer, or of the filled section without a FEM.
double points_of(const scene::Scene& scene, double elements);

/// Duration of a runout that ends at rest [s]: the longer the less strength the soil keeps after
/// softening or liquefaction, from 7 sqrt(H / g) on; limited by the earliest rest and the longest
/// duration.
double runout_duration(const scene::Scene& scene);
/// Time step from the Courant number and the fastest wave speed of all soils [s].
double runout_step(const scene::Scene& scene);

/// Number of surfaces in one search, and of searches: the LEM's own, one per liquefied layer, and
/// those with varied parameters. Polylines are analysed by Spencer's method.
struct Searches {
    double surfaces;
    double stages;
    double polylines;
    /// For all circles, also along thin weak layers, with other cracks and beyond the bounds.
    double slices;
};
/// For a scene with /lem.
Searches searches_of(const scene::Scene& scene);

}  // namespace breach::estimate
