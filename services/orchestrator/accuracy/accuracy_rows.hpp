// The table of an accuracy study as plain data (value, error and cost of each rung, error of each
// ladder, recommended setting). accuracy_table.cpp fills it; sentences.cpp and runout_error.cpp
// read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/statistics/convergence.hpp"
#include "services/orchestrator/accuracy/measured.hpp"
#include "services/orchestrator/study/accuracy.hpp"

namespace breach::orchestrator {

/// The mean of several runs of a setting, each on its own lattice.
struct MeanOfDraws {
    std::size_t draws;
    double error;        ///< largest error in nine of ten cases; relative
    double cpu_seconds;  ///< sum over the repeats; repeats of points share one FEM
};

struct AccuracyRow {
    Setting setting;
    std::optional<double> size = {};
    std::optional<statistics::Repeats> value = {};  ///< over the repeats that have a value
    std::optional<Cost> cost = {};                  ///< mean over the repeats; the largest memory
    std::optional<double> error = {};  ///< of the mean over the repeats, relative to the reference
    /// Error on its own ladder: the difference from the reference; if that is the finest rung, plus
    /// the error of the finest rung
    std::optional<statistics::Share> of_own_ladder = {};
    /// Error of the base on the other ladders together, which this row shares
    double error_of_other_ladders = 0.0;
    /// Relative error of one run: bias of its own and of the other ladders, plus scatter. The bias
    /// of a reference rung is the error of the finest rung.
    std::optional<double> error_of_a_run = {};
    std::optional<double> bias = {};  ///< error_of_a_run without the scatter
    /// Fewest repeats whose mean is within the requested error; nothing: no allowed number suffices
    std::optional<MeanOfDraws> mean_within_asked = {};
    bool is_reference = false;  ///< errors are relative to it; its own error is unknown
    bool below_noise = false;   ///< the error does not exceed the noise of the repeats
    bool questionable = false;  ///< one of its runs has a flag that makes it unreliable
    bool softens = false;       ///< its soil loses strength with strain (Measured)
    bool has_length = false;    ///< of the shear bands
    bool on_front = false;      ///< on the Pareto front of error and CPU seconds
    std::string reason = {};    ///< why a repeat has no value, or there is no error

    bool has_all_draws() const { return value && value->count == setting.variants.size(); }
};

struct LadderSummary {
    statistics::Convergence convergence;
    std::optional<double> reference;
    bool reference_is_questionable = false;  ///< the reference's rung is questionable
    std::string message;                     ///< the convergence in a sentence
    /// Error of the rung that is the base; nothing: no rung is the base, or its error is unknown
    std::optional<statistics::Share> of_base;
    /// Errors are relative to the finest rung, whose own error is unknown without sizes
    bool lacks_sizes = false;
    bool base_lacks_sizes = false;  ///< a ladder without sizes that includes the base
};

struct AccuracyTable {
    AccuracyPlan plan;
    std::optional<double> transfer_time;  ///< [s]
    std::vector<AccuracyRow> rows;        ///< ladder by ladder, coarse to fine
    std::vector<LadderSummary> ladders;
    std::optional<std::size_t> recommended;  ///< row
    std::string recommendation;              ///< in a sentence
};

/// Whether the row's error is known and reliable: all repeats have a value, and neither the row nor
/// its reference is questionable.
inline bool can_be_offered(const AccuracyTable& table, const AccuracyRow& row) {
    return row.error_of_a_run && row.cost && row.has_all_draws() && !row.questionable &&
           !table.ladders[row.setting.ladder].reference_is_questionable;
}

}  // namespace breach::orchestrator
