// Inside core/scene only: checks shared by the readers of several phases.
#pragma once

#include "core/scene/reader.hpp"

namespace breach::scene {

inline void check_ascending(Reader& reader, const std::array<double, 2>& range,
                            const std::string& pointer) {
    if (range[0] >= range[1])
        reader.add(pointer, "is not ascending", "write [from, to] with from < to");
}

/// Checks the order of a list whose entries are valid individually.
template <class List, class Before>
void check_order(Reader& reader, const List& list, Before before, const std::string& pointer,
                 const std::string& remedy) {
    for (std::size_t i = 1; i < list.size(); ++i) {
        if (!before(list[i - 1], list[i])) {
            reader.add(pointer + "/" + std::to_string(i), "is out of order", remedy);
        }
    }
}

/// Points from left to right with ascending x.
inline std::vector<Vec2> line_from(Reader& reader, const nlohmann::json& points,
                                   const std::string& pointer) {
    std::vector<Vec2> line;
    for (const nlohmann::json& vertex : points) line.push_back(point_from(vertex));
    check_order(
        reader, line, [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); }, pointer,
        "give points from left to right, no two with the same x");
    return line;
}

}  // namespace breach::scene
