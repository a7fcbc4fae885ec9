// Reads telemetry.jsonl: one JSON object per line, numbers by name; a phase may still be writing
// it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace breach::telemetry {

/// Iterates over the complete lines of a file; a last line without line break is incomplete.
class LineWalk {
  public:
    /// from: the position() of an earlier walk [bytes].
    explicit LineWalk(const std::filesystem::path& file, std::streamoff from = 0);

    /// Goes to the next line; false: none yet, or the file cannot be read.
    bool next();
    /// The line; after next() returned false, the incomplete rest.
    const std::string& text() const { return text_; }
    /// Offset after the last complete line [bytes].
    std::streamoff position() const { return position_; }
    bool can_be_read() const { return readable_; }

  private:
    std::ifstream stream_;
    std::string text_;
    std::streamoff position_;
    bool readable_;
};

struct Line {
    double time;                                        ///< simulated [s]
    std::int64_t step;                                  ///< 0 if the line has none
    std::map<std::string, double, std::less<>> values;  ///< numbers of the line, "time" included
};

/// Valid lines of a file, complete or not. Ignores a line whose time does not exceed that of an
/// earlier one (resumed phase). Throws IoError if the file cannot be read, BadInput for a line that
/// is no JSON object with a time.
std::vector<Line> read(const std::filesystem::path& file);

/// Reads the lines of a running phase, each once. Skips invalid lines.
class Tail {
  public:
    explicit Tail(std::filesystem::path file) : file_(std::move(file)) {}

    /// Lines since the last call. A file that became shorter is read from the beginning.
    std::vector<Line> fresh();
    const std::filesystem::path& file() const { return file_; }

  private:
    std::filesystem::path file_;
    std::streamoff read_ = 0;
    double last_time_ = -1.0;
};

}  // namespace breach::telemetry
