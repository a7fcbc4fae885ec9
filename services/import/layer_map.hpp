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
    bool told = false;          ///< by a mapping, not by its own name
};

/// Layer names are not case-sensitive. A layer means what the mapping says, else the material or the
/// line (phreatic, terrain, ground) of its own name.
class LayerMap {
  public:
    /// `entries`: "LAYER=material", "LAYER=phreatic|terrain|ground|none". Adds a fault to `faults`
    /// for any other form.
    LayerMap(const std::vector<std::string>& entries, const std::set<std::string>& materials,
             std::vector<Fault>& faults);

    Meaning meaning_of(const std::string& layer) const;
    /// Entries whose layer is not among these.
    std::vector<std::string> unused(const std::set<std::string>& layers) const;

  private:
    std::map<std::string, Meaning> told_;     ///< by lower-case layer
    std::map<std::string, std::string> own_;  ///< lower-case name to material
};

}  // namespace breach::importing
