// Finds the known word nearest to a misspelt one.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace breach::words {

/// Levenshtein distance.
inline std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
        }
    }
    return row[b.size()];
}

/// The nearest word, the last of equally near ones; empty: none is near.
inline std::string nearest(const std::string& word, const std::vector<std::string>& known) {
    std::string found;
    std::size_t least = 1 + word.size() / 3;
    for (const std::string& each : known) {
        if (word.size() > each.size() + least) continue;  // a distance of more than that
        const std::size_t distance = edit_distance(word, each);
        if (distance > least) continue;
        least = distance;
        found = each;
    }
    return found;
}

}  // namespace breach::words
