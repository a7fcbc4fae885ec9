// The lines that a phase appends to its telemetry, each once and whole, while it runs.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace breach::orchestrator {

class TelemetryTail {
  public:
    explicit TelemetryTail(std::filesystem::path file) : file_(std::move(file)) {}

    /// What is new since the last call. A torn last line waits until it is whole. A resumed phase
    /// writes some lines again: a line whose "time" is not later than one given out is dropped.
    std::vector<nlohmann::json> fresh();
    const std::filesystem::path& file() const { return file_; }

  private:
    std::filesystem::path file_;
    std::streamoff read_ = 0;
    double last_time_ = -1.0;
};

}  // namespace breach::orchestrator
