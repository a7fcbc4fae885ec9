// Monitored quantities at one time, as a telemetry line and a row of the history.
// Recorder reads them at each telemetry row; what is not of a single motion (dt, works) it adds
// itself. Triggers, windows and reports know these columns by name.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/exchange/archive.hpp"
#include "core/telemetry/columns.hpp"
#include "fem_solver/model/model.hpp"

namespace breach::fem {

/// Distortion of the mesh, |J_t| / |J_0| [-]. centre: area ratio; least: worst corner of an
/// element.
struct Distortion {
    double centre_average = 1.0;  ///< over the strained elements
    double least_average = 1.0;   ///< over the strained elements
    double least = 1.0;           ///< over all elements
    std::size_t worst_element = 0;
    std::size_t inverted = 0;  ///< elements with a corner at or below 0
};

/// One row; each member is a column.
struct Reading {
    double step = 0.0;
    double time = 0.0;  ///< [s]
    double dt = 0.0;    ///< [s]
    double iterations = 0.0;
    double residual = 0.0;                  ///< out-of-balance over reference force [-]
    double crest_displacement = 0.0;        ///< [m]
    double crest_dx = 0.0;                  ///< [m]
    double crest_dy = 0.0;                  ///< [m]
    double base_velocity = 0.0;             ///< horizontal, of an elastic base [m/s]
    double kinetic_energy = 0.0;            ///< [J]
    double kinetic_energy_over_peak = 1.0;  ///< over its maximum so far [-]
    double external_work = 0.0;             ///< of gravity since the first dynamic stage [J]
    double internal_work = 0.0;             ///< of the stresses since the first dynamic stage [J]
    double viscous_dissipation = 0.0;       ///< by the materials' viscosity, in the body [J]
    double jacobian_ratio_avg = 1.0;        ///< = jacobian_centre_avg
    double jacobian_ratio_min = 1.0;        ///< = jacobian_least_min
    double jacobian_centre_avg = 1.0;
    double jacobian_least_avg = 1.0;
    double jacobian_least_min = 1.0;
    /// Volume average over the strained elements; 0 if there are none [-]
    double epsilon_q_avg = 0.0;
    double epsilon_q_max = 0.0;  ///< [-]
    /// Volume of elements with epsilon_q above the threshold over the total volume [-]
    double strained_share = 0.0;
    /// average of u - u_0 at nodes with unknown pressure, weighted by mass [Pa]
    double excess_pressure_avg = 0.0;
    double r_u_max = 0.0;             ///< maximum at the watched nodes [-]
    double liquefaction_depth = 0.0;  ///< of the deepest liquefied watched node [m]
    double failure_surfaces = 0.0;    ///< from ground to ground
    double slip_across_band = 0.0;    ///< of the largest body that failure surfaces separate [m]
    double inverted_elements = 0.0;
    double psi_avg = 0.0;                ///< state parameter, by volume [-]
    double instability_ratio_max = 0.0;  ///< eta over eta_L [-]
    /// share of the volume with psi in which q would fall in undrained shear [-]
    double past_peak_share = 0.0;
    double strength_ratio_avg = 0.0;  ///< s_u over sigma'_v0, by volume [-]
    double strength_ratio_min = 0.0;  ///< minimum [-]
    double viscous_share = 0.0;       ///< damping stress over the soil's stress in bands [-]
    double softened_share = 0.0;      ///< volume that has softened over volume that can soften [-]
};

struct Column : telemetry::Column {
    double Reading::*member;
};
/// In the order of core/telemetry/columns.hpp.
const std::vector<Column>& columns();
/// Without columns that this scene does not measure.
std::vector<Column> columns_of(const scene::Scene& scene);

/// Element average of epsilon_q = sqrt(2/3 e:e) of the total strain since the first dynamic stage
/// [-].
double element_epsilon_q(const Model& model, const Motion& motion, std::size_t element);
/// The same for all elements of the body.
std::vector<double> epsilon_q_of_elements(const Model& model, const Motion& motion);

Distortion distortion_of(const Model& model, const Motion& motion, double strain_threshold);

/// All entries of a Reading that follow from the motion; the caller sets the others (time, dt,
/// iterations, residual, works).
Reading read_monitors(const Model& model, const Motion& motion, const Distortion& distortion,
                      std::size_t crest_node, double strain_threshold);

nlohmann::json telemetry_line(const Reading& reading, const std::vector<Column>& columns);
exchange::Archive history_archive(const std::vector<Reading>& history,
                                  const std::vector<Column>& columns);
/// Throws std::out_of_range if a column is missing or has another length.
std::vector<Reading> history_from(const exchange::Archive& archive);

std::size_t nearest_node(const Mesh& mesh, const Vec2& point);
/// Mean length of the edges at a node [m].
double element_size_at(const Mesh& mesh, std::size_t node);

}  // namespace breach::fem
