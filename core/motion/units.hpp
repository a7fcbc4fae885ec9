// Units of a motion in a header or a column's name: whole words of a closed list.
#pragma once

#include <optional>
#include <string>

namespace breach::motion {

enum class Quantity { acceleration, velocity, displacement };

struct Unit {
    Quantity quantity;
    double factor;  ///< to SI
    bool operator==(const Unit&) const = default;
};

/// From a line such as "ACCELERATION TIME SERIES IN UNITS OF CM/S/S": the unit behind "UNITS OF",
/// otherwise the only unit in it. A unit may have a scale ("G/10", "0.01 G"). Where the line names
/// quantities, the unit must be one of theirs. Beside the unit stand words of a closed list only.
/// Nothing for any other line.
std::optional<Unit> unit_in_header(const std::string& header);

/// Of a column's name: "acceleration_g", "acceleration_m_s2", "Velocity (cm/s)".
std::optional<Unit> unit_of_column(const std::string& name);

/// What a comment says of its file's values.
struct Named {
    std::optional<Unit> unit;
    std::string unknown;  ///< what looks like a unit and is none of the list
};
/// Of "time [s] acceleration [m/s2]", "acceleration in cm/s2", "units: gal". Values with their units
/// ("PGA 0.3 g") and other prose say nothing.
Named unit_in_comment(const std::string& comment);

/// "time_s", "Time (sec)", "t"
bool is_time_column(const std::string& name);

/// The units that a remedy lists.
inline constexpr const char* known_units =
    "G, GAL, CM/S2, M/S2, MM/S2, IN/S2 or FT/S2 for an acceleration; CM/S, M/S, MM/S, IN/S or FT/S "
    "for a velocity; a scale as in G/10";

}  // namespace breach::motion
