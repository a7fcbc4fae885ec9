// A study's repeats. A repeat moves the lattice of points, or computes the FEM again with slightly
// different steps and tolerances; each is an ordinary variant. Sweeps and accuracy studies use it;
// an uncertainty study samples the lattice as a parameter.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/fault/fault.hpp"
#include "services/orchestrator/study/reach.hpp"

namespace breach::orchestrator {

/// What a repeat changes: the lattice of points, or also the FEM, with slightly different steps and
/// tolerances. A converged result does not change.
enum class Redrawn { points, fem };
/// An empty name means points.
Redrawn redrawn_named(const std::string& name);
std::string_view name_of(Redrawn what);
/// Whether these phases contain what the repeat changes.
bool can_redraw(Redrawn what, Reach reach);

/// How many repeats, the scene itself included.
struct Draws {
    std::size_t count = 1;
    Redrawn of = Redrawn::points;
};
/// Faults of repeats without effect on the quantity or the runout. `where`: pointer of their
/// object.
void check_draws(const Draws& draws, Reach reach, const std::string& where,
                 std::vector<fault::Fault>& faults);
/// Why repeats of the FEM allow transfer times only.
inline constexpr const char* each_fem_has_its_time =
    "each repeat has its own FEM, and a trigger fires at another time in each: there would be no "
    "mean at a transfer time";
/// The study's entries, which the schema has accepted; missing entries mean no repeats.
Draws draws_of(const nlohmann::json& study);

/// Whether this entry of a scene moves the lattice of points, as repeats do.
bool is_lattice(const std::string& pointer);
/// Overrides that move the points to another lattice; none for repeat 0, the scene's own lattice.
std::vector<std::string> lattice_of_draw(std::size_t draw, Reach reach);

/// A variant before its scene is checked.
struct VariantEntry {
    std::string name;
    std::vector<std::string> overrides;
    std::string name_pointer;        ///< of the study's entry that defines the name
    std::string pointer;             ///< of the entry that defines the overrides
    std::string made_by;             ///< "draws", "accuracy", "uncertainty"; empty: the study's own
    std::string draws_pointer = {};  ///< of the entry that repeats it; empty: no repeat
    nlohmann::json sample = nullptr;  ///< its sampled values (sampled_variants.hpp)
};
nlohmann::json changed(nlohmann::json scene, const std::vector<std::string>& overrides);
/// "soft" -> "soft_d2" for the repeat with the number 1.
std::string name_of_draw(const std::string& variant, std::size_t draw);
/// Makes a variant its repeat with this number. `pointer`: of the entry that requests repeats;
/// `scene`: with the variant's own changes.
void draw(VariantEntry& entry, std::size_t number, const char* pointer, Redrawn what, Reach reach,
          const nlohmann::json& scene);
/// The study's own variants with their repeats: "soft", "soft_d2", "soft_d3"; without variants
/// "d1", "d2", "d3".
std::vector<VariantEntry> repeated(const std::vector<VariantEntry>& own, const Draws& draws,
                                   Reach reach, const nlohmann::json& scene);

}  // namespace breach::orchestrator
