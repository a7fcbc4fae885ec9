// Scenes stored by the server: listing, showing, storing and removing them.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>

#include "services/cli/commands.hpp"

namespace breach::cli {

struct ScenesOptions {
    std::string address;  ///< NAME, NAME@3, SHA-256, or a reference with "scene:" before it
    std::filesystem::path file;
    std::string name;   ///< name to store it under; empty: no name, only its hash
    std::string found;  ///< only scenes with this text in a name; empty: all
    bool send_files = false;
};

fault::ExitCode list_scenes(Server& server, const ScenesOptions& options, const Console& console);
/// Prints only the completed scene, so that it can be redirected into a file.
fault::ExitCode show_scene(Server& server, const ScenesOptions& options, const Console& console);
/// Stores the scene and prints how a study refers to it.
fault::ExitCode add_scene(Server& server, const ScenesOptions& options, const Console& console);
fault::ExitCode remove_scene(Server& server, const ScenesOptions& options, const Console& console);

using ScenesCommand = fault::ExitCode (*)(Server&, const ScenesOptions&, const Console&);
/// Adds the subcommands of `scenes`; `chosen` receives the command of the given one.
void take_scene_words(CLI::App& word, ScenesOptions& options,
                      const std::function<void(ScenesCommand)>& chosen);

}  // namespace breach::cli
