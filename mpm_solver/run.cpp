// The course of a run: begin or resume, then step, measure and write until Simulation::course()
// ends it or a stop is requested. Only this file and results.cpp write outputs.
#include "mpm_solver/run.hpp"

#include <spdlog/spdlog.h>

#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "core/scene/words.hpp"
#include "core/words/number.hpp"
#include "mpm_solver/begin.hpp"
#include "mpm_solver/checkpoint.hpp"
#include "mpm_solver/results.hpp"
#include "mpm_solver/simulation.hpp"

namespace breach::mpm {

namespace {

using nlohmann::json;
using process::Outcome;
using process::Session;

Simulation begin_or_resume(Session& session) {
    const auto checkpoint = session.output(phases::files::checkpoint);
    if (session.settings().start == process::Start::resume && std::filesystem::exists(checkpoint)) {
        Resumed resumed = load_checkpoint(checkpoint, session.scene(), session.provenance(),
                                          computing_of(session));
        // Lines after the checkpoint would appear twice.
        session.truncate_telemetry(resumed.telemetry_lines);
        session.went_on_after(resumed.spent);
        spdlog::info("goes on at t = {:.6f} s, step {}", resumed.simulation.clock().time,
                     resumed.simulation.clock().step);
        return std::move(resumed.simulation);
    }
    session.truncate_telemetry(0);
    Begun begun = begin(session);
    return {session.scene(), std::move(begun.body), begun.transfer_time, std::move(begun.ground)};
}

void save(const Session& session, const Simulation& simulation) {
    save_checkpoint(session.output(phases::files::checkpoint), simulation,
                    session.telemetry_lines(), session.provenance());
}

void write_frame(Session& session, Simulation& simulation) {
    const double time = simulation.clock().time;
    const std::string name = phases::files::frame_name(time);
    std::vector<std::string_view> fields;
    for (const scene::PointField field : session.scene().mpm->output.fields)
        fields.push_back(words::name_of(field));
    exchange::write_particle_frame(session.output(name), simulation.state(), fields,
                                   session.provenance());
    simulation.take_frame();
    session.announce_frame(name, phases::files::frame_prefix, time);
}

void report(Session& session, const Simulation& simulation) {
    const Row& row = simulation.last_row();
    json line{{"phase", phases::mpm.program}};
    for_each_column(row, [&](const char* name, const char*, double value) { line[name] = value; });
    if (row.runout_front == nowhere) line["runout_front"] = nullptr;
    line["step"] = static_cast<std::int64_t>(row.step);
    line["front"] = session.scene().mpm->runout.toe.x() + row.runout_beyond_toe;
    for (std::size_t k = 0; k < simulation.gauges().size(); ++k) {
        const std::string gauge = "gauge." + simulation.gauges()[k].name;
        line[gauge + ".depth"] = simulation.records().gauges[k].depth.back();
        line[gauge + ".velocity"] = simulation.records().gauges[k].velocity.back();
    }
    for (std::size_t k = 0; k < simulation.sections().size(); ++k) {
        const std::string section = "section." + simulation.sections()[k].name + ".";
        for_each_column_of_section(
            simulation.records().sections[k],
            [&](const char* name, const char*, const std::vector<double>& rows) {
                line[section + name] = rows.back();
            });
    }
    session.telemetry(line);
}

void show_progress(Session& session, const Simulation& simulation) {
    const double time = simulation.clock().time;
    const scene::Mpm& mpm = *session.scene().mpm;
    // The time of rest is unknown: the share then approaches 1.
    session.progress(time / (mpm.until_rest ? time + simulation.rest().earliest : mpm.duration),
                     words::formatted("t = %.2f s", time));
}

void look_and_write(Session& session, Simulation& simulation) {
    if (simulation.look_due()) {
        simulation.look();
        report(session, simulation);
        show_progress(session, simulation);
    }
    if (simulation.frame_due()) write_frame(session, simulation);
}

/// Steps until the end; saves checkpoints.
Outcome advance_to_the_end(Session& session, Simulation& simulation) {
    double saved = session.wall_seconds();
    while (simulation.course() == Course::goes_on) {
        // Between steps only: a checkpoint is always the state after a whole step.
        if (session.stop_requested()) {
            save(session, simulation);
            return Outcome::stopped;
        }
        simulation.advance();
        look_and_write(session, simulation);
        if (session.wall_seconds() - saved >= session.scene().mpm->checkpoint_interval) {
            save(session, simulation);
            saved = session.wall_seconds();
        }
    }
    return Outcome::done;
}

void finish(Session& session, Simulation& simulation, double speed) {
    // Results are those of the last step, which need not have a measurement.
    if (simulation.last_row().step < static_cast<double>(simulation.clock().step)) {
        simulation.look();
        report(session, simulation);
    }
    const auto file = session.output(phases::files::final_state);
    exchange::write_particle_state(file, simulation.state(), session.provenance());
    session.announce(file, {{"kind", "particles"}, {"time", simulation.clock().time}});
    write_results(session, simulation, speed);
    // Last: a run that is interrupted while it writes results can resume and write them again.
    std::filesystem::remove(session.output(phases::files::checkpoint));
    session.progress(1.0, "done");
}

/// Warnings about the scene, which may explain a breakdown.
std::string warnings_before(const scene::Scene& scene) {
    std::string text;
    for (const fault::Flag& each : scene.warnings)
        text += "\n  warned before the run: " + each.pointer + ": " + each.message;
    return text;
}

}  // namespace

Outcome run(Session& session) {
    Simulation simulation = begin_or_resume(session);
    const std::int64_t first_step = simulation.clock().step;
    const double began = session.cpu_seconds();
    try {
        look_and_write(session, simulation);
        if (advance_to_the_end(session, simulation) == Outcome::stopped) return Outcome::stopped;
    } catch (const fault::Breakdown& breakdown) {
        const auto file = session.output("last_good.vtkhdf");
        exchange::write_particle_state(file, simulation.last_good_state(), session.provenance());
        throw fault::Breakdown(std::string(breakdown.what()) + "; last good state in " +
                               file.string() + warnings_before(session.scene()));
    }
    const double seconds = session.cpu_seconds() - began;
    const double work = static_cast<double>(simulation.body().points.size()) *
                        static_cast<double>(simulation.clock().step - first_step);
    finish(session, simulation, seconds > 0.0 ? work / seconds : 0.0);
    return Outcome::done;
}

}  // namespace breach::mpm
