// A runout depends on where the material points lie, a FEM near failure on its steps: numerical
// noise that one run does not show. Repeats measure it. Each is a variant with overrides of its
// own, so tasks, cache and results need no notion of repeats.
#include "services/orchestrator/study/draws.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/scene/schema.hpp"
#include "core/words/number.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;

namespace {

constexpr const char* point_shift = "/transfer/point_shift";
constexpr const char* fill_shift = "/mpm/fill_shift";

/// The k-th point of the R2 sequence (Roberts 2018), which fills the unit square evenly for every
/// length; point 0 is the corner.
std::array<double, 2> place_of_draw(std::size_t draw) {
    // The inverse of the plastic number and its square, to all digits of a double.
    constexpr std::array step{0.7548776662466927, 0.5698402909980532};
    const auto k = static_cast<double>(draw);
    return {std::fmod(k * step[0], 1.0), std::fmod(k * step[1], 1.0)};
}

std::string override_of(const char* pointer, double a, double b) {
    std::array<char, 96> text{};
    // Four digits: the text is part of the cache's key and must be the same on every machine.
    std::snprintf(text.data(), text.size(), "%s=[%.4f,%.4f]", pointer, a, b);
    return text.data();
}

std::string override_of(const std::string& pointer, double value) {
    return pointer + "=" + words::text_of(value);
}

/// The force tolerance falls by 5 % from repeat to repeat, and time steps shrink by the fractional
/// parts of multiples of the golden ratio, scaled to 0 to 10 %: numerical noise, no change of the
/// model. Near failure the runs diverge. Tolerances alone have too little effect: the crest of
/// docs/verification/mochikoshi_fem.md scatters three times as much with the steps.
std::vector<std::string> fem_of_draw(std::size_t draw, const json& scene) {
    // Repeat 0 is the scene itself, so that it shares its results with runs without repeats.
    if (draw == 0 || !scene.contains("fem")) return {};
    const auto d = static_cast<double>(draw);
    std::vector<std::string> changes;
    const auto scale = [&](const std::string& pointer, double by) {
        const json::json_pointer place(pointer);
        if (scene.contains(place) && scene[place].is_number())
            changes.push_back(override_of(pointer, by * scene[place].get<double>()));
    };
    scale("/fem/force_tolerance", std::pow(0.95, d));
    const std::size_t stages = scene["fem"].value("stages", json::array()).size();
    for (std::size_t i = 0; i < stages; ++i)
        scale("/fem/stages/" + std::to_string(i) + "/time_step",
              1.0 - 0.1 * std::fmod(d * 0.6180339887498949, 1.0));
    return changes;
}

}  // namespace

bool is_lattice(const std::string& pointer) {
    return pointer.starts_with(point_shift) || pointer.starts_with(fill_shift);
}

std::vector<std::string> lattice_of_draw(std::size_t draw, Reach reach) {
    if (draw == 0) return {};
    const auto [a, b] = place_of_draw(draw);
    if (reach == Reach::filled_mpm) return {override_of(fill_shift, a, b)};
    constexpr double largest_shift = 0.9;  // allowed by the scene, to either side
    return {
        override_of(point_shift, largest_shift * (2.0 * a - 1.0), largest_shift * (2.0 * b - 1.0))};
}

/// The schema has refused every other word.
Redrawn redrawn_named(const std::string& name) {
    return name == name_of(Redrawn::fem) ? Redrawn::fem : Redrawn::points;
}

std::string_view name_of(Redrawn what) { return what == Redrawn::fem ? "fem" : "points"; }

bool can_redraw(Redrawn what, Reach reach) {
    return what == Redrawn::fem ? reach == Reach::chain || reach == Reach::fem : has_lattice(reach);
}

void check_draws(const Draws& draws, Reach reach, const std::string& where,
                 std::vector<Fault>& faults) {
    const char* program = phases_of(reach).front().program;
    if (draws.of == Redrawn::fem && !can_redraw(draws.of, reach))
        faults.push_back(
            {where + "/draws_of",
             std::string("each repeat computes the FEM again, and ") + program + " comes first",
             "leave \"draws_of\" out"});
    else if (draws.count > 1 && !can_redraw(draws.of, reach))
        faults.push_back(
            {where + "/draws",
             std::string("repeats move the lattice of material points, and ") + program +
                 " has none",
             can_redraw(Redrawn::fem, reach)
                 ? "give \"draws_of\": \"fem\", so that each computes the FEM again, or "
                   "leave \"draws\" out"
                 : "leave \"draws\" out: every run gives the same"});
}

Draws draws_of(const json& study) {
    return {study.value("draws", std::size_t{1}), redrawn_named(study.value("draws_of", ""))};
}

json changed(json scene, const std::vector<std::string>& overrides) {
    for (const std::string& each : overrides) scene::apply_override(scene, each);
    return scene;
}

/// Numbers in names count from 1, so the first repeat of "soft" is "soft_d2".
std::string name_of_draw(const std::string& variant, std::size_t draw) {
    if (draw == 0) return variant;
    return variant + "_d" + std::to_string(draw + 1);
}

void draw(VariantEntry& entry, std::size_t number, const char* pointer, Redrawn what, Reach reach,
          const json& scene) {
    const auto add = [&](const std::vector<std::string>& changes) {
        entry.overrides.insert(entry.overrides.end(), changes.begin(), changes.end());
    };
    // A fault of repeat 0 is the variant's own.
    if (number > 0) entry.draws_pointer = pointer;
    if (what == Redrawn::fem) add(fem_of_draw(number, scene));
    if (has_lattice(reach)) add(lattice_of_draw(number, reach));
}

std::vector<VariantEntry> repeated(const std::vector<VariantEntry>& own, const Draws& draws,
                                   Reach reach, const json& scene) {
    std::vector<VariantEntry> entries;
    for (const VariantEntry& each : own) {
        const json its_scene = changed(scene, each.overrides);
        for (std::size_t d = 0; d < draws.count; ++d) {
            VariantEntry entry = each;
            // A study without variants: its repeats have no stem, and all of them are made here.
            const bool unnamed = each.name.empty();
            entry.name = unnamed ? "d" + std::to_string(d + 1) : name_of_draw(each.name, d);
            if (unnamed || d > 0) entry.made_by = "draws";
            draw(entry, d, "/draws", draws.of, reach, its_scene);
            entries.push_back(std::move(entry));
        }
    }
    return entries;
}

}  // namespace breach::orchestrator
