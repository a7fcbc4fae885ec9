// report: writes reports and figures of phases' results.
#include <CLI/CLI.hpp>
#include <iostream>

#include "core/fault/fault.hpp"
#include "core/version/version.hpp"
#include "services/report/accuracy_page.hpp"
#include "services/report/figures/element_test_figures.hpp"
#include "services/report/figures/stability_figures.hpp"
#include "services/report/figures/transfer_figures.hpp"
#include "services/report/run_report.hpp"

namespace {

using breach::fault::ExitCode;

/// Runs the work and reports errors on standard error.
template <class Work>
ExitCode guarded(const std::filesystem::path& source, const Work& work) {
    const auto say = [](const std::string& what, ExitCode code) {
        std::cerr << "report: " << what << "\n";
        return code;
    };
    try {
        work();
        return ExitCode::done;
    } catch (const breach::fault::BadInput& error) {
        return say(error.what(), ExitCode::bad_input);
    } catch (const std::invalid_argument& error) {  // numbers that cannot be drawn
        return say(source.string() + ": " + error.what(), ExitCode::bad_input);
    } catch (const breach::fault::IoError& error) {
        return say(error.what(), ExitCode::io);
    } catch (const std::filesystem::filesystem_error& error) {
        return say(error.what(), ExitCode::io);
    } catch (const std::bad_alloc&) {
        return say("not enough memory", ExitCode::try_again);
    } catch (const std::exception& error) {
        return say(std::string("internal fault: ") + error.what(), ExitCode::breakdown);
    }
}

/// Figures of one phase's folder.
struct OnePhase {
    CLI::App* command;
    void (*write)(const std::filesystem::path& folder, const std::filesystem::path& output);
};

template <auto figures>
void write_figures_of(const std::filesystem::path& folder, const std::filesystem::path& output) {
    breach::report::write_figures(output, figures(folder));
}

}  // namespace

int main(int argc, char** argv) {
    using namespace breach;
    CLI::App app("A run as one HTML page with its figures (SVG, PNG) and their data (CSV)",
                 "report");
    app.set_version_flag("--version", std::string("report ") + version());
    std::filesystem::path folder, output;
    report::Choice choice;
    app.add_option("run", folder, "folder of breach export, or with one folder per phase");
    app.add_option("--output", output, "the page, F.html; figures and data go to F_files");
    app.add_option("--snapshots", choice.snapshot_times, "times of contours and meshes [s]")
        ->delimiter(',');
    app.add_option("--transfers", choice.transfer_times, "transfer times of the geometries [s]")
        ->delimiter(',');
    app.add_option("--motion", choice.motion, "the scene's motion, when the run does not hold it");
    app.add_option("--element-tests", choice.element_tests,
                   "folder of fem_solver element-test: strength of the scene's soils");
    app.add_option(
           "--companions", choice.companions,
           "other runs: their runouts in the figure, their variants behind those of this one")
        ->delimiter(',');
    bool alone = false;
    app.add_flag("--alone", alone, "the page only, without files of its figures and their data");
    app.footer("One phase alone: figures and data only.");
    app.require_subcommand(0, 1);
    const OnePhase single[] = {
        {app.add_subcommand("element-test", "figures of fem_solver element-test"),
         write_figures_of<report::element_test_figures>},
        {app.add_subcommand("stability", "figures of lem_tool"),
         write_figures_of<report::stability_figures>},
        {app.add_subcommand("transfer", "figures of transfer_tool, before and after side by side"),
         report::write_transfer_figures}};
    for (const OnePhase& each : single) {
        each.command->add_option("folder", folder, "output folder of the phase")->required();
        each.command->add_option("--output", output, "folder for figures, made if absent")
            ->required();
    }
    std::vector<std::filesystem::path> tables;
    CLI::App* accuracy =
        app.add_subcommand("accuracy", "page of accuracy studies, with error against CPU seconds");
    accuracy
        ->add_option("tables", tables,
                     "what breach accuracy --of RUN --json printed, one file each")
        ->required();
    accuracy
        ->add_option("--output", output,
                     "the page (Markdown); figures and data go to a folder of its name")
        ->required();
    try {
        app.parse(argc, argv);
        if (app.get_subcommands().empty() && (folder.empty() || output.empty())) {
            throw CLI::RequiredError("RUN and --output");
        }
    } catch (const CLI::ParseError& error) {
        return static_cast<int>(app.exit(error) == 0 ? ExitCode::done : ExitCode::usage);
    }
    return static_cast<int>(guarded(*accuracy ? output : folder, [&] {
        if (*accuracy) return report::write_accuracy_page(tables, output);
        for (const OnePhase& each : single) {
            if (*each.command) return each.write(folder, output);
        }
        report::write_report(report::document_of(report::read_run(folder), choice), output,
                             alone ? report::Files::none : report::Files::beside_the_page);
    }));
}
