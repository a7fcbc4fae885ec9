// Flow through the scene's sections: hydrographs per metre of width. Volumes are the constant
// initial ones (V_0), independent of loosening.
// Measured twice on purpose: from positions (read_sections, per row) and from momentum
// (sample_sections, every few steps). Their difference is the closure, the error of a hydrograph.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm_solver/body/body.hpp"
#include "mpm_solver/measure/flow.hpp"

namespace breach::mpm {

/// Steps between two samples of the momentum flux; a point takes about ten times as many to pass.
inline constexpr std::int64_t steps_between_fluxes = 4;

/// Soil beyond a section, per metre of width. A point is a square of its volume and passes
/// gradually.
struct Beyond {
    double volume = 0.0;  ///< [m2]
    double mass = 0.0;    ///< [kg/m]
};

struct SectionRecord {
    Beyond start;              ///< at the first measurement
    double by_momentum = 0.0;  ///< time integral of the momentum flux so far [m2]
    double flux = 0.0;         ///< momentum flux at `time` [m2/s]
    double time = -1.0;        ///< of the last flux sample [s]
    // One per row of the history:
    std::vector<double> discharge;  ///< mean since the row before, towards +x [m2/s]
    std::vector<double> depth;      ///< as at a gauge [m]
    std::vector<double> velocity;   ///< as at a gauge [m/s]
    std::vector<double> volume;     ///< passed since the first measurement, net [m2]
    std::vector<double> mass;       ///< the same [kg/m]
};

/// In the order of Mpm::sections.
using SectionRecords = std::vector<SectionRecord>;

Beyond beyond(const Points& points, const FlowView& view, double x);

/// Volume that the momentum of the points carries through x per time and metre [m2/s]: the rate of
/// Beyond::volume from velocities instead of positions.
double flux_at(const Body& body, const FlowView& view, double x);

/// Adds the flux since the last sample, by the trapezoidal rule.
void sample_sections(const std::vector<scene::FlowSection>& sections, const Body& body,
                     const FlowView& view, double now, SectionRecords& records);

/// Adds a row; `since`: time of the row before.
void read_sections(const std::vector<scene::FlowSection>& sections, const Points& points,
                   const FlowView& view, double now, double since, SectionRecords& records);

/// Largest mean discharge over the time in which the fastest flow travels two cells: single rows
/// scatter with the number of points that cross.
struct Peak {
    double discharge = 0.0;  ///< towards +x [m2/s]
    double time = 0.0;       ///< middle of the window [s]
    double window = 0.0;     ///< [s]
};
/// `times`: of the rows. The fastest flow has at least `arrival_depth`, if any is so deep: soil
/// thrown ahead would shorten the time. None if nothing passed towards +x.
std::optional<Peak> peak_of(const SectionRecord& record, const std::vector<double>& times,
                            const FlowView& view, double arrival_depth);

/// Volume by the momentum flux minus the volume beyond, over all volume that moved in both
/// directions [-]. None if nothing passed.
std::optional<double> closure_of(const SectionRecord& record);

/// "<prefix>section.<name>.discharge" and so on: the rows; with `State::whole` also the running
/// sums.
enum class SectionState { rows, whole };
void store(const std::vector<scene::FlowSection>& sections, const SectionRecords& records,
           const std::string& prefix, SectionState state, exchange::Archive& archive);
/// Throws std::out_of_range if an array is missing or not `rows` long.
SectionRecords load_sections(const std::vector<scene::FlowSection>& sections,
                             const exchange::Archive& archive, const std::string& prefix,
                             std::size_t rows);

/// Calls visit(name, unit, rows) for each column of a hydrograph.
template <class AnyRecord, class Visit>
void for_each_column_of_section(AnyRecord& record, Visit&& visit) {
    visit("discharge", "m2/s", record.discharge), visit("depth", "m", record.depth);
    visit("velocity", "m/s", record.velocity), visit("volume", "m2", record.volume);
    visit("mass", "kg/m", record.mass);
}

}  // namespace breach::mpm
