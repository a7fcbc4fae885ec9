// The entry "accuracy" of a study: ladders of settings, each rung computed in several repeats.
// Rungs become ordinary variants; which variant belongs to which rung follows from the study alone.
// accuracy/ computes the errors.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/orchestrator/study/draws.hpp"
#include "services/orchestrator/study/reach.hpp"

namespace breach::orchestrator {

/// A result whose error an accuracy study measures.
struct Quantity {
    std::string name;  ///< "runout", "crest_displacement", "factor_of_safety"
    Reach reach;
    std::string pointer;         ///< in the last phase's result.json; empty: FEM's telemetry
    std::string unit;            ///< "m", "1"
    std::optional<double> time;  ///< of the telemetry [s]
};

/// From "runout" and the like, NAME@TIME of the FEM's telemetry, or "factor_of_safety". Nothing:
/// there is no such quantity. scene: tells whether there is a FEM.
std::optional<Quantity> quantity_named(const std::string& text, const nlohmann::json& scene);
/// The quantity in the form of a study's entry.
std::string text_of(const Quantity& quantity);
/// Names of the quantities of the results, for messages.
std::string names_of_results();

struct Ladder {
    std::string name;
    std::vector<std::vector<std::string>> steps;  ///< overrides in full, coarse to fine
    std::vector<double> sizes;                    ///< size of each rung, falling; empty: unknown
};

enum class ReferenceKind { finest, richardson, given };
struct Reference {
    ReferenceKind kind = ReferenceKind::finest;
    double value = 0.0;  ///< given
    std::string source;  ///< origin of the given one
};

struct AccuracyPlan {
    Quantity quantity;
    std::vector<Ladder> ladders;
    std::vector<std::string> base;
    std::size_t draws = 1;
    Redrawn draws_of = Redrawn::points;
    Reference reference;
    double asked_error = 0.05;
};

/// A rung of a ladder and the variants that give its value. Rungs with equal scenes, possible in
/// two ladders, have the same variants: the base is computed once, although every ladder has it.
struct Setting {
    std::size_t ladder;
    std::size_t step;
    std::vector<std::string> variants;  ///< one per repeat, the scene itself first
    bool is_base = false;               ///< the setting that the other ladders leave unchanged
};

/// The entry, which the schema has accepted; faults have the study's pointers. `scene`: with the
/// study's own overrides; tells whether there is a FEM.
AccuracyPlan read_accuracy(const nlohmann::json& entry, const nlohmann::json& scene,
                           std::vector<fault::Fault>& faults);

/// Overrides of a rung: those of the base, then its own.
std::vector<std::string> overrides_of(const AccuracyPlan& plan, std::size_t ladder,
                                      std::size_t step);
std::vector<Setting> settings_of(const AccuracyPlan& plan, const nlohmann::json& scene);
/// All variants of the plan, each once, in the order of the settings.
std::vector<VariantEntry> variants_of(const AccuracyPlan& plan, const nlohmann::json& scene);

}  // namespace breach::orchestrator
