// Hydrographs in the formats of other programs: CSV, HEC-RAS's flow hydrograph, FLO-2D's
// INFLOW.DAT. docs/how-to/hydrographs.md gives the sources of the formats and what was tested.
#pragma once

#include <optional>
#include <string>

#include "services/outflow/hydrograph.hpp"

namespace breach::outflow {

/// Warning against routing the numbers as if they were water.
extern const std::string slurry_warning;
/// The same, and the reasons against using this hydrograph.
std::string warning_of(const Hydrograph& hydrograph);

/// Every row per metre; with a width the discharges and volumes of its low, best and high, too.
std::string as_csv(const Hydrograph& hydrograph, const std::optional<BreachWidth>& width);

/// Flows at equal intervals.
struct Ordinates {
    double interval;               ///< [s]
    std::vector<double> m3_per_s;  ///< the first and the last are 0
    double volume;                 ///< by straight lines between them [m3]
    double peak_before;            ///< largest flow of the hydrograph [m3/s]
    double peak_after;             ///< largest of these flows [m3/s]
};

/// Means over intervals about each time, so that straight lines between them carry exactly the volume
/// that passed: the first ordinate is an interval before the runout begins. Soil that flows back is
/// subtracted from the flow before it, so that no flow is negative. Throws BadInput when nothing passes
/// towards +x, or for more than a million ordinates.
Ordinates ordinates_of(const Hydrograph& hydrograph, double width, double interval,
                       const std::string& file);

/// The peak before and after, with a warning and a remedy where more than a tenth of it is lost.
std::string peaks_in_words(const Ordinates& flows);

/// Comments, then ordinate, simulation time, flow [m3/s]. interval: one of HEC-RAS's, in whole
/// seconds; otherwise throws BadInput.
std::string as_hec_ras(const Hydrograph& hydrograph, double width, double interval,
                       const std::string& file);

struct Flo2dOptions {
    std::int64_t cell = 1;                  ///< number of the grid element that takes the inflow
    std::optional<double> concentration{};  ///< of solids by volume; none: no column [-]
};

/// Hours and m3/s. Throws BadInput as ordinates_of does.
std::string as_flo_2d(const Hydrograph& hydrograph, double width, double interval,
                      const Flo2dOptions& request, const std::string& file);

}  // namespace breach::outflow
