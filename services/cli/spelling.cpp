// Words of the command line that are no command or option. Separate from command_line.cpp, because
// it only reads the finished CLI::App: it knows every name that --help shows, and no command.
#include "services/cli/spelling.hpp"

#include <algorithm>
#include <iostream>

#include "core/words/list.hpp"
#include "core/words/nearest.hpp"
#include "services/cli/table.hpp"

namespace breach::cli {

namespace {

/// The innermost given command; without one, the program.
const CLI::App& named_command(const CLI::App& program) {
    const CLI::App* named = &program;
    while (!named->get_subcommands().empty()) named = named->get_subcommands().front();
    return *named;
}

std::vector<std::string> names_below(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* each : app.get_subcommands(nullptr))
        if (!each->get_name().empty()) names.push_back(each->get_name());
    return names;
}

/// Options of the command, of its groups and of the program.
std::vector<std::string> options_of(const CLI::App& program, const CLI::App& app) {
    std::vector<std::string> names;
    const auto add_all = [&](const CLI::App& from) {
        for (const CLI::Option* each : from.get_options())
            for (const std::string& name : each->get_lnames()) names.push_back("--" + name);
    };
    add_all(program);
    add_all(app);
    for (const CLI::App* group : app.get_subcommands(nullptr))
        if (group->get_name().empty()) add_all(*group);
    return names;
}

/// Empty where no name is near: a far suggestion would mislead.
std::string meant(const std::string& word, const std::vector<std::string>& known) {
    const std::string nearest = words::nearest(word, known);
    return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace

/// A value may be spelt like a command, as in `--key list`: a word after an option that takes a
/// value is none.
std::vector<std::string>::iterator command_in(const CLI::App& program,
                                              std::vector<std::string>& words) {
    const auto takes_value = [](const CLI::App& app, const std::string& name) {
        const CLI::Option* option = app.get_option_no_throw(name);
        return option && option->get_items_expected_max() > 0;
    };
    const auto commands = program.get_subcommands(nullptr);
    for (auto word = words.begin(); word != words.end(); ++word) {
        const bool is_command = std::ranges::any_of(
            commands, [&](const CLI::App* each) { return each->get_name() == *word; });
        if (!is_command) continue;
        const bool is_value = word != words.begin() && (word - 1)->starts_with("-") &&
                              (takes_value(program, *(word - 1)) ||
                               std::ranges::any_of(commands, [&](const CLI::App* each) {
                                   return takes_value(*each, *(word - 1));
                               }));
        if (!is_value) return word;
    }
    return words.end();
}

/// CLI11 would print "The following argument was not expected". Required and excluded options keep
/// its message, which names the option.
/// Options first: CLI11 also counts the values of an unknown option among the unknown words.
int explain(const CLI::App& program, const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // help was requested
    const CLI::App& named = named_command(program);
    std::string name = named.get_name();
    for (const CLI::App* each = named.get_parent(); each; each = each->get_parent())
        name = each->get_name() + " " + name;
    const std::vector<std::string> unknown = program.remaining(true);
    const auto option = std::ranges::find_if(
        unknown, [](const std::string& each) { return each.starts_with("-"); });
    const std::vector<std::string> known = names_below(named);
    if (option != unknown.end()) {
        std::cerr << name << ": unknown option " << harmless(*option)
                  << meant(option->substr(0, option->find('=')), options_of(program, named))
                  << "; `" << name << " --help` lists them\n";
    } else if (!unknown.empty() && !known.empty()) {
        std::cerr << name << ": unknown command \"" << harmless(unknown.front()) << "\""
                  << meant(unknown.front(), known)
                  << "; the commands are: " << words::list_of(known) << "\n";
    } else if (error.get_name() == "RequiredError" && !named.get_parent()) {
        std::cerr << "breach: give a command: " << words::list_of(known)
                  << "\nFor example: breach submit study.json --watch\n";
    } else {
        return program.exit(error);
    }
    return error.get_exit_code();
}

}  // namespace breach::cli
