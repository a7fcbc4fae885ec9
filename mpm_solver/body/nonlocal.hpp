// Nonlocal softening: averages the increments of a brittle soil's softening strain over its
// neighbourhood every few steps, so that a length of the soil and not the cell determines the width
// of a shear band. Method: docs/reference/methods/softening.md.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm_solver/body/grid.hpp"
#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

class NonlocalSoftening {
  public:
    /// Averages after `due` steps, of which `done` are done; few enough that bands grow by only a
    /// small part of the softening strain in between.
    struct Pace {
        std::int64_t done = 0;
        std::int64_t due = 1;
    };
    static constexpr std::int64_t most_steps = 16;

    NonlocalSoftening() = default;
    /// `widest`: see Body; a point with a larger volume is separated.
    NonlocalSoftening(const Points& points, const std::vector<Zone>& zones, const Grid& grid,
                      double gimp_half_size, double widest);

    bool is_on() const { return !groups_.empty(); }
    /// Stores the strains from which the increments count.
    static void remember(Points& points);
    /// Call after the stress update of a step; averages if due.
    void follow(Points& points, const std::vector<Zone>& zones, const Grid& grid);
    /// Replaces the increment of every brittle point by that of its neighbourhood. Returns the mean
    /// increment of softening soil over the strain from peak to residual strength, weighted by the
    /// increment itself: the few points of a band decide, not the soil at rest beside it.
    double spread(Points& points, const std::vector<Zone>& zones, const Grid& grid);

    const Pace& pace() const { return pace_; }
    /// For checkpoints: a resumed run averages at the same steps.
    void go_on_from(const Pace& pace) { pace_ = pace; }

  private:
    /// Soil of one region: debris on another dam must not soften it from a distance.
    struct Group {
        std::size_t zone;
        std::int32_t region;
    };
    /// Neighbouring nodes in one column, adjacent in memory, starting at a row.
    struct Column {
        std::int32_t columns, rows;   ///< relative to the middle node
        std::vector<double> weights;  ///< 0 for the middle node
    };
    /// Nodes [begin, end) of one column.
    struct Run {
        std::int32_t begin, end;
    };
    /// Weights of a point at its 3 x 3 nodes.
    struct Weights {
        std::int32_t first;
        double at[3][3];
    };
    static Weights weights_of(const GimpKernel& kernel, const Grid& grid, double x, double y);
    template <class Visit>
    static void for_nodes(const Grid& grid, const Weights& weights, const Visit& visit);
    static bool grows(const Points& points, const Zone& zone);
    bool takes_part(const Points& points, std::size_t p, const Group& group, double spent) const;
    void average(const Grid& grid, const std::vector<Column>& neighbourhood);
    void give(const Grid& grid, std::int32_t node, const std::vector<Column>& neighbourhood);
    void take(const Grid& grid, Run run, const std::vector<Column>& neighbourhood);
    void forget_given(const Grid& grid, const std::vector<Column>& neighbourhood);

    std::vector<Group> groups_;
    std::vector<std::vector<Column>> neighbourhoods_;  ///< [zones]; empty: local softening
    double gimp_half_size_ = 0.0;
    double widest_ = 0.0;
    Pace pace_;
    std::vector<Weights> weights_;  ///< of the participating points of one group
    // [nodes], of one group at a time; 0 between groups.
    std::vector<double> volume_;  ///< of the points near it [m3]
    std::vector<double> growth_;  ///< volume x growth [m3]
    std::vector<double> given_;   ///< weighted growth_ of its neighbours, with soil or without [m3]
    std::vector<double> mean_;    ///< mean increment of the neighbourhood [-]
};

}  // namespace breach::mpm
