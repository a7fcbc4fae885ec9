// What an analysis writes: telemetry, history, snapshots, checkpoints and the facts of its end.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <sstream>

#include "core/motion/series.hpp"
#include "core/phases/files.hpp"
#include "fem_solver/analysis.hpp"
#include "fem_solver/model/stages.hpp"
#include "fem_solver/monitors/strength.hpp"
#include "fem_solver/monitors/upstream_wall.hpp"
#include "fem_solver/snapshot.hpp"
#include "fem_solver/snapshot_request.hpp"

namespace breach::fem {

namespace {
constexpr double checkpoint_interval = 20.0;  // wall clock [s]
constexpr const char* geostatic =
    "geostatic";  // facts of stages that a resumed run does not repeat
constexpr const char* entanglement = "entanglement";

std::string shown(double value) {
    std::ostringstream text;
    text.precision(4);
    text << value;
    return text.str();
}

/// Kinetic energy over its largest value so far; 1 while nothing has moved.
double over_peak(double energy, const std::vector<Reading>& history) {
    double peak = energy;
    for (const Reading& each : history) peak = std::max(peak, each.kinetic_energy);
    return peak > 0.0 ? energy / peak : 1.0;
}
}  // namespace

void Analysis::write_due_outputs(double dt, const NewtonOutcome& outcome) {
    const double slack = 1e-9 * std::max(fem_.telemetry_interval, span_);
    if (position_.time >= position_.next_telemetry - slack) {
        const Stopwatch watch(seconds_, &Seconds::output);
        Reading reading =
            read_monitors(model_, motion_, distortion_, crest_node_, fem_.strain_threshold);
        watch_.read(model_, motion_, beginning_, reading);
        reading.step = static_cast<double>(position_.step);
        reading.time = position_.time;
        reading.dt = dt;
        reading.iterations = outcome.iterations;
        reading.residual = outcome.residual;
        reading.external_work = position_.external_work;
        reading.internal_work = position_.internal_work;
        reading.viscous_dissipation = position_.viscous_dissipation;
        read_strength(reading);
        reading.kinetic_energy_over_peak = over_peak(reading.kinetic_energy, history_);
        history_.push_back(reading);
        session_.telemetry(telemetry_line(reading, columns_));
        position_.telemetry_lines = session_.telemetry_lines();
        const double interval = fem_.telemetry_interval;
        position_.next_telemetry =
            interval > 0.0 ? interval * (std::floor((position_.time + slack) / interval) + 1.0)
                           : position_.time;
    }
    if (!snapshot_is_due(dt)) return;
    write_snapshot();
    answer_request(session_.settings().output);
}

/// At the first line at or after each multiple of its interval; in between the last one stands.
void Analysis::read_strength(Reading& reading) const {
    if (!fem_.strength_interval) return;
    const auto count = [&](double time) {
        return std::floor(time / *fem_.strength_interval + 1e-9);
    };
    if (!history_.empty() && count(reading.time) == count(history_.back().time)) {
        reading.strength_ratio_avg = history_.back().strength_ratio_avg;
        reading.strength_ratio_min = history_.back().strength_ratio_min;
        return;
    }
    const StrengthRatio ratio = strength_ratio(model_, motion_, beginning_);
    reading.strength_ratio_avg = ratio.average;
    reading.strength_ratio_min = ratio.least;
}

/// A wanted time was met, a multiple of the interval lies in this step, or somebody outside asks.
/// The last two take the step as it comes: whoever asks must not change what is computed.
bool Analysis::snapshot_is_due(double dt) {
    const auto& times = decided_.snapshot_times.value;
    const auto next = static_cast<std::size_t>(position_.next_snapshot);
    const bool wanted = next < times.size() && position_.time >= times[next];
    if (wanted) ++position_.next_snapshot;
    checkpoint_wanted_ = checkpoint_wanted_ || wanted;
    const double interval = decided_.snapshot_interval.value;
    const auto count = [&](double time) { return std::floor(time / interval + 1e-9); };
    const bool regular = interval > 0.0 && count(position_.time) > count(position_.time - dt);
    const bool asked = dt > 0.0 && request_is_taken(session_.settings().output);
    return wanted || regular || asked;
}

void Analysis::write_snapshot() {
    const Stopwatch watch(seconds_, &Seconds::output);
    const std::string name = snapshot_name(position_.time);
    exchange::write_mesh_snapshot(session_.output(name),
                                  snapshot_of(session_.scene(), model_, motion_, beginning_,
                                              excess_pressure_max_, position_.time, position_.step),
                                  session_.provenance());
    session_.announce_frame(name, phases::files::snapshot_prefix, position_.time);
    last_snapshot_ = position_.time;
}

/// The end answers every request that is still open.
void Analysis::write_last_snapshot() {
    if (last_snapshot_ != position_.time) write_snapshot();
    const auto& output = session_.settings().output;
    if (request_is_taken(output)) answer_request(output);
}

bool Analysis::checkpoint_is_due() const {
    return checkpoint_wanted_ ||
           session_.wall_seconds() - checkpoint_written_ >= checkpoint_interval;
}

void Analysis::write_checkpoint() {
    const Stopwatch watch(seconds_, &Seconds::output);
    Checkpoint checkpoint{.position = position_,
                          .motion = motion_,
                          .beginning = beginning_,
                          .excess_pressure_max = excess_pressure_max_,
                          .stage_force = stage_force_,
                          .newton = newton_->memory(),
                          .counts = newton_->counts(),
                          .history = history_};
    exchange::Archive archive = checkpoint_archive(checkpoint, session_.scene());
    const nlohmann::json& facts = session_.result();
    if (facts.contains(geostatic)) archive.texts[geostatic] = facts.at(geostatic).dump();
    if (entanglement_) archive.texts[entanglement] = as_json(*entanglement_).dump();
    put_flags(session_.flags(), archive);
    exchange::write_archive(session_.output(phases::files::checkpoint), archive,
                            session_.provenance());
    checkpoint_written_ = session_.wall_seconds();
    checkpoint_wanted_ = false;
}

void Analysis::resume() {
    const auto file = session_.output(phases::files::checkpoint);
    const exchange::Archive archive =
        exchange::read_archive(file, checkpoint_kind, checkpoint_version, exchange::Reals::finite);
    position_ = position_in(archive, session_.scene(), file.string());
    place_stage();
    Checkpoint checkpoint = checkpoint_from(archive, session_.scene(), model_, file.string());
    if (const auto kept = archive.texts.find(geostatic); kept != archive.texts.end()) {
        session_.result()[geostatic] = nlohmann::json::parse(kept->second);
    }
    if (const auto noted = archive.texts.find(entanglement); noted != archive.texts.end()) {
        entanglement_ =
            entanglement_from(nlohmann::json::parse(noted->second), session_.scene().section);
    }
    motion_ = std::move(checkpoint.motion);
    trial_ = motion_;
    beginning_ = std::move(checkpoint.beginning);
    excess_pressure_max_ = std::move(checkpoint.excess_pressure_max);
    stage_force_ = std::move(checkpoint.stage_force);
    set_skeleton_modulus(beginning_, model_);
    history_ = std::move(checkpoint.history);
    raise_again(flags_in(archive, file.string()));
    session_.truncate_telemetry(position_.telemetry_lines);
    session_.went_on_after(archive.spent);
    before_ = {position_.step, checkpoint.counts.iterations};
    make_newton(fem_.stages[position_.stage], checkpoint.counts);
    if (!newton_->restore(checkpoint.newton))
        throw fault::BadInput(file.string(), {{"/breachline/reals/newton.values",
                                               "the matrix is not that of this mesh",
                                               "resume with the same scene, or start afresh"}});
    distortion_ = distortion_of(model_, motion_, fem_.strain_threshold);
    spdlog::info("goes on at {} s (step {})", position_.time, position_.step);
}

/// What was found out on the way, and is not found out again.
void Analysis::raise_again(const std::vector<fault::Flag>& flags) {
    for (const fault::Flag& each : flags) {
        const bool is_there =
            std::ranges::any_of(session_.flags(), [&](const fault::Flag& present) {
                return present.code == each.code && present.pointer == each.pointer;
            });
        if (!is_there) session_.flag(each);
    }
}

void Analysis::write_history() {
    const Stopwatch watch(seconds_, &Seconds::output);
    exchange::write_archive(session_.output(phases::files::history),
                            history_archive(history_, columns_), session_.provenance());
}

/// Saves the last good state (the accepted one: `trial_` is dropped) and ends the run.
void Analysis::give_up(const std::string& cause) {
    write_last_snapshot();
    write_checkpoint();
    write_history();
    print_profile();
    throw fault::Breakdown(cause + "; the last good state is at " + std::to_string(position_.time) +
                           " s in " + snapshot_name(position_.time));
}

namespace {

/// Energy and stress that the stabilisation of single-point quads carries in the body. The stress is the
/// largest nodal hourglass force per side length, of the worst element.
nlohmann::json hourglass_facts(const Model& model, const Motion& motion, double internal_work) {
    double energy = 0.0, largest = 0.0;
    std::size_t worst = 0;
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        const Hourglass& each = motion.hourglass[e];
        energy += each.energy;
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

}  // namespace

/// Which node stands for the scene's crest. One that is far away measures another place.
void Analysis::report_crest() {
    const Mesh& body = watch_.body();
    const Vec2& node = body.nodes[crest_node_];
    const double distance = (node - fem_.crest).norm();
    const double size = element_size_at(body, crest_node_);
    std::ostringstream text;
    text << "the crest's displacement is that of the node at (" << node.x() << ", " << node.y()
         << "), " << distance << " m from /fem/crest";
    session_.result()["crest"] = {{"x", node.x()}, {"y", node.y()}, {"distance", distance}};
    constexpr double near = 2.0;  // element sizes
    if (distance <= near * size) {
        spdlog::info("{}", text.str());
        return;
    }
    text << ", which is " << std::round(distance / size)
         << " element sizes: another place than was asked for; give a point on the ground";
    session_.flag({"far_crest", fault::Severity::warning, text.str(), "/fem/crest"});
}

namespace {

/// Time of the first line where a column reaches a value [s]; null: never.
nlohmann::json first_time(const std::vector<Reading>& history, double Reading::*column,
                          double value) {
    const auto first =
        std::ranges::find_if(history, [&](const Reading& each) { return each.*column >= value; });
    if (first == history.end()) return nullptr;
    return first->time;
}

/// Of the largest depth, from which on liquefaction counts as complete. Mochikoshi's runouts reach their plateau 0.4 s later.
constexpr double most_of_depth = 0.8;

/// Excess pore pressure that grew by a fifth or more in the last tenth of a shaken FEM.
std::optional<fault::Flag> still_liquefying(const std::vector<Reading>& history) {
    if (history.size() < 2 || history.back().liquefaction_depth <= 0.0) return std::nullopt;
    const double end = history.back().time;
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

/// The course as events that need no mesh.
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
    if (peak != history.end()) {
        facts["kinetic_energy_peak"] = {{"time", peak->time}, {"energy", peak->kinetic_energy}};
    }
    return facts;
}

}  // namespace

/// How it ended and what it came to, as facts and in plain words.
void Analysis::report_end() {
    auto& facts = session_.result();
    const bool stopped = entanglement_ && entanglement_->then == scene::AtEntanglement::stop;
    facts["ended"] = stopped ? "entangled" : "complete";
    facts["end_time"] = position_.time;
    if (entanglement_) {
        facts[entanglement] = as_json(*entanglement_);
        session_.flag(flag_of(*entanglement_));
    }
    if (!position_.moving) {
        spdlog::info("ended as planned: all stages were run, none of them dynamic");
        return;
    }
    Reading last = read_monitors(model_, motion_, distortion_, crest_node_, fem_.strain_threshold);
    watch_.read(model_, motion_, beginning_, last);
    if (auto near = upstream_wall(fem_, model_, motion_, beginning_, last.failure_surfaces > 0.0,
                                  excess_pressure_max_))
        session_.flag(std::move(*near));
    const nlohmann::json surface = first_time(history_, &Reading::failure_surfaces, 1.0);
    double depth = last.liquefaction_depth;
    for (const Reading& each : history_) depth = std::max(depth, each.liquefaction_depth);
    facts["crest"].update(
        {{"displacement", last.crest_displacement}, {"dx", last.crest_dx}, {"dy", last.crest_dy}});
    facts["failure_surfaces"] = static_cast<std::int64_t>(last.failure_surfaces);
    facts["first_failure_surface_time"] = surface;
    facts["milestones"] = milestones_in(history_);
    if (decided_.liquefaction.value) facts["largest_liquefaction_depth"] = depth;
    if (auto growing = still_liquefying(history_); growing && fem_.motion)
        session_.flag(std::move(*growing));
    spdlog::info("{}", stopped ? "ended before its duration, at " + shown(position_.time) + " of " +
                                     shown(span_) + " s: " + in_words(*entanglement_)
                               : "ended as planned, at " + shown(position_.time) + " s");
    if (facts.contains("motion")) {
        spdlog::info("shaken with a PGA of {} g, as applied, by a motion of {} s",
                     shown(facts["motion"]["pga_g"].get<double>()),
                     shown(facts["motion"]["duration"].get<double>()));
    }
    spdlog::info("the crest moved {} m (x {}, y {})", shown(last.crest_displacement),
                 shown(last.crest_dx), shown(last.crest_dy));
    spdlog::info("{}", surface.is_null()
                           ? std::string("no failure surface cut through to the ground")
                           : "the first failure surface was there at " +
                                 shown(surface.get<double>()) + " s; at the end there are " +
                                 shown(last.failure_surfaces));
    if (decided_.liquefaction.value) {
        spdlog::info("{}", depth > 0.0
                               ? "liquefied to a depth of " + shown(depth) + " m where watched"
                               : std::string("nothing liquefied where it was watched"));
    }
}

void Analysis::report_facts() {
    const Quality quality = quality_of(model_.mesh);
    const Unknowns unknowns = model_.unknowns(Solved::motion_and_pressure);
    const std::vector<bool> lonely = lonely_nodes(model_);
    double largest = 0.0;  // of the soil that is there
    for (std::size_t i = 0; i < model_.body.nodes; ++i) {
        if (lonely[i]) continue;
        largest = std::max(largest, motion_.u.segment<2>(2 * static_cast<Eigen::Index>(i)).norm());
    }
    auto& facts = session_.result();
    facts["steps"] = position_.step;
    facts["cut_steps"] = position_.cut_steps;
    facts["iterations"] = counts_.iterations;
    facts["factorisations"] = counts_.factorisations;
    facts["elastic_fallbacks"] = counts_.elastic_fallbacks;
    facts["stalled_steps"] = counts_.stalled;
    if (!motion_.memory.empty()) {
        const StressBias bias = stress_bias(model_, motion_);
        facts["stress_bias"] = {{"points", bias.points}, {"largest", bias.largest}};
        report_fallen();
    }
    facts["elements"] = model_.body.elements;
    facts["nodes"] = model_.body.nodes;
    facts["unknowns"] = unknowns.displacements;
    facts["pressure_unknowns"] = unknowns.pressures();
    facts["largest_displacement"] = largest;
    report_base_motion();
    facts["mesh"] = {{"shortest_edge", quality.shortest_edge},
                     {"longest_edge", quality.longest_edge},
                     {"smallest_angle_deg", quality.smallest_angle * 180.0 / std::numbers::pi},
                     {"largest_aspect", quality.largest_aspect},
                     {"least_jacobian", quality.least_jacobian}};
    if (!motion_.hourglass.empty()) {
        facts["hourglass"] = hourglass_facts(model_, motion_, position_.internal_work);
    }
    if (std::ranges::any_of(model_.zones, [](const Zone& zone) { return zone.viscosity > 0.0; })) {
        facts["viscous_dissipation"] = position_.viscous_dissipation;
    }
    spdlog::info("seconds: assembly {:.2f}, law {:.2f}, factor {:.2f}, solve {:.2f}, output {:.2f}",
                 seconds_.assembly, seconds_.law, seconds_.factor, seconds_.solve, seconds_.output);
    facts["seconds"] = {{"assembly", seconds_.assembly}, {"law", seconds_.law},
                        {"factor", seconds_.factor},     {"solve", seconds_.solve},
                        {"output", seconds_.output},     {"free_ground", seconds_for_free_ground_}};
}

/// Points whose law gave up the path and took its end.
void Analysis::report_fallen() {
    const std::size_t fallen = fallen_points(model_, motion_);
    if (fallen == 0) return;
    session_.result()["fallen_points"] = fallen;
    session_.flag({"fell_to_critical_state", fault::Severity::questionable,
                   std::to_string(fallen) + " of " +
                       std::to_string(points_with_memory(model_, motion_)) +
                       " points fell to the critical state of their void ratio at once, for no "
                       "strain of theirs could be followed (very loose soil at a few kPa): how "
                       "fast they lost their strength is the program's choice; see where "
                       "psi and instability_ratio of the snapshots jump, and transfer before",
                   "/fem/stages"});
}

/// The free ground's motion stands in for the FEM's own base after a transfer: how far the two were
/// apart as long as there were both.
void Analysis::report_base_motion() {
    const exchange::BaseMotion& ground = beginning_.base_motion;
    if (!ground.any()) return;
    const motion::Series velocity{ground.time_step, ground.velocity};
    const double peak = motion::peak(velocity);
    double farthest = 0.0;
    for (const Reading& each : history_) {
        const double apart = each.base_velocity - motion::value_at(velocity, each.time);
        farthest = std::max(farthest, std::abs(apart));
    }
    session_.result()["base_motion"] = {
        {"file", phases::files::base_motion},
        {"duration", velocity.duration()},
        {"peak_velocity", peak},
        {"largest_difference_to_mesh", peak > 0.0 ? farthest / peak : 0.0}};
}

void Analysis::print_profile() {
    if (!session_.settings().switches.contains(profile_switch)) return;
    const Work work{position_.step - before_.steps,
                    (newton_ ? newton_->counts() : counts_).iterations - before_.iterations};
    const double whole = session_.cpu_seconds();
    const std::string text = profile_text(seconds_, whole, work);
    if (session_.settings().progress == process::ProgressStyle::json) {
        spdlog::info("\n{}", text);
    } else {
        std::cout << text << std::flush;
    }
}

}  // namespace breach::fem
