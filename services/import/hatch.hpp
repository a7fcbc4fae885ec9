// Reads filled areas of a DXF drawing as closed boundaries: HATCH, SOLID, TRACE and 3DFACE.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "services/import/arcs.hpp"
#include "services/import/dxf_records.hpp"

namespace breach::importing {

/// One closed boundary in drawing units; without corners: `cause` says why it is none.
struct Boundary {
    std::vector<Corner> corners;
    std::string cause = "has no area";
    Vec2 at = Vec2::Zero();  ///< a place on it, for the cause
};

/// Whether entities of this type are filled areas.
bool is_area(std::string_view type);

/// The boundaries of a filled area: polylines with bulges, and closed chains of lines and circular
/// arcs; ellipses and splines are none. `number`: the value of a group. Group codes: Autodesk, DXF
/// Reference (2012), HATCH, "Boundary path data".
std::vector<Boundary> boundaries_of(const Record& record,
                                    const std::function<double(const Group&)>& number);

}  // namespace breach::importing
