// What a flag means for a number (lower bound, questionable) is decided here and nowhere else.
#include "services/findings/flags.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace breach::findings {

using nlohmann::json;

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
