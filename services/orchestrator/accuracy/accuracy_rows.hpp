// The table of an accuracy study as plain data: every rung with its value, error and cost; the
// error of each ladder; the recommended setting. And the result of a blind check.
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
    double cpu_seconds;  ///< of all the repeats; those of points share a FEM
};

struct AccuracyRow {
    Setting setting;
    std::optional<double> size = {};
    std::optional<statistics::Repeats> value = {};  ///< of the draws that have one
    std::optional<Cost> cost = {};                  ///< mean over the draws; of memory the most
    std::optional<double> error = {};  ///< of the mean of the draws, relative to the reference
    /// Error from its own ladder: the difference from the finest rung as reference, plus the error
    /// of that one
    std::optional<statistics::Share> of_own_ladder = {};
    /// Error of the base's rungs in the other ladders, together: shared by this row
    double error_of_other_ladders = 0.0;
    /// Of one run, relative: its own bias and that of the other ladders, and its scatter. The bias of
    /// a reference rung is its ladder's error of the finest.
    std::optional<double> error_of_a_run = {};
    std::optional<double> bias = {};  ///< the same without the scatter
    /// Of the fewest repeats with a mean within the asked error; nothing: not even many suffice
    std::optional<MeanOfDraws> mean_within_asked = {};
    bool is_reference = false;  ///< errors are measured from it: its own is not known
    bool below_noise = false;   ///< the error does not exceed the noise of the repeats
    bool questionable = false;  ///< a run of it has a flag that makes it unreliable
    bool on_front = false;      ///< of error against CPU seconds
    std::string reason = {};    ///< why a repeat has no value, or there is no error

    bool has_all_draws() const { return value && value->count == setting.variants.size(); }
};

struct LadderSummary {
    statistics::Convergence convergence;
    std::optional<double> reference;
    bool reference_is_questionable = false;  ///< its rung carries such a flag
    std::string message;                     ///< the course in a sentence
    /// Error of the rung that is the base; nothing: no rung is the base, or its error is unknown
    std::optional<statistics::Share> of_base;
    /// Errors are relative to its finest rung, and the error of that one is unknown without sizes
    bool lacks_sizes = false;
    bool base_lacks_sizes = false;  ///< such a ladder includes the base, too
};

struct AccuracyTable {
    AccuracyPlan plan;
    std::optional<double> transfer_time;  ///< [s]
    std::vector<AccuracyRow> rows;        ///< ladder by ladder, coarse to fine
    std::vector<LadderSummary> ladders;
    std::optional<std::size_t> recommended;  ///< row
    std::string recommendation;              ///< in a sentence
};

/// Its error is known and reliable: all its repeats have a value, and neither it nor its reference is
/// questionable.
inline bool can_be_offered(const AccuracyTable& table, const AccuracyRow& row) {
    return row.error_of_a_run && row.cost && row.has_all_draws() && !row.questionable &&
           !table.ladders[row.setting.ladder].reference_is_questionable;
}

struct BlindMean {
    std::vector<std::string> variants;  ///< one per draw
    std::optional<double> value = {};   ///< nothing: a draw has none
    std::optional<double> error = {};   ///< relative to the reference
    bool kept = false;                  ///< the error is at most the one that was asked for
    bool questionable = false;          ///< a repeat has a flag that makes it unreliable
    std::string reason = {};            ///< why there is no value
};

struct BlindCheck {
    BlindCheckPlan plan;
    std::vector<BlindMean> means;
    std::size_t judged = 0;  ///< means that have a value
    std::size_t kept = 0;
    std::optional<double> furthest;  ///< largest error of a mean
};

}  // namespace breach::orchestrator
