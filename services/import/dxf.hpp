// Reads the polylines of a DXF drawing: LWPOLYLINE, POLYLINE, LINE, ARC and CIRCLE of model space,
// in metres, and filled areas on layers with a material. Other entities on a layer with a meaning
// are faults, and so is such a layer with texts alone; other texts are reported as skipped.
// Does not check whether outlines close or touch.
#pragma once

#include <optional>
#include <string_view>

#include "services/import/layer_map.hpp"
#include "services/import/numbers.hpp"

namespace breach::importing {

struct DxfOptions {
    std::optional<Unit> unit = {};  ///< replaces the file's unit
    /// Arcs become chords with at most this error [m]; nothing: arcs are faults.
    std::optional<double> flatten = {};
};

/// Group codes: Autodesk, DXF Reference (2012), ENTITIES section. `text` has passed form_faults.
Drawing read_dxf(std::string_view text, const LayerMap& layers, const DxfOptions& request);

}  // namespace breach::importing
