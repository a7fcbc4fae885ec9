// breachline serve | supervise
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <fstream>
#include <iostream>
#include <optional>
#include <set>

#include "core/fault/fault.hpp"
#include "services/orchestrator/executors/supervisor.hpp"
#include "services/orchestrator/serve.hpp"

using breach::fault::ExitCode;
using namespace breach::orchestrator;

namespace {

std::string token_in(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string token;
    if (!std::getline(stream, token) || token.size() < 16) {
        throw breach::fault::IoError(
            file.string() + ": must hold a token of at least 16 characters in its first line");
    }
    return token;
}

/// A shared folder: installed beside the executable, else in the source tree.
std::filesystem::path shared_folder(const std::filesystem::path& self, const char* name,
                                    const char* in_source_tree) {
    const auto installed = self.parent_path().parent_path() / "share" / "breachline" / name;
    return std::filesystem::exists(installed) ? installed : std::filesystem::path(in_source_tree);
}

/// "mpm_solver=2"
std::optional<std::pair<std::string, std::size_t>> limit_in(const std::string& text) {
    static const std::set<std::string> phases{"lem_tool", "fem_solver", "transfer_tool",
                                              "mpm_solver"};
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || !phases.contains(text.substr(0, equals)))
        return std::nullopt;
    std::size_t number = 0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data() + equals + 1, end, number);
    if (parsed.ec != std::errc{} || parsed.ptr != end || number == 0) return std::nullopt;
    return std::pair{text.substr(0, equals), number};
}

int guarded_serve(const ServeSettings& settings) {
    try {
        return serve(settings);
    } catch (const breach::fault::BadInput& error) {
        std::cerr << "breachline: " << error.what() << "\n";
        return static_cast<int>(ExitCode::usage);
    } catch (const std::exception& error) {
        std::cerr << "breachline: " << error.what() << "\n";
        return static_cast<int>(ExitCode::io);
    }
}

}  // namespace

int main(int argc, char** argv) {
    ServeSettings settings;
    settings.self = std::filesystem::canonical("/proc/self/exe");
    settings.dispatch.bin = settings.self.parent_path();
    settings.dispatch.slots = std::max(1U, std::thread::hardware_concurrency());
    settings.web = shared_folder(settings.self, "web", BREACH_WEB);
    settings.workflows = shared_folder(settings.self, "studies/..", BREACH_WORKFLOWS);
    settings.http.port = 8470;
    std::filesystem::path token_file;
    std::filesystem::path attempt;
    double retry_seconds = 0.5;
    std::vector<std::string> limits;

    CLI::App app("Runs studies: FEM, transfers, MPM, and what connects them", "breachline");
    app.set_version_flag("--version", "breachline " BREACH_VERSION);
    app.require_subcommand(1);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    CLI::App* serving = app.add_subcommand("serve", "answer requests and run what is submitted");
    serving->add_option("--data", settings.data, "folder of the database and all results")
        ->capture_default_str();
    serving->add_option("--host", settings.http.host, "address to bind")->capture_default_str();
    serving->add_option("--port", settings.http.port, "0: any free one")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    serving
        ->add_option("--slots", settings.dispatch.slots,
                     "cores that running phases may occupy together")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    serving
        ->add_option("--memory", settings.dispatch.memory_mb,
                     "MB that running phases may ask for together; 0: not limited")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    serving->add_option("--limit", limits, "at most N of a phase at the same time, as PHASE=N")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    serving->add_option("--bin", settings.dispatch.bin, "folder of the phase executables")
        ->capture_default_str();
    serving->add_option("--web", settings.web, "folder of the dashboard")->capture_default_str();
    serving->add_option("--token-file", token_file,
                        "file whose first line is the token that clients must send");
    serving->add_option("--grace", settings.dispatch.grace_seconds, "seconds between TERM and KILL")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
    serving->add_option("--tries", settings.dispatch.most_tries, "attempts per task")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    serving
        ->add_option("--retry-delay", retry_seconds,
                     "seconds before the first retry; doubled each time")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
    CLI::App* supervising = app.add_subcommand("supervise", "run one attempt (started by serve)");
    supervising->add_option("folder", attempt, "the attempt's folder")->required();
    CLI11_PARSE(app, argc, argv);

    if (*supervising) return supervise(attempt);
    spdlog::set_default_logger(spdlog::stderr_color_mt("breachline"));
    spdlog::set_pattern("%H:%M:%S %n %l: %v");
    settings.dispatch.bin = std::filesystem::absolute(settings.dispatch.bin);
    settings.dispatch.retry_delay =
        std::chrono::milliseconds(static_cast<int>(1000 * retry_seconds));
    for (const std::string& each : limits) {
        const auto limit = limit_in(each);
        if (!limit) {
            std::cerr << "breachline: --limit " << each << ": must be PHASE=N with N >= 1\n";
            return static_cast<int>(ExitCode::usage);
        }
        settings.dispatch.limits.insert(*limit);
    }
    if (!token_file.empty()) settings.http.token = token_in(token_file);
    return guarded_serve(settings);
}
