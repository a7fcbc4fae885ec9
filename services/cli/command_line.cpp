// Reads the command line of `breach`: adds the program's own options and every command, lets the
// chosen one run, and turns what it throws into a message and an exit code. main() calls run() and
// does nothing else. Parsing ends before the first request: a wrong flag costs no connection.
// Commands know nothing of arguments, so that tests call them with options.
#include "services/cli/command_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iostream>

#include "core/version/version.hpp"
#include "services/cli/completion.hpp"
#include "services/cli/program.hpp"
#include "services/cli/spelling.hpp"
#include "services/cli/table.hpp"

namespace breach::cli {

using fault::ExitCode;

namespace {

constexpr const char* default_server = "http://127.0.0.1:8470";

/// The program's own options: where the server is, and how answers are printed.
struct Connection {
    std::string server = default_server;
    std::string token_file;
    std::filesystem::path authority;
    bool json = false;
    bool quiet = false;
};

/// From a file, because others on the machine can read a program's arguments.
std::optional<std::string> read_token(const std::string& file) {
    if (file.empty()) return std::nullopt;
    std::ifstream stream(file);
    std::string token;
    if (!(stream >> token)) throw fault::IoError(file + ": holds no token, or cannot be read");
    return token;
}

/// A flag wins over its environment variable, so that one call can use another server.
void add_own_options(CLI::App& app, Connection& to) {
    app.set_version_flag("--version", std::string("breach ") + version());
    app.require_subcommand(1);
    app.fallthrough();  // --json may follow the command
    app.add_option("--server", to.server, "the server's address")
        ->envname("BREACH_SERVER")
        ->capture_default_str()
        ->check([](const std::string& url) {
            return address_from(url) ? "" : url + " is not an address such as " + default_server;
        });
    app.add_option("--token-file", to.token_file, "file with the bearer token")
        ->envname("BREACH_TOKEN_FILE");
    app.add_option("--tls-ca", to.authority,
                   "PEM file of the authorities to trust instead of the system's")
        ->envname("BREACH_TLS_CA");
    app.add_flag("--json", to.json, "the server's answer as JSON");
    app.add_flag("-q,--quiet", to.quiet,
                 "only what was asked for, and faults; no progress, no remarks");
    app.footer(
        "RUN: an id, its beginning, a name (the newest run of it), or `latest`. Exit codes: 0 "
        "done, 2 usage, 65 refused, 70 the run failed "
        "(with\n"
        "--strict: or is questionable), 74 file fault, 75 the server does not answer.");
}

void add_completion(Program& program) {
    const auto shell = program.add<std::string>(
        "completion", "print a script that completes words in a shell",
        "bash > ~/.local/share/bash-completion/completions/breach\n"
        "  breach completion zsh > ~/.zfunc/_breach\n"
        "  breach completion fish > ~/.config/fish/completions/breach.fish",
        [&program](Server&, const std::string& name, const Console& console) {
            console.out << completion(program.app, name);
            return ExitCode::done;
        });
    shell.word.add_option("SHELL", shell.options, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
}

/// Throws CLI::ParseError.
void parse(CLI::App& app, int argc, char** argv) {
    std::vector<std::string> words(argv + 1, argv + argc);
    if (const auto command = command_in(app, words); command != words.end())
        std::rotate(words.begin(), command, command + 1);
    std::ranges::reverse(words);  // CLI11 expects reversed arguments
    app.parse(words);
}

/// --quiet silences the notes only: faults go through tell(), which writes to stderr itself.
ExitCode execute(const Program& program, const Connection& to) {
    Server server(*address_from(to.server), read_token(to.token_file), to.authority);
    const Style style = to.json ? Style::json : program.csv ? Style::csv : Style::people;
    const Screen screen = to.quiet                     ? Screen::quiet
                          : isatty(STDOUT_FILENO) == 1 ? Screen::terminal
                                                       : Screen::plain;
    std::ostream nowhere(nullptr);
    return program.chosen(server, {std::cout, to.quiet ? nowhere : std::cerr, style, screen});
}

/// Everything may come from the server and passes through harmless().
void tell(const std::string& summary, const std::vector<fault::Fault>& faults) {
    std::cerr << "breach: " << harmless(summary) << "\n";
    for (const fault::Fault& each : faults) {
        std::cerr << "  " << (each.pointer.empty() ? "/" : harmless(each.pointer)) << ": "
                  << harmless(each.cause) << "\n";
        if (!each.remedy.empty()) std::cerr << "      remedy: " << harmless(each.remedy) << "\n";
    }
}

/// The only place that turns exceptions into exit codes. An answer with another form counts as a
/// fault of reading: the server may be newer.
ExitCode guarded(const Program& program, const Connection& to) {
    try {
        return execute(program, to);
    } catch (const Refused& error) {
        tell(error.what(), error.faults());
        return ExitCode::bad_input;
    } catch (const fault::BadInput& error) {
        // Not through harmless(), which would remove the line breaks of the list. These faults are
        // about files that the user named.
        std::cerr << "breach: " << error.what() << "\n";  // what() lists the faults
        return ExitCode::bad_input;
    } catch (const Unreachable& error) {
        tell(error.what(), {});
        return ExitCode::try_again;
    } catch (const fault::IoError& error) {
        tell(error.what(), {});
        return ExitCode::io;
    } catch (const nlohmann::json::exception& error) {
        tell(std::string("the server's answer is not what this version expects: ") + error.what(),
             {});
        return ExitCode::io;
    } catch (const std::exception& error) {
        tell(error.what(), {});
        return ExitCode::io;
    }
}

}  // namespace

int run(int argc, char** argv) {
    std::signal(SIGPIPE, SIG_IGN);  // a lost server gets its own message
    Program program;
    Connection to;
    add_own_options(program.app, to);
    add_words_of_runs(program);
    add_words_of_results(program);
    add_words_of_documents(program);
    add_words_of_server(program);
    add_completion(program);
    try {
        parse(program.app, argc, argv);
    } catch (const CLI::ParseError& error) {
        return explain(program.app, error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    }
    const ExitCode code = guarded(program, to);
    // A full disk or a closed pipe shows at the last flush: a cut file must not end with code 0.
    std::cout.flush();
    if (!std::cout && code == ExitCode::done) return static_cast<int>(ExitCode::io);
    return static_cast<int>(code);
}

}  // namespace breach::cli
