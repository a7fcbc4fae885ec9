// Shell completion for the words of this program.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace breach::cli {

/// A script for bash, zsh or fish, generated from the words and options. Completes runs by a request to the
/// server that BREACH_SERVER names, else to the default one.
std::string completion(const CLI::App& program, const std::string& shell);

}  // namespace breach::cli
