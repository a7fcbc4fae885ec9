// The table of an accuracy study as plain data: every rung with its value, its error and its cost;
// what each ladder says; which setting to take. And what a blind check made of that.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/statistics/convergence.hpp"
#include "services/orchestrator/accuracy/measured.hpp"
#include "services/orchestrator/study/accuracy.hpp"

namespace breach::orchestrator {

/// The mean of several runs with a setting on lattices of their own.
struct MeanOfDraws {
    std::size_t draws;
    double error;        ///< what it is off at most, in nine of ten times; relative
    double cpu_seconds;  ///< of all the draws; those of points share a FEM
};

struct AccuracyRow {
    Setting setting;
    std::optional<double> size = {};
    std::optional<statistics::Repeats> value = {};  ///< of the draws that have one
    std::optional<Cost> cost = {};                  ///< mean over the draws; of memory the most
    std::optional<double> error = {};  ///< of the mean of the draws, relative to the reference
    /// What its own ladder says it is off: with the finest rung as reference the difference from
    /// that, and what that one is off itself
    std::optional<statistics::Share> of_own_ladder = {};
    /// What the base's rungs of the other ladders are off, together: what this row shares with them
    double error_of_other_ladders = 0.0;
    /// Of one run, relative: its own bias and that of the other ladders, and its scatter. The bias of
    /// a reference rung is what its ladder says of the finest.
    std::optional<double> error_of_a_run = {};
    std::optional<double> bias = {};  ///< the same without the scatter
    /// Of the fewest draws whose mean keeps the asked error; nothing: not even many do
    std::optional<MeanOfDraws> mean_within_asked = {};
    bool is_reference = false;  ///< errors are measured from it: its own is not known
    bool below_noise = false;   ///< the error is not told apart from the noise of the repeats
    bool questionable = false;  ///< a run of it carries a flag that forbids to rely on it
    bool on_front = false;      ///< of error against CPU seconds
    std::string reason = {};    ///< why a draw has no value, or there is no error

    bool has_all_draws() const { return value && value->count == setting.variants.size(); }
};

struct LadderSummary {
    statistics::Convergence convergence;
    std::optional<double> reference;
    bool reference_is_questionable = false;  ///< its rung carries such a flag
    std::string message;                     ///< the course in a sentence
    /// What the rung is off that is the base; nothing: no rung is the base, or its error is not known
    std::optional<statistics::Share> of_base;
    /// Errors are measured from its finest rung, and what that one is off is not known without sizes
    bool lacks_sizes = false;
    bool base_lacks_sizes = false;  ///< such a ladder has the base, too
};

struct AccuracyTable {
    AccuracyPlan plan;
    std::optional<double> transfer_time;  ///< [s]
    std::vector<AccuracyRow> rows;        ///< ladder by ladder, coarse to fine
    std::vector<LadderSummary> ladders;
    std::optional<std::size_t> recommended;  ///< row
    std::string recommendation;              ///< in a sentence
};

/// Its error is known and can be relied on: all its draws have a value, and neither it nor what it is
/// measured from is questionable.
inline bool can_be_offered(const AccuracyTable& table, const AccuracyRow& row) {
    return row.error_of_a_run && row.cost && row.has_all_draws() && !row.questionable &&
           !table.ladders[row.setting.ladder].reference_is_questionable;
}

struct BlindMean {
    std::vector<std::string> variants;  ///< one per draw
    std::optional<double> value = {};   ///< nothing: a draw has none
    std::optional<double> error = {};   ///< relative to the reference
    bool kept = false;                  ///< the error is at most the one that was asked for
    bool questionable = false;          ///< a draw carries a flag that forbids to rely on it
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
