// A study's repeats. A draw moves the lattice of points, or computes the FEM again with other steps and
// residuals; each is an ordinary variant.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/orchestrator/study/reach.hpp"

namespace breach::orchestrator {

/// What a draw does again: it moves the points; or it computes the FEM afresh as well, with other
/// steps and residuals, which nothing but what a FEM scatters by should hang on.
enum class Redrawn { points, fem };
/// Studies of versions before it have no name for it: points.
Redrawn redrawn_named(const std::string& name);
std::string_view name_of(Redrawn what);
/// Whether these phases have what is drawn.
bool can_redraw(Redrawn what, Reach reach);

/// Which draws: `count` of them from the one with the number `first`; number 0 is the scene itself.
struct Draws {
    std::size_t first = 0;
    std::size_t count = 1;
    Redrawn of = Redrawn::points;
};
/// Draws of what the quantity or the runout does not come from. `where`: the object that has them.
void check_draws(const Draws& draws, Reach reach, const std::string& where,
                 std::vector<fault::Fault>& faults);
/// The study's own entries, which the schema has found sound; of a stored study, which may be older
/// than they are.
Draws draws_of(const nlohmann::json& study);
/// Why such draws have transfer times and no triggers; empty: they may have triggers.
std::string_view refusal_of_triggers(const Draws& draws);
/// These entries where nothing is drawn.
const nlohmann::json& entries_of_no_draws();

/// Whether this entry of a scene moves the lattice of points, as draws do.
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
    std::string draws_pointer = {};   ///< of the entry that draws it; empty: it is the first draw
    nlohmann::json sample = nullptr;  ///< what was drawn for it (sampled_variants.hpp)
};
/// With these changes.
nlohmann::json changed(nlohmann::json scene, const std::vector<std::string>& overrides);
/// "soft" -> "soft_d2" for the draw with the number 1.
std::string name_of_draw(const std::string& variant, std::size_t draw);
/// Makes a variant its draw with this number. `pointer`: of the entry that asks for draws; `scene`:
/// with the variant's own changes.
void draw(VariantEntry& entry, std::size_t number, const char* pointer, Redrawn what, Reach reach,
          const nlohmann::json& scene);
/// The study's own variants, each so often: "soft", "soft_d2", "soft_d3"; of a study without
/// variants "d1", "d2", "d3".
std::vector<VariantEntry> repeated(const std::vector<VariantEntry>& own, const Draws& draws,
                                   Reach reach, const nlohmann::json& scene);
/// What a variant of the completed study repeats: "soft_d2" -> "soft"; its own name when it is no
/// repeat. variant: {name, made_by}.
std::string repeated_variant(const nlohmann::json& variant);

}  // namespace breach::orchestrator
