// Reads numbers and units of length in drawings.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace breach::importing {

std::string_view trimmed(std::string_view text);
/// The whole text as a finite number, ignoring blanks around it.
std::optional<double> number_in(std::string_view text);

struct Unit {
    std::string name;  ///< "mm"
    double metres;     ///< metres per unit
};
/// m, mm, cm, dm, km, in, ft, yd, mi, us-ft (US survey foot).
std::optional<Unit> unit_named(const std::string& name);
std::string unit_names();
/// Unit of DXF's $INSUNITS; nothing for 0 (unitless) and for units that no section uses.
std::optional<Unit> unit_of_code(int code);

}  // namespace breach::importing
