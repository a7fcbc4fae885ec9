#include "lem_tool/analysis.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/exchange/archive.hpp"
#include "lem_tool/search.hpp"
#include "lem_tool/slip_circle.hpp"

namespace breach::lem {

using nlohmann::json;
using process::PlanLine;
using process::Use;

namespace {

bool has_closed_region(const Model& model) {
    for (const Soil& soil : model.soils) {
        if (soil.passage == Soil::Passage::closed) return true;
    }
    return false;
}

json point(double x, double y) { return json::array({x, y}); }

json facts_of(const Critical& critical, double depth) {
    const Surface& s = critical.surface;
    const scene::Vec2 center = s.circle.center;
    const bool higher_left = s.level(s.left) > s.level(s.right);
    const double entry = higher_left ? s.left : s.right;
    const double exit = higher_left ? s.right : s.left;
    const double lowest = std::clamp(center.x(), s.left, s.right);
    return {{"factor_of_safety", critical.bishop.factor_of_safety},
            {"method", "bishop_simplified"},
            {"circle", {{"center", point(center.x(), center.y())}, {"radius", s.circle.radius}}},
            {"entry", point(entry, s.level(entry))},
            {"exit", point(exit, s.level(exit))},
            {"lowest_point", point(lowest, s.level(lowest))},
            {"sliding_depth", depth},
            {"least_m_alpha", critical.bishop.m_alpha},
            {"iterations", critical.bishop.iterations}};
}

std::string because(Cut cut) {
    switch (cut) {
        case Cut::above_ground:
            return "comes out of the ground between its ends";
        case Cut::leaves_model:
            return "leaves the model";
        case Cut::closed_region:
            return "passes through a linear elastic region, which cannot fail";
        case Cut::overhangs:
            return "meets the ground above its centre and would lean back over the mass";
        case Cut::done:
            break;
    }
    return "cuts nothing off";
}

std::string because(Balance balance) {
    switch (balance) {
        case Balance::no_driving_moment:
            return "cuts off a mass that its weight does not drive";
        case Balance::not_converged:
            return "has a factor of safety on which the iteration does not settle";
        case Balance::small_m_alpha:
        case Balance::found:
            break;
    }
    return "has no factor of safety";
}

[[noreturn]] void refuse_circle(const scene::Scene& scene, const std::string& why) {
    throw fault::BadInput(
        scene.name, {{"/lem/circle", why,
                      "give a circle whose lower arc cuts a mass off the slope, or a search"}});
}

struct Analysed {
    Critical critical;
    double depth;
};

/// The mass of the given circle with the lowest factor of safety; a circle can cut off several.
Analysed analyse_circle(const scene::Scene& scene, const Model& model, const scene::Circle& circle,
                        Slices& slices) {
    std::optional<Analysed> best;
    std::string why = because(Cut::done);
    for (const Surface& surface : masses_of(model.strata, circle)) {
        const Cut verdict = cut(model.strata, model.soils, surface, model.slices, slices);
        if (verdict != Cut::done) {
            why = because(verdict);
            continue;
        }
        const Bishop result = bishop(slices, slide_of(slices), model.k_h);
        // a small m_alpha is reported, not refused: this circle was asked for
        if (result.balance != Balance::found && result.balance != Balance::small_m_alpha) {
            why = because(result.balance);
            continue;
        }
        if (!best || result.factor_of_safety < best->critical.bishop.factor_of_safety) {
            best = Analysed{{surface, result}, slices.depth};
        }
    }
    if (!best) refuse_circle(scene, why);
    return *best;
}

std::vector<double> first(const std::vector<double>& array, std::size_t count) {
    return {array.begin(), array.begin() + static_cast<std::ptrdiff_t>(count)};
}

void write_surfaces(process::Session& session, const std::vector<PairBest>& pairs,
                    const Slices& slices) {
    exchange::Archive archive;
    archive.kind = "lem_surfaces";
    auto& reals = archive.reals;
    for (const PairBest& pair : pairs) {
        reals["pair_entry_x"].push_back(pair.entry);
        reals["pair_exit_x"].push_back(pair.exit);
        reals["pair_center_x"].push_back(pair.critical.surface.circle.center.x());
        reals["pair_center_y"].push_back(pair.critical.surface.circle.center.y());
        reals["pair_radius"].push_back(pair.critical.surface.circle.radius);
        reals["pair_factor_of_safety"].push_back(pair.critical.bishop.factor_of_safety);
    }
    reals["slice_left"] = first(slices.left, slices.count);
    reals["slice_width"] = first(slices.width, slices.count);
    reals["slice_base"] = first(slices.base, slices.count);
    reals["slice_weight"] = first(slices.weight, slices.count);
    reals["slice_u"] = first(slices.u, slices.count);
    reals["slice_c"] = first(slices.c, slices.count);
    reals["slice_tan_phi"] = first(slices.tan_phi, slices.count);
    for (const auto& [name, array] : reals) archive.units[name] = "m";
    archive.units["pair_factor_of_safety"] = archive.units["slice_tan_phi"] = "1";
    archive.units["slice_weight"] = "N/m";
    archive.units["slice_c"] = archive.units["slice_u"] = "Pa";
    const auto file = session.output("surfaces.h5");
    exchange::write_archive(file, archive, session.provenance());
    session.announce(file, {{"kind", "surfaces"}});
}

[[noreturn]] void refuse_search(const scene::Scene& scene, const Tally& tally) {
    throw fault::BadInput(
        scene.name,
        {{"/lem/search",
          "finds no surface: " + std::to_string(tally.not_a_surface) + " leave the soil, " +
              std::to_string(tally.too_shallow) + " are shallower than minimum_depth, " +
              std::to_string(tally.no_answer) + " have no factor of safety",
          "put entry on the upper and exit on the lower side of the slope, within the model"}});
}

json facts_of(const Tally& tally) {
    return {{"analysed", tally.analysed},
            {"outside_soil", tally.not_a_surface},
            {"too_shallow", tally.too_shallow},
            {"without_answer", tally.no_answer}};
}

}  // namespace

process::Plan plan(const scene::Scene& scene) {
    const Model model = make_model(scene);
    const scene::Lem& lem = scene::lem_of(scene);
    const auto use = [](bool on) { return on ? Use::on : Use::left_out; };
    const std::string strata = std::to_string(model.strata.strips.size()) + " strips with " +
                               std::to_string(model.strata.layers.size()) + " layer pieces";
    return {
        {"simplified Bishop", Use::on, "circular surfaces; " + strata, "/section/regions"},
        {"given circle", use(lem.circle.has_value()),
         lem.circle ? "one circle is given" : "no circle is given", "/lem/circle"},
        {"search", use(lem.search.has_value()),
         lem.search ? "entry and exit ranges are given" : "no ranges are given", "/lem/search"},
        {"regions that cannot fail", use(has_closed_region(model)),
         has_closed_region(model) ? "linear elastic: surfaces through them are not considered"
                                  : "every region has a Mohr-Coulomb law",
         "/materials"},
        {"softening", Use::left_out, "limit equilibrium takes the peak strength", "/materials"},
        {"water", use(lem.water.has_value()),
         lem.water ? "hydrostatic below the line, free water above ground" : "no line is given",
         "/lem/water"},
        {"pore pressure ratio", use(!lem.pore_pressure_ratios.empty()),
         std::to_string(lem.pore_pressure_ratios.size()) + " regions have one",
         "/lem/pore_pressure_ratios"},
        {"seismic coefficient", use(lem.seismic_coefficient > 0.0),
         lem.seismic_coefficient > 0.0 ? "weight pushes sideways" : "k_h is zero",
         "/lem/seismic_coefficient"},
        {"surcharge", use(!lem.surcharge.empty()),
         std::to_string(lem.surcharge.size()) + " loads on the ground", "/lem/surcharge"},
        {"liquefied layers", use(!lem.liquefaction.empty()),
         std::to_string(lem.liquefaction.size()) + " layers, one search per stage",
         "/lem/liquefaction"},
    };
}

namespace {

double top_of(const scene::Region& region) { return scene::bounding_box(region.polygon).high.y(); }
double bottom_of(const scene::Region& region) {
    return scene::bounding_box(region.polygon).low.y();
}

/// Depth at which F falls through 1, linear between the stages around it.
json depth_at_one(const json& stages) {
    for (std::size_t i = 1; i < stages.size(); ++i) {
        const double before = stages[i - 1].at("factor_of_safety");
        const double after = stages[i].at("factor_of_safety");
        if (before < 1.0 || after >= 1.0) continue;
        const double from = stages[i - 1].at("liquefied_depth");
        const double to = stages[i].at("liquefied_depth");
        return from + (to - from) * (before - 1.0) / (before - after);
    }
    return nullptr;
}

/// The search with 0, 1, 2, ... layers liquefied. Depths are below the top of the first layer.
void run_stages(const scene::Scene& scene, const Model& sound, Slices& slices, json& result) {
    const std::vector<scene::LiquefiedLayer>& layers = scene.lem->liquefaction;
    const double top = top_of(scene.section.regions[layers.front().region]);
    std::int64_t analysed = 0;
    json stages = json::array();
    for (std::size_t count = 0; count <= layers.size(); ++count) {
        Model model = sound;
        model.soils = liquefied(sound, layers, count);
        const SearchResult found = search(model, *scene.lem->search);
        if (!found.critical) refuse_search(scene, found.tally);
        cut(model.strata, model.soils, found.critical->surface, model.slices, slices);
        json stage = facts_of(*found.critical, slices.depth);
        stage["layers_liquefied"] = count;
        stage["liquefied_depth"] =
            count == 0 ? 0.0 : top - bottom_of(scene.section.regions[layers[count - 1].region]);
        stage["lowest_point_depth"] = top - stage.at("lowest_point")[1].get<double>();
        analysed += found.tally.analysed;
        stages.push_back(stage);
    }
    const auto lowest =
        std::min_element(stages.begin(), stages.end(), [](const json& a, const json& b) {
            // a stage that repeats the minimum adds nothing: the earlier one counts
            return a.at("factor_of_safety").get<double>() <
                   b.at("factor_of_safety").get<double>() * (1.0 - 1e-6);
        });
    result["stages"] = stages;
    result["critical_depth"] = lowest->at("lowest_point_depth");
    result["depth_at_fs_1"] = depth_at_one(stages);
    result["surfaces_analysed_in_stages"] = analysed;
}

}  // namespace

process::Outcome run(process::Session& session) {
    const auto began = std::chrono::steady_clock::now();
    const scene::Scene& scene = session.scene();
    const scene::Lem& lem = scene::lem_of(scene);
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    json& result = session.result();
    std::vector<PairBest> pairs;
    if (lem.circle) {
        const Analysed given = analyse_circle(scene, model, *lem.circle, slices);
        const json facts = facts_of(given.critical, given.depth);
        if (lem.search) {
            result["given_circle"] = facts;
        } else {
            result = facts;
            cut(model.strata, model.soils, given.critical.surface, model.slices, slices);
            result["surfaces"] = facts_of(Tally{.analysed = 1});
        }
    }
    if (lem.search) {
        SearchResult found = search(model, *lem.search);
        if (!found.critical) refuse_search(scene, found.tally);
        cut(model.strata, model.soils, found.critical->surface, model.slices, slices);
        result.update(facts_of(*found.critical, slices.depth));
        result["surfaces"] = facts_of(found.tally);
        pairs = std::move(found.pairs);
    }
    result["slices"] = slices.count;
    result["surfaces_analysed"] = result["surfaces"]["analysed"];
    write_surfaces(session, pairs, slices);
    if (!lem.liquefaction.empty()) run_stages(scene, model, slices, result);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    result["seconds"] = took.count();
    session.progress(1.0, "factor of safety " + result["factor_of_safety"].dump());
    return process::Outcome::done;
}

}  // namespace breach::lem
