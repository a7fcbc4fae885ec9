// Depth of liquefaction, column by column.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/fault/flag.hpp"
#include "core/mechanics/tensor.hpp"
#include "core/scene/scene.hpp"

namespace breach::transfer {

using mechanics::Vec2;

/// Columns with a smaller depth of liquefaction than those on both sides.
struct LiquefiedGap {
    double from, to;  ///< [m]
    double level;     ///< down to which they have liquefied; the highest soil if not at all [m]
    double beside;    ///< the same of the shallower side [m]
};

/// A narrower wall of unliquefied soil does not hold in the runout: its cells do not resolve it.
constexpr double cells_of_a_wall = 2.0;

/// Flag about gaps for a runout with cells of this size [m]; 0: unknown. Of several gaps it names the narrowest
/// if that is narrower than a wall can be, else the widest.
std::optional<fault::Flag> flag_of(const std::vector<LiquefiedGap>& gaps, double cell_size);

/// A node is liquefied where r_u = (u - u_0) / sigma'_v0 is above the threshold, or was once. It
/// represents the column between the middles of its elements to the left and to the right; everything
/// above the deepest liquefied node of a column is liquefied. Columns narrower than `narrowest_wall`
/// between two deeper liquefied ones are liquefied as deep as the shallower of the two. All on the
/// undeformed mesh.
class LiquefiedZone {
  public:
    /// regions: [n_regions of the mesh] whether the region can liquefy. The mesh has sigma_v0.
    LiquefiedZone(const exchange::MeshSnapshot& mesh, const std::vector<char>& regions,
                  double threshold, scene::LiquefiedWhen when, double narrowest_wall = 0.0);

    /// Soil above the line counts, too.
    void add(const scene::LiquefiedLine& line) {
        line_.assign(line.points.begin(), line.points.end());
    }

    /// Whether the place [m] lies in the zone.
    bool holds(const Vec2& place) const;
    std::size_t liquefied_nodes() const { return nodes_; }
    /// Width of the narrow columns that count as liquefied deeper than their own nodes are [m].
    double closed_width() const { return closed_width_; }
    /// Lowest level reached anywhere [m]; nothing liquefied: +infinity.
    double deepest_level() const { return deepest_; }
    /// Gaps at least as high as a fifth of the soil that can liquefy, no wider than that and no mere
    /// slits. Single nodes near the threshold decide on them, and a wall of unliquefied soil can
    /// hold back the flow.
    std::vector<LiquefiedGap> gaps() const;

  private:
    void close_walls(double narrowest);

    std::map<double, double> level_from_;  ///< x where it begins -> level; +infinity: none
    std::vector<Vec2> line_;               ///< what lies above it counts, too; empty: none [m]
    double highest_, lowest_;              ///< of the soil that can liquefy [m]
    std::size_t nodes_ = 0;
    double closed_width_ = 0.0;
    double deepest_;
};

}  // namespace breach::transfer
