// Problem size of a scene for each phase, without meshing or filling it. Within about a third of
// the sizes that the phases then report.
#pragma once

#include "core/scene/scene.hpp"

namespace breach::estimate {

/// Quads of each region [n_regions]: of blocks from their divisions, else from element size.
std::vector<double> elements_of(const scene::Scene& scene);

/// Area of the section's polygons together [m2].
double soil_area(const scene::Scene& scene);

/// Steps that the FEM's stages plan, and duration of the dynamic ones.
struct FemSteps {
    double steps;
    double duration;
};
FemSteps steps_of(const scene::Fem& fem);
double snapshots_of(const scene::Fem& fem);

/// Points of the transfer, or of the filled section where there is no FEM.
double points_of(const scene::Scene& scene, double elements);

/// Duration of a runout that ends at rest: 7 sqrt(H / g), and 75 sqrt(H / g) where soil can flow that
/// keeps no friction once it has softened or liquefied, at least the earliest rest and at most the
/// longest duration [s].
double runout_duration(const scene::Scene& scene);
/// Time step from the Courant number and the fastest wave of all soils [s].
double runout_step(const scene::Scene& scene);

/// Surfaces of one search, and the number of searches: the LEM's own, one per liquefied layer, and
/// those of varied parameters. Surfaces of straight pieces are analysed by Spencer's method.
struct Searches {
    double surfaces;
    double stages;
    double polylines;
    /// For all circles, also along thin weak layers, with other crack depths and beyond the bounds.
    double slices;
};
/// For a scene with /lem.
Searches searches_of(const scene::Scene& scene);

}  // namespace breach::estimate
