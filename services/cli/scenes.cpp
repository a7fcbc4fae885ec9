#include "services/cli/scenes.hpp"

#include <nlohmann/json.hpp>

#include "core/scene/file_paths.hpp"
#include "services/cli/sending.hpp"
#include "services/cli/stored.hpp"
#include "services/cli/study_file.hpp"
#include "services/cli/table.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;

namespace {

/// "dam@2, slope": without a number for the newest version.
std::string names_of(const json& scene) {
    std::string names;
    for (const json& each : scene.at("names"))
        names += (names.empty() ? "" : ", ") + cell(each, "name") + "@" + cell(each, "version");
    return names.empty() ? "-" : names;
}

/// The path of "scene:dam", "scene:sha256/..." or the same without "scene:".
std::string path_of_scene(std::string address) {
    if (address.starts_with(scene::stored_scene)) address.erase(0, scene::stored_scene.size());
    if (address.starts_with("sha256/")) address.erase(0, 7);
    return path_of({"scenes", address});
}

}  // namespace

ExitCode list_scenes(Server& server, const ScenesOptions& options, const Console& console) {
    json scenes = json::array();
    std::string cursor;
    do {
        const json page =
            server.get("/v1/scenes" + query_of({{"search", options.found}, {"cursor", cursor}}));
        for (const json& each : page.at("scenes")) scenes.push_back(each);
        cursor = page.at("next").is_string() ? page["next"].get<std::string>() : "";
    } while (!cursor.empty());
    if (console.style == Style::json) {
        show_json(scenes, console);
        return ExitCode::done;
    }
    std::vector<Cells> rows;
    for (const json& each : scenes)
        rows.push_back({names_of(each), cell(each, "sha256").substr(0, 12),
                        in_bytes(each.at("bytes").get<double>()),
                        cell(each, "created").substr(0, 10),
                        std::to_string(each.at("runs").size())});
    if (rows.empty())
        console.notes << "no scenes are stored\n";
    else
        console.out << as_table({{"names", Align::left},
                                 {"SHA-256", Align::left},
                                 {"size", Align::right},
                                 {"stored", Align::left},
                                 {"runs", Align::right}},
                                rows);
    return ExitCode::done;
}

ExitCode show_scene(Server& server, const ScenesOptions& options, const Console& console) {
    const json answer = server.get(path_of_scene(options.address));
    console.notes << "SHA-256 " << cell(answer, "sha256") << ", " << names_of(answer) << "\n";
    show_json(console.style == Style::json ? answer : answer.at("scene"), console);
    return ExitCode::done;
}

ExitCode add_scene(Server& server, const ScenesOptions& options, const Console& console) {
    const json stored =
        post_scene(server, "/v1/scenes" + query_of({{"name", options.name}}),
                   read_scene_document(options.file),
                   options.send_files ? Sending::always : Sending::where_needed, console);
    if (console.style == Style::json) {
        show_json(stored, console);
        return ExitCode::done;
    }
    for (const json& each : stored.at("names")) {
        if (each.at("name") != options.name) continue;
        console.out << scene::stored_scene << options.name << "@" << cell(each, "version") << "\n";
        return ExitCode::done;
    }
    console.out << cell(stored, "reference") << "\n";
    return ExitCode::done;
}

ExitCode remove_scene(Server& server, const ScenesOptions& options, const Console& console) {
    const json answer = server.remove(path_of_scene(options.address));
    if (console.style == Style::json)
        show_json(answer, console);
    else
        console.out << cell(answer, "id") << "  removed\n";
    return ExitCode::done;
}

void take_scene_words(CLI::App& word, ScenesOptions& options,
                      const std::function<void(ScenesCommand)>& chosen) {
    word.require_subcommand(0, 1);
    const auto add = [&](const char* name, const char* what, const char* example,
                         ScenesCommand command) {
        CLI::App* sub = word.add_subcommand(name, what);
        sub->footer(std::string("Example:\n  breach scenes ") + name + " " + example);
        sub->callback([chosen, command] { chosen(command); });
        return sub;
    };
    add("list", "scenes that the server keeps", "--search dam", list_scenes)
        ->add_option("--search", options.found, "only those with this in a name");
    add("show", "a stored scene, completed", "dam@2 > scene.json", show_scene)
        ->add_option("SCENE", options.address, "NAME, NAME@VERSION or SHA-256")
        ->required();
    CLI::App* store = add("add", "store a scene; prints how a study refers to it",
                          "scene.json --name dam", add_scene);
    store->add_option("SCENE", options.file, "scene file (JSON)")->required();
    store->add_option("--name", options.name,
                      "name of the scene; another scene of this name becomes its next version");
    store->add_flag("--send-files", options.send_files,
                    "send its motions and meshes even to a server on this machine");
    add("rm", "remove a name with all versions, or a content that nothing needs", "dam",
        remove_scene)
        ->add_option("SCENE", options.address, "NAME or SHA-256")
        ->required();
}

}  // namespace breach::cli
