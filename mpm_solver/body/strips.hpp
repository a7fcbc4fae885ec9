// Order of the points: by zone, then by nearest node, column by column, so that points with the
// same 3 x 3 nodes are adjacent in memory. Columns are divided into strips, the units of work of
// threads. As long as no point has moved far from its home, every second strip shares no node with
// another, and the active nodes are known. Sums over strips do not depend on the number of threads.
#pragma once

#include <array>
#include <vector>

#include "mpm_solver/body/grid.hpp"
#include "mpm_solver/body/points.hpp"

namespace breach::mpm {

class Strips {
  public:
    /// Columns of nodes per strip: strips with one in between never share a node.
    static constexpr std::int32_t width = 4;
    /// Largest distance of points from their homes before the next sort [cells].
    static constexpr double largest_stray = 0.5;

    /// Sorts the points, sets their homes and divides them into strips.
    void sort(Grid& grid, Points& points, const std::vector<Zone>& zones);
    /// Divides sorted points into strips, and finds the active nodes.
    void cut(Grid& grid, const Points& points, const std::vector<Zone>& zones);

    std::size_t count() const { return count_; }
    /// Empty for a strip that the zone does not reach.
    Span span(std::size_t strip, std::size_t zone) const { return spans_[strip * zones_ + zone]; }
    /// Strips that share no nodes: the even ones, the odd ones.
    const std::array<std::vector<std::size_t>, 2>& apart() const { return apart_; }
    const std::vector<std::size_t>& all() const { return all_; }
    /// Possible cells (index of a node) of a zone's points.
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
