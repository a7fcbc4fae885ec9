// The history of a run: one row per telemetry line.
// Simulation::look adds the rows. for_each_column is the one list of columns, from which telemetry,
// history.h5 and checkpoints are made: renaming one changes files that others read.
#pragma once

#include <cstdint>
#include <vector>

#include "core/exchange/archive.hpp"

namespace breach::mpm {

struct Row {
    double time = 0.0;
    double step = 0.0;
    double dt = 0.0;
    double runout = 0.0;
    double runout_beyond_toe = 0.0;
    double runout_beyond_toe_95 = 0.0;
    double runout_beyond_toe_50 = 0.0;
    double runout_largest = 0.0;
    double runout_by_count = 0.0;  ///< 99th percentile over points, not weighted by mass
    double runout_front = 0.0;     ///< farthest place with the front's depth, from the toe
    double area_beyond_toe = 0.0;  ///< of the section
    double kinetic_energy = 0.0;
    double kinetic_mobile = 0.0;  ///< of the mobile soil
    double gravitational_energy = 0.0;
    double elastic_energy = 0.0;
    double plastic_dissipation = 0.0;
    double friction_dissipation = 0.0;
    double viscous_dissipation = 0.0;
    double shaking_work = 0.0;  ///< of the moving frame
    double energy_numerical = 0.0;
    double energy_numerical_share = 0.0;  ///< over energy_scale
    double volume_ratio = 0.0;
    double overlap = 0.0;
    double overlap_energy = 0.0;  ///< by the overlap correction, part of the numerical energy
    double fastest = 0.0;
};

/// Calls visit(name, unit, value) for every column.
template <class AnyRow, class Visit>
void for_each_column(AnyRow& row, Visit&& visit) {
    visit("time", "s", row.time), visit("step", "1", row.step), visit("dt", "s", row.dt);
    visit("runout", "m", row.runout), visit("runout_beyond_toe", "m", row.runout_beyond_toe);
    visit("runout_beyond_toe_95", "m", row.runout_beyond_toe_95);
    visit("runout_beyond_toe_50", "m", row.runout_beyond_toe_50);
    visit("runout_by_count", "m", row.runout_by_count);
    visit("runout_largest", "m", row.runout_largest), visit("runout_front", "m", row.runout_front);
    visit("area_beyond_toe", "m2", row.area_beyond_toe);
    visit("kinetic_energy", "J", row.kinetic_energy);
    visit("kinetic_mobile", "J", row.kinetic_mobile);
    visit("gravitational_energy", "J", row.gravitational_energy);
    visit("elastic_energy", "J", row.elastic_energy);
    visit("plastic_dissipation", "J", row.plastic_dissipation);
    visit("friction_dissipation", "J", row.friction_dissipation);
    visit("viscous_dissipation", "J", row.viscous_dissipation);
    visit("shaking_work", "J", row.shaking_work);
    visit("energy_numerical", "J", row.energy_numerical);
    visit("energy_numerical_share", "1", row.energy_numerical_share);
    visit("volume_ratio", "1", row.volume_ratio), visit("overlap", "1", row.overlap);
    visit("overlap_energy", "J", row.overlap_energy);
    visit("fastest", "m/s", row.fastest);
}

using History = std::vector<Row>;

/// Stores and loads the rows as arrays "<prefix><column>".
void store(const History& history, const std::string& prefix, exchange::Archive& archive);
History load(const exchange::Archive& archive, const std::string& prefix);

}  // namespace breach::mpm
