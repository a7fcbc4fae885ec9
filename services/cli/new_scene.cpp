// `breach new`: the command's options are made from the catalogue in services/templates, so that a
// new template or option needs no code here. Called before any server runs: a first scene must not
// depend on one.
#include "services/cli/new_scene.hpp"

#include <algorithm>

#include "core/exchange/publish.hpp"
#include "core/words/number.hpp"
#include "services/cli/table.hpp"
#include "services/templates/templates.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;
using templates::Kind;
using templates::Option;

namespace {

/// "starter_height" is --starter-height.
std::string flag_of(std::string name) {
    std::ranges::replace(name, '_', '-');
    return "--" + name;
}

/// The unit "1" marks numbers without one.
std::string with_unit(double value, const Option& option) {
    return words::text_of(value, 5) + (option.unit == "1" ? "" : " " + option.unit);
}

/// Range and default come from the template, so that help and faults agree.
std::string help_of(const Option& option) {
    if (option.kind == Kind::yes_or_no)
        return option.help + " (default " + (option.value > 0.5 ? "yes" : "no") + ")";
    const std::string rule = templates::rule_of(option);
    return option.help + " (" + words::text_of(option.least) + " to " +
           with_unit(option.most, option) + "; default " + (rule.empty() ? "" : rule + " = ") +
           with_unit(option.value, option) + ")";
}

/// The text as a number if it is one; else the template reports the fault.
json value_of(const std::string& text) {
    const json value = json::parse(text, nullptr, false);
    return value.is_number() ? value : json(text);
}

/// A yes-or-no option has two flags. The one that repeats the default is accepted and not listed.
void take_option(CLI::App& word, const Option& option, NewOptions& chosen) {
    const std::string flag = flag_of(option.name);
    if (option.kind == Kind::yes_or_no) {
        const auto add = [&](const std::string& name, bool value) {
            CLI::Option* made = word.add_flag_callback(
                name, [&chosen, entry = option.name, value] { chosen.options[entry] = value; },
                help_of(option));
            if (value == (option.value > 0.5)) made->group("");  // hidden in the help: no effect
        };
        add(flag, true);
        add("--no-" + flag.substr(2), false);
        return;
    }
    word.add_option_function<std::string>(
            flag,
            [&chosen, name = option.name](const std::string& text) {
                chosen.options[name] = value_of(text);
            },
            help_of(option))
        ->type_name(option.unit == "1" ? "N" : option.unit);
}

/// A name from the folder's name, as far as names allow its characters.
/// The detour over "/." gives `.` and `dams/` the name of their folder too. Where the folder's name
/// does not fit a scene's (64 characters, lower case), the template chooses one.
std::string name_for(const std::filesystem::path& folder) {
    std::string name =
        std::filesystem::absolute(folder / ".").lexically_normal().parent_path().filename();
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    const bool fits = !name.empty() && name.size() <= 64 &&
                      std::isalnum(static_cast<unsigned char>(name[0])) &&
                      std::ranges::all_of(name, [](unsigned char c) {
                          return (std::isalnum(c) && c < 0x80) || c == '_' || c == '-';
                      });
    return fits ? name : "";
}

void list_templates(const Console& console) {
    if (shown_as_json(templates::as_json(templates::catalogue()), console)) return;
    for (const templates::Template& each : templates::catalogue())
        console.out << each.name << std::string(18 - each.name.size(), ' ') << each.title << "\n";
    console.notes << "`breach new NAME --help` says what can be asked of each\n";
}

/// Names options in faults as flags if they were given as flags.
/// The dashboard calls the same templates with JSON, where a fault's pointer is an entry.
templates::Made made_of(const NewOptions& chosen, const json& options) {
    try {
        return templates::make(chosen.made_from, options);
    } catch (const fault::BadInput& refusal) {
        std::vector<fault::Fault> faults = refusal.faults();
        for (fault::Fault& each : faults)
            if (each.pointer.size() > 1) each.pointer = flag_of(each.pointer.substr(1));
        throw fault::BadInput("breach new " + chosen.made_from, std::move(faults));
    }
}

}  // namespace

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw fault::IoError(folder.string() + ": cannot be made: " + error.message());
}

void write_files(const Files& files) {
    for (const auto& [path, text] : files) {
        if (path.has_parent_path()) make_folder(path.parent_path());
        exchange::publish_text(path, text);
    }
}

/// All at once, before the first file is written.
void refuse_to_overwrite(const Files& files, const std::string& command) {
    std::vector<fault::Fault> faults;
    for (const auto& [path, text] : files)
        if (std::filesystem::exists(path))
            faults.push_back(
                {path, "is there already", "give --force to write over it, or another --output"});
    if (!faults.empty()) throw fault::BadInput(command, std::move(faults));
}

std::string help_of_dam(const std::string& option) {
    const auto& options = templates::named("upstream_dam").options;
    return help_of(*std::ranges::find(options, option, &Option::name));
}

void take_templates(CLI::App& word, NewOptions& chosen) {
    word.add_flag("--list", chosen.list, "the templates");
    word.require_subcommand(0, 1);
    for (const templates::Template& each : templates::catalogue()) {
        CLI::App* sub = word.add_subcommand(each.name, each.title);
        for (const Option& option : each.options) take_option(*sub, option, chosen);
        sub->add_option_function<std::string>(
            "--name", [&chosen](const std::string& name) { chosen.options["name"] = name; },
            "of scene and study; without it that of the folder");
        sub->add_option(
            "--output", chosen.folder,
            "folder for scene.json and study.json; without it one that is named like the template");
        sub->add_flag("--force", chosen.force, "write over the files that are there");
        sub->callback([&chosen, name = each.name] { chosen.made_from = name; });
        sub->footer("Example:\n  breach new " + each.name + " --height 20 --output my_" +
                    each.name);
    }
}

/// Without a template it lists them, so that `breach new` alone is a beginning.
ExitCode make_new(const NewOptions& chosen, const Console& console) {
    if (chosen.made_from.empty()) {
        list_templates(console);
        return ExitCode::done;
    }
    const std::filesystem::path folder =
        chosen.folder.empty() ? std::filesystem::path(chosen.made_from) : chosen.folder;
    json options = chosen.options;
    if (const std::string name = name_for(folder); !options.contains("name") && !name.empty())
        options["name"] = name;
    const templates::Made made = made_of(chosen, options);
    Files files{{folder / "scene.json", templates::as_text(made.scene)},
                {folder / "study.json", templates::as_text(made.study)}};
    if (!made.motion.empty()) files[folder / "motion.csv"] = made.motion;
    // After make(): wrong options are reported even where the files exist.
    if (!chosen.force) refuse_to_overwrite(files, "breach new");
    write_files(files);
    json written = json::array();
    for (const auto& [path, text] : files) written.push_back(path.string());
    if (shown_as_json(
            {{"template", chosen.made_from}, {"options", made.options}, {"files", written}},
            console))
        return ExitCode::done;
    for (const json& each : written) console.out << each.get<std::string>() << "\n";
    const std::string study = (folder / "study.json").string();
    console.notes << "The notes of scene.json list the assumptions. Next:\n"
                  << "  breach draw " << study << " --output " << (folder / "section.svg").string()
                  << "    # look at it, and at what it will cost\n"
                  << "  breach submit " << study << " --watch\n"
                  << "  breach results latest\n";
    return ExitCode::done;
}

}  // namespace breach::cli
