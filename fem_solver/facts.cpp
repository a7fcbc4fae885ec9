// From states to what a reader needs: numbers in result.json, flags with remedies, sentences in the
// log. Columns of the history are computed elsewhere (monitors/); here they are only searched.
#include "fem_solver/facts.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <span>
#include <sstream>

#include "core/motion/measures.hpp"
#include "core/phases/files.hpp"
#include "core/scene/softening.hpp"
#include "core/words/remedy.hpp"
#include "fem_solver/model/stages.hpp"
#include "fem_solver/monitors/upstream_wall.hpp"
#include "fem_solver/monitors/viscous_share.hpp"

namespace breach::fem {

namespace {

std::string shown(double value) {
    std::ostringstream text;
    text.precision(4);
    text << value;
    return text.str();
}

/// Energy and stress of the hourglass stabilisation in the body. Stress: largest nodal hourglass
/// force per side length over all elements.
nlohmann::json hourglass_facts(const Model& model, const Motion& motion, double internal_work) {
    double energy = 0.0, largest = 0.0;
    std::size_t worst = 0;
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        const Hourglass& each = motion.hourglass[e];
        energy += each.energy;
        // To compare with the soil's mean stress there: stabilisation that carries as much as the
        // soil decides whether a liquefied dam fails (docs/reference/methods/up_element.md).
        const double force = model.hourglass[e].gamma.cwiseAbs().maxCoeff() * each.force.norm();
        const double stress = force / std::sqrt(model.volume[e] * model.thickness);
        if (stress <= largest) continue;
        largest = stress;
        worst = e;
    }
    const double mean_stress = motion.points[worst].sigma.head<3>().sum() / 3.0;
    return {{"energy", energy},
            {"energy_over_internal_work",
             internal_work != 0.0 ? energy / std::abs(internal_work) : 0.0},
            {"largest_stress", largest},
            {"mean_stress_there", mean_stress},
            {"element", worst}};
}

/// Time of the first row in which a column reaches a value [s]; null: never.
nlohmann::json first_time(const std::vector<Reading>& history, double Reading::*column,
                          double value) {
    const auto first =
        std::ranges::find_if(history, [&](const Reading& each) { return each.*column >= value; });
    if (first == history.end()) return nullptr;
    return first->time;
}

/// Share of the final depth at which liquefaction counts as complete. Mochikoshi's runouts reach
/// their plateau 0.4 s later.
constexpr double most_of_depth = 0.8;

/// Flags excess pore pressure that grew by a fifth or more in the last tenth of the shaking.
std::optional<fault::Flag> still_liquefying(const std::vector<Reading>& history) {
    if (history.size() < 2 || history.back().liquefaction_depth <= 0.0) return std::nullopt;
    const double end = history.back().time;
    // Ended in the middle of liquefaction, the runout would start from soil that is too strong.
    const auto then =
        std::ranges::find_if(history, [&](const Reading& each) { return each.time >= 0.9 * end; });
    const double before = then->excess_pressure_avg, at_end = history.back().excess_pressure_avg;
    if (at_end < 1.2 * before) return std::nullopt;
    return fault::Flag{
        "still_liquefying", fault::Severity::questionable,
        "the mean excess pore pressure still grew when the FEM ended, from " + shown(before / 1e3) +
            " kPa at " + shown(then->time) + " s to " + shown(at_end / 1e3) + " kPa at " +
            shown(end) + " s: runouts from its last states are too short; lengthen the last stage",
        "/fem/stages"};
}

fault::Flag viscous_band(const scene::Fem& fem, double share) {
    // A slide with less damping is faster: its share falls about with the damping's square root.
    const double stiffness = std::pow(largest_viscous_share / share, 2) * fem.rayleigh_stiffness;
    const std::string remedy =
        fem.damping_frequency
            ? words::set("/fem/damping/ratio",
                         words::rounded_down(stiffness * std::numbers::pi * *fem.damping_frequency))
            : words::set("/fem/rayleigh_stiffness", words::rounded_down(stiffness));
    return {"viscous_band", fault::Severity::warning,
            "in soil that fails, damping carries " + shown(100.0 * share) +
                " % of what the soil itself carries in shear (at most 33 % can be trusted): it "
                "slows the slide; compare with " +
                remedy,
            "/fem/damping"};
}

/// Events of the analysis from the history.
nlohmann::json milestones_in(const std::vector<Reading>& history) {
    const auto crest = [&](double value) {
        return first_time(history, &Reading::crest_displacement, value);
    };
    nlohmann::json facts{{"crest_1_m", crest(1.0)},
                         {"crest_2_5_m", crest(2.5)},
                         {"crest_5_m", crest(5.0)},
                         {"slip_1_m", first_time(history, &Reading::slip_across_band, 1.0)}};
    const auto deepest = std::ranges::max_element(history, {}, &Reading::liquefaction_depth);
    if (deepest != history.end() && deepest->liquefaction_depth > 0.0)
        facts["liquefied"] = {{"depth", deepest->liquefaction_depth},
                              {"time", first_time(history, &Reading::liquefaction_depth,
                                                  most_of_depth * deepest->liquefaction_depth)}};
    const auto peak = std::ranges::max_element(history, {}, &Reading::kinetic_energy);
    if (peak != history.end())
        facts["kinetic_energy_peak"] = {{"time", peak->time}, {"energy", peak->kinetic_energy}};
    return facts;
}

/// Logs the end in words.
void tell_end(const Course& course, const Reading& last) {
    const nlohmann::json& facts = course.session.result();
    // "as planned" also for a dam that failed but did not fold its mesh.
    const bool stopped = facts["ended"] == "entangled";
    spdlog::info("{}", stopped ? "ended before its duration, at " + shown(course.position.time) +
                                     " of " + shown(course.span) +
                                     " s: " + in_words(*course.entanglement)
                               : "ended as planned, at " + shown(course.position.time) + " s");
    if (facts.contains("motion")) {
        spdlog::info("shaken with a PGA of {} g, as applied, by a motion of {} s",
                     shown(facts["motion"]["pga_g"].get<double>()),
                     shown(facts["motion"]["duration"].get<double>()));
    }
    spdlog::info("the crest moved {} m (x {}, y {})", shown(last.crest_displacement),
                 shown(last.crest_dx), shown(last.crest_dy));
    const nlohmann::json& surface = facts["first_failure_surface_time"];
    spdlog::info("{}", surface.is_null()
                           ? std::string("no failure surface cut through to the ground")
                           : "the first failure surface was there at " +
                                 shown(surface.get<double>()) + " s; at the end there are " +
                                 shown(last.failure_surfaces));
    if (!course.decided.liquefaction.value) return;
    const double depth = facts["largest_liquefaction_depth"];
    spdlog::info("{}", depth > 0.0 ? "liquefied to a depth of " + shown(depth) + " m where watched"
                                   : std::string("nothing liquefied where it was watched"));
}

/// Reports points that their law moved to the critical state.
void report_fallen(Course& course) {
    const std::size_t fallen = fallen_points(course.model, course.motion);
    if (fallen == 0) return;
    course.session.result()["fallen_points"] = fallen;
    course.session.flag(
        {"fell_to_critical_state", fault::Severity::questionable,
         std::to_string(fallen) + " of " +
             std::to_string(points_with_memory(course.model, course.motion)) +
             " points fell to the critical state of their void ratio at once, for no strain of "
             "theirs could be followed (very loose soil at a few kPa): how fast they lost their "
             "strength is the program's choice; see where psi and instability_ratio of the "
             "snapshots jump, and transfer before",
         "/fem/stages"});
}

/// After a transfer the motion of the free field replaces that of the FEM's base. Reports their
/// difference while both exist.
void report_base_motion(Course& course) {
    const exchange::BaseMotion& ground = course.beginning.base_motion;
    if (!ground.any()) return;
    const motion::Series velocity{ground.time_step, ground.velocity};
    const double peak = motion::peak(velocity);
    double farthest = 0.0;
    // Up to the end of the mesh: after it the columns' motion stands alone.
    for (const Reading& each : course.history) {
        const double apart = each.base_velocity - motion::value_at(velocity, each.time);
        farthest = std::max(farthest, std::abs(apart));
    }
    course.session.result()["base_motion"] = {
        {"file", phases::files::base_motion},
        {"duration", velocity.duration()},
        {"peak_velocity", peak},
        {"largest_difference_to_mesh", peak > 0.0 ? farthest / peak : 0.0}};
}

/// Range of s_u by region, from the first dynamic stage on.
void report_dynamic_strengths(Course& course) {
    const Model& model = course.model;
    for (const Zone& zone : model.zones) {
        if (!zone.dynamic_strength || zone.first >= model.body.elements) continue;
        const std::string& name =
            course.session.scene().section.regions[model.mesh.region_of_element[zone.first]].name;
        const auto [least, largest] = std::ranges::minmax(std::span(model.s_u).subspan(
            zone.first * model.points_per_element, zone.count * model.points_per_element));
        course.session.result()["dynamic_strength"][name] = {{"least", least},
                                                             {"largest", largest}};
        spdlog::info("s_u in {}: {} to {} kPa", name, shown(least / 1e3), shown(largest / 1e3));
    }
}

/// Of the present soil [m].
double largest_displacement(const Course& course) {
    const std::vector<bool> lonely = lonely_nodes(course.model);
    double largest = 0.0;
    for (std::size_t i = 0; i < course.model.body.nodes; ++i) {
        if (lonely[i]) continue;
        const auto d = static_cast<Eigen::Index>(2 * i);
        largest = std::max(largest, course.motion.u.segment<2>(d).norm());
    }
    return largest;
}

nlohmann::json facts_of_mesh(const Model& model) {
    const Quality quality = quality_of(model.mesh);
    return {{"shortest_edge", quality.shortest_edge},
            {"longest_edge", quality.longest_edge},
            {"smallest_angle_deg", quality.smallest_angle * 180.0 / std::numbers::pi},
            {"largest_aspect", quality.largest_aspect},
            {"least_jacobian", quality.least_jacobian}};
}

nlohmann::json facts_of_time(const Course& course) {
    const Seconds& spent = course.seconds;
    spdlog::info("seconds: assembly {:.2f}, law {:.2f}, factor {:.2f}, solve {:.2f}, output {:.2f}",
                 spent.assembly, spent.law, spent.factor, spent.solve, spent.output);
    return {{"assembly", spent.assembly}, {"law", spent.law},
            {"factor", spent.factor},     {"solve", spent.solve},
            {"output", spent.output},     {"free_ground", course.seconds_for_free_ground}};
}

/// Intensity measures of the motion at the base of the columns, and at the crest up to the end of
/// the analysis.
void report_motions(Course& course) {
    auto& facts = course.session.result();
    if (!facts.contains("motion") || course.crest_time.empty()) return;
    const exchange::BaseMotion& base = course.beginning.base_motion;
    if (base.any())
        facts["motions"]["base"] =
            as_json(motion::measures_of(motion::derivative({base.time_step, base.velocity})));
    facts["motions"]["crest"] = as_json(motion::measures_of(motion::equally_spaced(
        course.crest_time, course.crest_acceleration, facts["motion"]["time_step"])));
}

}  // namespace

void report_end(Course& course) {
    process::Session& session = course.session;
    auto& facts = session.result();
    const auto& entangled = course.entanglement;
    facts["softening"] = scene::softening_in(session.scene());
    facts["ended"] = entangled ? "entangled" : "complete";
    facts["end_time"] = course.position.time;
    if (entangled) {
        facts["entanglement"] = as_json(*entangled);
        session.flag(flag_of(*entangled));
    }
    if (!course.position.moving) {
        spdlog::info("ended as planned: all stages were run, none of them dynamic");
        return;
    }
    Reading last = read_monitors(course.model, course.motion, course.distortion, course.crest_node,
                                 course.fem.strain_threshold);
    course.watch.read(course.model, course.motion, course.beginning, last);
    if (auto near = upstream_wall(course.fem, course.model, course.motion, course.beginning,
                                  last.failure_surfaces > 0.0, course.crest_node,
                                  course.largest.excess_pressure))
        session.flag(std::move(*near));
    double depth = last.liquefaction_depth;
    for (const Reading& each : course.history) depth = std::max(depth, each.liquefaction_depth);
    facts["crest"].update(
        {{"displacement", last.crest_displacement}, {"dx", last.crest_dx}, {"dy", last.crest_dy}});
    facts["failure_surfaces"] = static_cast<std::int64_t>(last.failure_surfaces);
    facts["first_failure_surface_time"] =
        first_time(course.history, &Reading::failure_surfaces, 1.0);
    facts["milestones"] = milestones_in(course.history);
    report_motions(course);
    report_dynamic_strengths(course);
    if (course.decided.liquefaction.value) facts["largest_liquefaction_depth"] = depth;
    if (course.model.rayleigh.stiffness > 0.0) {
        const double share =
            std::ranges::max(course.history, {}, &Reading::viscous_share).viscous_share;
        facts["viscous_share"] = share;
        if (share > largest_viscous_share) session.flag(viscous_band(course.fem, share));
    }
    if (auto growing = still_liquefying(course.history); growing && course.fem.motion)
        session.flag(std::move(*growing));
    tell_end(course, last);
}

void report_facts(Course& course) {
    const Model& model = course.model;
    const Motion& motion = course.motion;
    const Unknowns unknowns = model.unknowns(Solved::motion_and_pressure);
    auto& facts = course.session.result();
    facts["steps"] = course.position.step;
    facts["cut_steps"] = course.position.cut_steps;
    facts["iterations"] = course.counts.iterations;
    facts["factorisations"] = course.counts.factorisations;
    facts["elastic_fallbacks"] = course.counts.elastic_fallbacks;
    facts["stalled_steps"] = course.counts.stalled;
    if (!motion.memory.empty()) {
        const StressBias bias = stress_bias(model, motion);
        facts["stress_bias"] = {{"points", bias.points}, {"largest", bias.largest}};
        report_fallen(course);
    }
    facts["elements"] = model.body.elements;
    facts["nodes"] = model.body.nodes;
    facts["unknowns"] = unknowns.displacements;
    facts["pressure_unknowns"] = unknowns.pressures();
    facts["largest_displacement"] = largest_displacement(course);
    report_base_motion(course);
    facts["mesh"] = facts_of_mesh(model);
    if (!motion.hourglass.empty())
        facts["hourglass"] = hourglass_facts(model, motion, course.position.internal_work);
    if (std::ranges::any_of(model.zones, [](const Zone& zone) { return zone.viscosity > 0.0; }))
        facts["viscous_dissipation"] = course.position.viscous_dissipation;
    facts["seconds"] = facts_of_time(course);
}

void print_profile(const Course& course) {
    const process::SessionSettings& settings = course.session.settings();
    if (!settings.switches.contains(profile_switch)) return;
    const NewtonCounts& counts = course.newton ? course.newton->counts() : course.counts;
    const Work work{course.position.step - course.before.steps,
                    counts.iterations - course.before.iterations};
    const std::string text = profile_text(course.seconds, course.session.cpu_seconds(), work);
    if (settings.progress == process::ProgressStyle::json) {
        spdlog::info("\n{}", text);
    } else {
        std::cout << text << std::flush;
    }
}

}  // namespace breach::fem
