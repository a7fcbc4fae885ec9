// Commands that fetch what the tasks of a run left: logs, telemetry, flows past sections, files.
// Called by command_line.cpp. Numbers that only the server can check stay texts here and are sent
// as given.
#include "services/cli/commands.hpp"
#include "services/cli/export_run.hpp"
#include "services/cli/logs.hpp"
#include "services/cli/program.hpp"

namespace breach::cli {

namespace {

/// One runout of a run with several.
void take_runout(CLI::App& word, std::string& transfer_time, std::string& variant) {
    word.add_option("--transfer-time", transfer_time, "which of the sweep's runouts [s]");
    word.add_option("--variant", variant, "which of the study's variants");
}

void add_logs(Program& program) {
    const auto& [word, options] =
        program.add<LogOptions>("logs", "a task's log", "TASK -f", show_log);
    word.add_option("TASK", options.task, "whose log; `show RUN` lists the tasks")->required();
    word.add_option("--attempt", options.attempt, "which attempt (default: the newest)");
    word.add_option("-n,--lines", options.lines, "only the last lines, this many");
    word.add_flag_callback(
        "-f,--follow", [&follow = options.follow] { follow = Follow::until_the_end; },
        "go on until the task ends");
}

void add_telemetry(Program& program) {
    const auto& [word, options] =
        program.add<TelemetryOptions>("telemetry", "what a phase measured while it ran",
                                      "latest mpm_solver --transfer-time 0.5 --csv", telemetry);
    take_run(word, options.run);
    word.add_option("PHASE", options.phase, "fem_solver or mpm_solver")->required();
    take_runout(word, options.transfer_time, options.variant);
    word.add_option("--fields", options.fields, "only these, separated by commas");
    word.add_option("--from", options.from, "first line, counted from 0")
        ->check(CLI::NonNegativeNumber);
    word.add_option("--stride", options.stride, "every n-th line")->check(CLI::PositiveNumber);
    word.add_flag("--csv", program.csv, "comma-separated, for other programs");
}

void add_hydrograph(Program& program) {
    const auto& [word, options] = program.add<HydrographOptions>(
        "hydrograph", "what passed a section of a runout, for HEC-RAS, FLO-2D or as CSV",
        "latest --section toe --for hec-ras --breach-width 72 --output toe.csv", hydrograph);
    take_run(word, options.run);
    word.add_option("--section", options.section, "its name in the scene's /mpm/sections")
        ->required();
    word.add_option("--for", options.target, "csv, hec-ras, hec-ras-unsteady or flo-2d")
        ->check(CLI::IsMember({"csv", "hec-ras", "hec-ras-unsteady", "flo-2d"}))
        ->capture_default_str();
    word.add_option("--breach-width", options.breach_width,
                    "72, or 60,72,90 for low, best, high [m] (default: the scene's)");
    word.add_option("--interval", options.interval,
                    "between two flows, for hec-ras and flo-2d [s] (1)");
    take_runout(word, options.transfer_time, options.variant);
    word.add_option("--cell", options.cell, "FLO-2D's grid element that takes the inflow (1)");
    word.add_option("--concentration", options.concentration,
                    "solids by volume, 0 to 1; FLO-2D: adds the column for mudflow");
    word.add_option("--percentile", options.percentile,
                    "10, 50 or 90 of the volume, over all runouts of the run");
    word.add_option("--rheology", options.rheology,
                    "hec-ras-unsteady: bingham, obrien or herschel-bulkley (bingham)");
    word.add_option("--yield-stress", options.yield_stress,
                    "hec-ras-unsteady [Pa] (default: that of the runout's soils)");
    word.add_option("--viscosity", options.viscosity, "hec-ras-unsteady, with it [Pa s]");
    word.add_option("--output", options.file, "a file instead of the screen");
}

void add_report(Program& program) {
    struct Asked {
        std::string run;
        std::filesystem::path file;
    };
    const auto& [word, options] =
        program.add<Asked>("report", "the report of a run as a PDF (needs weasyprint) or HTML",
                           "latest --output my_dam.pdf",
                           [](Server& server, const Asked& asked, const Console& console) {
                               return report(server, asked.run, asked.file, console);
                           });
    take_run(word, options.run);
    word.add_option("--output", options.file, "a .pdf or .html file (default: the run's name.pdf)")
        ->check([](const std::string& name) {
            const std::string kind = std::filesystem::path(name).extension();
            return kind == ".pdf" || kind == ".html" ? ""
                                                     : name + ": end the name with .pdf or .html";
        });
}

void add_export(Program& program) {
    struct Copy {
        std::string run;
        std::filesystem::path folder;
    };
    const auto& [word, options] = program.add<Copy>(
        "export", "a run as a folder: results, study, logs, verified artifacts",
        "latest slope-run/", [](Server& server, const Copy& copy, const Console& console) {
            return export_run(server, copy.run, copy.folder, console);
        });
    take_run(word, options.run);
    word.add_option("DIR", options.folder,
                    "a new or empty folder, or one with an earlier export of the run")
        ->required();
}

}  // namespace

void add_words_of_results(Program& program) {
    add_logs(program);
    add_telemetry(program);
    add_hydrograph(program);
    add_report(program);
    add_export(program);
}

}  // namespace breach::cli
