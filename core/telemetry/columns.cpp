#include "core/telemetry/columns.hpp"

#include <algorithm>
#include <array>

namespace breach::telemetry {

namespace {

constexpr std::array fem_table{
    Column{"step", "1", "steps so far, those of the static stages too", Needs::nothing, 0.0},
    Column{"time", "s", "since the first dynamic stage began", Needs::nothing, 0.0},
    Column{"dt", "s", "length of the step", Needs::nothing, 0.0},
    Column{"iterations", "1", "Newton iterations of the step", Needs::nothing, 0.0},
    Column{"residual", "1", "out of balance after the step, over the reference force",
           Needs::nothing, 0.0},
    Column{"crest_displacement", "m", "displacement of the crest's node", Needs::nothing, 0.0,
           500.0},
    Column{"crest_dx", "m", "its horizontal part"},
    Column{"crest_dy", "m", "its vertical part"},
    Column{"base_velocity", "m/s",
           "horizontal velocity of the elastic base, averaged over its nodes"},
    Column{"kinetic_energy", "J", "of the body without free-field columns", Needs::nothing, 0.0},
    Column{"kinetic_energy_over_peak", "1",
           "kinetic energy over its largest value so far: below 1 the peak is past", Needs::nothing,
           0.0, 1.0},
    Column{"external_work", "J", "of gravity and other constant loads"},
    Column{"internal_work", "J", "of the stresses"},
    Column{"viscous_dissipation", "J",
           "taken by the materials' viscosity, in the body without free-field columns"},
    Column{"jacobian_ratio_avg", "1", "the same as jacobian_centre_avg"},
    Column{"jacobian_ratio_min", "1", "the same as jacobian_least_min"},
    Column{"jacobian_centre_avg", "1", "area ratio of the strained elements"},
    Column{"jacobian_least_avg", "1", "worst corner ratio of the strained elements, averaged"},
    Column{"jacobian_least_min", "1", "worst corner ratio of all elements"},
    Column{"epsilon_q_avg", "1", "deviatoric strain of the strained elements, averaged",
           Needs::nothing, 0.0},
    Column{"epsilon_q_max", "1", "largest deviatoric strain of an element", Needs::nothing, 0.0},
    Column{"strained_share", "1", "volume of strained elements over all volume", Needs::nothing,
           0.0, 1.0},
    Column{"softened_share", "1", "volume that has lost strength over volume that can",
           Needs::softening, 0.0, 1.0},
    Column{"psi_avg", "1", "state parameter of NorSand's points, averaged by volume",
           Needs::state_parameter},
    Column{"instability_ratio_max", "1",
           "largest stress ratio of NorSand's points over the limiting one, eta_L",
           Needs::state_parameter},
    Column{"past_peak_share", "1",
           "volume of NorSand that would lose strength if it were sheared undrained, over all of "
           "its volume",
           Needs::state_parameter, 0.0, 1.0},
    Column{"strength_ratio_avg", "1",
           "undrained peak strength of NorSand now over sigma'_v0, averaged by volume; of the last "
           "look (/fem/strength_interval)",
           Needs::looks_at_strength},
    Column{"strength_ratio_min", "1", "the least of a point", Needs::looks_at_strength},
    Column{
        "viscous_share", "1",
        "shear stress of the stiffness-proportional damping over the soil's own, in soil strained "
        "beyond /fem/failure_surfaces/epsilon_q",
        Needs::damping, 0.0},
    Column{"excess_pressure_avg", "Pa", "excess pore pressure, averaged by mass", Needs::water},
    Column{"r_u_max", "1", "largest excess pore pressure ratio of the watched nodes",
           Needs::watched_ground},
    Column{"liquefaction_depth", "m", "of the deepest liquefied watched node",
           Needs::watched_ground, 0.0},
    Column{"failure_surfaces", "1", "bands of large strain from ground to ground", Needs::nothing,
           0.0},
    Column{"slip_across_band", "m",
           "mean displacement of the largest body that such bands cut off, against the rest"},
    Column{"inverted_elements", "1", "elements with a corner turned inside out", Needs::nothing,
           0.0},
};

constexpr std::array run_table{
    Column{"critical_depth", "m",
           "depth of the slip surface with the least factor of safety as layers liquefy, no deeper "
           "than they; 0 when it is below 1 before any does (lem_tool)",
           Needs::nothing, 0.0},
    Column{
        "post_seismic_factor", "1",
        "factor of safety with the strengths of the latest snapshot, residual where the soil has "
        "liquefied (lem_tool, with \"post_seismic\" in the study)"},
};

}  // namespace

std::span<const Column> fem_columns() { return fem_table; }
std::span<const Column> run_columns() { return run_table; }

const Column* column_named(std::string_view name) {
    for (const std::span<const Column> table : {fem_columns(), run_columns()}) {
        const auto found =
            std::ranges::find_if(table, [&](const Column& column) { return column.name == name; });
        if (found != table.end()) return &*found;
    }
    return nullptr;
}

}  // namespace breach::telemetry
