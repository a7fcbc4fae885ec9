// Reads the hydrographs of a runout at its sections (history.h5).
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/exchange/archive.hpp"

namespace breach::outflow {

/// Flow past one section per metre of width; one entry per telemetry line.
struct Hydrograph {
    std::string section;
    std::vector<double> time{};       ///< since the runout began [s]
    std::vector<double> discharge{};  ///< mean since the previous entry, towards +x [m2/s]
    std::vector<double> depth{};      ///< [m]
    std::vector<double> velocity{};   ///< [m/s]
    std::vector<double> volume{};     ///< net, passed so far, at initial density [m2]
    std::vector<double> mass{};       ///< [kg/m]
    std::string warning{};  ///< why the runout's numbers are unreliable; empty: no reason is known
};

/// Calls visit(name, unit, values) for every column except the time.
template <class AnyHydrograph, class Visit>
void for_each_column(AnyHydrograph& hydrograph, Visit&& visit) {
    visit("discharge", "m2/s", hydrograph.discharge), visit("depth", "m", hydrograph.depth);
    visit("velocity", "m/s", hydrograph.velocity), visit("volume", "m2", hydrograph.volume);
    visit("mass", "kg/m", hydrograph.mass);
}

std::vector<std::string> sections_in(const exchange::Archive& history);

/// Throws BadInput, naming `file` and its sections, if the section does not exist.
Hydrograph hydrograph_in(const exchange::Archive& history, const std::string& section,
                         const std::string& file);

/// One of many samples, and its index.
struct Chosen {
    std::size_t sample;
    Hydrograph hydrograph;
};
/// The one whose volume is nearest to the percentile p [%] of all volumes, scaled to that volume
/// (discharge, volume and mass); its warning says so. Needs the samples of core/statistics, else
/// throws BadInput.
Chosen at_percentile(const std::vector<Hydrograph>& samples, double p, const std::string& file);

/// The history in a runout's output folder.
exchange::Archive history_of(const std::filesystem::path& output);

/// Width of the breach [m].
struct BreachWidth {
    double low;
    double best;
    double high;
};

/// From a number or [low, best, high]. Throws BadInput at `pointer`.
BreachWidth breach_width_from(const nlohmann::json& entry, const std::string& file,
                              const std::string& pointer);

/// A width with its source in words.
struct StatedWidth {
    BreachWidth width;
    std::string from;
};

/// The scene's /mpm/breach_width, else 3 (2 to 4) heights of the soil above the toe, the usual
/// widths of embankment dams (Reclamation 1988 and FERC 1987, in Wahl 1998, DSO-98-004).
/// For the report alone: other programs get only a width that someone chose. scene: completed, with
/// a runout.
StatedWidth stated_width(const nlohmann::json& scene);

}  // namespace breach::outflow
