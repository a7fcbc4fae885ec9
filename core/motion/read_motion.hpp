// Motions from files: PEER records (.AT2, .VT2, .DT2), two columns of text, and CSV with a header.
// Every fault names its line.
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
    std::string title;  ///< PEER: its second line; otherwise the file's name
};

/// The first lines decide the form, for any file name; if they do not, the ending does:
/// .at2/.vt2/.dt2 (any case) PEER, .csv CSV, anything else two columns. Throws IoError when the
/// file cannot be opened, BadInput ("line N") for faults in it.
Recording read_motion(const std::filesystem::path& file);

/// Header lines, usually four: the last one gives NPTS and DT in either order, the one before it the
/// unit. Then values, any number per line.
Recording read_peer(std::istream& in, const std::string& name);

/// Time [s] and acceleration [g] per line, blanks, tabs, a semicolon or a comma between. Another unit
/// is that which lines starting with #, or one header, name (units.hpp). Times may be rounded or cut
/// off after their last digit.
Recording read_two_columns(std::istream& in, const std::string& name);

/// A header `time_s,acceleration_g` (or acceleration_m_s2, velocity_cm_s: units.hpp), then rows as
/// above.
Recording read_csv(std::istream& in, const std::string& name);

/// The CSV form, an acceleration in g, a velocity in m/s; `remarks` become # lines. Read again, it
/// gives the same values to 1e-8 of these units. Displacements have no CSV form: throws
/// std::invalid_argument.
void write_csv(std::ostream& out, const Recording& motion, const std::string& remarks);

}  // namespace breach::motion
