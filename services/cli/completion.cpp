// Scripts for bash and fish, made from the program's own options, so that they cannot lag behind.
// Ids of runs are asked for when the user presses the key, by a call of breach.
#include "services/cli/completion.hpp"

#include <nlohmann/json.hpp>

namespace breach::cli {

namespace {

/// Long names only: a short one is a single letter, which needs no completion.
std::string options_of(const CLI::App& app) {
    std::string words;
    for (const CLI::Option* each : app.get_options())
        for (const std::string& name : each->get_lnames()) words += " --" + name;
    return words;
}

/// Options of a command, including those of its unnamed option groups.
std::string all_options_of(const CLI::App& word) {
    std::string words = options_of(word);
    for (const CLI::App* group : word.get_subcommands(nullptr)) words += options_of(*group);
    return words;
}

/// Subcommands of a command; option groups have no name.
std::string words_below(const CLI::App& word) {
    std::string words;
    for (const CLI::App* each : word.get_subcommands(nullptr))
        if (!each->get_name().empty()) words += (words.empty() ? "" : " ") + each->get_name();
    return words;
}

/// take_run() in program.hpp and similar positionals name it RUN.
bool takes_a_run(const CLI::App& word) {
    for (const CLI::Option* each : word.get_options())
        if (each->get_positional() && each->get_name().starts_with("RUN")) return true;
    return false;
}

/// By sed, as jq may not be installed; it relies on the indentation of --json.
/// Without a server the key offers `latest` alone; a message would land in the line that the user
/// types.
constexpr const char* ids_of_runs =
    R"sed(breach --json list 2>/dev/null | sed -n 's/^    "id": "\(.*\)",$/\1/p')sed";

/// For fish, where \' stands for a quote within quotes. POSIX shells have no such escape.
std::string quoted(const std::string& text) {
    std::string safe = "'";
    for (const char each : text) safe += each == '\'' ? std::string("\\'") : std::string(1, each);
    return safe + "'";
}

void add_fish_options(const CLI::App& word, const std::string& when, std::string& script) {
    for (const CLI::Option* each : word.get_options()) {
        // -r tells fish that a value follows; it then offers files instead of the next option.
        const bool has_value = each->get_items_expected_max() > 0;
        for (const std::string& name : each->get_lnames())
            script += "complete -c breach" + when + " -l " + name + (has_value ? " -r" : "") +
                      " -d " + quoted(each->get_description()) + "\n";
    }
}

/// In fish each option is a line, with the command as its condition.
std::string fish_completion(const CLI::App& program) {
    std::string script =
        "# Completes the words of breach in fish; made by: breach completion fish\n";
    add_fish_options(program, "", script);
    for (const CLI::App* each : program.get_subcommands(nullptr)) {
        const std::string when = " -n " + quoted("__fish_seen_subcommand_from " + each->get_name());
        script += "complete -c breach -f -n __fish_use_subcommand -a " + each->get_name() + " -d " +
                  quoted(each->get_description()) + "\n";
        add_fish_options(*each, when, script);
        for (const CLI::App* group : each->get_subcommands(nullptr)) {
            if (group->get_name().empty())
                add_fish_options(*group, when, script);
            else
                script += "complete -c breach -f" + when + " -a " + group->get_name() + "\n";
        }
        if (takes_a_run(*each))
            script += "complete -c breach -f" + when + " -a " +
                      quoted("latest (" + std::string(ids_of_runs) + ")") + "\n";
    }
    return script;
}

/// The first word that is no option is the command; the tables of commands and options are written
/// into the script, so that completing needs no call of breach except for ids of runs.
std::string bash_completion(const CLI::App& program) {
    std::string words;
    std::string cases;
    std::string runs;
    std::string below;
    for (const CLI::App* each : program.get_subcommands(nullptr)) {
        words += (words.empty() ? "" : " ") + each->get_name();
        cases += "        " + each->get_name() + ") options=\"" + all_options_of(*each) + "\" ;;\n";
        if (takes_a_run(*each)) runs += (runs.empty() ? "" : "|") + each->get_name();
        if (const std::string known = words_below(*each); !known.empty())
            below += "        " + each->get_name() + ") COMPREPLY=($(compgen -W \"" + known +
                     "\" -- \"$current\")) ;;\n";
    }
    return R"bash(# Completes the words of breach in bash; made by: breach completion bash
_breach() {
    local current=${COMP_WORDS[COMP_CWORD]} word="" options="" each
    for each in "${COMP_WORDS[@]:1:$((COMP_CWORD - 1))}"; do
        case $each in -*) ;; *) word=$each; break ;; esac
    done
    case $word in
        "") COMPREPLY=($(compgen -W ")bash" +
           words + options_of(program) + R"bash(" -- "$current")); return ;;
)bash" + cases +
           R"bash(    esac
    if [[ $current == -* ]]; then
        COMPREPLY=($(compgen -W "$options)bash" +
           options_of(program) + R"bash(" -- "$current"))
        return
    fi
    case $word in
        )bash" +
           runs + R"bash()
            COMPREPLY=($(compgen -W "latest $()bash" +
           ids_of_runs + R"bash()" -- "$current")) ;;
)bash" + below +
           R"bash(        completion) COMPREPLY=($(compgen -W "bash zsh fish" -- "$current")) ;;
        *) COMPREPLY=($(compgen -f -- "$current")) ;;
    esac
}
complete -o filenames -F _breach breach
)bash";
}

}  // namespace

std::string completion(const CLI::App& program, const std::string& shell) {
    if (shell == "fish") return fish_completion(program);
    const std::string bash = bash_completion(program);
    if (shell == "bash") return bash;
    // zsh reads the file at the first completion, and its last line answers it.
    return "#compdef breach\nautoload -U +X bashcompinit && bashcompinit\n" + bash +
           "_bash_complete -o filenames -F _breach\n";
}

}  // namespace breach::cli
