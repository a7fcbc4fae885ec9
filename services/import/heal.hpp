// Makes outlines of soil fit together that nearly do: common vertices, no gaps, no overlaps. Reports
// each change with place and size; deviations beyond the tolerance are faults.
#pragma once

#include <string>
#include <vector>

#include "services/import/arrangement.hpp"
#include "services/import/drawing.hpp"

namespace breach::importing {

struct Soil {
    std::string name;  ///< of the region
    std::string layer;
    std::string material;
    Polygon ring;
    Origin origin;
    int depth_layer = 0;  ///< below the phreatic line, from 1; 0: none
};

/// One change by healing.
struct Change {
    std::string kind;  ///< gap, overlap, junction, sliver, short_side, spike, orientation, end,
                       ///< edge
    std::vector<std::string> regions;
    Vec2 at;
    double size;  ///< how wide the gap or overlap was, how far something moved [m]
};

struct Healed {
    std::vector<Soil> soils;    ///< rings counter-clockwise, of common vertices
    std::vector<Vec2> terrain;  ///< through the vertices that it passes
    std::vector<Change> changes;
    std::vector<Fault> faults;
};

/// `tolerance` [m]: nearer places are meant to touch. `terrain`: a line from left to right that soil may
/// lie on; empty: none.
Healed healed(std::vector<Soil> soils, double tolerance, const std::vector<Vec2>& terrain = {});

/// Faces with the soil that each belongs to: the result of healing and of cutting into layers.
struct Shares {
    std::vector<Vec2> nodes;
    std::vector<Face> faces;
    std::vector<int> owners;  ///< per face, index of a soil; -1: none
};

/// Moves thin pieces joined to their soil at a corner only to the neighbour with the longest border.
void give_slivers_away(Shares& shares, const std::vector<Soil>& soils, double tolerance,
                       std::vector<Change>& changes);

/// Outer rings of a soil's faces, the largest first; `holes`: it encloses something.
std::vector<Polygon> pieces_of(const Shares& shares, int owner, bool& holes);

}  // namespace breach::importing
