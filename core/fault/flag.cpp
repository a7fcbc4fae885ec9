#include "core/fault/flag.hpp"

#include <algorithm>

namespace breach::fault {

const char* name_of(Severity severity) {
    return severity == Severity::questionable ? "questionable" : "warning";
}

bool is_questionable(const std::vector<Flag>& flags) {
    return std::ranges::find(flags, Severity::questionable, &Flag::severity) != flags.end();
}

}  // namespace breach::fault
