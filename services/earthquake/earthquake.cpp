// One place for the assumptions of a seismic study, used by templates and by the import with a
// motion. Numbers without a measurement are written into the scene with notes, so that a reader
// of the scene sees them.
#include "services/earthquake/earthquake.hpp"

#include <algorithm>
#include <sstream>

#include "core/motion/read_motion.hpp"
#include "core/motion/synthetic.hpp"
#include "core/scene/resolution.hpp"
#include "core/words/number.hpp"

namespace breach::earthquake {

namespace {

double coefficient_kPa(const Section& section) {
    return rounded(section.residual_ratio * atmosphere);
}

/// Free-field columns need a side that is one vertical line.
std::optional<Json> free_field_of(const Section& section) {
    if (!section.upright_left && !section.upright_right) return std::nullopt;
    Json columns{{"width", section.element_size}, {"thickness_factor", 1000}};
    if (!section.upright_left || !section.upright_right)
        columns["sides"] = section.upright_left ? "left" : "right";
    return columns;
}

/// The monitored soil: from one height upstream of the crest to the crest.
/// The crest's upstream side is where the dam is lost if the soil below it liquefies.
std::optional<Json> watch_of(const Section& section) {
    Json names = Json::array();
    double right = section.left;  // right end of the soil that can liquefy
    for (const Region& each : section.regions) {
        if (each.layer == 0) continue;
        names.push_back(each.name);
        right = std::max(right, geometry::bounding_box(each.polygon).high.x());
    }
    if (names.empty()) return std::nullopt;
    const double from = std::min(section.crest_from, right) - section.height;
    return Json{{"regions", names},
                {"x", {nanometres(from), nanometres(section.crest.x())}},
                {"level", nanometres(section.phreatic.front().y())}};
}

}  // namespace

Json fem_of(const Section& section, const Motion& motion) {
    Json fem{
        {"notes",
         {"assumed: rock below the model with V_s = 760 m/s; motion.csv is synthetic, no record; "
          "0.5 % of damping at 3 Hz beside that of the soil's law",
          "elements are for a first look: halve element_size before relying on the failure",
          "gravity acts on elastic soil: PM4Sand, which has no cohesion, starts with the "
          "shaking"}}};
    fem["element"] = "ssp";
    fem["supports"] = {{{"name", "base"},
                        {"from", {nanometres(section.left), nanometres(section.base)}},
                        {"to", {nanometres(section.right), nanometres(section.base)}},
                        {"fixes", "xy"}}};
    fem["water"] = {{"line", points(section.phreatic)}};
    // 760 m/s is the usual boundary between rock and stiff soil (NEHRP B/C).
    fem["base"] = {{"density", 2243}, {"V_s", 760}, {"motion_at", "outcrop"}};
    fem["motion"] = {{"file", motion_file}};
    if (const auto columns = free_field_of(section)) fem["free_field"] = *columns;
    // gamma = 5/6 and beta = (gamma + 1/2)^2 / 4: damps high frequencies, stays unconditionally
    // stable.
    fem["newmark_beta"] = 4.0 / 9;
    fem["newmark_gamma"] = 5.0 / 6;
    fem["damping"] = {{"ratio", 0.005}, {"frequency_Hz", 3}};
    fem["stages"] = {{{"type", "static"}, {"name", "elastic gravity"}, {"laws", "elastic"}},
                     {{"type", "dynamic"},
                      {"name", "shaking"},
                      {"duration", motion.shaking},
                      {"time_step", 0.005}}};
    fem["force_tolerance"] = 1e-5;
    fem["crest"] = corner(section.crest);
    if (const auto watch = watch_of(section)) fem["liquefaction"] = *watch;
    fem["telemetry_interval"] = 0.05;
    return fem;
}

Json transfer_of(const Section& section) {
    Json mapping = Json::array(), names = Json::array();
    for (const Region& each : section.regions) {
        if (const auto runout = section.runouts.find(each.material);
            runout != section.runouts.end())
            mapping.push_back({{"region", each.name}, {"to", runout->second}});
        if (each.layer == 0) continue;
        names.push_back(each.name);
    }
    Json transfer{{"points_per_cell", scene::points_across_cell * scene::points_across_cell},
                  {"mapping", mapping}};
    transfer["phreatic_line"] = points(section.phreatic);
    if (names.empty()) return transfer;
    // Half a layer: the mean strength of a layer is then that of the stability analysis.
    const double step =
        0.5 * rounded(section.layer_thickness * (section.density - water_density) * g / 1e3);
    Json layers = Json::array();
    for (double from = 0.0; from < section.largest_sigma_v0_kPa || layers.empty(); from += step)
        layers.push_back({{"sigma_v0_kPa", {rounded(from), rounded(from + step)}}});
    transfer["liquefied"] = {
        {"regions", names},
        {"layers", layers},
        {"narrowest_wall", 2.0 * section.cell_size},
        {"residual_strength",
         {{"like", "liquefied"}, {"coefficient_kPa", coefficient_kPa(section)}, {"exponent", 1}}}};
    return transfer;
}

std::optional<Json> liquefaction_of(const Section& section) {
    std::vector<Region> regions = section.regions;
    std::ranges::stable_sort(regions, {}, &Region::layer);  // from the top down
    Json layers = Json::array();
    for (const Region& each : regions)
        if (each.layer > 0)
            layers.push_back(
                {{"region", each.name}, {"residual_coefficient_kPa", coefficient_kPa(section)}});
    if (layers.empty()) return std::nullopt;
    return layers;
}

Json transfers_of(const Motion& motion) {
    const double duration = motion.shaking;
    Json study;
    study["triggers"] = {{{"kind", "window"},
                          {"name", "last_sound_mesh"},
                          {"lower", "time > " + words::text_of(duration / 8)},
                          {"upper", "jacobian_least_avg < 0.97 or epsilon_q_avg > 0.2"},
                          {"pick", "last_before"},
                          {"snapshot_interval_s", rounded(duration / 32)}}};
    // A transfer may come before the dam has liquefied. Times that a distorted mesh never reaches
    // cost nothing.
    for (const double share : {0.4, 0.6, 0.8, 1.0})
        study["transfer_times"].push_back(rounded(share * duration));
    return study;
}

std::string text_of(const Motion& motion) {
    const double strong = 0.4 * motion.shaking;
    const motion::Target target{
        .peak_acceleration = motion.pga * motion::standard_gravity,
        .peak_velocity = 0.85 * motion.pga,
        .strong_duration = strong,
        .arias_intensity = 1.33 * (motion.pga / 0.3) * (motion.pga / 0.3) * strong / 11.16,
        .length = motion.shaking,
        .dt = 0.01,
        .seed = 1978};
    const motion::Recording recording{.quantity = motion::Quantity::acceleration,
                                      .series = motion::synthetic_motion(target),
                                      .title = "synthetic"};
    std::ostringstream text;
    motion::write_csv(text, recording,
                      "Synthetic: no recorded earthquake. Made by breach new, seed 1978.");
    return text.str();
}

}  // namespace breach::earthquake
