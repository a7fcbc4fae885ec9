// Writes the comparisons as one page: HTML with figures, and Markdown for docs.
#pragma once

#include <string>

#include "services/report/chart/document.hpp"
#include "services/verify/comparison.hpp"

namespace breach::verify {

struct About {
    std::string versions;  ///< of the programs, with their numerics
    std::string machine;
    bool quick = false;
};

struct Sum {
    std::size_t comparisons = 0, passed = 0;
    double worst = 0.0;  ///< largest used share of a tolerance
    double cpu_seconds = 0.0;
};
Sum sum_of(const std::vector<Outcome>& outcomes);
/// "161 of 162 comparisons pass, ..."
std::string in_words(const Sum& sum);

report::Document document_of(const std::vector<Topic>& catalogue,
                             const std::vector<Outcome>& outcomes, const About& about);
/// figures: folder of error_TOPIC.svg, relative to the page.
std::string as_markdown(const std::vector<Topic>& catalogue, const std::vector<Outcome>& outcomes,
                        const About& about, const std::string& figures);

/// Writes index.html, index.md, results.json and figures/ into the folder.
void write_pages(const std::filesystem::path& folder, const std::vector<Topic>& catalogue,
                 const std::vector<Outcome>& outcomes, const About& about);

}  // namespace breach::verify
