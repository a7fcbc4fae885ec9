// The end of a run: run.cpp calls write_results once, after the last measurement. It only reads the
// simulation. Flags come from measure/, where their limits are.
#include "mpm_solver/results.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>

#include "core/exchange/publish.hpp"
#include "core/phases/files.hpp"
#include "core/scene/softening.hpp"
#include "core/scene/words.hpp"
#include "mpm_solver/measure/carried_slide.hpp"
#include "mpm_solver/measure/ending_flags.hpp"
#include "mpm_solver/measure/ends.hpp"
#include "mpm_solver/measure/pool.hpp"

namespace breach::mpm {

namespace {

using nlohmann::json;
using process::Session;

json energy_json(const Simulation& simulation, const Row& row) {
    const Energy now = energy_of(simulation.body());
    const Energy& start = simulation.start().energy;
    const double scale = simulation.scale_of_energy();
    const auto share = [&](double J) { return scale > 0.0 ? J / scale : 0.0; };
    const auto entry = [&](double J) { return json{{"J", J}, {"share", share(J)}}; };
    return {{"scale", {{"J", scale}}},
            {"released", entry(released(start, now))},
            {"kinetic", entry(now.kinetic)},
            {"gravitational", {{"J", now.gravitational}}},
            {"elastic_change", entry(now.elastic - start.elastic)},
            {"plastic", entry(now.plastic)},
            {"friction", entry(now.friction)},
            {"viscous", entry(now.viscous)},
            {"shaking", entry(now.shaking)},
            {"overlap_correction", entry(row.overlap_energy)},
            {"numerical", entry(row.energy_numerical)}};
}

json gauges_json(const Simulation& simulation) {
    std::vector<double> times;
    for (const Row& row : simulation.records().history) times.push_back(row.time);
    json result = json::object();
    for (std::size_t k = 0; k < simulation.gauges().size(); ++k) {
        const scene::Gauge& gauge = simulation.gauges()[k];
        const GaugeRecord& record = simulation.records().gauges[k];
        const auto deepest = std::max_element(record.depth.begin(), record.depth.end());
        const auto arrival = arrival_time(times, record.depth, gauge.arrival_depth);
        result[gauge.name] = {
            {"x", gauge.x},
            {"arrival_time", arrival ? json(*arrival) : json(nullptr)},
            {"largest_depth", *deepest},
            {"time_of_largest_depth", times[deepest - record.depth.begin()]},
            {"largest_velocity", fastest_of(record.depth, record.velocity, gauge.arrival_depth)}};
    }
    return result;
}

/// Maxima and their places, and the envelope's runout.
json envelope_json(const Simulation& simulation, double arrival_depth) {
    const Envelope& envelope = simulation.records().envelope;
    const std::vector<double> places = profile_places(simulation.view());
    json result{{"arrival_depth", arrival_depth},
                {"fewest_points", fewest_points_of_a_flow},
                {"steps_between_samples", steps_between_samples},
                {"farthest_arrival", nullptr}};
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (envelope.arrival[k] == Envelope::never) continue;
        result["farthest_arrival"] = {{"x", places[k]}, {"time", envelope.arrival[k]}};
    }
    const auto largest = [&](const char* name, const std::vector<double>& values) {
        const auto most = std::max_element(values.begin(), values.end());
        result[name] = {{"value", *most}, {"x", places[most - values.begin()]}};
    };
    largest("largest_depth", envelope.depth);
    largest("largest_velocity", envelope.velocity);
    largest("largest_momentum_flux", envelope.flux);
    return result;
}

/// Volumes through each section, per metre of width; with a breach width also in m3 and m3/s.
json sections_json(const Simulation& simulation, const scene::Mpm& mpm) {
    const auto& width = mpm.breach_width;
    std::vector<double> times;
    for (const Row& row : simulation.records().history) times.push_back(row.time);
    json result = json::object();
    for (std::size_t k = 0; k < simulation.sections().size(); ++k) {
        const SectionRecord& record = simulation.records().sections[k];
        const auto peak = peak_of(record, times, simulation.view(), mpm.arrival_depth);
        const auto closure = closure_of(record);
        json& entry = result[simulation.sections()[k].name];
        entry = {{"x", simulation.sections()[k].x},
                 {"largest_discharge", peak ? peak->discharge : 0.0},
                 {"time_of_largest_discharge", peak ? json(peak->time) : json(nullptr)},
                 {"averaged_over", peak ? json(peak->window) : json(nullptr)},
                 {"largest_depth", *std::max_element(record.depth.begin(), record.depth.end())},
                 {"volume", record.volume.back()},
                 {"mass", record.mass.back()},
                 {"closure", closure ? json(*closure) : json(nullptr)}};
        // Plane strain: all else is per metre of width, and only the scene can say how wide the
        // breach is.
        if (!width) continue;
        const auto of_breach = [&](double per_metre) {
            return json{per_metre * width->low, per_metre * width->best, per_metre * width->high};
        };
        entry["breach"] = {{"width", of_breach(1.0)},
                           {"volume", of_breach(record.volume.back())},
                           {"largest_discharge", of_breach(peak ? peak->discharge : 0.0)}};
    }
    return result;
}

json rest_json(const scene::Mpm& mpm, const scene::Rest& rest, const Ending& ending) {
    return {{"change", rest.change},
            {"window", rest.window},
            {"earliest", rest.earliest},
            {"speed", rest.speed},
            {"longest_duration", mpm.duration},
            {"moving", ending.moving ? json(*ending.moving) : json(nullptr)}};
}

/// Motion of the ground. Position relative to far rock = position on the ground + its displacement.
json shaking_json(const GroundMotion& ground, double time) {
    return {{"until", ground.end()},
            {"peak_acceleration", ground.peak_acceleration()},
            {"ground_velocity_at_transfer", ground.velocity(0.0)},
            {"ground_displacement", ground.displacement(time)}};
}

double fastest_of(const History& history) {
    return std::ranges::max(history, {}, &Row::fastest).fastest;
}

/// Largest elastic volume loss due to pressure, over the points [-].
double largest_compression(const Body& body) {
    double largest = 0.0;
    const Points& points = body.points;
    for (const Zone& zone : body.zones)
        for (std::size_t p = zone.begin; p < zone.end; ++p)
            largest = std::max(largest, -(points.sxx[p] + points.syy[p] + points.szz[p]) / 3.0 /
                                            zone.elasticity.bulk_modulus());
    return largest;
}

/// Energy scale above the energy released: a fall of centimetres (energy_scale).
/// A large numerical share is then a warning only: it is a share of almost nothing.
bool stood(const scene::Mpm& mpm, const Simulation& simulation) {
    const Row& first = simulation.records().history.front();
    const Row& last = simulation.last_row();
    const Energy now{.gravitational = last.gravitational_energy, .shaking = last.shaking_work};
    return released(simulation.start().energy, now) < simulation.scale_of_energy() &&
           std::abs(last.runout - first.runout) < mpm.cell_size &&
           std::abs(last.runout_largest - first.runout_largest) < mpm.cell_size;
}

double points_per_cell(const scene::Scene& scene, const Points& points) {
    const double cell = std::pow(scene::mpm_of(scene).cell_size, 2) * scene.thickness;
    const auto& V_0 = points.V_0;
    return cell * static_cast<double>(V_0.size()) / std::accumulate(V_0.begin(), V_0.end(), 0.0);
}

Ending ending_of(const Session& session, const Simulation& simulation) {
    const scene::Mpm& mpm = scene::mpm_of(session.scene());
    const Row& row = simulation.last_row();
    const double scale = simulation.scale_of_energy();
    const auto share = [&](double J) { return scale > 0.0 ? J / scale : 0.0; };
    return {.time = simulation.clock().time,
            .moving = simulation.moving(),
            .kinetic_share = share(row.kinetic_mobile),
            .numerical_share = share(row.energy_numerical),
            .stood = stood(mpm, simulation),
            .correction_share = share(row.overlap_energy),
            .volume_ratio = row.volume_ratio,
            .overlap = row.overlap,
            // Area over length: the mean depth of the deposit beyond the toe.
            .deposit_depth =
                row.runout_beyond_toe > 0.0 ? row.area_beyond_toe / row.runout_beyond_toe : 0.0,
            .cell_size = mpm.cell_size,
            .until_rest = mpm.until_rest,
            .tension_share = mpm.tension_share,
            .damping_ratio = mpm.damping_ratio,
            .overlap_rate = mpm.overlap_correction.rate,
            .points_per_cell = points_per_cell(session.scene(), simulation.body().points),
            .filled = session.settings().inputs.empty(),
            .scaled = mpm.stiffness_scale != 1.0,
            .mach = fastest_of(simulation.records().history) / wave_speed(simulation.body()),
            .softer = std::ranges::any_of(simulation.body().zones, [](const Zone& each) {
                return each.elasticity.bulk_modulus() < (1.0 - 1e-9) * each.K_drawn;
            })};
}

/// The deposit's largest depth beyond the toe [m]; 0: none.
double depth_beyond_toe(const scene::Mpm& mpm, const Simulation& simulation) {
    const std::vector<double> places = profile_places(simulation.view());
    const std::vector<Flow> deposit = without_grains(simulation.profile());
    double depth = 0.0;
    for (std::size_t k = 0; k < places.size(); ++k)
        if (places[k] > mpm.runout.toe.x()) depth = std::max(depth, deposit[k].depth);
    return depth;
}

void conclude(Session& session, const Simulation& simulation, const Ending& ending, double speed) {
    const Row& row = simulation.last_row();
    const Clock& clock = simulation.clock();
    const scene::Mpm& mpm = *session.scene().mpm;
    json& result = session.result();
    result["runout"] = row.runout;
    result["runout_beyond_toe"] = row.runout_beyond_toe;
    result["runout_beyond_toe_95"] = row.runout_beyond_toe_95;
    result["runout_beyond_toe_50"] = row.runout_beyond_toe_50;
    result["runout_largest"] = row.runout_largest;
    result["stood"] = ending.stood;
    result["runout_by_count"] = row.runout_by_count;
    result["runout_front"] = row.runout_front == nowhere ? json() : json(row.runout_front);
    result["area_beyond_toe"] = row.area_beyond_toe;
    result["depth_beyond_toe"] = depth_beyond_toe(mpm, simulation);
    result["gauges"] = gauges_json(simulation);
    result["envelope"] = envelope_json(simulation, mpm.arrival_depth);
    result["sections"] = sections_json(simulation, mpm);
    result["at_rest"] = simulation.course() == Course::rests;
    result["ended"] = simulation.course() == Course::rests ? "at_rest" : "duration";
    result["end_time"] = clock.time;
    result["kinetic_share"] = ending.kinetic_share;
    result["rest"] = rest_json(mpm, simulation.rest(), ending);
    result["transfer_time"] = clock.transfer_time;
    if (simulation.ground()) result["shaking"] = shaking_json(*simulation.ground(), clock.time);
    result["energy"] = energy_json(simulation, row);
    result["volume_ratio"] = row.volume_ratio;
    result["overlap"] = row.overlap;
    result["steps"] = clock.step;
    result["dt_min"] = clock.dt_min;
    result["dt_max"] = clock.dt_max;
    result["particles"] = simulation.body().points.size();
    result["particle_steps_per_second"] = speed;
    result["domain_x"] = mpm.domain_x;
    result["domain_y"] = mpm.domain_y;
    result["fill_shift"] = mpm.fill_shift;
    result["cell_size"] = mpm.cell_size;
    result["softening"] = scene::softening_in(session.scene());
    result["stiffness_scale"] = mpm.stiffness_scale;
    result["wave_speed"] = wave_speed(simulation.body());
    result["mach"] = ending.mach;
    result["largest_compression"] = largest_compression(simulation.body());
}

void write_history(const Session& session, const Simulation& simulation) {
    exchange::Archive archive{
        .kind = "mpm_history", .version = 1, .reals = {}, .integers = {}, .texts = {}, .units = {}};
    const Records& records = simulation.records();
    store(records.history, "", archive);
    // `nowhere` is finite because checkpoints refuse NaN; readers of history.h5 get NaN.
    std::ranges::replace(archive.reals.at("runout_front"), nowhere,
                         std::numeric_limits<double>::quiet_NaN());
    store(simulation.gauges(), records.gauges, "", archive);
    store(records.profiles, simulation.view(), "", archive);
    publish(records.envelope, simulation.view(), without_grains(simulation.profile()), archive);
    store(simulation.sections(), records.sections, "", SectionState::rows, archive);
    write_archive(session.output(phases::files::history), archive, session.provenance());
}

void publish_table(Session& session, const Simulation& simulation, const std::string& name,
                   const char* kind, const std::ostringstream& table) {
    const auto file = session.output(name);
    exchange::publish_text(file, table.str());
    session.announce(file, {{"kind", kind}, {"time", simulation.clock().time}});
}

/// Writes the deposit as a table.
void write_profile(Session& session, const Simulation& simulation, const Surfaces& surfaces) {
    const std::vector<double> places = profile_places(simulation.view());
    const std::vector<Flow> profile = simulation.profile();
    std::ostringstream table;
    table.precision(10);
    table << "x_m,ground_m,depth_m,surface_m,velocity_m_per_s\n";
    for (std::size_t k = 0; k < places.size(); ++k) {
        table << places[k] << "," << surfaces.ground[k] << "," << profile[k].depth << ","
              << surfaces.top[k] << "," << profile[k].velocity << "\n";
    }
    publish_table(session, simulation, "profile.csv", "profile", table);
}

/// Writes the envelope as a table; an empty cell if never reached.
void write_envelope(Session& session, const Simulation& simulation) {
    const Envelope& envelope = simulation.records().envelope;
    const std::vector<double> places = profile_places(simulation.view());
    const std::vector<Flow> last = without_grains(simulation.profile());
    std::ostringstream table;
    table.precision(10);
    table << "x_m,largest_depth_m,largest_velocity_m_per_s,largest_momentum_flux_m3_per_s2,"
             "arrival_s,time_of_peak_s,final_depth_m\n";
    const auto time = [&](double value) {
        if (value != Envelope::never) table << value;
        table << ",";
    };
    for (std::size_t k = 0; k < places.size(); ++k) {
        table << places[k] << "," << envelope.depth[k] << "," << envelope.velocity[k] << ","
              << envelope.flux[k] << ",";
        time(envelope.arrival[k]);
        time(envelope.time_of_peak[k]);
        table << last[k].depth << "\n";
    }
    publish_table(session, simulation, phases::files::envelope, "envelope", table);
}

/// The first frame is at time 0 (run.cpp), so the first profile is that of the start.
Depths depths_of(const Simulation& simulation) {
    const Records& records = simulation.records();
    const auto columns = static_cast<std::ptrdiff_t>(records.envelope.depth.size());
    Depths depths{
        .first = {records.profiles.depths.begin(), records.profiles.depths.begin() + columns},
        .largest = records.envelope.depth,
        .last = {}};
    for (const Flow& flow : simulation.profile()) depths.last.push_back(flow.depth);
    return depths;
}

/// Logs the main results.
void say(const Session& session, const Ending& ending, const Row& row) {
    std::string flags;
    for (const fault::Flag& each : session.flags())
        flags += (flags.empty() ? "" : ", ") + each.code + " (" + name_of(each.severity) + ")";
    spdlog::info(
        "runout {:.2f} m: 99 % of the mobile soil lies within this distance of the toe; of the "
        "soil beyond the toe {:.2f} m; farthest point {:.2f} m",
        row.runout, row.runout_beyond_toe, row.runout_largest);
    if (ending.moving) {
        spdlog::warn("ended at {:.2f} s, STILL MOVING: {}", ending.time, *ending.moving);
    } else {
        spdlog::info("at rest at {:.2f} s", ending.time);
    }
    spdlog::info(
        "volume ratio {:.3f}, numerical share of the released energy {:+.1f} %, overlap {:.1f} %; "
        "flags: {}",
        row.volume_ratio, 100.0 * ending.numerical_share, 100.0 * row.overlap,
        flags.empty() ? "none" : flags);
}

}  // namespace

void write_results(Session& session, const Simulation& simulation, double speed) {
    write_history(session, simulation);
    const Body& body = simulation.body();
    const FlowView& view = simulation.view();
    const Surfaces surfaces = surfaces_of(session.scene(), body, view);
    write_profile(session, simulation, surfaces);
    write_envelope(session, simulation);
    const Ending ending = ending_of(session, simulation);
    conclude(session, simulation, ending, speed);
    for (fault::Flag& each : flags_of_ending(ending)) session.flag(std::move(each));
    for (fault::Flag& each :
         flags_of_ends(session.scene(), simulation.view(), depths_of(simulation)))
        session.flag(std::move(each));
    for (fault::Flag& each : flags_of_pool(session.scene(), body, view, surfaces))
        session.flag(std::move(each));
    const Travel travel{
        .start = simulation.start().energy,
        .end = energy_of(body),
        .mean = mean_x_of(body.points, view.mobile) - simulation.start().mobile_x,
        .front = simulation.last_row().runout - simulation.records().history.front().runout};
    if (auto flag = flag_of_carried_slide(session.scene(), body, view, travel))
        session.flag(std::move(*flag));
    say(session, ending, simulation.last_row());
}

}  // namespace breach::mpm
