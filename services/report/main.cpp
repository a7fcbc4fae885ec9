// report: figures of what phases have written.
#include <CLI/CLI.hpp>
#include <iostream>

#include "core/fault/fault.hpp"
#include "services/report/element_test_figures.hpp"
#include "services/report/stability_figures.hpp"

namespace {

using breach::fault::ExitCode;

/// Runs the work and says what went wrong on standard error.
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

}  // namespace

int main(int argc, char** argv) {
    using namespace breach;
    CLI::App app("Figures (SVG) and their data (CSV) from the outputs of phases", "report");
    app.require_subcommand(1);
    std::filesystem::path folder, output;
    CLI::App* element = app.add_subcommand("element-test", "from fem_solver element-test");
    CLI::App* stability = app.add_subcommand("stability", "from lem_tool");
    for (CLI::App* each : {element, stability}) {
        each->add_option("folder", folder, "output folder of the phase")->required();
        each->add_option("--output", output, "folder for figures, made if absent")->required();
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return static_cast<int>(app.exit(error) == 0 ? ExitCode::done : ExitCode::usage);
    }
    return static_cast<int>(guarded(folder, [&] {
        report::write_figures(output, *element ? report::element_test_figures(folder)
                                               : report::stability_figures(folder));
    }));
}
