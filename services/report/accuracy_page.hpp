// Writes accuracy studies as a page of the manual: error against CPU seconds, the table and its
// recommendation.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "services/report/chart/figure.hpp"

namespace breach::report {

/// The output of `breach accuracy --of RUN --json`.
struct AccuracyAnswer {
    std::string name;  ///< of the file without its extension; names the figure
    nlohmann::json table;
};

/// Error of one run against CPU seconds, log-log: one line per ladder, the Pareto front and the
/// requested error. Without series when no row has an error.
Figure error_against_time(const AccuracyAnswer& answer);
/// Markdown. `figures`: folder of the figures, relative to the page.
std::string accuracy_page(const std::vector<AccuracyAnswer>& answers, const std::string& figures);
/// Writes the page, and a folder of its name with the figures. Throws BadInput, IoError.
void write_accuracy_page(const std::vector<std::filesystem::path>& files,
                         const std::filesystem::path& page);

}  // namespace breach::report
