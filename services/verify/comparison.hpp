// Runs the catalogue's cases with the programs and compares the results.
#pragma once

#include <functional>
#include <optional>

#include "services/verify/catalogue.hpp"

namespace breach::verify {

struct Found {
    const Quantity* quantity;
    std::optional<double> value = {};
    std::string problem = {};  ///< why there is no value

    double difference() const { return *value - quantity->right; }
    /// |difference| over the tolerance; infinite if there is no value.
    double used() const;
    bool passed() const { return used() <= 1.0; }
};

struct Outcome {
    const Case* of;
    double cpu_seconds = 0.0;
    std::vector<Found> found = {};
};

struct Settings {
    std::filesystem::path programs;
    std::filesystem::path output;  ///< each case has a folder below it
    bool quick = false;
    unsigned slots = 1;
};

/// In the catalogue's order. said: called after each case.
std::vector<Outcome> compare(const std::vector<Topic>& catalogue, const Settings& settings,
                             const std::function<void(const Outcome&, std::size_t of)>& said);

/// "lem_tool 1.0.0+abc (numerics 8), ...": versions as the programs report them.
std::string versions_of(const Settings& settings);

}  // namespace breach::verify
