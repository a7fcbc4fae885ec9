// Reads the telemetry of a phase, telemetry.jsonl, as columns against time.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/criteria/window.hpp"
#include "core/telemetry/lines.hpp"
#include "services/report/chart/chart.hpp"

namespace breach::report {

class Telemetry {
  public:
    /// Throws like telemetry::read. `beside`: constants that conditions may use like fields of
    /// every line (critical_depth).
    explicit Telemetry(const std::filesystem::path& file,
                       std::map<std::string, double> beside = {});

    /// Whether some line has a number in this field.
    bool has(const std::string& field) const;
    /// The field against time [s], divided by `unit`; lines without it are skipped.
    Series series(const std::string& field, const std::string& name, double unit = 1.0) const;
    /// The first time at which the condition is true [s]; nothing when it never is.
    std::optional<double> first_time(const criteria::Expression& condition) const;
    std::optional<double> first_time(const std::string& condition) const;
    /// Shows every line to the window, which finds its edges.
    void show_to(criteria::Window& window) const;

    const std::vector<telemetry::Line>& lines() const { return lines_; }

  private:
    std::vector<telemetry::Line> lines_;
    std::map<std::string, double> beside_;
};

}  // namespace breach::report
