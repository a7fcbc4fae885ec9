// Serves pages that draw a running FEM: they ask again from `next`, so an incomplete last line is
// not counted and comes whole with the next answer.
#include "services/orchestrator/files/telemetry.hpp"

#include <nlohmann/json.hpp>

#include "core/telemetry/lines.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr std::size_t most_lines = 100000;  // of one answer

json chosen(const json& line, const std::vector<std::string>& fields) {
    if (fields.empty()) return line;
    json part = json::object();
    for (const std::string& each : fields) {
        if (line.contains(each)) part[each] = line[each];
    }
    return part;
}

}  // namespace

json read_telemetry(const std::filesystem::path& file, const TelemetryRequest& request) {
    json lines = json::array();
    std::int64_t number = 0;
    telemetry::LineWalk walk(file);
    while (lines.size() < most_lines && walk.next()) {
        const std::int64_t here = number++;
        if (here < request.from || here % request.stride != 0) continue;
        const json line = json::parse(walk.text(), nullptr, false);
        if (line.is_object()) lines.push_back(chosen(line, request.fields));
    }
    return {{"lines", std::move(lines)}, {"next", std::max(number, request.from)}};
}

}  // namespace breach::orchestrator
