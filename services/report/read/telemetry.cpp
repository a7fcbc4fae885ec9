#include "services/report/read/telemetry.hpp"

#include <cmath>
#include <fstream>
#include <limits>

#include "core/criteria/evaluation.hpp"
#include "core/fault/fault.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

std::optional<double> number_in(const json& line, const std::string& field) {
    const auto found = line.find(field);
    if (found == line.end() || !found->is_number()) return {};
    return found->get<double>();
}

}  // namespace

Telemetry::Telemetry(const std::filesystem::path& file, std::map<std::string, double> beside)
    : beside_(std::move(beside)) {
    std::ifstream stream(file);
    if (!stream) throw fault::IoError(file.string() + ": cannot be read; export the run again");
    for (std::string line; std::getline(stream, line);) {
        if (stream.eof()) break;  // without its line break: not whole
        json parsed = json::parse(line, nullptr, false);
        if (!parsed.is_object() || !number_in(parsed, "time")) {
            throw fault::BadInput(file.string(),
                                  {{"line " + std::to_string(lines_.size() + 1),
                                    "is no telemetry with a time", "export the run again"}});
        }
        lines_.push_back(std::move(parsed));
    }
}

bool Telemetry::has(const std::string& field) const {
    for (const json& line : lines_) {
        if (number_in(line, field)) return true;
    }
    return false;
}

Series Telemetry::series(const std::string& field, const std::string& name, double unit) const {
    Series s{name, {}, {}};
    for (const json& line : lines_) {
        const auto value = number_in(line, field);
        if (!value) continue;
        s.x.push_back(line.at("time"));
        s.y.push_back(*value / unit);
    }
    return s;
}

std::optional<double> Telemetry::first_time(const criteria::Expression& condition) const {
    criteria::Evaluation evaluation(condition);
    std::vector<double> values;
    for (const json& line : lines_) {
        values.clear();
        for (const std::string& field : condition.fields) {
            const auto fixed = beside_.find(field);
            values.push_back(
                fixed != beside_.end()
                    ? fixed->second
                    : number_in(line, field).value_or(std::numeric_limits<double>::quiet_NaN()));
        }
        const double time = line.at("time");
        if (evaluation(time, values) > 0.5) return time;
    }
    return {};
}

std::optional<double> Telemetry::first_time(const std::string& condition) const {
    return first_time(criteria::parse(condition, criteria::Kind::condition, "/report"));
}

}  // namespace breach::report
