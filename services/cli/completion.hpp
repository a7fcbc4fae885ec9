// What a shell needs to complete the words of this program.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace breach::cli {

/// A script for bash, zsh or fish, made from the words and options themselves. Runs are completed by asking the
/// server that BREACH_SERVER names, else the default one.
std::string completion(const CLI::App& program, const std::string& shell);

}  // namespace breach::cli
