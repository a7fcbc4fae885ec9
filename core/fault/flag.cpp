#include "core/fault/flag.hpp"

#include <algorithm>

#include "core/words/words.hpp"

namespace breach::fault {

static constexpr auto words_of(Severity) {
    using enum Severity;
    return words::in_order<Severity>({{warning, "warning"}, {questionable, "questionable"}});
}

const char* name_of(Severity severity) { return words::name_of(severity).data(); }

bool is_questionable(const std::vector<Flag>& flags) {
    return std::ranges::find(flags, Severity::questionable, &Flag::severity) != flags.end();
}

}  // namespace breach::fault
