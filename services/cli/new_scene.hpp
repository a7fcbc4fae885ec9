// `new`: a scene and its study from a template, written into a folder. Needs no server.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/fault/fault.hpp"
#include "services/cli/console.hpp"

namespace breach::cli {

struct NewOptions {
    bool list = false;
    bool force = false;                                 ///< writes over what is there
    std::string made_from;                              ///< name of the template
    nlohmann::json options = nlohmann::json::object();  ///< those that were given
    std::filesystem::path folder;
};

/// Every template as a word below `new`, its options with unit, range and default; what is given goes
/// into `chosen`, which must live as long as the word.
void take_templates(CLI::App& word, NewOptions& chosen);

/// Writes scene.json, study.json and, for a shaken scene, motion.csv; prints what to do next. Throws
/// BadInput for options that close no section and for files that are there.
fault::ExitCode make_new(const NewOptions& chosen, const Console& console);

}  // namespace breach::cli
