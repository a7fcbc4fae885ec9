// A completed scene as a list of its entries, each with its unit and with whether it stands at the
// program's own value. What an entry means is the schema's to say.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::report {

struct SceneEntry {
    std::string pointer;  ///< "/mpm/floor/level"
    std::string value;    ///< as it is written, lists in full
    std::string unit;     ///< of the schema; empty: it has none
    bool is_default;      ///< the value is the one that the program takes where nothing is given
};

/// In the order of the document. Lists of numbers are one entry, objects in lists one each. `set`:
/// pointers that were set by an override; what is there or below is never a default.
std::vector<SceneEntry> entries_of(const nlohmann::json& scene,
                                   const std::vector<std::string>& set = {});

}  // namespace breach::report
