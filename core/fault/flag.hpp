// What a reader must know before relying on a result. A fault stops a phase; a flag goes with its result, and every
// place that shows a number of that result shows the flag as well.
#pragma once

#include <string>
#include <vector>

namespace breach::fault {

/// warning: the number is usable, but less certain than it looks. questionable: the number is wrong, a bound, or
/// cannot be trusted; the result is not plainly "succeeded".
enum class Severity { warning, questionable };

struct Flag {
    std::string code;  ///< fixed and short: "still_moving", "coarse_cells"
    Severity severity;
    std::string message;       ///< what, with its number and its limit, and what to do
    std::string pointer = {};  ///< JSON pointer of the scene entry behind it; empty: none
};

const char* name_of(Severity severity);

/// Whether one of them makes the result questionable.
bool is_questionable(const std::vector<Flag>& flags);

}  // namespace breach::fault
