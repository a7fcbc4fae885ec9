// Reads motions: PEER records (.AT2, .VT2, .DT2), two columns of text, and CSV with a header. Every
// fault names its line.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include "core/motion/series.hpp"
#include "core/motion/units.hpp"

namespace breach::motion {

struct Recording {
    Quantity quantity = Quantity::acceleration;
    Series series;      ///< SI
    std::string title;  ///< PEER: second line; others: the file's name
};

/// The first lines decide the format; if they do not, the extension: .at2/.vt2/.dt2 (any case)
/// PEER, .csv CSV, else two columns. Throws IoError if the file cannot be opened, BadInput ("line
/// N") for faults in it and for publishers' forms that are not read (V1, V2, SMC, COSMOS, ...).
Recording read_motion(const std::filesystem::path& file);

/// Header lines, usually four: the last has NPTS and DT in either order, the one before it the
/// unit. Then values, any number per line; they may touch ("0.1-0.2") as Fortran writes them.
Recording read_peer(std::istream& in, const std::string& name);

/// Time [s] and acceleration [g] per line, separated by blanks, tabs, a semicolon or a comma. Lines
/// that start with #, or one header, may name another unit (units.hpp). Times may be rounded or
/// truncated.
Recording read_two_columns(std::istream& in, const std::string& name);

/// A header `time_s,acceleration_g` (or acceleration_m_s2, velocity_cm_s: units.hpp), then rows as
/// in two columns.
Recording read_csv(std::istream& in, const std::string& name);

/// Writes the CSV format, an acceleration in g or a velocity in m/s; `remarks` become # lines. Read
/// again, the values are equal to 1e-8 of these units. Throws std::invalid_argument for a
/// displacement.
void write_csv(std::ostream& out, const Recording& motion, const std::string& remarks);

}  // namespace breach::motion
