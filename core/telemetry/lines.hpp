// telemetry.jsonl on the disk: one JSON object per line, numbers by name, which a phase may still
// be writing. Defines what a whole line is and which lines count.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace breach::telemetry {

/// Iterates over the lines of a file. A last line without its line break is still being written: it
/// is not returned until it is complete.
class LineWalk {
  public:
    /// from: the position() of an earlier walk [bytes].
    explicit LineWalk(const std::filesystem::path& file, std::streamoff from = 0);

    /// Goes to the next line; false: there is none yet, or the file cannot be read.
    bool next();
    /// The line; after next() returned false, the text behind the last line break.
    const std::string& text() const { return text_; }
    /// Behind the line break of the last line [bytes].
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
    std::int64_t step;                                  ///< 0 where the line has none
    std::map<std::string, double, std::less<>> values;  ///< its numbers, "time" among them
};

/// The valid lines of a file that is complete or may still end inside a line: leaves out a line
/// that is not later than one before it (a resumed phase). Throws IoError when the file cannot be
/// read, BadInput naming a line that is no JSON object with a time.
std::vector<Line> read(const std::filesystem::path& file);

/// The same lines of a running phase, each once. Skips a line that is no JSON object with a time,
/// as a watcher cannot refuse it.
class Tail {
  public:
    explicit Tail(std::filesystem::path file) : file_(std::move(file)) {}

    /// The lines since the last call. A file that has become shorter is read from its beginning.
    std::vector<Line> fresh();
    const std::filesystem::path& file() const { return file_; }

  private:
    std::filesystem::path file_;
    std::streamoff read_ = 0;
    double last_time_ = -1.0;
};

}  // namespace breach::telemetry
