// What make_body or the next step rebuilds is not stored: grid, strips, cell averages. A checkpoint
// may have been changed by another program (tests/fuzz): the loops index arrays unchecked, so every
// length and index is checked here before a body is made.
#include "mpm_solver/checkpoint.hpp"

#include <cstdlib>

#include "core/exchange/archive.hpp"

namespace breach::mpm {

namespace {

using exchange::Archive;

constexpr const char* kind = "mpm_checkpoint";
constexpr const char* water_nodes = "water.nodes";  ///< it came with the input's points
constexpr const char* records_prefix = "records.";

[[noreturn]] void refuse(const std::string& file, const std::string& where,
                         const std::string& cause) {
    throw fault::BadInput(file, {{where, cause, "start afresh without --resume"}});
}

/// Numbers of the run that are not per point. Calls visit(name, value).
template <class AnyClock, class AnyStart, class AnyTally, class Visit>
void for_each_number(AnyClock& clock, AnyStart& start, AnyTally& tally, Visit&& visit) {
    visit("time", clock.time), visit("dt", clock.dt);
    visit("dt_min", clock.dt_min), visit("dt_max", clock.dt_max);
    visit("transfer_time", clock.transfer_time);
    visit("start_kinetic", start.energy.kinetic);
    visit("start_gravitational", start.energy.gravitational);
    visit("start_elastic", start.energy.elastic);
    visit("start_mobile_volume", start.mobile_volume);
    visit("start_mobile_x", start.mobile_x);
    visit("plastic", tally.plastic), visit("friction", tally.friction);
    visit("viscous", tally.viscous), visit("pushed_in", tally.pushed_in);
    visit("shaking", tally.shaking);
    visit("kinetic", tally.kinetic), visit("fastest", tally.fastest);
    visit("strayed", tally.strayed);
}

/// By content and not by name: an input that was moved is still the same.
std::string digests(const exchange::Provenance& provenance) {
    std::string text;
    for (const exchange::InputDigest& input : provenance.inputs) text += input.sha256 + "\n";
    return text;
}

void refuse_if_different(const Archive& archive, const std::string& name, const std::string& here,
                         const std::string& file) {
    const auto there = archive.texts.find(name);
    if (there != archive.texts.end() && there->second == here) return;
    throw fault::BadInput(file, {{"/" + name, "is not that of this run",
                                  "resume with the scene, overrides and input of the run that was "
                                  "stopped, or start afresh without --resume"}});
}

constexpr const char* ground_velocity = "ground.velocity";
constexpr const char* ground_clock = "ground.clock";  ///< time step of the samples, transfer time

void store(const std::optional<GroundMotion>& ground, Archive& archive) {
    if (!ground) return;
    archive.reals[ground_velocity] = ground->base().velocity;
    archive.reals[ground_clock] = {ground->base().time_step, ground->transfer_time()};
}

std::optional<GroundMotion> load_ground(const Archive& archive, const std::string& file) {
    if (!archive.reals.contains(ground_velocity)) return std::nullopt;
    const std::vector<double>& velocity = archive.reals.at(ground_velocity);
    const std::vector<double>& clock = archive.reals.at(ground_clock);
    if (velocity.empty() || !(clock.at(0) > 0.0))
        refuse(file, "/ground.velocity", "has no samples");
    return GroundMotion({clock.at(0), velocity}, clock.at(1));
}

/// Refuses first: a run must not change between moving and resting ground.
void refuse_other_ground(const Archive& archive, scene::Shaking here, const std::string& file) {
    const bool moved = archive.reals.contains(ground_velocity);
    const bool moves = here == scene::Shaking::goes_on;
    if (moved == moves) return;
    const std::string then = moved ? "on" : "off";
    throw fault::BadInput(
        file, {{"/mpm/shaking",
                "was " + then + " when this run began and is " + (moves ? "on" : "off") + " now",
                "resume with --set /mpm/shaking=" + then + ", or start afresh without --resume"}});
}

/// Refuses arrays of unequal length and indices out of range, in a checkpoint changed by another
/// program.
void refuse_if_ragged(const Points& points, std::size_t soils, const std::string& file) {
    const std::size_t n = points.size();
    if (n == 0) refuse(file, "/x", "holds no points");
    for_each_real(points, [&](const char* name, const std::vector<double>& values) {
        if (values.size() != n) refuse(file, std::string("/").append(name), "has another length");
    });
    for_each_integer(points, [&](const char* name, const std::vector<std::int32_t>& values) {
        if (values.size() != n) refuse(file, std::string("/").append(name), "has another length");
    });
    for (std::size_t p = 0; p < n; ++p) {
        if (points.region[p] < 0 || static_cast<std::size_t>(points.region[p]) >= soils)
            refuse(file, "/region", "names a soil that the scene does not have");
        if (points.number[p] < 0 || static_cast<std::size_t>(points.number[p]) >= n)
            refuse(file, "/number", "names a point that is not there");
    }
    const Carried& carried = points.carried;
    if (!carried.r_u.empty() && carried.r_u.size() != n) refuse(file, "/r_u", "has another length");
    if (!carried.stress_of_soils.empty() && carried.stress_of_soils.size() != soils)
        refuse(file, "/stress_of_soils", "has another length");
}

/// Refuses points outside the grid, and homes more than one column and row away, unless the points
/// are sorted before homes are used.
void refuse_if_homeless(const Points& points, double strayed, const Grid& grid,
                        const std::string& file) {
    if (strayed < 0.0) refuse(file, "/run.strayed", "is less than nothing");
    // A point reaches only nodes around its home, or threads would write to the same node at once.
    const bool sorted_before_use = strayed > Strips::largest_stray;
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (!grid.holds(points.x[p], points.y[p]))
            refuse(file, "/x", "places a point outside the grid");
        const std::int32_t home = points.home[p];
        if (home < grid.rows || home >= grid.nodes() || home % grid.rows == 0)
            refuse(file, "/home", "names a node outside the grid");
        const std::int32_t here = grid.cell(grid.xi(points.x[p]), grid.eta(points.y[p]));
        const bool far = std::abs(home / grid.rows - here / grid.rows) > 1 ||
                         std::abs(home % grid.rows - here % grid.rows) > 1;
        if (far && !sorted_before_use)
            refuse(file, "/home", "names a node that is not next to the point");
    }
}

/// A count: not negative, and far from overflow by adding one.
std::int64_t count_at(const Archive& archive, const std::string& name, const std::string& file) {
    // Row stores the step as a real number, which is exact up to here.
    constexpr std::int64_t most = std::int64_t{1} << 53;
    const std::int64_t count = archive.integers.at(name).at(0);
    if (count < 0 || count > most) refuse(file, "/" + name, "is no count of what has happened");
    return count;
}

NonlocalSoftening::Pace load_pace(const Archive& archive, const std::string& file) {
    const std::vector<std::int64_t>& stored = archive.integers.at("run.softening_pace");
    const NonlocalSoftening::Pace pace{.done = stored.at(0), .due = stored.at(1)};
    if (pace.done < 0 || pace.done >= pace.due || pace.due > NonlocalSoftening::most_steps)
        refuse(file, "/run.softening_pace", "is no pace");
    return pace;
}

Points load_points(const Archive& archive, const std::string& file) {
    Points points;
    for (const auto& real : reals_of_points<Reals>)
        // A stored key array makes its group present; for_each_real below then asks for all of the
        // group.
        if (real.only_with == real.array && archive.reals.contains(real.name))
            (points.*real.array).resize(1);
    for_each_real(points, [&](const char* name, std::vector<double>& values) {
        values = archive.reals.at(name);
    });
    for_each_integer(points, [&](const char* name, std::vector<std::int32_t>& values) {
        const auto& stored = archive.integers.at(name);
        values.assign(stored.begin(), stored.end());
    });
    Carried& carried = points.carried;
    if (const auto r_u = archive.reals.find("r_u"); r_u != archive.reals.end()) {
        carried.r_u = r_u->second;
    }
    if (const auto measures = archive.integers.find("stress_of_soils");
        measures != archive.integers.end()) {
        constexpr auto known = words::values<exchange::StressMeasure>;
        for (const std::int64_t measure : measures->second) {
            if (measure < 0 || static_cast<std::size_t>(measure) >= known.size())
                refuse(file, "/stress_of_soils", "is no measure of stress");
            carried.stress_of_soils.push_back(known[static_cast<std::size_t>(measure)]);
        }
    }
    return points;
}

}  // namespace

void save_checkpoint(const std::filesystem::path& file, const Simulation& simulation,
                     std::int64_t telemetry_lines, const exchange::Provenance& provenance) {
    Archive archive{.kind = kind,
                    .version = checkpoint_version,
                    .reals = {},
                    .integers = {},
                    .texts = {},
                    .units = {}};
    const Body& body = simulation.body();
    for_each_real(body.points, [&](const char* name, const std::vector<double>& values) {
        archive.reals[name] = values;
    });
    for_each_integer(body.points, [&](const char* name, const std::vector<std::int32_t>& values) {
        archive.integers[name].assign(values.begin(), values.end());
    });
    const Carried& carried = body.points.carried;
    if (!carried.r_u.empty()) archive.reals["r_u"] = carried.r_u;
    for (const exchange::StressMeasure measure : carried.stress_of_soils) {
        archive.integers["stress_of_soils"].push_back(static_cast<std::int64_t>(measure));
    }
    for_each_number(simulation.clock(), simulation.start(), body.tally,
                    [&](const char* name, double value) {
                        archive.reals[std::string("run.") + name] = {value};
                    });
    const Clock& clock = simulation.clock();
    archive.integers["run.step"] = {clock.step};
    archive.integers["run.frames"] = {clock.frames};
    archive.integers["run.looks"] = {clock.looks};
    archive.integers["run.telemetry_lines"] = {telemetry_lines};
    if (body.softening.is_on()) {
        const NonlocalSoftening::Pace& pace = body.softening.pace();
        archive.integers["run.softening_pace"] = {pace.done, pace.due};
    }
    if (body.water.is_there()) archive.reals[water_nodes] = body.water.nodes();
    const Records& records = simulation.records();
    store(records.history, records_prefix, archive);
    store(simulation.gauges(), records.gauges, records_prefix, archive);
    store(records.profiles, simulation.view(), records_prefix, archive);
    store(records.envelope, records_prefix, archive);
    store(simulation.sections(), records.sections, records_prefix, SectionState::whole, archive);
    store(simulation.ground(), archive);
    archive.texts["scene"] = provenance.scene;
    archive.texts["inputs"] = digests(provenance);
    write_archive(file, archive, provenance);
}

Resumed load_checkpoint(const std::filesystem::path& file, const scene::Scene& scene,
                        const exchange::Provenance& provenance, const Computing& computing) {
    const Archive archive =
        exchange::read_archive(file, kind, checkpoint_version, exchange::Reals::finite);
    refuse_other_ground(archive, scene::mpm_of(scene).shaking, file.string());
    refuse_if_different(archive, "scene", provenance.scene, file.string());
    refuse_if_different(archive, "inputs", digests(provenance), file.string());
    try {
        ZonedPoints points{load_points(archive, file.string()), {}};
        refuse_if_ragged(points.points, scene::soils_of(scene).size(), file.string());
        refuse_without_strength(scene, points.points, file.string());
        refuse_if_homeless(points.points, archive.reals.at("run.strayed").at(0),
                           make_grid(scene::mpm_of(scene)), file.string());
        points.zones = zones_of(scene, points.points);
        const bool is_wet = !points.points.displaced.empty();
        const bool has_shared = !points.points.epsilon_q_shared.empty();
        Body body = make_body(scene, std::move(points), file.string(), computing);
        if (body.softening.is_on() != has_shared)
            refuse(file.string(), "/epsilon_q_shared", "does not go with this scene's softening");
        if (body.water.is_there() != is_wet)
            refuse(file.string(), "/displaced", "does not go with this scene's water");
        if (is_wet) {
            const std::vector<double>& nodes = archive.reals.at(water_nodes);
            if (nodes.size() != body.water.nodes().size())
                refuse(file.string(), "/water.nodes", "is of another grid");
            body.water.set_nodes(nodes);
        }
        if (body.softening.is_on()) body.softening.go_on_from(load_pace(archive, file.string()));
        Clock clock;
        Start start;
        for_each_number(clock, start, body.tally, [&](const char* name, double& value) {
            value = archive.reals.at(std::string("run.") + name).at(0);
        });
        clock.step = count_at(archive, "run.step", file.string());
        clock.frames = count_at(archive, "run.frames", file.string());
        clock.looks = count_at(archive, "run.looks", file.string());
        if (clock.time < 0.0) refuse(file.string(), "/run.time", "is before the beginning");
        History history = load(archive, records_prefix);
        const std::size_t rows = history.size();
        Records records{
            std::move(history), load_gauges(scene::mpm_of(scene).gauges, archive, records_prefix),
            load_profiles(archive, records_prefix),
            load_envelope(archive, records_prefix,
                          profile_places(flow_view(scene, body.grid)).size()),
            load_sections(scene::mpm_of(scene).sections, archive, records_prefix, rows)};
        if (records.history.empty() && clock.looks > 0)
            refuse(file.string(), "/run.looks", "counts looks of which there is no record");
        return {Simulation(scene, std::move(body), clock, start, std::move(records),
                           load_ground(archive, file.string())),
                count_at(archive, "run.telemetry_lines", file.string()), archive.spent};
    } catch (const std::out_of_range&) {
        refuse(file.string(), "/", "lacks an array of a checkpoint");
    }
}

}  // namespace breach::mpm
