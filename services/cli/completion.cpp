#include "services/cli/completion.hpp"

#include <nlohmann/json.hpp>

namespace breach::cli {

namespace {

std::string options_of(const CLI::App& app) {
    std::string words;
    for (const CLI::Option* each : app.get_options())
        for (const std::string& name : each->get_lnames()) words += " --" + name;
    return words;
}

/// The options of option groups, which have no name of their own, count as the word's.
std::string all_options_of(const CLI::App& word) {
    std::string words = options_of(word);
    for (const CLI::App* group : word.get_subcommands(nullptr)) words += options_of(*group);
    return words;
}

/// Words below a word; option groups have none.
std::string words_below(const CLI::App& word) {
    std::string words;
    for (const CLI::App* each : word.get_subcommands(nullptr))
        if (!each->get_name().empty()) words += (words.empty() ? "" : " ") + each->get_name();
    return words;
}

bool takes_a_run(const CLI::App& word) {
    for (const CLI::Option* each : word.get_options())
        if (each->get_positional() && each->get_name().starts_with("RUN")) return true;
    return false;
}

}  // namespace

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
    for each in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
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
            COMPREPLY=($(compgen -W "latest $(breach --json list 2>/dev/null |
                sed -n 's/^    "id": "\(.*\)",$/\1/p')" -- "$current")) ;;
)bash" + below +
           R"bash(        completion) COMPREPLY=($(compgen -W "bash" -- "$current")) ;;
        *) COMPREPLY=($(compgen -f -- "$current")) ;;
    esac
}
complete -o filenames -F _breach breach
)bash";
}

}  // namespace breach::cli
