#include "lem_tool/analysis.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "core/exchange/archive.hpp"
#include "lem_tool/drained.hpp"
#include "lem_tool/facts.hpp"
#include "lem_tool/limit_scene.hpp"
#include "lem_tool/non_circular.hpp"
#include "lem_tool/search.hpp"
#include "lem_tool/stages.hpp"
#include "lem_tool/variation.hpp"

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

std::vector<double> first(const std::vector<double>& array, std::size_t count) {
    return {array.begin(), array.begin() + static_cast<std::ptrdiff_t>(count)};
}

void add_polylines(const json& result, exchange::Archive& archive) {
    for (const char* name : {"given_polyline", "non_circular"}) {
        if (!result.contains(name) || result.at(name).is_null()) continue;
        for (const json& point : result.at(name).at("points")) {
            archive.reals[std::string(name) + "_x"].push_back(point[0]);
            archive.reals[std::string(name) + "_y"].push_back(point[1]);
        }
    }
}

void write_surfaces(process::Session& session, const std::vector<PairBest>& pairs,
                    const Slices& slices) {
    exchange::Archive archive;
    archive.kind = "lem_surfaces";
    auto& reals = archive.reals;
    add_polylines(session.result(), archive);
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

void write_table(process::Session& session, const std::string& kind, const std::string& text) {
    const auto file = session.output(kind + ".csv");
    std::ofstream stream(file);
    stream << text;
    stream.close();
    if (!stream) throw fault::IoError(file.string() + ": cannot be written");
    session.announce(file, {{"kind", kind}});
}

std::string spelt(const char* format, double value) {
    char words[48];
    std::snprintf(words, sizeof words, format, value);
    return words;
}

std::string place(const json& point) {
    return spelt("(%.4g, ", point[0]) + spelt("%.4g)", point[1]);
}

std::string other_methods(const json& facts) {
    std::string words;
    if (const json& spencer = facts.at("spencer"); !spencer.is_null())
        words += spelt("; Spencer %.3f", spencer.at("factor_of_safety"));
    else
        words += "; Spencer none";
    if (const json& ordinary = facts.at("ordinary"); !ordinary.is_null())
        words += spelt("; Ordinary %.3f", ordinary.at("factor_of_safety"));
    return words;
}

/// The critical surface ends where the search was not allowed to go on.
void flag_edges(process::Session& session, const Strata& strata, const scene::SlipSearch& search,
                const json& result) {
    std::vector<std::pair<std::string, const json*>> surfaces{{"the critical surface", &result}};
    if (result.contains("stages"))
        for (const json& stage : result.at("stages").get_ref<const json::array_t&>())
            if (const int layers = stage.at("layers_liquefied"); layers > 0)
                surfaces.emplace_back("the critical surface with " + std::to_string(layers) +
                                          (layers == 1 ? " layer" : " layers") + " liquefied",
                                      &stage);
    const auto look = [&](const std::array<double, 2>& range, const std::string& end) {
        const double width = strata.right() - strata.left();
        for (const double edge : range) {
            const bool ground_ends = edge <= strata.left() || edge >= strata.right();
            if (ground_ends || range[0] == range[1]) continue;
            const auto at_edge = [&](const auto& each) {
                return std::abs(each.second->at(end)[0].template get<double>() - edge) <=
                       1e-3 * width;
            };
            const auto first = std::ranges::find_if(surfaces, at_edge);
            if (first == surfaces.end()) continue;
            session.flag({"range_edge", fault::Severity::warning,
                          first->first + " ends at the edge of this range, x = " +
                              spelt("%.4g m", edge) + ": a lower factor of safety may lie beyond" +
                              (first->second == &result ? "" : ", and another critical_depth") +
                              "; widen it",
                          "/lem/search/" + end});
        }
    };
    look(search.entry, "entry");
    look(search.exit, "exit");
}

/// The answer in words, for whoever reads the log and not result.json.
void say(const json& result) {
    const double F = result.at("factor_of_safety");
    spdlog::info("least factor of safety {:.3f} (simplified Bishop{}): {}", F,
                 other_methods(result), F < 1.0 ? "the slope fails" : "the slope stands");
    if (const std::string why = result.at("spencer_reason"); !why.empty())
        spdlog::info("Spencer's method has no answer: {}", why);
    spdlog::info("its circle about {}, radius {:.4g} m, enters at {}, leaves at {}, lowest at {}",
                 place(result.at("circle").at("center")),
                 result.at("circle").at("radius").get<double>(), place(result.at("entry")),
                 place(result.at("exit")), place(result.at("lowest_point")));
    for (const auto& [name, what] : {std::pair{"given_polyline",
                                               "the given surface of straight "
                                               "pieces"},
                                     {"non_circular", "the optimised surface of straight pieces"}})
        if (result.contains(name) && !result.at(name).is_null())
            spdlog::info("{}: factor of safety {:.3f} (Spencer)", what,
                         result.at(name).at("factor_of_safety").get<double>());
    if (!result.contains("stages")) return;
    for (const json& stage : result.at("stages"))
        spdlog::info("liquefied to {:.4g} m: factor of safety {:.3f}",
                     stage.at("liquefied_depth").get<double>(),
                     stage.at("factor_of_safety").get<double>());
    spdlog::info("critical depth {:.4g} m", result.at("critical_depth").get<double>());
}

}  // namespace

process::Plan plan(const scene::Scene& whole) {
    const scene::Scene scene = limit_scene(whole);
    const Model model = make_model(scene);
    const scene::Lem& lem = scene::lem_of(scene);
    const auto use = [](bool on) { return on ? Use::on : Use::left_out; };
    const auto profiles = std::ranges::count_if(whole.materials, scene::lem_takes_profile);
    const auto says_norsand = [](const scene::UndrainedRegion& each) {
        return each.strength.norsand.has_value();
    };
    const auto by_state = std::ranges::count_if(whole.lem->undrained, says_norsand) +
                          std::ranges::count_if(whole.lem->liquefaction, says_norsand);
    const std::string strata = std::to_string(model.strata.strips.size()) + " strips with " +
                               std::to_string(model.strata.layers.size()) + " layer pieces";
    return {
        {"simplified Bishop", Use::on, "Spencer and Ordinary on the critical surface; " + strata,
         "/section/regions"},
        {"given circle", use(lem.circle.has_value()),
         lem.circle ? "one circle is given" : "no circle is given", "/lem/circle"},
        {"search", use(lem.search.has_value()),
         lem.search ? "entry and exit ranges are given" : "no ranges are given", "/lem/search"},
        {"regions that cannot fail", use(has_closed_region(model)),
         has_closed_region(model) ? "linear elastic: surfaces through them are not considered"
                                  : "every region has a strength",
         "/materials"},
        {"softening", Use::left_out, "limit equilibrium takes the peak strength", "/materials"},
        {"water", use(lem.water.has_value()),
         lem.water ? "hydrostatic below the line, free water above ground" : "no line is given",
         "/lem/water"},
        {"piezometric lines", use(!lem.piezometric_lines.empty()),
         std::to_string(lem.piezometric_lines.size()) + " lines for regions of their own",
         "/lem/piezometric_lines"},
        {"pore pressure ratio", use(!lem.pore_pressure_ratios.empty()),
         std::to_string(lem.pore_pressure_ratios.size()) + " regions have one",
         "/lem/pore_pressure_ratios"},
        {"composite surfaces", use(!lem.floor.empty()),
         lem.floor.empty() ? "no floor is given" : "circles follow the floor", "/lem/floor"},
        {"tension crack", use(lem.tension_crack.has_value()),
         lem.tension_crack ? "surfaces end at its foot" : "no crack is given",
         "/lem/tension_crack"},
        {"non-circular surfaces", use(lem.non_circular.has_value()),
         lem.non_circular ? "straight pieces, by Spencer's method" : "circles only",
         "/lem/non_circular"},
        {"limit on m_alpha", use(lem.m_alpha.least > 0.0),
         "surfaces below " + spelt("%.3g", lem.m_alpha.least) + " do not count", "/lem/m_alpha"},
        {"strength profiles", use(profiles > 0),
         std::to_string(profiles) + " materials take theirs at each slice's base", "/materials"},
        {"undrained strength", use(!lem.undrained.empty()),
         std::to_string(lem.undrained.size()) + " regions fail undrained", "/lem/undrained"},
        {"NorSand's undrained strength", use(by_state > 0),
         std::to_string(by_state) + " entries have s_u by psi_0, K_0 and S, in simple shear",
         "/lem/undrained"},
        {"seismic coefficient", use(lem.seismic_coefficient > 0.0),
         lem.seismic_coefficient > 0.0 ? "weight pushes sideways" : "k_h is zero",
         "/lem/seismic_coefficient"},
        {"surcharge", use(!lem.surcharge.empty()),
         std::to_string(lem.surcharge.size()) + " loads on the ground", "/lem/surcharge"},
        {"line loads", use(!lem.line_loads.empty()),
         std::to_string(lem.line_loads.size()) + " forces on the ground", "/lem/line_loads"},
        {"liquefied layers", use(!lem.liquefaction.empty()),
         std::to_string(lem.liquefaction.size()) +
             " layers, one search per stage, below the phreatic line",
         "/lem/liquefaction"},
        {"sensitivity", use(lem.sensitivity.has_value()),
         lem.sensitivity ? "every strength parameter alone" : "not asked for", "/lem/sensitivity"},
        {"probability of failure", use(lem.probability.has_value()),
         lem.probability ? std::to_string(lem.probability->samples) + " samples" : "not asked for",
         "/lem/probability"},
    };
}

process::Outcome run(process::Session& session) {
    const auto began = std::chrono::steady_clock::now();
    const scene::Scene scene = limit_scene(session.scene());
    const scene::Lem& lem = scene::lem_of(scene);
    const int threads = session.settings().threads;
    for (fault::Flag& each : flags_of_drained(session.scene())) session.flag(std::move(each));
    const Model model = make_model(scene);
    Slices slices = make_slices(model.strata, model.slices);
    json& result = session.result();
    SearchResult found;
    if (lem.circle) {
        const Critical given = analyse_circle(scene, model, slices);
        const json facts = facts_of(model, given, slices);
        if (lem.search) {
            result["given_circle"] = facts;
        } else {
            result = facts;
            found.critical = given;
            found.tally.analysed = 1;
        }
    }
    if (lem.search) {
        found = found_by_search(scene, model, threads);
        result.update(facts_of(model, *found.critical, slices));
    }
    if (lem.non_circular && !lem.non_circular->given.empty())
        result["given_polyline"] = given_polyline(scene, model);
    if (lem.non_circular && lem.non_circular->vertices > 0)
        result["non_circular"] = optimised_polyline(scene, model, found.critical->surface);
    for (fault::Flag& each : flags_of_polyline(result.value("non_circular", json())))
        session.flag(std::move(each));
    result["surfaces"] = facts_of(found.tally);
    result["surfaces_analysed"] = found.tally.analysed;
    write_surfaces(session, found.pairs, slices);
    if (!lem.liquefaction.empty()) {
        add_stages(scene, model, found, threads, result);
        write_table(session, "stages", table_of(result.at("stages")));
        for (fault::Flag& each : flags_of_stages(result.at("stages")))
            session.flag(std::move(each));
    }
    if (lem.search) flag_edges(session, model.strata, *lem.search, result);
    if (lem.sensitivity) add_sensitivity(session.scene(), threads, result);
    if (lem.probability) {
        const Samples samples = add_probability(session.scene(), threads, result);
        write_table(session, "samples", table_of(samples));
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    result["seconds"] = took.count();
    say(result);
    session.progress(1.0, "factor of safety " + result["factor_of_safety"].dump());
    return process::Outcome::done;
}

}  // namespace breach::lem
