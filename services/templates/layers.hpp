// Cuts a part along the phreatic line and along lines of equal depth below it. assembly.cpp does it
// to the part that can liquefy, once it has the water.
#pragma once

#include "services/templates/outline.hpp"

namespace breach::templates {

struct Layer {
    int number;  ///< 0: above the line; 1: the uppermost below it
    Polygon polygon;
};

struct Cut {
    double thickness;  ///< of a layer, measured downwards from the line; the lowest layer is up to
                       ///< twice as thick [m]
    double nearest;    ///< points of the cut closer than this to a vertex move to it [m]
    double
        thinnest;  ///< thinner pieces are merged with the neighbour with the longest common border,
                   ///< if possible on the same side of the line [m]
};

/// From the top down. Each piece of a layer is one entry.
std::vector<Layer> cut_by_depth(const Polygon& polygon, const Line& phreatic, const Cut& cut);

/// Splits a polygon along a line. Points within `nearest` of a vertex move to it.
std::vector<Polygon> divided(const Polygon& polygon, const Line& line, double nearest);

/// Adds every vertex on another part's side to that part, too.
void share_vertices(std::vector<Part>& parts);

}  // namespace breach::templates
