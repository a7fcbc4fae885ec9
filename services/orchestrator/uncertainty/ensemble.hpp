// The results of an uncertainty study so far: each sample with its sampled values and its result.
// Read from the store at each call, by requests on their threads and by BatchWatch on the
// dispatcher's.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/orchestrator/records/result_columns.hpp"
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

/// open: may still get a result. It becomes one of the others when its tasks end, without anyone
/// setting it: it is derived from the rows at each reading.
enum class SampleEnd { done, failed, no_transfer, open };

struct SampleRow {
    std::string name;      ///< of its variant, "s0001"
    std::string state;     ///< state of its row of results; "queued": no row yet
    SampleEnd end;         ///< failed: ended without a result, for any reason; no_transfer: the FEM
                           ///< ended before the transfer
    std::string reason;    ///< why there is no result
    nlohmann::json drawn;  ///< by parameter: a number, an option's name, a lattice's number
    std::optional<ResultRow> row;
    /// Independent of its runout, so that samples without one are included.
    FactorsOfSafety safety;
};

struct Ensemble {
    Run run;
    nlohmann::json entry;            ///< "uncertainty" of the study
    std::vector<SampleRow> samples;  ///< in the order of their numbers
    std::string ended = {};          ///< why no more samples are added; empty: they may be
};

/// Nothing: the run does not exist, or its study has no samples.
std::optional<Ensemble> ensemble_of(const Store& store, const std::string& run);

/// Result columns with statistics: numbers, not indicators of error, that at least one sample has.
std::vector<const ResultColumn*> quantities_of(const Ensemble& ensemble);
/// The quantity shown first: the study's, else the first of quantities_of.
std::string first_quantity(const Ensemble& ensemble);

/// The sample's value of the quantity; nothing: it has none.
std::optional<double> result_of(const SampleRow& sample, std::string_view quantity);

/// Whether the soil still moved at the end, so that the quantity is a lower bound.
bool is_lower_bound(const SampleRow& sample, std::string_view quantity);

/// How well the percentile of "until" is known; the study has that entry.
struct Narrowness {
    std::string quantity;
    std::size_t results = 0;             ///< samples that have the quantity
    std::optional<double> half_width{};  ///< of its interval, over its value; nothing: too few
                                         ///< samples, or a value of 0
    bool reached = false;
};
Narrowness narrowness_of(const Ensemble& ensemble);

/// The samples with their values and results as a table of its own, one row each.
struct SampleTable {
    std::vector<std::string> names;  ///< owns the texts that `columns` points to
    std::vector<ResultColumn> columns;
    std::vector<ResultRow> rows;
};
SampleTable sample_table(const Ensemble& ensemble);

}  // namespace breach::orchestrator
