// The parts of the dam-breach assessment, private to its files: shared functions, the first page,
// and the chapter with its data.
#pragma once

#include "services/report/chapters/chapters.hpp"

namespace breach::report {

/// Names of the answer's quantities: the one requested first, then the others.
std::vector<std::string> quantities_of(const nlohmann::json& answer);
/// "Farthest point"; an unknown quantity: its name.
std::string words_of(const std::string& quantity);
/// " [m]"; empty without a unit.
std::string unit_in_brackets(const nlohmann::json& quantity);
/// "38.5 (32.6 to 45.5)", marked where it is a lower bound; without a percentile, the reason.
std::string percentile_text(const Run& run, const std::string& name, double p);
/// "60 of 64 samples".
std::string known_of(const Run& run, const std::string& name);
/// "2 samples".
std::string count_of(const nlohmann::json& number, const std::string& noun);
std::string or_dash(const nlohmann::json& value, int digits = 3);
/// "0.1 to 0.3", from two entries; "-" if they are not numbers.
std::string ends_of(const nlohmann::json& each, const char* low, const char* high);

/// The page for a regulator. name: the quantity requested first.
Chapter assessment_page(const Run& run, const std::string& name);
/// Distributions, envelopes, hydrographs and samples behind that page; notes missing ones.
Chapter assessment_basis(const Material& from, const std::string& name, Document& document);

/// "0.48", marked where nearby results are lower bounds.
std::string value_found(const nlohmann::json& inverse);
/// For a study that searches the value that gives a known result.
Chapter back_analysis(const Run& run);

}  // namespace breach::report
