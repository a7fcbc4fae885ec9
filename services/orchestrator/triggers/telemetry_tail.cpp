#include "services/orchestrator/triggers/telemetry_tail.hpp"

#include <fstream>

namespace breach::orchestrator {

using nlohmann::json;

std::vector<json> TelemetryTail::fresh() {
    std::vector<json> lines;
    std::error_code error;
    const auto size = std::filesystem::file_size(file_, error);
    if (error || static_cast<std::streamoff>(size) == read_) return lines;
    if (static_cast<std::streamoff>(size) < read_) read_ = 0;  // begun again
    std::ifstream stream(file_, std::ios::binary);
    stream.seekg(read_);
    std::string text;
    while (std::getline(stream, text) && !stream.eof()) {
        read_ += static_cast<std::streamoff>(text.size()) + 1;
        json line = json::parse(text, nullptr, false);
        if (!line.is_object() || !line.contains("time") || !line["time"].is_number()) continue;
        const double time = line["time"];
        if (time <= last_time_) continue;
        last_time_ = time;
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace breach::orchestrator
