// The study's own repeats: the entry "accuracy" (ladders of settings, each rung drawn some times)
// and the entry "draws" (every variant). A draw moves the lattice of points, or computes the FEM
// again with other residuals. Both become ordinary variants;
// which variant is which rung follows from the study alone. What they say of the error is in
// accuracy/.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"

namespace breach::orchestrator {

/// Whether this entry of a scene moves the lattice of points, as draws do.
bool is_lattice(const std::string& pointer);

/// How far a study's tasks go: FEM, transfer and MPM; the MPM alone, from the section itself; the
/// FEM alone; lem_tool alone.
enum class Reach { chain, filled_mpm, fem, lem };
/// The phases of a variant, first to last.
std::vector<phases::Phase> phases_of(Reach reach);
/// Whether there are material points, whose lattice can be moved.
bool has_lattice(Reach reach);
/// What a draw does again: it moves the points; or it computes the FEM afresh as well, in smaller
/// residuals than the draw before, which nothing but what a FEM scatters by should hang on.
enum class Redrawn { points, fem };
/// Studies of versions before it have no name for it: points.
Redrawn redrawn_named(const std::string& name);
std::string_view name_of(Redrawn what);
/// Whether these phases have what is drawn.
bool can_redraw(Redrawn what, Reach reach);

/// Changes that move the points to another lattice; none for the first one, number 0, which is the
/// scene's own.
std::vector<std::string> lattice_of_draw(std::size_t draw, Reach reach);

/// A number that an accuracy study judges.
struct Quantity {
    std::string name;  ///< "runout", "crest_displacement", "factor_of_safety"
    Reach reach;
    std::string pointer;         ///< in the last phase's result.json; empty: FEM's telemetry
    std::string unit;            ///< "m", "1"
    std::optional<double> time;  ///< of the telemetry [s]
};

/// A number of the results; NAME@TIME of the FEM's telemetry; factor_of_safety. Nothing: none has it.
/// scene: to know whether it has a FEM.
std::optional<Quantity> quantity_named(const std::string& text, const nlohmann::json& scene);
/// Those of the results, for people.
std::string names_of_results();

struct Ladder {
    std::string name;
    std::vector<std::vector<std::string>> steps;  ///< overrides in full, coarse to fine
    std::vector<double> sizes;  ///< of each rung, falling; empty: they cannot be told
};

enum class ReferenceKind { finest, richardson, given };
struct Reference {
    ReferenceKind kind = ReferenceKind::finest;
    double value = 0.0;  ///< given
    std::string source;  ///< of the given one
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

/// A run of new draws of a setting that an accuracy study has measured: it needs its study's entry
/// "check" only, not the study.
struct BlindCheckPlan {
    std::string of;  ///< the accuracy study's run; empty: not known
    Quantity quantity;
    std::size_t mean_of = 1;   ///< so many draws are averaged
    double reference = 1.0;    ///< in the unit of the quantity
    double asked_error = 0.0;  ///< relative
};

/// A variant before its scene is checked.
struct VariantEntry {
    std::string name;
    std::vector<std::string> overrides;
    std::string name_pointer;  ///< of the study's entry that its name comes from
    std::string pointer;       ///< of the entry that its overrides come from
    std::string made_by;       ///< "draws", "accuracy", "uncertainty"; empty: it is the study's own
    std::string draws_pointer = {};   ///< of the entry that draws it; empty: it is the first draw
    nlohmann::json sample = nullptr;  ///< what was drawn for it (sampled_variants.hpp)
};

/// A rung of a ladder and the variants that give its value. Rungs that come to the same scene, as
/// those of two ladders can, have the same variants.
struct Setting {
    std::size_t ladder;
    std::size_t step;
    std::vector<std::string> variants;  ///< one per draw, the scene itself first
    bool is_base = false;               ///< it is what the other ladders leave as it is
};

/// The entry, which the schema has found sound; faults have the study's pointers. `scene`: with the
/// study's own overrides, to know whether it has a FEM.
AccuracyPlan read_accuracy(const nlohmann::json& entry, const nlohmann::json& scene,
                           std::vector<fault::Fault>& faults);

std::vector<Setting> settings_of(const AccuracyPlan& plan, const nlohmann::json& scene);
/// All variants of the plan, each once, in the order of the settings.
std::vector<VariantEntry> variants_of(const AccuracyPlan& plan, const nlohmann::json& scene);

/// Which draws: `count` of them from the one with the number `first`; number 0 is the scene itself.
struct Draws {
    std::size_t first = 0;
    std::size_t count = 1;
    Redrawn of = Redrawn::points;
};
/// Draws of what the quantity or the runout does not come from. `where`: the object that has them.
void check_draws(const Draws& draws, Reach reach, const std::string& where,
                 std::vector<fault::Fault>& faults);
/// The study's own entries, which the schema has found sound.
Draws draws_of(const nlohmann::json& study);
/// These entries where nothing is drawn.
const nlohmann::json& entries_of_no_draws();

/// The entry "check"; faults have the study's pointers. draws: of the study.
BlindCheckPlan read_blind_check(const nlohmann::json& entry, const nlohmann::json& scene,
                                const Draws& draws, std::vector<fault::Fault>& faults);

/// The study's own variants, each so often: "soft", "soft_d2", "soft_d3"; of a study without
/// variants "d1", "d2", "d3".
std::vector<VariantEntry> repeated(const std::vector<VariantEntry>& own, const Draws& draws,
                                   Reach reach, const nlohmann::json& scene);
/// What a variant of the completed study repeats: "soft_d2" -> "soft"; its own name when it is no
/// repeat. variant: {name, made_by}.
std::string repeated_variant(const nlohmann::json& variant);

}  // namespace breach::orchestrator
