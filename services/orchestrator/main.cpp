// breachline serve | check | token | findings | conditions | inputs | supervise.
// serve is the service; supervise is started by it, once per attempt. check and token work on files
// and need no service. The report's program asks findings, conditions and inputs of a folder.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <functional>
#include <iostream>

#include "core/fault/fault.hpp"
#include "core/version/version.hpp"
#include "services/orchestrator/access/token_command.hpp"
#include "services/orchestrator/audit/check_command.hpp"
#include "services/orchestrator/executors/supervisor.hpp"
#include "services/orchestrator/report_questions.hpp"
#include "services/orchestrator/serve_options.hpp"

using breach::fault::ExitCode;
using namespace breach::orchestrator;

namespace {

/// Wrong options (2) are a person's to correct; of a question's input (65) the report shows the
/// text to its user.
int guarded(const std::function<int()>& work, ExitCode of_bad_input = ExitCode::usage) {
    spdlog::set_default_logger(spdlog::stderr_color_mt("breachline"));
    spdlog::set_pattern("%H:%M:%S %n %l: %v");
    try {
        return work();
    } catch (const breach::fault::BadInput& error) {
        std::cerr << "breachline: " << error.what() << "\n";
        return static_cast<int>(of_bad_input);
    } catch (const std::exception& error) {
        std::cerr << "breachline: " << error.what() << "\n";
        return static_cast<int>(ExitCode::io);
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Runs studies: FEM, transfers, MPM, and what connects them", "breachline");
    app.set_version_flag("--version", std::string("breachline ") + breach::version());
    app.require_subcommand(1);
    // An option that is given twice: the last one counts.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    ServeOptions options(std::filesystem::canonical("/proc/self/exe"));
    CLI::App* serving = options.add_to(app);
    CheckOptions checks;
    CLI::App* checking = checks.add_to(app);
    TokenCommand tokens;
    CLI::App* token = tokens.add_to(app);
    ReportQuestions questions;
    questions.add_to(app);
    CLI::App* supervising = app.add_subcommand("supervise", "run one attempt (started by serve)");
    std::filesystem::path attempt;
    supervising->add_option("folder", attempt, "the attempt's folder")->required();
    bool take_lock = false;
    supervising->add_flag("--take-lock", take_lock, "the attempt is not locked yet");
    bool ending = false;
    supervising->add_flag("--end-strays", ending, "the supervisor was killed: end what it left");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const auto place = ServeOptions::explained(error, app, *serving);
        if (!place) return app.exit(error);
        std::cerr << "breachline: " << *place << "\n";
        return static_cast<int>(ExitCode::usage);
    }

    if (*serving) return guarded([&] { return serve(options.settings()); });
    if (*checking) return guarded([&] { return static_cast<int>(check(checks)); });
    if (*token) return guarded([&] { return tokens.run(); });
    if (questions.was_asked()) {
        return guarded(
            [&] {
                questions.answer();
                return 0;
            },
            ExitCode::bad_input);
    }
    // No guard: a supervisor has its own log and exit record, which the service reads.
    if (ending) {
        end_strays(attempt);
        return 0;
    }
    return supervise(attempt, take_lock ? AttemptLock::to_be_taken : AttemptLock::inherited);
}
