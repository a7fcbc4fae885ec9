// A completed scene as a list of its entries, each with its unit and with whether it has its
// default value. The schema gives the meaning of an entry.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::report {

struct SceneEntry {
    std::string pointer;  ///< "/mpm/floor/level"
    std::string value;    ///< as it is written, lists in full
    std::string unit;     ///< of the schema; empty: it has none
    bool is_default;      ///< the value is the one used when none is given
};

/// In the order of the document. Lists of numbers are one entry, objects in lists one each. `set`:
/// pointers set by an override; an entry there or below is never a default.
std::vector<SceneEntry> entries_of(const nlohmann::json& scene,
                                   const std::vector<std::string>& set = {});

}  // namespace breach::report
