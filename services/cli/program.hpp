// The program `breach` as CLI11 knows it, and its commands. Each command owns the options that it
// reads; command_line.cpp adds the commands before it parses and runs the one that was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

#include "core/fault/fault.hpp"
#include "services/cli/console.hpp"
#include "services/cli/http/server.hpp"

namespace breach::cli {

using Command = std::function<fault::ExitCode(Server&, const Console&)>;

/// A command and its options, for adding their words.
template <class Options>
struct Added {
    CLI::App& word;
    Options& options;  ///< filled by the parser; lives as long as the program
};

/// Lives in run() and is not moved: CLI11 and the callbacks keep its address.
struct Program {
    CLI::App app{"Talks to a Breachline server: submits studies and shows their results.",
                 "breach"};
    bool csv = false;  ///< commands that can print a table as CSV have a flag for it
    Command chosen{};  ///< set by the parser: parsing ends before the first request

    /// `example`: working arguments, for the command's help.
    CLI::App& add(const std::string& word, const std::string& what, const std::string& example,
                  Command command) {
        CLI::App* sub = app.add_subcommand(word, what);
        sub->footer("Example:\n  breach " + word + " " + example);
        sub->callback([this, command = std::move(command)] { chosen = command; });
        return *sub;
    }

    /// The same for a command with options. CLI11 keeps addresses of what it fills, so that the
    /// options are shared with the command, which outlives this call.
    template <class Options, class Run>
    Added<Options> add(const std::string& word, const std::string& what, const std::string& example,
                       Run run) {
        const auto options = std::make_shared<Options>();
        return {add(word, what, example,
                    [=](Server& server, const Console& console) {
                        return run(server, *options, console);
                    }),
                *options};
    }
};

/// In the order of the help.
void add_words_of_runs(Program& program);
void add_words_of_results(Program& program);
void add_words_of_documents(Program& program);
void add_words_of_server(Program& program);

/// The argument RUN, which completion.cpp recognises by this name.
inline void take_run(CLI::App& word, std::string& run) {
    word.add_option("RUN", run, "which run")->required();
}

}  // namespace breach::cli
