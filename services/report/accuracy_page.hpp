// Accuracy studies as a page of a manual: error against CPU seconds, the table and its
// recommendation, study by study.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "services/report/chart/figure.hpp"

namespace breach::report {

/// The output of `breach accuracy --of RUN --json`.
struct AccuracyAnswer {
    std::string name;  ///< of the file, without its ending: names the figure
    nlohmann::json table;
};

/// Error of one run against CPU seconds, log-log, one line per ladder, with the Pareto front and
/// the asked error; without series when no row has an error.
Figure error_against_time(const AccuracyAnswer& answer);
/// Markdown; figures lie in `figures`, relative to the page.
std::string accuracy_page(const std::vector<AccuracyAnswer>& answers, const std::string& figures);
/// Writes the page, and the figures with their data into a folder of its name. Throws BadInput for other files, IoError.
void write_accuracy_page(const std::vector<std::filesystem::path>& files,
                         const std::filesystem::path& page);

}  // namespace breach::report
