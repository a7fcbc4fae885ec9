// Outlines from comma-separated text: columns region, x, y (a polygon per region), or x, y alone.
#pragma once

#include <string_view>

#include "services/import/layer_map.hpp"
#include "services/import/numbers.hpp"

namespace breach::importing {

/// A header names the columns, in any order; separators are commas, semicolons (then with decimal
/// commas) or tabs; lines that begin with # are remarks. A region's outline ends with another region's
/// name or a blank line. Rows without a region column belong to the layer `alone`. Soil is closed,
/// lines are not. Levels may be called z; other columns are ignored. Two columns of one meaning are a
/// fault, and so are rows with more fields than the header. The header may give the unit ("x_mm",
/// "x (ft)", "x [m]"); metres where neither it nor `asked` does, and a fault where they differ.
Drawing read_csv(std::string_view text, const LayerMap& layers, const std::optional<Unit>& asked,
                 const std::string& alone = "");

}  // namespace breach::importing
