// Makes outlines that nearly fit together fit: common vertices, no gaps, no overlaps. Reports each
// change with place and size; larger deviations than the tolerance are faults.
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
    int depth_layer = 0;        ///< below the phreatic line, from 1; 0: none
    std::string cut_from = "";  ///< region as drawn, whose part this is; empty: whole
};

/// One correction.
struct Change {
    std::string kind;  ///< gap, overlap, junction, sliver, short_side, spike, orientation, end,
                       ///< edge
    std::vector<std::string> regions;
    Vec2 at;
    double size;  ///< width of the gap or overlap, or distance of the move [m]
};

struct Healed {
    std::vector<Soil> soils;    ///< counter-clockwise rings with common vertices
    std::vector<Vec2> terrain;  ///< with all vertices that it passes
    std::vector<Change> changes;
    std::vector<Fault> faults;
};

/// `tolerance` [m]: points closer than this coincide. `terrain`: a line from left to right on which
/// soil may lie; empty: none.
Healed healed(std::vector<Soil> soils, double tolerance, const std::vector<Vec2>& terrain = {});

/// Faces with their soils: the result of healing and of cutting into layers.
struct Shares {
    std::vector<Vec2> nodes;
    std::vector<Face> faces;
    std::vector<int> owners;  ///< per face, index of a soil; -1: none
};

/// Gives thin pieces that touch their soil only at a corner to the longest neighbour.
void give_slivers_away(Shares& shares, const std::vector<Soil>& soils, double tolerance,
                       std::vector<Change>& changes);

/// Outer rings of a soil's faces, the largest first; `holes`: whether it encloses something.
std::vector<Polygon> pieces_of(const Shares& shares, int owner, bool& holes);

}  // namespace breach::importing
