// Cuts a part along the phreatic line and along lines of equal depth below it.
#pragma once

#include "services/templates/outline.hpp"

namespace breach::templates {

struct Layer {
    int number;  ///< 0: above the line; 1: the uppermost below it
    Polygon polygon;
};

struct Cut {
    double thickness;  ///< of a layer, measured downwards from the line; the lowest takes the rest,
                       ///< less than another one [m]
    double nearest;    ///< places of the cut nearer than this to a vertex are moved to it [m]
    double
        thinnest;  ///< a thinner piece is merged with a neighbour on the same side of the line with
                   ///< the longest common border, else with one across the line [m]
};

/// From the top down. A layer may be in several pieces: each is one entry.
std::vector<Layer> cut_by_depth(const Polygon& polygon, const Line& phreatic, const Cut& cut);

/// The pieces of a polygon on either side of a line. Places within `nearest` of a vertex move to it.
std::vector<Polygon> divided(const Polygon& polygon, const Line& line, double nearest);

/// Every vertex of one part on another part's side is added to that one, too.
void share_vertices(std::vector<Part>& parts);

}  // namespace breach::templates
