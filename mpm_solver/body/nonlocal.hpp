// Softening independent of the lattice: the growth of a brittle soil's softening strain over some
// steps is averaged over its neighbourhood, so that the soil's own length and not the cell sets the
// width of a shear band. Method: docs/reference/methods/softening.md.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm_solver/body/grid.hpp"
#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

class NonlocalSoftening {
  public:
    /// Averages after `due` steps, of which `done` are done: as many as keep the growth of the bands
    /// below a small part of the softening strain.
    struct Pace {
        std::int64_t done = 0;
        std::int64_t due = 1;
    };
    static constexpr std::int64_t most_steps = 16;

    /// No averaging.
    NonlocalSoftening() = default;
    /// `widest`: Body's; a point that has expanded so far is separated.
    NonlocalSoftening(const Points& points, const std::vector<Zone>& zones, const Grid& grid,
                      KernelKind kernel, double gimp_half_size, double widest);

    bool is_on() const { return !groups_.empty(); }
    /// Stores the strains at the beginning of the growth.
    static void remember(Points& points);
    /// Call after the stress update of a step; averages when it is due.
    void follow(Points& points, const std::vector<Zone>& zones, const Grid& grid);
    /// Replaces the growth of every brittle point by its neighbourhood's. Returns the mean growth of
    /// softening soil, as a part of the strain over which it softens.
    double spread(Points& points, const std::vector<Zone>& zones, const Grid& grid);

    const Pace& pace() const { return pace_; }
    void go_on_from(const Pace& pace) { pace_ = pace; }

  private:
    /// Soil of one region: debris that rides over another dam must not soften that from a distance.
    struct Group {
        std::size_t zone;
        std::int32_t region;
    };
    /// The neighbourhood's nodes in one column, adjacent in memory, from a row on.
    struct Column {
        std::int32_t columns, rows;   ///< from the node in the middle
        std::vector<double> weights;  ///< 0 of the middle itself
    };
    /// Nodes [begin, end) of one column.
    struct Run {
        std::int32_t begin, end;
    };
    /// Of a point, at the 3 x 3 nodes about it.
    struct Weights {
        std::int32_t first;
        double at[3][3];
    };
    template <class Kernel>
    static Weights weights_of(const Kernel& kernel, const Grid& grid, double x, double y);
    template <class Visit>
    static void for_nodes(const Grid& grid, const Weights& weights, const Visit& visit);
    static bool grows(const Points& points, const Zone& zone);
    bool takes_part(const Points& points, std::size_t p, const Group& group, double spent) const;
    template <class Kernel>
    double spread_with(const Kernel& kernel, Points& points, const std::vector<Zone>& zones,
                       const Grid& grid);
    void average(const Grid& grid, const std::vector<Column>& neighbourhood);
    void give(const Grid& grid, std::int32_t node, const std::vector<Column>& neighbourhood);
    void take(const Grid& grid, Run run, const std::vector<Column>& neighbourhood);
    void forget_given(const Grid& grid, const std::vector<Column>& neighbourhood);

    std::vector<Group> groups_;
    std::vector<std::vector<Column>> neighbourhoods_;  ///< per zone; empty: its softening is local
    KernelKind kernel_ = KernelKind::gimp;
    double gimp_half_size_ = 0.0;
    double widest_ = 0.0;
    Pace pace_;
    std::vector<Weights> weights_;  ///< of the points of one group that take part, in their order
    // Per node, of one group at a time; all 0 between the groups.
    std::vector<double> volume_;  ///< of the points about it [m3]
    std::vector<double> growth_;  ///< volume x growth [m3]
    std::vector<double> given_;   ///< growth_ of its neighbours, weighted, soil or none [m3]
    std::vector<double> mean_;    ///< the neighbourhood's growth [-]
};

}  // namespace breach::mpm
