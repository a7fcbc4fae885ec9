// Resolution of a scene: cells of the MPM across the mobile soil, elements of the FEM
// across a region. Computed from the scene alone, so that warnings come before anything
// runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// Cells across the thinnest mobile region and across the slope's height: wanted, and least.
/// Runouts shrink with coarse cells, which is unsafe: the same dam of 30 m ran 30 m beyond its toe
/// with cells of 4 m and stayed behind it with cells of 10 m. Below two cells soil cannot shear
/// internally: all its points share the same nodes.
constexpr double cells_wanted = 8.0;
constexpr double least_cells = 2.0;
/// Cells per nonlocal length: least, and wanted. Shorter lengths average over too few nodes, and the
/// width of the band again depends on the cells.
constexpr double least_nonlocal_cells = 1.3;
constexpr double nonlocal_cells_wanted = 1.6;
/// Soil that has softened at this epsilon_q breaks along bands. Soil that softens over more strain
/// flows, and a nonlocal length changed its runouts by about 1 %.
constexpr double brittle_until = 0.5;
/// A band wider than this share of a region is no longer a band.
constexpr double widest_band_share = 1.0 / 3.0;
/// Elements across a region: one cannot bend, and leaves no soil beside a band.
constexpr double elements_wanted = 2.0;

/// The length over which the runout averages the material's softening: none where cells are too
/// coarse for the material's own and the scene allows them (allow_coarse_cells).
std::optional<double> nonlocal_length_in_runout(const Material& material, const Mpm& mpm);
/// Width of a shear band: a cell, or the width set by nonlocal softening [m].
double band_width(const Material& material, const Mpm& mpm);

/// Whether the region counts for the runout.
bool is_mobile(const Region& region, const Mpm& mpm);

/// Box around the regions that count for the runout; inverted: there are none.
geometry::Box mobile_extent(const Scene& scene, const Mpm& mpm);
/// Its height [m]; 0: none.
double mobile_height(const Scene& scene, const Mpm& mpm);

/// Heights of the dam that the soil goes on upstream of the crest, from where a longer section changed
/// Mochikoshi's runout by less than 5 % (docs/verification/mochikoshi_authors.md; its 317 m are 10.8).
inline constexpr double enough_heights_upstream = 10.5;
/// The same in words: "from 10.5 heights upstream of the crest on, ...".
std::string why_enough_upstream();

/// Of all regions together [m2].
double area_of_section(const Scene& scene);
/// Of the MPM over that area; more take longer than anybody waits.
inline constexpr double most_cells = 2.5e5;

struct Resolved {
    std::vector<fault::Fault> faults;
    std::vector<fault::Flag> flags;
};

/// The parts that are too coarse. Ignores parts that the scene lacks and regions without a valid
/// polygon; finds nothing while a region's material is unknown.
Resolved resolution_of(const Scene& scene);

}  // namespace breach::scene
