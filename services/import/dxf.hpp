// The polylines of a DXF drawing: LWPOLYLINE, POLYLINE, LINE, ARC and CIRCLE of model space, in metres.
// Everything else on a layer that means something is a fault or, where it is only writing, told as
// passed over. Whether outlines close or touch is not judged here.
#pragma once

#include <optional>
#include <string_view>

#include "services/import/layer_map.hpp"
#include "services/import/numbers.hpp"

namespace breach::importing {

struct DxfOptions {
    std::optional<Unit> unit = {};  ///< instead of the file's
    /// Arcs become chords that are off by so much [m]; none: they are refused.
    std::optional<double> flatten = {};
};

/// Group codes: Autodesk, DXF Reference (2012), ENTITIES section. `text` as form_faults lets it pass.
Drawing read_dxf(std::string_view text, const LayerMap& layers, const DxfOptions& request);

}  // namespace breach::importing
