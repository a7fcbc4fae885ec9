// Depth of liquefaction, column by column.
// SoilMap asks holds() per point. Columns and not elements: soil above liquefied soil loses its
// support, also where r_u of its own nodes stayed below the threshold.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/fault/flag.hpp"
#include "core/mechanics/tensor.hpp"
#include "core/scene/scene.hpp"

namespace breach::liquefied {

using mechanics::Vec2;

/// Columns with a smaller depth of liquefaction than those on both sides.
struct LiquefiedGap {
    double from, to;  ///< [m]
    double level;     ///< of liquefaction; the top of the soil if none [m]
    double beside;    ///< of liquefaction on the shallower side [m]
};

/// Width [cells] below which a wall of unliquefied soil cannot resist in the runout: its cells do
/// not resolve it.
constexpr double cells_of_a_wall = 2.0;

/// Flag about gaps, for a runout with cells of this size [m]; 0: unknown. Names the narrowest gap
/// if that is too narrow for a wall, else the widest.
std::optional<fault::Flag> flag_of(const std::vector<LiquefiedGap>& gaps, double cell_size);

/// A node is liquefied if r_u = (u - u_0) / sigma'_v0 is above the threshold, now or at any earlier
/// time. It represents the column between the middles of its elements on both sides; everything
/// above the deepest liquefied node of a column is liquefied. Columns narrower than
/// `narrowest_wall` between two deeper ones are liquefied to the shallower depth of the two. Soil
/// above the water table never is. On the undeformed mesh.
class LiquefiedZone {
  public:
    /// regions: [n_regions of the mesh] whether it can liquefy. The mesh must have sigma_v0.
    LiquefiedZone(const exchange::MeshSnapshot& mesh, const std::vector<char>& regions,
                  double threshold, scene::LiquefiedWhen when, double narrowest_wall = 0.0);

    /// Takes out the soil above the water table [m]; an empty one is not known.
    /// SoilMap calls it once, before any point is assigned.
    void keep_below(std::vector<Vec2> water_table) { water_table_ = std::move(water_table); }

    /// Adds the soil above the line.
    /// For one transfer time; SoilMap adds the line whose time is the snapshot's.
    void add(const scene::LiquefiedLine& line) {
        line_.assign(line.points.begin(), line.points.end());
    }

    /// Whether the zone contains the place [m].
    bool holds(const Vec2& place) const;
    std::size_t liquefied_nodes() const { return nodes_; }
    /// Width of the narrow columns that are liquefied deeper than their own nodes [m].
    double closed_width() const { return closed_width_; }
    /// Lowest level of liquefaction [m]; +infinity: none.
    double deepest_level() const { return deepest_; }
    /// Gaps at least as high as a fifth of the soil that can liquefy, no wider than that, and wider
    /// than a slit. They depend on single nodes near the threshold, and a wall of unliquefied soil
    /// can hold back the flow.
    std::vector<LiquefiedGap> gaps() const;

  private:
    void close_walls(double narrowest);

    /// x where the column begins -> level; +infinity: not liquefied
    std::map<double, double> level_from_;
    std::vector<Vec2> line_;  ///< soil above it counts; empty: none [m]
    std::vector<Vec2> water_table_;
    double highest_, lowest_;  ///< of the soil that can liquefy [m]
    std::size_t nodes_ = 0;
    double closed_width_ = 0.0;
    double deepest_;
};

}  // namespace breach::liquefied
