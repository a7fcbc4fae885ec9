// Adds what a scene needs for an earthquake: the FEM phase, its transfer, the stages of
// liquefaction in the stability analysis, the study's transfer times and a synthetic motion.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "services/earthquake/soils.hpp"
#include "services/earthquake/stress.hpp"

namespace breach::earthquake {

constexpr double least_pga = 0.01, most_pga = 1.5;      // g
constexpr double least_shaking = 4, most_shaking = 60;  // s
constexpr const char* motion_file = "motion.csv";

/// A synthetic motion of outcropping rock.
struct Motion {
    double pga = 0.3;      ///< [g]
    double shaking = 8.0;  ///< length [s]
};

/// A section that falls to the right, on a level base.
struct Section {
    std::vector<Region> regions;
    /// materials that another one replaces in the runout
    std::map<std::string, std::string> runouts;
    Line phreatic;
    Vec2 crest;                                      ///< downstream edge of the crest [m]
    double crest_from;                               ///< x of the crest's upstream edge [m]
    double height;                                   ///< of the slope [m]
    double left, right, base;                        ///< ends and level of the lower edge
    bool upright_left = true, upright_right = true;  ///< whether each side is one vertical line
    double element_size, cell_size;
    double layer_thickness;       ///< [m]
    double largest_sigma_v0_kPa;  ///< end of the last layer by stress, in liquefying soil
    double density;               ///< of the soil that liquefies [kg/m3]
    double residual_ratio = usual_residual_ratio;
};

Json fem_of(const Section& section, const Motion& motion);
Json transfer_of(const Section& section);
/// /lem/liquefaction; none without layers.
std::optional<Json> liquefaction_of(const Section& section);

/// Rigid ground of the runout: the base level up to `end`, then the level of the ground. `level`:
/// ground level at x; `h`: cell size.
template <class Level>
Line terrain_of(double left, double base, double end, double right, double h, const Level& level) {
    return {{left - h, base},
            {end + 0.2 * h, base},
            {end + 0.4 * h, level(end + 0.4 * h)},
            {right, level(right)}};
}

/// Wall of a grid of cells h, beside the base's end: the sides of the FEM sway.
inline double wall_beside(double left, double h) { return left - 0.25 * h; }

/// Triggers and transfer times of the study.
Json transfers_of(const Motion& motion);

/// Text of the motion's file. PGV and Arias intensity are like those of a record of San Fernando
/// 1971 with the same PGA and length.
std::string text_of(const Motion& motion);

}  // namespace breach::earthquake
