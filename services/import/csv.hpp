// Reads outlines from CSV: columns region, x, y (a polygon per region), or x, y only.
#pragma once

#include <string_view>

#include "services/import/layer_map.hpp"
#include "services/import/numbers.hpp"

namespace breach::importing {

/// A header names the columns in any order; "z" means levels; other columns are ignored. Separators
/// are commas, semicolons (then with decimal commas) or tabs; lines that begin with # are remarks.
/// A region's outline ends at another region's name or a blank line; soil is closed, lines are not.
/// Rows without a region column belong to the layer `alone`. The header may give the unit ("x_mm",
/// "x (ft)", "x [m]"); without it and without `asked` it is metres. Faults: units that differ, two
/// columns with the same meaning, rows longer than the header.
Drawing read_csv(std::string_view text, const LayerMap& layers, const std::optional<Unit>& asked,
                 const std::string& alone = "");

}  // namespace breach::importing
