// A region cut into layers by depth below the phreatic line.
#pragma once

#include <optional>

#include "services/import/heal.hpp"

namespace breach::importing {

struct LayerRequest {
    std::string region;          ///< a region's name, or the layer that several regions come from
    std::vector<double> depths;  ///< ascending, vertically below the line [m]
};

/// "tailings=5,10,15"; adds a fault to `faults` for any other form.
std::optional<LayerRequest> layer_request_from(const std::string& entry,
                                               std::vector<Fault>& faults);

/// The line is level beyond its ends. Parts: NAME_above, NAME_0_5, NAME_5_10, ..., NAME_below_15; a
/// part in several pieces gives NAME_0_5_2 and so on. Neighbours get the vertices of the cuts; parts
/// thinner than `tolerance` [m] are merged with the part beside them, and listed in `changes`.
Healed with_layers(std::vector<Soil> soils, const LayerRequest& request,
                   const std::vector<Vec2>& line, double tolerance);

}  // namespace breach::importing
