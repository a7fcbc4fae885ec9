// How much a scene gives each phase to compute, without meshing or filling it. Within about a third
// of what the phases then count themselves.
#pragma once

#include "core/scene/scene.hpp"

namespace breach::estimate {

/// Quads of each region [n_regions]: of blocks from their divisions, else from area and element size.
std::vector<double> elements_of(const scene::Scene& scene);

/// Of the section's polygons together [m2].
double soil_area(const scene::Scene& scene);

/// Steps of the FEM that its stages plan, and seconds of its dynamic ones.
struct FemSteps {
    double steps;
    double duration;
};
FemSteps steps_of(const scene::Fem& fem);
double snapshots_of(const scene::Fem& fem);

/// Of the transfer, or of the filled section where there is no FEM.
double points_of(const scene::Scene& scene, double elements);

/// Seconds that the runout is followed, where it ends at rest: 7 sqrt(H / g), and 75 sqrt(H / g) where
/// soil can flow that keeps no friction once it has softened or liquefied, at least the earliest rest
/// and at most the longest duration.
double runout_duration(const scene::Scene& scene);
/// By the Courant number and the fastest wave of all soils [s].
double runout_step(const scene::Scene& scene);

/// Surfaces of one search, and how often the LEM searches: for itself, for every liquefied layer and
/// for what varies. Surfaces of straight pieces are analysed by Spencer's method.
struct Searches {
    double surfaces;
    double stages;
    double polylines;
    /// Of all circles, those along thin weak layers, of other crack depths and beyond the bounds, too.
    double slices;
};
/// Of a scene with /lem.
Searches searches_of(const scene::Scene& scene);

}  // namespace breach::estimate
