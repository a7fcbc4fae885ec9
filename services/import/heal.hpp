// Outlines of soil that nearly fit together, made to fit: common vertices, no gaps, no overlaps. What
// was done is told with its place and size; what is larger than the tolerance is a fault.
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
};

/// One thing that healing did.
struct Change {
    std::string kind;  ///< gap, overlap, junction, sliver, short_side, spike, orientation, end
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

/// `tolerance` [m]: what is nearer is meant to touch. `terrain`: a line from left to right that soil may
/// lie on; empty: none.
Healed healed(std::vector<Soil> soils, double tolerance, const std::vector<Vec2>& terrain = {});

/// Faces with the soil that each belongs to: what healing and cutting into layers end with.
struct Shares {
    std::vector<Vec2> nodes;
    std::vector<Face> faces;
    std::vector<int> owners;  ///< per face, index of a soil; -1: nobody's
};

/// Thin pieces that hang on their soil by a corner go to the neighbour with the longest common border.
void give_slivers_away(Shares& shares, const std::vector<Soil>& soils, double tolerance,
                       std::vector<Change>& changes);

/// Outer rings of what a soil has got, the largest first; `holes`: it encloses something.
std::vector<Polygon> pieces_of(const Shares& shares, int owner, bool& holes);

}  // namespace breach::importing
