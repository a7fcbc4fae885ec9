#include "core/fault/flag.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/words/words.hpp"

namespace breach::fault {

using nlohmann::json;

static constexpr auto words_of(Severity) {
    using enum Severity;
    return words::in_order<Severity>({{warning, "warning"}, {questionable, "questionable"}});
}

const char* name_of(Severity severity) { return words::name_of(severity).data(); }

bool is_questionable(const std::vector<Flag>& flags) {
    return std::ranges::find(flags, Severity::questionable, &Flag::severity) != flags.end();
}

json as_json(const std::vector<Flag>& flags) {
    json list = json::array();
    for (const Flag& each : flags)
        list.push_back({{"code", each.code},
                        {"severity", name_of(each.severity)},
                        {"message", each.message},
                        {"pointer", each.pointer}});
    return list;
}

std::vector<Flag> flags_in(const json& list) {
    std::vector<Flag> flags;
    for (const json& each : list) {
        const bool questionable = each.at("severity") == name_of(Severity::questionable);
        flags.push_back({each.at("code"), questionable ? Severity::questionable : Severity::warning,
                         each.at("message"), each.value("pointer", "")});
    }
    return flags;
}

}  // namespace breach::fault
