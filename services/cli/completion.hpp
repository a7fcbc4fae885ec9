// Shell completion for the commands and options of `breach`.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace breach::cli {

/// Script for bash, zsh or fish, generated from the commands and options. Completes runs by a
/// request to the server in BREACH_SERVER, else to the default one.
std::string completion(const CLI::App& program, const std::string& shell);

}  // namespace breach::cli
