#include "core/criteria/telemetry.hpp"

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"

namespace breach::criteria {

std::vector<TelemetryLine> read_telemetry(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream || std::filesystem::is_directory(file))
        throw fault::IoError(file.string() + ": cannot be read; give a phase's telemetry.jsonl");
    std::vector<TelemetryLine> lines;
    std::string text;
    for (std::int64_t number = 1; std::getline(stream, text); ++number) {
        const nlohmann::json entry = nlohmann::json::parse(text, nullptr, false);
        const bool was_ended = !stream.eof();
        if (entry.is_discarded() && was_ended) {
            throw fault::BadInput(file.string(),
                                  {{"line " + std::to_string(number), "is no JSON",
                                    "give the telemetry.jsonl as the phase wrote it"}});
        }
        if (!entry.is_object() || !entry.contains("time") || !entry["time"].is_number()) continue;
        TelemetryLine line{entry["time"], 0, {}};
        if (!lines.empty() && line.time <= lines.back().time) continue;
        for (const auto& [name, value] : entry.items())
            if (value.is_number()) line.values[name] = value;
        if (entry.contains("step") && entry["step"].is_number_integer()) line.step = entry["step"];
        lines.push_back(std::move(line));
    }
    if (lines.empty())
        throw fault::BadInput(file.string(), {{"", "no line holds a time",
                                               "give the telemetry.jsonl of a phase that ran"}});
    return lines;
}

Line line_for(const Expression& expression, const TelemetryLine& telemetry) {
    Line line{telemetry.time, telemetry.step, {}};
    for (const std::string& field : expression.fields) {
        const auto found = telemetry.values.find(field);
        line.values.push_back(found == telemetry.values.end()
                                  ? std::numeric_limits<double>::quiet_NaN()
                                  : found->second);
    }
    return line;
}

}  // namespace breach::criteria
