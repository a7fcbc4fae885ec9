// Numbers and units as drawings write them. The units are one table: names for users, codes for DXF
// ($INSUNITS), metres.
#include "services/import/numbers.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "core/words/list.hpp"

namespace breach::importing {

namespace {

struct Known {
    const char* name;
    int code;  ///< of $INSUNITS
    double metres;
};
constexpr std::array<Known, 10> units{{{"m", 6, 1.0},
                                       {"mm", 4, 1e-3},
                                       {"cm", 5, 1e-2},
                                       {"dm", 14, 0.1},
                                       {"km", 7, 1e3},
                                       {"in", 1, 0.0254},
                                       {"ft", 2, 0.3048},
                                       {"yd", 10, 0.9144},
                                       {"mi", 3, 1609.344},
                                       {"us-ft", 21, 1200.0 / 3937.0}}};

}  // namespace

/// \r as well: lines of files from Windows end with \r\n and are split at \n.
std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// from_chars() knows no locale, so that 1.5 is read alike everywhere, and refuses a leading plus,
/// which CAD programs write.
std::optional<double> number_in(std::string_view text) {
    text = trimmed(text);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<Unit> unit_named(const std::string& name) {
    for (const Known& each : units)
        if (name == each.name) return Unit{each.name, each.metres};
    return std::nullopt;
}

std::string unit_names() { return words::list_of(units, &Known::name); }

/// Codes of the DXF Reference, $INSUNITS.
std::optional<Unit> unit_of_code(int code) {
    for (const Known& each : units)
        if (code == each.code) return Unit{each.name, each.metres};
    return std::nullopt;
}

}  // namespace breach::importing
