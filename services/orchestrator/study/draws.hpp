// A study's repeats. A repeat moves the lattice of points, or computes the FEM again with slightly
// different steps and tolerances; each is an ordinary variant.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/orchestrator/study/reach.hpp"

namespace breach::orchestrator {

/// What a repeat changes: it moves the points; or it repeats the FEM as well, with slightly
/// different steps and tolerances; a converged result does not change.
enum class Redrawn { points, fem };
/// Empty in studies of earlier versions, which had no name for it: points.
Redrawn redrawn_named(const std::string& name);
std::string_view name_of(Redrawn what);
/// Whether these phases have what is repeated.
bool can_redraw(Redrawn what, Reach reach);

/// Which repeats: `count` of them from the one with the number `first`; 0 is the scene itself.
struct Draws {
    std::size_t first = 0;
    std::size_t count = 1;
    Redrawn of = Redrawn::points;
};
/// Faults of repeats on which the quantity or the runout does not depend. `where`: their object.
void check_draws(const Draws& draws, Reach reach, const std::string& where,
                 std::vector<fault::Fault>& faults);
/// The study's own entries, which the schema has accepted; also of a stored study, which may be
/// older than these entries.
Draws draws_of(const nlohmann::json& study);
/// Why such repeats allow transfer times only, no triggers; empty: triggers are allowed.
std::string_view refusal_of_triggers(const Draws& draws);
/// The values of these entries without repeats.
const nlohmann::json& entries_of_no_draws();

/// Whether this entry of a scene moves the lattice of points, as repeats do.
bool is_lattice(const std::string& pointer);
/// Changes that move the points to another lattice; none for the first one, number 0, which is the
/// scene's own.
std::vector<std::string> lattice_of_draw(std::size_t draw, Reach reach);

/// A variant before its scene is checked.
struct VariantEntry {
    std::string name;
    std::vector<std::string> overrides;
    std::string name_pointer;  ///< of the study's entry that its name comes from
    std::string pointer;       ///< of the entry that its overrides come from
    std::string made_by;       ///< "draws", "accuracy", "uncertainty"; empty: it is the study's own
    std::string draws_pointer = {};   ///< of the entry that repeats it; empty: it is no repeat
    nlohmann::json sample = nullptr;  ///< its sampled values (sampled_variants.hpp)
};
/// The scene with these changes.
nlohmann::json changed(nlohmann::json scene, const std::vector<std::string>& overrides);
/// "soft" -> "soft_d2" for the repeat with the number 1.
std::string name_of_draw(const std::string& variant, std::size_t draw);
/// Makes a variant its repeat with this number. `pointer`: of the entry that asks for repeats;
/// `scene`: with the variant's own changes.
void draw(VariantEntry& entry, std::size_t number, const char* pointer, Redrawn what, Reach reach,
          const nlohmann::json& scene);
/// The study's own variants with their repeats: "soft", "soft_d2", "soft_d3"; of a study without
/// variants "d1", "d2", "d3".
std::vector<VariantEntry> repeated(const std::vector<VariantEntry>& own, const Draws& draws,
                                   Reach reach, const nlohmann::json& scene);
/// The variant that a variant of the completed study repeats: "soft_d2" -> "soft"; its own name
/// when it is no repeat. variant: {name, made_by}.
std::string repeated_variant(const nlohmann::json& variant);

}  // namespace breach::orchestrator
