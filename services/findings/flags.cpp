// Reads flags as result.json and the store hold them. What a flag means for a number (lower bound,
// questionable) is decided here and nowhere else.
#include "services/findings/flags.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace breach::findings {

using fault::Flag;
using fault::Severity;
using nlohmann::json;

std::vector<Flag> flags_in(const json& list) {
    std::vector<Flag> flags;
    for (const json& each : list)
        flags.push_back({each.at("code"),
                         each.at("severity") == name_of(Severity::questionable)
                             ? Severity::questionable
                             : Severity::warning,
                         each.at("message"), each.value("pointer", "")});
    return flags;
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

std::string worded(std::string code) {
    std::ranges::replace(code, '_', ' ');
    return code;
}

/// Other numbers of a runout, such as its depth beyond the toe, may also fall while soil moves.
bool grows(std::string_view quantity) {
    constexpr std::array growing{"runout", "runout_beyond_toe", "runout_largest",
                                 "area_beyond_toe"};
    return std::ranges::find(growing, quantity) != growing.end();
}

/// mpm_solver writes both for every runout; either is enough.
bool still_moves(const json& at_rest, const json& flags) {
    return at_rest == json(false) || std::ranges::any_of(flags, [](const json& each) {
               return each.at("code") == "still_moving";
           });
}

bool still_moves(const json& result) {
    return result.is_object() &&
           still_moves(result.value("at_rest", json()), result.value("flags", json::array()));
}

}  // namespace breach::findings
