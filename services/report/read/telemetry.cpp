#include "services/report/read/telemetry.hpp"

#include <algorithm>

#include "core/criteria/criterion.hpp"

namespace breach::report {

Telemetry::Telemetry(const std::filesystem::path& file, std::map<std::string, double> beside)
    : lines_(telemetry::read(file)), beside_(std::move(beside)) {}

bool Telemetry::has(const std::string& field) const {
    return std::ranges::any_of(
        lines_, [&](const telemetry::Line& line) { return line.values.contains(field); });
}

Series Telemetry::series(const std::string& field, const std::string& name, double unit) const {
    Series s{name, {}, {}};
    for (const telemetry::Line& line : lines_) {
        const auto value = line.values.find(field);
        if (value == line.values.end()) continue;
        s.x.push_back(line.time);
        s.y.push_back(value->second / unit);
    }
    return s;
}

std::optional<double> Telemetry::first_time(const criteria::Expression& condition) const {
    criteria::Evaluation evaluation(condition);
    for (const telemetry::Line& line : lines_) {
        if (evaluation(line.time, criteria::line_for(condition, line, beside_).values) == 1.0)
            return line.time;
    }
    return {};
}

std::optional<double> Telemetry::first_time(const std::string& condition) const {
    return first_time(criteria::parse(condition, criteria::Kind::condition, "/report"));
}

void Telemetry::show_to(criteria::Window& window) const {
    for (const telemetry::Line& line : lines_) window.take(line, beside_);
}

}  // namespace breach::report
