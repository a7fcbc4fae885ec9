// `new`: a scene and its study from a template, written into a folder. Needs no server.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/fault/fault.hpp"
#include "services/cli/console.hpp"

namespace breach::cli {

struct NewOptions {
    bool list = false;
    bool force = false;                                 ///< overwrite existing files
    std::string made_from;                              ///< name of the template
    nlohmann::json options = nlohmann::json::object();  ///< given options
    std::filesystem::path folder;
};

using Files = std::map<std::filesystem::path, std::string>;  ///< texts to write

/// With its parents. Throws IoError.
void make_folder(const std::filesystem::path& folder);

/// Makes folders that are missing.
void write_files(const Files& files);

/// Throws BadInput with every file that exists.
void refuse_to_overwrite(const Files& files, const std::string& command);

/// Help text of an option of the dam templates, for commands with the same option.
std::string help_of_dam(const std::string& option);

/// Adds every template as a subcommand of `new`, its options with unit, range and default. Given
/// values go into `chosen`, which must outlive the subcommand.
void take_templates(CLI::App& word, NewOptions& chosen);

/// Writes scene.json, study.json and, for a shaken scene, motion.csv; prints the next steps. Throws
/// BadInput for options that give no closed section and for existing files.
fault::ExitCode make_new(const NewOptions& chosen, const Console& console);

}  // namespace breach::cli
