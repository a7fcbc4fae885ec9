// An uncertainty study as far as its run has come: each sample with what it has drawn and what came
// of it. Read from the store each time, so that it grows with the run.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/orchestrator/records/result_columns.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

enum class Fate { done, failed, no_transfer, open };

struct SampleRow {
    std::string name;      ///< of its variant, "s0001"
    std::string state;     ///< that of its row of the results; "queued": it has none yet
    Fate fate;             ///< failed: it ended without a result, whatever the reason; no_transfer:
                           ///< its FEM came to its end and not to what the transfer waits for
    std::string reason;    ///< why it has no result
    nlohmann::json drawn;  ///< by parameter: a number, an option's name, a lattice's number
    std::optional<ResultRow> row;
    /// Whatever became of its runout: those without one must not be missing in it.
    FactorsOfSafety safety;
};

struct Ensemble {
    Run run;
    nlohmann::json entry;            ///< "uncertainty" of the study
    std::vector<SampleRow> samples;  ///< in the order of their numbers
};

/// Nothing: the run is not there, or its study has no samples.
std::optional<Ensemble> ensemble_of(const Store& store, const std::string& run);

/// Results that statistics are told of: numbers of the table of results that are answers of the
/// study, not indicators of its error, and that a sample has.
std::vector<const ResultColumn*> quantities_of(const Ensemble& ensemble);
/// The one that is looked at first: as the study says, else the first.
std::string first_quantity(const Ensemble& ensemble);

/// A sample's number; nothing: it has none.
std::optional<double> result_of(const SampleRow& sample, std::string_view quantity);

/// Its soil still moved when it ended, which only adds to this quantity.
bool is_lower_bound(const SampleRow& sample, std::string_view quantity);

/// The samples with their draws and results as a table of its own, one row each.
struct SampleTable {
    std::vector<std::string> names;  ///< that the columns point to
    std::vector<ResultColumn> columns;
    std::vector<ResultRow> rows;
};
SampleTable sample_table(const Ensemble& ensemble);

}  // namespace breach::orchestrator
