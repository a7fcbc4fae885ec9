// What the phases' programs share, with their further commands (fem_solver mesh, transfer_tool
// advise, the element tests): arguments, the questions --plan and --check, provenance, result.json
// or fault.json, exit codes. A main() calls run_phase once; the physics begins in Phase::run.
//
// Order at a start: the scene is read and reduced, then planned, then compared with the checkpoint,
// and only then is the output folder touched. So a refused scene leaves an earlier result whole.
#include "core/process/phase.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <optional>

#include "core/exchange/publish.hpp"
#include "core/exchange/temporary_folder.hpp"
#include "core/phases/files.hpp"
#include "core/phases/reads.hpp"
#include "core/process/signals.hpp"
#include "core/scene/reading.hpp"
#include "core/version/version.hpp"

namespace breach::process {

using fault::ExitCode;
using nlohmann::json;

namespace {

/// What is asked instead of a run: an answer on stdout, no output folder.
enum class Question { none, plan, check };

struct Arguments {
    std::filesystem::path scene;
    SessionSettings settings;
    Question question = Question::none;
    bool measure = false;  ///< with the plan: cost of a step
};

/// Parsed arguments, or the exit code if nothing is to run (help, version, wrong usage).
struct ParsedArguments {
    std::optional<Arguments> arguments;
    ExitCode code = ExitCode::done;
};

ParsedArguments usage_fault(const std::string& message) {
    std::cerr << message << "\nRun with --help for more information.\n";
    return {std::nullopt, ExitCode::usage};
}

/// "fem_solver 0.1.0", and on a second line "numerics 3" for the service.
std::string version_of(const Phase& phase) {
    std::string text = phase.name + " " + version();
    if (phase.numerics > 0) text += "\nnumerics " + std::to_string(phase.numerics);
    return text;
}

ParsedArguments parse(int argc, char** argv, const Phase& phase) {
    CLI::App app(phase.purpose, phase.name);
    Arguments a;
    a.settings.phase = phase.name;
    std::string progress = "auto";
    bool plan = false;
    bool check = false;
    bool resume = false;
    app.add_option("scene", a.scene, "scene file (JSON)")->required();
    app.add_option("--input", a.settings.inputs, phase.inputs.what)->allow_extra_args(false);
    app.add_option("--output", a.settings.output, "folder for results, made if absent");
    app.add_option("--set", a.settings.overrides,
                   "/json/pointer=value, changes the scene; repeatable")
        ->allow_extra_args(false);
    app.add_flag("--plan", plan, "print what the scene needs and what is left out, and stop");
    if (phase.measure) {
        app.add_flag("--measure", a.measure,
                     "with --plan: takes ten steps and prints unknowns, bytes and where their time "
                     "went");
    }
    app.add_flag("--check", check, "check the scene and stop");
    app.add_flag("--resume", resume,
                 "go on from the checkpoint in the output folder, if there is one");
    app.add_option("--threads", a.settings.threads, "threads to use")->check(CLI::Range(1, 1024));
    app.add_option("--progress", progress, "auto, bar, json or none")
        ->check(CLI::IsMember({"auto", "bar", "json", "none"}));
    for (const Switch& each : phase.switches) {
        app.add_flag_callback(
            each.name, [&a, &each] { a.settings.switches.insert(each.name); }, each.purpose);
    }
    app.set_version_flag("--version", version_of(phase));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return {std::nullopt, app.exit(error) == 0 ? ExitCode::done : ExitCode::usage};
    }
    for (const Switch& each : phase.switches) {
        if (!each.sets.empty() && a.settings.switches.contains(each.name))
            a.settings.overrides.push_back(each.sets);
    }
    if (plan) a.question = Question::plan;
    if (check) a.question = Question::check;
    a.settings.start = resume ? Start::resume : Start::fresh;
    const bool terminal = isatty(STDERR_FILENO) == 1;
    if (progress == "json") a.settings.progress = ProgressStyle::json;
    if (progress == "bar" || (progress == "auto" && terminal))
        a.settings.progress = ProgressStyle::bar;
    if (phase.with_input && !a.settings.inputs.empty()) a.settings.phase = phase.with_input;
    if (a.measure && a.question != Question::plan)
        return usage_fault("--measure belongs to --plan");
    // A plan needs neither inputs nor a folder: the service asks for it before they exist.
    if (a.question != Question::none) return {a, ExitCode::done};
    if (a.settings.output.empty()) return usage_fault("--output is required");
    const int inputs = static_cast<int>(a.settings.inputs.size());
    if (inputs < phase.inputs.least || inputs > phase.inputs.most) {
        return usage_fault(phase.name + " takes " + std::to_string(phase.inputs.least) + " to " +
                           std::to_string(phase.inputs.most) + " --input (" + phase.inputs.what +
                           "), not " + std::to_string(inputs));
    }
    return {a, ExitCode::done};
}

json as_json(const Plan& plan) {
    json lines = json::array();
    for (const PlanLine& line : plan) {
        lines.push_back({{"feature", line.feature},
                         {"on", line.use == Use::on},
                         {"reason", line.reason},
                         {"pointer", line.pointer}});
    }
    return lines;
}

/// Keys of result.json and fault.json. The service takes a phase's inputs from here when it adopts
/// folders of phases that were run by hand (phase_folders.cpp).
json as_json(const exchange::Provenance& p) {
    json inputs = json::array();
    for (const auto& each : p.inputs)
        inputs.push_back({{"path", each.path}, {"sha256", each.sha256}});
    return {{"phase", p.phase},
            {"version", p.version},
            {"scene", json::parse(p.scene)},
            {"overrides", p.overrides},
            {"inputs", inputs},
            {"threads", p.threads},
            {"wall_seconds", p.spent.wall},
            {"cpu_seconds", p.spent.cpu}};
}

/// A number, a word, yes or no; none if it is long.
std::optional<std::string> short_text(const json& value) {
    constexpr std::size_t longest = 60;
    if (value.is_structured()) return std::nullopt;
    std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (text.size() > longest) return std::nullopt;
    return text;
}

fault::Fault changed_entry(const json& change, const json& before) {
    const std::string pointer = change.at("path");
    // An entry short enough to show comes with the --set that restores it.
    const std::string afresh = ", or start afresh without --resume";
    if (change.at("op") != "replace")
        return {
            pointer,
            change.at("op") == "add" ? "was not there when this run began" : "is no longer there",
            "resume with the scene that the run began with" + afresh};
    const auto was = short_text(before.at(json::json_pointer(pointer)));
    const auto is = short_text(change.at("value"));
    if (!was || !is)
        return {pointer, "is another than when this run began",
                "resume with the scene that the run began with" + afresh};
    return {pointer, "was " + *was + " when this run began and is " + *is + " now",
            "resume with --set " + pointer + "=" + *was + afresh};
}

/// Refuses to resume with another scene; lists the changed entries before changing the folder.
void refuse_another_scene(const SessionSettings& settings, const scene::Scene& scene) {
    constexpr std::size_t most_told = 20;  // another scene altogether would fill the screen
    const auto checkpoint = settings.output / phases::files::checkpoint;
    const auto kept = settings.output / phases::files::scene;
    if (settings.start == Start::fresh || !std::filesystem::exists(checkpoint)) return;
    std::ifstream stream(kept);
    const json before = json::parse(stream, nullptr, false);
    if (before.is_discarded()) return;  // the checkpoint has its own check
    std::vector<fault::Fault> faults;
    for (const json& change : json::diff(before, json::parse(scene.completed))) {
        faults.push_back(changed_entry(change, before));
        if (faults.size() == most_told) break;
    }
    if (!faults.empty()) throw fault::BadInput(kept.string(), std::move(faults));
}

/// Called when nothing can be refused any more. Removes what an earlier run left under the names by
/// which the service recognises an end.
void make_output_folder(const std::filesystem::path& folder, Start start) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw fault::IoError(folder.string() + ": cannot be made: " + error.message());
    if (access(folder.c_str(), W_OK) != 0)
        throw fault::IoError(folder.string() + ": is not writable");
    std::filesystem::remove(folder / phases::files::fault, error);
    std::filesystem::remove(folder / phases::files::result,
                            error);  // an old result must not be mistaken for the new one
    if (start == Start::fresh) std::filesystem::remove(folder / phases::files::checkpoint, error);
}

/// Facts of a run for result.json, or for fault.json if it fails.
json known_of(Session& session, const Plan& plan) {
    json known = session.result();
    known["phase"] = session.settings().phase;
    known["scene"] = session.scene().name;
    known["plan"] = as_json(plan);
    known["flags"] = fault::as_json(session.flags());
    known["questionable"] = fault::is_questionable(session.flags());
    const exchange::Spent spent = session.spent();
    known["wall_seconds"] = spent.wall;
    known["cpu_seconds"] = spent.cpu;
    if (const auto peak = session.peak_memory()) known["peak_memory_MB"] = *peak;
    known["provenance"] = as_json(session.provenance());
    return known;
}

/// The run itself, from the first write into the output folder on. `known` leaves by reference
/// because guarded() needs it after the exception has unwound the session.
ExitCode simulate(const Phase& phase, Arguments& arguments, scene::Scene scene, json& known) {
    const Plan plan = phase.plan(scene);
    spdlog::info("plan\n{}", as_text(plan));
    refuse_another_scene(arguments.settings, scene);
    make_output_folder(arguments.settings.output, arguments.settings.start);
    Session session(arguments.settings, std::move(scene));
    exchange::publish_text(session.output(phases::files::scene),
                           json::parse(session.scene().completed).dump(2) + "\n");
    try {
        // Stopped: a signal came and a checkpoint is written; no result.json, so that the service
        // resumes it.
        if (phase.run(session) == Outcome::stopped) {
            spdlog::warn("stopped; go on with --resume");
            return code_of_stop();
        }
    } catch (...) {
        // fault.json then has flags, provenance and times as well: guarded() writes it.
        known = known_of(session, plan);
        throw;
    }
    json result = known_of(session, plan);
    exchange::publish_text(session.output(phases::files::result), result.dump(2) + "\n");
    if (session.settings().progress == ProgressStyle::json) {
        // Left out of the event's one line because of their length; both are in result.json. The
        // service ignores this event: it reads lines of progress only (dispatch/attempts.cpp).
        result.erase("provenance");
        result.erase("plan");
        std::cout << json{{"event", "result"}, {"result", result}}.dump() << std::endl;
    }
    return ExitCode::done;
}

/// A trial in a folder of its own: --plan --measure leaves nothing behind and needs no --output. A
/// measure() that wants switches sets its own (the FEM's trial_switch).
Cost measured(const Phase& phase, const Arguments& arguments, const scene::Scene& scene) {
    const exchange::TemporaryFolder folder("breach_");
    SessionSettings settings = arguments.settings;
    settings.output = folder.path();
    settings.progress = ProgressStyle::none;
    settings.start = Start::fresh;
    settings.switches.clear();
    Session session(settings, scene);
    spdlog::set_level(spdlog::level::warn);  // the plan is on stdout; ten steps have nothing to say
    return phase.measure(session);
}

/// The part of /mpm that the phases after a FEM read.
scene::Mpm grid_alone(const scene::Mpm& mpm) {
    scene::Mpm grid{};
    grid.cell_size = mpm.cell_size;
    grid.domain_x = mpm.domain_x;
    grid.domain_y = mpm.domain_y;
    grid.left = mpm.left;
    grid.right = mpm.right;
    grid.floor = mpm.floor;
    grid.water = mpm.water;
    grid.terrain = mpm.terrain;
    grid.gimp_half_size = mpm.gimp_half_size;
    return grid;
}

/// The scene reduced to what a phase reads, so that no result can depend on the rest. Provenance
/// has the whole text.
scene::Scene what_it_reads(const std::string& phase, const scene::Scene& scene,
                           const std::filesystem::path& file) {
    const phases::Phase* named = phases::named(phase);
    if (named == nullptr) return scene;
    scene::Reading known =
        scene::read_document(phases::scene_known_to(*named, json::parse(scene.completed)),
                             file.string(), file.parent_path(), {});
    if (!known.faults.empty()) throw fault::BadInput(file.string(), std::move(known.faults));
    known.scene.completed = scene.completed;
    // After a FEM, when the scene's motion file may be absent.
    if (phase == phases::transfer.program || phase == phases::post_seismic.program) {
        if (known.scene.mpm) known.scene.mpm = grid_alone(*known.scene.mpm);
        return std::move(known.scene);
    }
    for (fault::Flag& each : check::problems_of(known.scene).warnings)
        known.scene.warnings.push_back(std::move(each));
    return std::move(known.scene);
}

ExitCode answer(const Phase& phase, Arguments& arguments, json& known) {
    const scene::Scene whole = phase.read(arguments.scene, arguments.settings.overrides);
    scene::Scene scene = what_it_reads(arguments.settings.phase, whole, arguments.scene);
    if (arguments.question == Question::none)
        return simulate(phase, arguments, std::move(scene), known);
    const Plan plan = phase.plan(scene);
    if (arguments.question == Question::plan) {
        std::cout << as_text(plan);
        if (arguments.measure) std::cout << as_text(measured(phase, arguments, scene));
    } else {
        std::cout << arguments.scene.string() << ": no faults\n";
    }
    // Of the whole scene: a person who checks it asks about every part, not only about this
    // phase's.
    for (const fault::Flag& each : whole.warnings)
        std::cout << "warning   " << each.pointer << ": " << each.message << "\n";
    return ExitCode::done;
}

/// Reports an error on stderr, in fault.json (for the scheduler) and as an event (--progress json).
/// `known`: facts and provenance so far; empty if the phase did not start.
ExitCode report(const Arguments& arguments, const json& known, ExitCode code,
                const std::string& summary, const std::vector<fault::Fault>& faults) {
    std::cerr << arguments.settings.phase << ": " << summary << "\n";
    json line{
        {"exit_code", static_cast<int>(code)}, {"summary", summary}, {"faults", json::array()}};
    for (const fault::Fault& each : faults) {
        line["faults"].push_back(
            {{"pointer", each.pointer}, {"cause", each.cause}, {"remedy", each.remedy}});
    }
    try {
        if (std::filesystem::is_directory(arguments.settings.output)) {
            json document = known;
            document.update(line);
            exchange::publish_text(arguments.settings.output / phases::files::fault,
                                   document.dump(2) + "\n");
        }
    } catch (const fault::IoError& error) {
        std::cerr << error.what() << "\n";
    }
    if (arguments.settings.progress == ProgressStyle::json) {
        line["event"] = "fault";
        std::cout << line.dump() << std::endl;
    }
    return code;
}

/// The one place where exceptions become exit codes: 65 for input, 70 for the numerics, 74 for
/// files, 75 where another try may succeed. The service decides by them whether to retry
/// (dispatch/ending.cpp).
ExitCode guarded(const Phase& phase, Arguments& arguments) {
    json known = json::object();
    try {
        return answer(phase, arguments, known);
    } catch (const fault::BadInput& error) {
        return report(arguments, known, ExitCode::bad_input, error.what(), error.faults());
    } catch (const fault::Breakdown& error) {
        return report(arguments, known, ExitCode::breakdown, error.what(), {});
    } catch (const fault::IoError& error) {
        return report(arguments, known, ExitCode::io, error.what(), {});
    } catch (const std::bad_alloc&) {
        return report(arguments, known, ExitCode::try_again, "not enough memory", {});
    } catch (const std::filesystem::filesystem_error& error) {
        return report(arguments, known, ExitCode::io, error.what(), {});
    } catch (const std::exception& error) {
        return report(arguments, known, ExitCode::breakdown,
                      std::string("internal fault: ") + error.what(), {});
    }
}

}  // namespace

int run_phase(int argc, char** argv, const Phase& phase) {
    spdlog::set_default_logger(spdlog::stderr_color_mt(phase.name));
    spdlog::set_pattern("%H:%M:%S %n %l: %v");
    watch_signals();  // before anything that takes long: a TERM during reading must not be lost
    ParsedArguments parsed = parse(argc, argv, phase);
    if (!parsed.arguments) return static_cast<int>(parsed.code);
    return static_cast<int>(guarded(phase, *parsed.arguments));
}

}  // namespace breach::process
