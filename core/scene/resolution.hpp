// Resolution of a scene: MPM cells across the mobile soil, FEM elements across a region. Needs the
// scene only, so that warnings come before a run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"

namespace breach::scene {

/// Cells across the thinnest mobile region and across the slope's height: recommended, and least.
/// Coarse cells shorten the runout, which is unsafe: a dam of 30 m ran 30 m beyond its toe with
/// cells of 4 m and did not reach it with 10 m. Below two cells soil cannot shear internally: all
/// its points share the same nodes.
constexpr double cells_wanted = 8.0;
constexpr double least_cells = 2.0;
/// The setting of templates and imports, and what flags recommend
/// (docs/verification/mpm_convergence.md).
inline constexpr double cells_over_height = 20.0;
inline constexpr int points_across_cell = 4;
inline constexpr int usual_overlap_rate = 5;
/// Cells (or elements) per nonlocal length: least, and recommended. Shorter lengths average over too few nodes,
/// and the band's width depends on the cells again.
constexpr double least_nonlocal_cells = 1.3;
constexpr double nonlocal_cells_wanted = 1.6;
/// Soil that is fully softened at this epsilon_q fails in shear bands. Soil with slower softening
/// flows; a nonlocal length changed its runouts by about 1 %.
constexpr double brittle_until = 0.5;
/// A band wider than this share of a region is no longer a band.
constexpr double widest_band_share = 1.0 / 3.0;
/// Elements across a region: a single element cannot bend and leaves no soil beside a band.
constexpr double elements_wanted = 2.0;

/// Nonlocal length of softening in the runout. None if the cells are too coarse for the material's
/// and the scene allows that (allow_coarse_cells).
std::optional<double> nonlocal_length_in_runout(const Material& material, const Mpm& mpm);
/// Width of a shear band [m]: one cell, or that of nonlocal softening.
double band_width(const Material& material, const Mpm& mpm);

/// Of a soil that has a length, in elements of this size [m]; none: they are small enough. For a
/// mesh from a file the FEM asks, which reads it.
std::optional<fault::Flag> short_length(const Material& soil, double element);

bool is_mobile(const Region& region, const Mpm& mpm);

/// Bounding box of the mobile regions; inverted if there are none.
geometry::Box mobile_extent(const Scene& scene, const Mpm& mpm);
/// Height of the mobile regions [m]; 0: none.
double mobile_height(const Scene& scene, const Mpm& mpm);

/// Upstream length of the section in dam heights. Longer sections changed Mochikoshi's runout by
/// less than 5 % (docs/verification/mochikoshi_authors.md; its 317 m are 10.8).
inline constexpr double enough_heights_upstream = 10.5;
/// For messages: "from 10.5 heights upstream of the crest on, ...".
std::string why_enough_upstream();

/// Total area of all regions [m2].
double area_of_section(const Scene& scene);
/// Upper limit of MPM cells over that area: more take too long.
inline constexpr double most_cells = 2.5e5;

struct Resolved {
    std::vector<fault::Fault> faults;
    std::vector<fault::Flag> flags;
};

/// Parts that are too coarse. Ignores missing parts and regions without a valid polygon; empty
/// while a region's material is unknown.
Resolved resolution_of(const Scene& scene);

}  // namespace breach::scene
