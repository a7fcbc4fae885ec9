// Writes hydrographs in the formats of other programs: CSV, HEC-RAS's flow hydrograph, FLO-2D's
// INFLOW.DAT. Called by http_outflow.cpp alone; clients save its answer as it is. Sources and
// tests: docs/how-to/hydrographs.md.
#pragma once

#include <optional>
#include <string>

#include "services/outflow/hydrograph.hpp"

namespace breach::outflow {

/// Warns against routing the flow as water.
extern const std::string slurry_warning;
/// slurry_warning, and the reasons against using this hydrograph.
std::string warning_of(const Hydrograph& hydrograph);

/// All rows per metre of width; with a width also its low, best and high discharges and volumes.
std::string as_csv(const Hydrograph& hydrograph, const std::optional<BreachWidth>& width);

/// Flows at equal intervals.
struct Ordinates {
    double interval;               ///< [s]
    std::vector<double> m3_per_s;  ///< the first and the last are 0
    double volume;                 ///< with straight lines between them [m3]
    double peak_before;            ///< largest flow of the hydrograph [m3/s]
    double peak_after;             ///< largest of these flows [m3/s]
};

/// Means over intervals around each time, so that straight lines between them carry exactly the
/// volume that passed. The first ordinate lies one interval before the runout begins. Flow back is
/// subtracted from the flow before it, so that no flow is negative. Throws BadInput when nothing
/// passes towards +x, or for more than a million ordinates.
Ordinates ordinates_of(const Hydrograph& hydrograph, double width, double interval,
                       const std::string& file);

/// The peak before and after, with a warning and a remedy where more than a tenth of it is lost.
std::string peaks_in_words(const Ordinates& flows);

/// The same at an interval of HEC-RAS's list, in whole seconds; others throw BadInput.
Ordinates hec_ras_ordinates(const Hydrograph& hydrograph, double width, double interval,
                            const std::string& file);

/// Comments, then ordinate, simulation time, flow [m3/s].
std::string as_hec_ras(const Hydrograph& hydrograph, double width, double interval,
                       const std::string& file);

struct Flo2dOptions {
    std::int64_t cell = 1;                  ///< number of the grid element that takes the inflow
    std::optional<double> concentration{};  ///< of solids by volume; none: no column [-]
};

/// Hours and m3/s. Throws BadInput like ordinates_of.
std::string as_flo_2d(const Hydrograph& hydrograph, double width, double interval,
                      const Flo2dOptions& request, const std::string& file);

}  // namespace breach::outflow
