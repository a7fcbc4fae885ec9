// CAD users draw an outline as single lines and arcs, in any order and direction. This joins them
// before an outline is judged open. Called by sort_out.cpp for each layer and by section_lines.cpp
// for each kind of line. The nearest end wins; where ends are equally near, the piece drawn first,
// so that the same drawing gives the same outline. A branch stays as a piece of its own.
#include "services/import/join_lines.hpp"

#include <algorithm>
#include <optional>

namespace breach::importing {

namespace {

/// Four points at least: with three, the joined ends would leave two, which enclose nothing.
bool closes(const Outline& outline, double tolerance) {
    return outline.points.size() > 3 &&
           (outline.points.front() - outline.points.back()).norm() <= tolerance;
}

/// The nearest unused piece with an end here, reversed if necessary so that it begins here.
std::optional<std::size_t> next_piece(std::vector<Outline>& pieces, const std::vector<bool>& used,
                                      const Vec2& end, double tolerance) {
    std::optional<std::size_t> found;
    bool backwards = false;
    double least = tolerance;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (used[i] || pieces[i].closed) continue;
        for (const bool back : {false, true}) {
            const Vec2& begin = back ? pieces[i].points.back() : pieces[i].points.front();
            const double distance = (begin - end).norm();
            if (distance > least || (found && distance == least)) continue;
            least = distance;
            found = i;
            backwards = back;
        }
    }
    if (found && backwards) std::ranges::reverse(pieces[*found].points);
    return found;
}

}  // namespace

/// Each outline grows at its end, then, reversed, at its beginning. Inner joints drop the begin of
/// the next piece, so that its end within the tolerance is not a vertex twice.
std::vector<Outline> joined(std::vector<Outline> pieces, double tolerance) {
    std::vector<Outline> whole;
    std::vector<bool> used(pieces.size(), false);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (used[i]) continue;
        used[i] = true;
        Outline outline = pieces[i];
        for (int end = 0; end < 2 && !outline.closed; ++end) {
            while (!closes(outline, tolerance)) {
                const auto next = next_piece(pieces, used, outline.points.back(), tolerance);
                if (!next) break;
                used[*next] = true;
                const auto& more = pieces[*next].points;
                outline.points.insert(outline.points.end(), more.begin() + 1, more.end());
            }
            if (closes(outline, tolerance)) {
                outline.points.pop_back();
                outline.closed = true;
            } else {
                std::ranges::reverse(outline.points);  // then the other end; then restored
            }
        }
        whole.push_back(std::move(outline));
    }
    return whole;
}

}  // namespace breach::importing
