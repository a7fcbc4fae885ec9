// Writes the comparisons as one page of Markdown, and their numbers as JSON, from which
// workflows/verification/write draws error against run time.
#pragma once

#include <string>

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

std::string as_markdown(const std::vector<Topic>& catalogue, const std::vector<Outcome>& outcomes,
                        const About& about);

/// Writes index.md and results.json into the folder.
void write_pages(const std::filesystem::path& folder, const std::vector<Topic>& catalogue,
                 const std::vector<Outcome>& outcomes, const About& about);

}  // namespace breach::verify
