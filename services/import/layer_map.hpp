// Meaning of a drawing's layer: a material or a line of the section.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/import/drawing.hpp"

namespace breach::importing {

enum class Role { soil, phreatic, terrain, ground, none, unknown };

struct Meaning {
    Role role = Role::unknown;
    std::string material = "";  ///< of soil
    bool told = false;          ///< from the mapping, not from the layer's name
};

/// Layer names are not case-sensitive. The mapping decides, else the layer's name: a material or a
/// line (phreatic, terrain, ground).
class LayerMap {
  public:
    /// `entries`: "LAYER=material", "LAYER=phreatic|terrain|ground|none". Any other form adds a
    /// fault to `faults`.
    LayerMap(const std::vector<std::string>& entries, const std::set<std::string>& materials,
             std::vector<Fault>& faults);

    Meaning meaning_of(const std::string& layer) const;
    /// Entries whose layer is not in `layers`.
    std::vector<std::string> unused(const std::set<std::string>& layers) const;

  private:
    std::map<std::string, Meaning> told_;     ///< by lower-case layer
    std::map<std::string, std::string> own_;  ///< lower-case name to material
};

}  // namespace breach::importing
