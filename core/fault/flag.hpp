// Remarks on a result that its reader must know. A fault stops a phase; a flag accompanies the
// result wherever its numbers are shown.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace breach::fault {

/// warning: the number is usable but less certain than it looks. questionable: the number is wrong,
/// a bound, or unreliable; the result is not plainly "succeeded".
enum class Severity { warning, questionable };

struct Flag {
    std::string code;  ///< fixed and short: "still_moving", "coarse_cells"
    Severity severity;
    std::string message;       ///< what, its number and limit, and what to do
    std::string pointer = {};  ///< scene entry that causes it; empty: none
};

const char* name_of(Severity severity);

bool is_questionable(const std::vector<Flag>& flags);

/// [{"code", "severity", "message", "pointer"}], as in result.json, the FEM's checkpoints, the API
/// and the database.
nlohmann::json as_json(const std::vector<Flag>& flags);
/// Inverse of as_json; a missing pointer is read as empty. Throws nlohmann's exception for any
/// other JSON.
std::vector<Flag> flags_in(const nlohmann::json& list);

}  // namespace breach::fault
