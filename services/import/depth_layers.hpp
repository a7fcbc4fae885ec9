// Cuts a region into layers by depth below the phreatic line.
#pragma once

#include <optional>

#include "services/import/heal.hpp"

namespace breach::importing {

struct LayerRequest {
    std::string region;          ///< a region's name, or the layer shared by several regions
    std::vector<double> depths;  ///< ascending, measured vertically below the line [m]; none: the
                                 ///< region is cut along the line alone
};

/// "tailings=5,10,15"; any other form adds a fault to `faults`.
std::optional<LayerRequest> layer_request_from(const std::string& entry,
                                               std::vector<Fault>& faults);

/// Extends the line horizontally beyond its ends. Parts: NAME_above, NAME_0_5, NAME_5_10, ...,
/// NAME_below_15; further pieces of a part: NAME_0_5_2 and so on. Neighbours get the vertices of
/// the cuts. Parts thinner than `tolerance` [m] are merged with an adjacent part, and listed in
/// `changes`.
Healed with_layers(std::vector<Soil> soils, const LayerRequest& request,
                   const std::vector<Vec2>& line, double tolerance);

}  // namespace breach::importing
