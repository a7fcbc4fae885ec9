// Boundaries of HATCH, SOLID and the like as closed rings. Edges of a hatch come in order, but
// each may point either way, so they are chained by their ends.
#include "services/import/hatch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace breach::importing {

namespace {

using Number = std::function<double(const Group&)>;

/// Reads groups in their order, as paths and edges repeat their codes.
class Cursor {
  public:
    Cursor(const std::vector<Group>& groups, const Number& number)
        : groups_(groups), number_(number) {}

    /// The next value of this code; 0 at the end.
    double next(int code) {
        while (at_ < groups_.size() && groups_[at_].code != code) ++at_;
        return at_ < groups_.size() ? number_(groups_[at_++]) : 0.0;
    }
    /// The same, if the code comes next.
    double next_if(int code) {
        return at_ < groups_.size() && groups_[at_].code == code ? number_(groups_[at_++]) : 0.0;
    }
    Vec2 place(int code) {
        const double x = next(code);
        return {x, next(code + 10)};
    }
    bool more() const { return at_ < groups_.size(); }
    std::size_t line() const { return more() ? groups_[at_].line : 0; }

  private:
    const std::vector<Group>& groups_;
    const Number& number_;
    std::size_t at_ = 0;
};

/// 93 counts vertices, and 72 says here whether they have bulges; in chain_of() the same codes
/// count edges and name their kind.
Boundary polyline_of(Cursor& cursor) {
    Boundary boundary;
    const bool bulges = cursor.next(72) != 0.0;
    const double count = cursor.next(93);
    while (static_cast<double>(boundary.corners.size()) < count && cursor.more()) {
        const std::size_t line = cursor.line();
        const Vec2 place = cursor.place(10);
        boundary.corners.push_back({place, 0.0, bulges ? cursor.next_if(42) : 0.0, line});
    }
    return boundary;
}

/// Angles are degrees. Clockwise ones (73 = 0) are measured from the mirrored axis, hence the sign
/// on both.
std::vector<Corner> arc_edge(Cursor& cursor) {
    const Vec2 centre = cursor.place(10);
    const double radius = cursor.next(40);
    const double from = cursor.next(50), to = cursor.next(51);
    const double turn = cursor.next(73) != 0.0 ? 1.0 : -1.0;  // else angles are clockwise
    const double whole = std::fmod(to - from, 360.0);
    const double angle = whole <= 0.0 ? whole + 360.0 : whole;
    constexpr double radians = std::numbers::pi / 180.0;
    return corners_of_arc(centre, std::abs(radius), turn * radians * from, turn * radians * angle);
}

/// A bulge belongs to the edge that follows its corner: reversing moves it by one and changes its
/// sign.
std::vector<Corner> reversed(std::vector<Corner> edge) {
    std::ranges::reverse(edge);
    for (std::size_t i = 0; i + 1 < edge.size(); ++i) edge[i].bulge = -edge[i + 1].bulge;
    edge.back().bulge = 0.0;
    return edge;
}

/// Relative: programs write coordinates with 16 digits, and far from the origin they round more.
bool meets(const Corner& a, const Corner& b) {
    return (a.at - b.at).norm() <= 1e-6 * (1.0 + a.at.norm());
}

/// Appends the edge; false: it does not meet the chain. The first one may be the wrong way round.
bool append(std::vector<Corner> edge, bool is_second, std::vector<Corner>& chain) {
    if (chain.empty()) {
        chain = std::move(edge);
        return true;
    }
    if (is_second && !meets(chain.back(), edge.front()) && !meets(chain.back(), edge.back()))
        chain = reversed(std::move(chain));
    if (!meets(chain.back(), edge.front())) edge = reversed(std::move(edge));
    if (!meets(chain.back(), edge.front())) return false;
    chain.pop_back();
    chain.insert(chain.end(), edge.begin(), edge.end());
    return true;
}

/// Lines (1) and circular arcs (2). The last corner repeats the first and is dropped.
Boundary chain_of(Cursor& cursor) {
    constexpr const char* open = "has a boundary that is not closed";
    Boundary boundary;
    const double count = cursor.next(93);
    for (double i = 0.0; i < count && cursor.more(); ++i) {
        const auto kind = static_cast<int>(cursor.next(72));
        std::vector<Corner> edge;
        if (kind == 1) {
            edge.push_back({cursor.place(10)});
            edge.push_back({cursor.place(11)});
        } else if (kind == 2) {
            edge = arc_edge(cursor);
        } else {
            return {{}, "is bounded by a curve that has no exact polyline", cursor.place(10)};
        }
        const Vec2 at = edge.front().at;
        if (!append(std::move(edge), i == 1.0, boundary.corners)) return {{}, open, at};
    }
    if (boundary.corners.empty()) return boundary;
    if (!meets(boundary.corners.front(), boundary.corners.back()))
        return {{}, open, boundary.corners.back().at};
    boundary.corners.pop_back();
    return boundary;
}

}  // namespace

bool is_area(std::string_view type) {
    constexpr std::array<std::string_view, 4> areas{"HATCH", "SOLID", "TRACE", "3DFACE"};
    return std::ranges::find(areas, type) != areas.end();
}

/// Bit 2 of 92 marks a polyline. A boundary of unknown form ends the reading: its length is
/// unknown, too.
std::vector<Boundary> boundaries_of(const Record& record, const Number& number) {
    Cursor cursor(record.groups, number);
    if (record.type != "HATCH") {
        Boundary boundary;
        for (const int code : {10, 11, 12, 13}) {
            const Vec2 place = cursor.place(code);
            boundary.corners.push_back({place, cursor.next_if(code + 20), 0.0, record.line});
        }
        // The last two corners of SOLID and TRACE are crossed.
        if (record.type != "3DFACE") std::swap(boundary.corners[2], boundary.corners[3]);
        // A triangle has its third corner twice.
        if (meets(boundary.corners[2], boundary.corners[3])) boundary.corners.pop_back();
        return {std::move(boundary)};
    }
    std::vector<Boundary> boundaries;
    const double count = cursor.next(91);
    while (static_cast<double>(boundaries.size()) < count && cursor.more()) {
        const auto flags = static_cast<unsigned>(std::clamp(cursor.next(92), 0.0, 1e6));
        boundaries.push_back((flags & 2) != 0 ? polyline_of(cursor) : chain_of(cursor));
        if (boundaries.back().corners.empty()) break;  // the rest cannot be found
    }
    return boundaries;
}

}  // namespace breach::importing
