#include "core/telemetry/lines.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "core/fault/fault.hpp"

namespace breach::telemetry {

namespace {

/// None: no JSON object with a time.
std::optional<Line> line_of(const std::string& text) {
    const nlohmann::json entry = nlohmann::json::parse(text, nullptr, false);
    if (!entry.is_object()) return std::nullopt;
    Line line{0.0, 0, {}};
    for (const auto& [name, value] : entry.items()) {
        if (value.is_number()) line.values.emplace(name, value.get<double>());
    }
    const auto time = line.values.find("time");
    if (time == line.values.end()) return std::nullopt;
    line.time = time->second;
    const auto step = entry.find("step");
    if (step != entry.end() && step->is_number_integer()) line.step = step->get<std::int64_t>();
    return line;
}

}  // namespace

LineWalk::LineWalk(const std::filesystem::path& file, std::streamoff from)
    : stream_(file, std::ios::binary),
      position_(from),
      readable_(stream_ && !std::filesystem::is_directory(file)) {
    if (readable_) stream_.seekg(from);
}

bool LineWalk::next() {
    if (!readable_ || !std::getline(stream_, text_)) {
        text_.clear();
        return false;
    }
    if (stream_.eof()) return false;
    position_ += static_cast<std::streamoff>(text_.size()) + 1;
    return true;
}

std::vector<Line> read(const std::filesystem::path& file) {
    LineWalk walk(file);
    if (!walk.can_be_read())
        throw fault::IoError(file.string() + ": cannot be read; give a phase's telemetry.jsonl");
    std::vector<Line> lines;
    const auto take = [&](std::optional<Line> line) {
        if (lines.empty() || line->time > lines.back().time) lines.push_back(std::move(*line));
    };
    for (std::int64_t number = 1; walk.next(); ++number) {
        std::optional<Line> line = line_of(walk.text());
        if (!line) {
            throw fault::BadInput(
                file.string(), {{"line " + std::to_string(number), "is no JSON object with a time",
                                 "give the telemetry.jsonl as the phase wrote it"}});
        }
        take(std::move(line));
    }
    // A copied file may lack its last line break; an incomplete line is no JSON object.
    if (std::optional<Line> line = line_of(walk.text())) take(std::move(line));
    return lines;
}

std::vector<Line> Tail::fresh() {
    std::vector<Line> lines;
    std::error_code error;
    const auto size = std::filesystem::file_size(file_, error);
    if (error || static_cast<std::streamoff>(size) == read_) return lines;
    if (static_cast<std::streamoff>(size) < read_) read_ = 0;
    LineWalk walk(file_, read_);
    while (walk.next()) {
        std::optional<Line> line = line_of(walk.text());
        if (!line || line->time <= last_time_) continue;
        last_time_ = line->time;
        lines.push_back(std::move(*line));
    }
    read_ = walk.position();
    return lines;
}

}  // namespace breach::telemetry
