// One description of each option for command line, settings file and --help; docs/reference/cli.md
// is written from it. Checks that need only the text are here; what needs the disk or a program is
// found at the start of serve().
#include "services/orchestrator/serve_options.hpp"

#include <charconv>
#include <fstream>
#include <set>

#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"
#include "core/words/nearest.hpp"

namespace breach::orchestrator {

namespace {

/// Shorter ones could be guessed: requests are not slowed down after a wrong token.
std::string token_in(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string token;
    if (!std::getline(stream, token) || token.size() < 16) {
        throw fault::IoError(file.string() +
                             ": must hold a token of at least 16 characters in its first line");
    }
    return token;
}

/// A shared folder: beside the installed executable, else in the source tree.
std::filesystem::path shared_folder(const std::filesystem::path& self, const char* name,
                                    const char* in_source_tree) {
    const auto installed = self.parent_path().parent_path() / "share" / "breachline" / name;
    return std::filesystem::exists(installed) ? installed : std::filesystem::path(in_source_tree);
}

/// "mpm_solver=2"
std::pair<std::string, std::size_t> limit_in(const std::string& text) {
    const std::size_t equals = text.find('=');
    std::size_t number = 0;
    if (equals != std::string::npos && phases::named(text.substr(0, equals))) {
        const char* const end = text.data() + text.size();
        const auto parsed = std::from_chars(text.data() + equals + 1, end, number);
        if (parsed.ec != std::errc{} || parsed.ptr != end) number = 0;
    }
    if (number == 0)
        throw fault::BadInput("command line", {{"--limit", "\"" + text + "\" is not a limit",
                                                "give PHASE=N with N >= 1, like mpm_solver=2"}});
    return {text.substr(0, equals), number};
}

}  // namespace

ServeOptions::ServeOptions(const std::filesystem::path& self) {
    settings_.self = self;
    settings_.dispatch.bin = self.parent_path();
    // hardware_concurrency() may be 0: unknown.
    settings_.dispatch.slots = std::max(1U, std::thread::hardware_concurrency());
    settings_.web = shared_folder(self, "web", BREACH_WEB);
    settings_.workflows = shared_folder(self, "studies/..", BREACH_WORKFLOWS);
    settings_.http.port = 8470;
}

CLI::App* ServeOptions::add_to(CLI::App& program) {
    program
        .set_config("--config", "", "file with settings, section [serve]; the command line wins")
        ->check(CLI::ExistingFile);
    program.allow_config_extras(CLI::config_extras_mode::error);
    CLI::App* serving =
        program.add_subcommand("serve", "answer requests and run what is submitted");
    serving->fallthrough();  // --config may follow the command
    serving->add_option("--data", settings_.data, "folder of the database and all results")
        ->capture_default_str();
    serving->add_option("--bin", settings_.dispatch.bin, "folder of the phase executables")
        ->capture_default_str();
    serving->add_option("--web", settings_.web, "folder of the dashboard")->capture_default_str();
    add_access_options(*serving);
    add_dispatch(*serving);
    add_files(*serving);
    add_retention(*serving);
    add_slurm(*serving);
    return serving;
}

/// CLI11 names the key ("... parse serve.slotz") or the option ("--slots: Value abc not in range 1
/// to 100000"), but not the line. It is found by reading the file again.
std::optional<std::string> ServeOptions::explained(const CLI::ParseError& error,
                                                   const CLI::App& program,
                                                   const CLI::App& serving) {
    const CLI::Option* const config = program.get_config_ptr();
    if (config->count() == 0) return std::nullopt;
    const std::string said = error.what();
    const bool is_value = said.starts_with("--");
    const std::size_t from = is_value ? 2 : said.find_last_of(" .") + 1;
    const std::string key = said.substr(from, is_value ? said.find(':') - from : said.npos);
    std::ifstream settings(config->as<std::string>());
    std::string line;
    bool is_inside = false;
    for (std::size_t number = 1; std::getline(settings, line); ++number) {
        line = CLI::detail::trim_copy(line);
        const std::string place = config->as<std::string>() + ":" + std::to_string(number) + ": ";
        if (line.starts_with('[')) {
            is_inside = line == "[serve]";
            if (!is_inside) return place + "write the section as [serve]";
            continue;
        }
        const std::size_t equals = line.find('=');
        if (line.empty() || line.starts_with('#') || line.starts_with(';')) continue;
        if (!is_inside) return place + "put the line [serve] before the first key";
        if (equals == line.npos) return place + "write the entry as KEY=VALUE";
        if (CLI::detail::trim_copy(line.substr(0, equals)) != key) continue;
        if (!is_value) {
            std::vector<std::string> known;
            for (const CLI::Option* each : serving.get_options())
                for (const std::string& name : each->get_lnames()) known.push_back(name);
            const std::string meant = words::nearest(key, known);
            return place + "unknown key \"" + key + "\"" +
                   (meant.empty() ? "; `breachline serve --help` lists them"
                                  : "; did you mean " + meant + "?");
        }
        // The command line wins: its values are not those of the file.
        const std::string value = CLI::detail::trim_copy(line.substr(equals + 1));
        if (said.find(value.substr(value.find_last_of(' ') + 1)) != said.npos)
            return place + key + said.substr(said.find(':'));
    }
    return std::nullopt;
}

void ServeOptions::add_access_options(CLI::App& serving) {
    serving.add_option("--host", settings_.http.host, "address to bind")->capture_default_str();
    serving.add_option("--port", settings_.http.port, "0: any free one")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    serving.add_option("--token-file", token_file_,
                       "file whose first line is the token that clients must send");
    serving.add_option("--tokens", settings_.http.tokens,
                       "file of named tokens with rights (breachline token new NAME --rights ...)");
    serving
        .add_option("--allow-folder", allowed_folders_,
                    "scenes may name files below it by their paths; repeatable. Not given: "
                    "everywhere, or with "
                    "tokens nowhere, only files that were sent")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void ServeOptions::add_dispatch(CLI::App& serving) {
    DispatchSettings& dispatch = settings_.dispatch;
    serving.add_option("--slots", dispatch.slots, "cores that running phases may occupy together")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    serving
        .add_option("--memory", dispatch.memory_mb,
                    "MB that running phases may ask for together; 0: not limited")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    serving.add_option("--limit", limits_, "at most N of a phase at the same time, as PHASE=N")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    serving.add_option("--grace", dispatch.grace_seconds, "seconds between TERM and KILL")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
    serving.add_option("--tries", dispatch.most_tries, "attempts per task")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    serving
        .add_option("--retry-delay", retry_seconds_,
                    "seconds before the first retry; doubled each time")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
}

void ServeOptions::add_retention(CLI::App& serving) {
    serving
        .add_option("--keep-days", settings_.retention.keep_days,
                    "remove runs that ended more days ago; not given: never")
        ->check(CLI::NonNegativeNumber);
    serving
        .add_option(
            "--keep-gb", settings_.retention.keep_gb,
            "remove the runs that ended first when the data folder holds more GB; not given: "
            "never")
        ->check(CLI::NonNegativeNumber);
}

void ServeOptions::add_files(CLI::App& serving) {
    serving
        .add_option("--largest-file", settings_.largest_file_mb,
                    "MB that a motion or a mesh may have, sent or named by its path")
        ->check(CLI::Range(1, 65536))
        ->capture_default_str();
}

void ServeOptions::add_slurm(CLI::App& serving) {
    SlurmSettings& slurm = settings_.slurm;
    const std::map<std::string, Place> places{{"local", Place::local}, {"slurm", Place::slurm}};
    serving
        .add_option("--executor", settings_.place,
                    "where phases run: local (this machine) or slurm")
        ->transform(CLI::CheckedTransformer(places))
        ->default_str("local");
    serving
        .add_option("--slurm-option", slurm.options,
                    "further option of sbatch, like --partition=work; repeatable")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    serving
        .add_option("--slurm-poll", slurm.poll_seconds, "seconds between two looks at the queue")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    serving
        .add_option("--slurm-grace", slurm.grace_seconds,
                    "seconds without a sign of life before an attempt is given up")
        ->check(CLI::Range(0.1, 86400.0))
        ->capture_default_str();
    serving
        .add_option("--slurm-command-limit", slurm.command_seconds,
                    "seconds that sbatch, squeue or scancel may take")
        ->check(CLI::Range(0.1, 3600.0))
        ->capture_default_str();
    serving
        .add_option("--slurm-throttle", slurm.throttle,
                    "tasks of one array job at the same time; 0: not limited")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
}

/// Includes the folder of the shipped studies, whose scenes name files there.
std::vector<std::filesystem::path> ServeOptions::allowed() const {
    std::vector<std::filesystem::path> folders{settings_.workflows};
    for (const std::filesystem::path& each : allowed_folders_) {
        if (!std::filesystem::is_directory(each))
            throw fault::BadInput("command line",
                                  {{"--allow-folder", each.string() + " is no folder",
                                    "give a folder that is there"}});
        folders.push_back(std::filesystem::canonical(each));
    }
    return folders;
}

ServeSettings ServeOptions::settings() const {
    ServeSettings wanted = settings_;
    wanted.dispatch.bin = std::filesystem::absolute(wanted.dispatch.bin);
    wanted.dispatch.retry_delay =
        std::chrono::milliseconds(static_cast<int>(1000 * retry_seconds_));
    for (const std::string& each : limits_) wanted.dispatch.limits.insert(limit_in(each));
    if (!token_file_.empty()) wanted.http.token = token_in(token_file_);
    // With tokens, several people use the service: a scene of one must not read any file that the
    // service can read. Nothing in allowed_folders means everywhere.
    const bool tokens = !wanted.http.token.empty() || !wanted.http.tokens.empty();
    if (tokens || !allowed_folders_.empty()) wanted.allowed_folders = allowed();
    return wanted;
}

}  // namespace breach::orchestrator
