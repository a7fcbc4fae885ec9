// The order of the points: by zone, then by the node next to them, column by column, so that points
// that share their 3 x 3 nodes are neighbours in memory. Columns are divided into strips; while no
// point has moved far from where it was sorted, every second strip shares no node with another, and
// the active nodes are known. So a strip is a thread's unit of work, and the sums over strips do not
// depend on the number of threads.
#pragma once

#include <array>
#include <vector>

#include "mpm_solver/body/grid.hpp"
#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

class Strips {
  public:
    /// Columns of nodes in a strip: two strips with another one between them never share a
    /// node.
    static constexpr std::int32_t width = 4;
    /// Largest distance of points from their home before they are sorted again [cells].
    static constexpr double largest_stray = 0.5;

    /// Sorts the points, gives them new homes and divides them into strips.
    void sort(Grid& grid, Points& points, const std::vector<Zone>& zones);
    /// Divides points that are already sorted into strips, and finds the active nodes.
    void cut(Grid& grid, const Points& points, const std::vector<Zone>& zones);

    std::size_t count() const { return count_; }
    /// Points of a zone in a strip.
    Span span(std::size_t strip, std::size_t zone) const { return spans_[strip * zones_ + zone]; }
    /// Strips that share no node with one another: the even ones, the odd ones.
    const std::array<std::vector<std::size_t>, 2>& apart() const { return apart_; }
    const std::vector<std::size_t>& all() const { return all_; }
    /// Possible cells (as their nodes) of a zone's points; every active node belongs to some zone.
    const std::vector<std::int32_t>& cells(std::size_t zone) const { return cells_[zone]; }

  private:
    void find_active_nodes(Grid& grid, const Points& points, const std::vector<Zone>& zones);

    std::size_t count_ = 0;
    std::size_t zones_ = 0;
    std::vector<Span> spans_;
    std::array<std::vector<std::size_t>, 2> apart_;
    std::vector<std::size_t> all_;
    std::vector<std::vector<std::int32_t>> cells_;
};

}  // namespace breach::mpm
