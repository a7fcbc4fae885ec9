#include "core/scene/slips.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/words/number.hpp"

namespace breach::scene {

using nlohmann::json;

namespace {

constexpr const char* range_key = "x-plausible";
constexpr const char* slips_key = "x-slips";

bool within(double value, const json& range) {
    return value >= range.at(0).get<double>() && value <= range.at(1).get<double>();
}

std::string unit_of(const json& entry) {
    const std::string unit = entry.value("unit", "1");
    return unit == "1" ? "" : " " + unit;
}

/// Typical unit slips of an entry.
const json& slips_for(const json& entry, const json& root) {
    static const json none = json::array();
    if (entry.contains(slips_key)) return entry.at(slips_key);
    const std::string unit = entry.value("unit", "1");
    const bool known = root.contains(slips_key) && root.at(slips_key).contains(unit);
    return known ? root.at(slips_key).at(unit) : none;
}

/// The value in the entry's unit if it was given in the slip's unit.
double converted(double value, const json& slip) {
    if (slip.contains("tangent_of")) return std::tan(value * slip.at("tangent_of").get<double>());
    return value * slip.at("factor").get<double>();
}

/// Four digits, as accurate as a converted number.
double rounded(double value) {
    if (value == 0.0 || !std::isfinite(value)) return value;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
    return std::nearbyint(value / unit) * unit;
}

}  // namespace

std::string plain_number(double value) {
    const double size = std::abs(value);
    const bool plain = size == 0.0 || (size >= 1e-4 && size < 1e9);
    return words::formatted(plain && size >= 1e5 ? "%.0f" : "%.6g", value);
}

std::string likely_slip(double value, const json& entry, const json& root) {
    if (!entry.contains(range_key)) return {};
    std::string text;
    for (const json& slip : slips_for(entry, root)) {
        const double meant = converted(value, slip);
        if (!within(meant, entry.at(range_key))) continue;
        text += text.empty() ? plain_number(value) + " looks like " : ", or like ";
        text += slip.at("unit").get<std::string>() + ": write " + plain_number(rounded(meant)) +
                unit_of(entry);
    }
    return text;
}

std::optional<std::string> warning_about(double value, const json& entry, const json& root) {
    if (!entry.contains(range_key) || value == 0.0) return std::nullopt;
    const json& range = entry.at(range_key);
    if (within(value, range)) return std::nullopt;
    std::string text = plain_number(value) + unit_of(entry) + " lies outside the plausible " +
                       plain_number(range.at(0)) + " to " + plain_number(range.at(1)) +
                       unit_of(entry);
    if (entry.contains("description")) text += ": " + entry.at("description").get<std::string>();
    const std::string slip = likely_slip(value, entry, root);
    return slip.empty() ? text : text + "; " + slip;
}

}  // namespace breach::scene
