// breachline findings | conditions | inputs: what the program `report` asks of a run, so that it
// judges nothing itself. Each prints one JSON document.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace breach::orchestrator {

class ReportQuestions {
  public:
    void add_to(CLI::App& program);
    bool was_asked() const { return *findings_ || *conditions_ || *inputs_; }
    /// Call after parsing. Throws BadInput and IoError.
    void answer() const;

  private:
    CLI::App* findings_ = nullptr;
    CLI::App* conditions_ = nullptr;
    CLI::App* inputs_ = nullptr;
    std::filesystem::path place_;
};

}  // namespace breach::orchestrator
