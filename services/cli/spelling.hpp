// Finds the command among the words of a command line, and explains words that are none.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace breach::cli {

/// The command among the words; end() without one. Options may come before it: the caller moves
/// the command to the front, as CLI11 would give such options to the program alone.
std::vector<std::string>::iterator command_in(const CLI::App& program,
                                              std::vector<std::string>& words);

/// Prints the requested help, or what is wrong with the words and what may have been meant.
/// Returns CLI11's exit code; 0 for help.
int explain(const CLI::App& program, const CLI::ParseError& error);

}  // namespace breach::cli
