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

/// The unit in a header such as "ACCELERATION TIME SERIES IN UNITS OF CM/S/S": the one after "UNITS
/// OF", or the only one in the line. A unit may have a scale ("G/10", "0.01 G"). If the line names
/// quantities, the unit must be one of theirs. Apart from the unit, only words of a closed list are
/// allowed; none for any other line.
std::optional<Unit> unit_in_header(const std::string& header);

/// The unit in a column's name: "acceleration_g", "acceleration_m_s2", "Velocity (cm/s)".
std::optional<Unit> unit_of_column(const std::string& name);

/// Unit that a comment gives for its file's values.
struct Named {
    std::optional<Unit> unit;
    std::string unknown;  ///< looks like a unit but is not in the list
};
/// Reads "time [s] acceleration [m/s2]", "acceleration in cm/s2", "units: gal". Ignores values with
/// units ("PGA 0.3 g") and other prose.
Named unit_in_comment(const std::string& comment);

/// "time_s", "Time (sec)", "t"
bool is_time_column(const std::string& name);

/// For remedies.
inline constexpr const char* known_units =
    "G, GAL, CM/S2, M/S2, MM/S2, IN/S2 or FT/S2 for an acceleration; CM/S, M/S, MM/S, IN/S or FT/S "
    "for a velocity; a scale as in G/10";

}  // namespace breach::motion
