// breachline token new | list | rm: edits the file of tokens.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

namespace breach::orchestrator {

class TokenCommand {
  public:
    CLI::App* add_to(CLI::App& program);
    /// Call after parsing. Returns the exit code; throws BadInput and IoError.
    int run() const;

  private:
    CLI::App* make_ = nullptr;
    CLI::App* remove_ = nullptr;
    std::filesystem::path file_ = "tokens.json";
    std::string name_;
    std::string rights_;
};

}  // namespace breach::orchestrator
