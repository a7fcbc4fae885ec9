// The analysis from top to bottom: strength at failure (limit_scene), the surfaces of the sound
// slope, the same for each stage of liquefaction, then the probability of failure. Each part adds
// its entries to one json, from which log, tables and flags are made.
#include "lem_tool/analysis.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>

#include "core/exchange/archive.hpp"
#include "core/words/number.hpp"
#include "lem_tool/after_shaking.hpp"
#include "lem_tool/answer.hpp"
#include "lem_tool/drained.hpp"
#include "lem_tool/facts.hpp"
#include "lem_tool/limit_scene.hpp"
#include "lem_tool/non_circular.hpp"
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

/// Writes the pairs of ends and the slices of the critical circle.
void write_surfaces(process::Session& session, const Searched& circles) {
    const Model& model = circles.model;
    // Bishop's circle also where another surface has the lower factor: the figure of the search
    // shows it.
    Slices slices = make_slices(model.strata, model.slices);
    cut(model.strata, model.soils, circles.found.critical->surface, model.slices, slices);
    exchange::Archive archive;
    archive.kind = "lem_surfaces";
    auto& reals = archive.reals;
    add_polylines(session.result(), archive);
    for (const PairBest& pair : circles.found.pairs) {
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

std::string place(const json& point) {
    return words::formatted("(%.4g, %.4g)", point[0].get<double>(), point[1].get<double>());
}

std::string other_methods(const json& facts) {
    std::string words;
    if (const json& spencer = facts.at("spencer"); !spencer.is_null())
        words += words::formatted("; Spencer %.3f", spencer.at("factor_of_safety").get<double>());
    else
        words += "; Spencer none";
    if (const json& ordinary = facts.at("ordinary"); !ordinary.is_null())
        words += words::formatted("; Ordinary %.3f", ordinary.at("factor_of_safety").get<double>());
    return words;
}

/// Logs the result in words.
void say(const json& result) {
    const double F = result.at("factor_of_safety");
    const std::string surface = result.at("surface");
    spdlog::info("least factor of safety {:.3f} ({}, {}): {}", F,
                 result.at("method") == "spencer" ? "Spencer" : "simplified Bishop",
                 in_words(surface), F < 1.0 ? "the slope fails" : "the slope is stable");
    constexpr double telling_error = 1e-3;
    if (const double error = result.value("search_error", 0.0); error > telling_error)
        spdlog::info("the search knows it to {:.1g} %", 100.0 * error);
    const json& bishop = result.at("bishop");
    spdlog::info("critical circle: simplified Bishop {:.3f}{}",
                 bishop.at("factor_of_safety").get<double>(), other_methods(bishop));
    if (const std::string why = bishop.at("spencer_reason"); !why.empty())
        spdlog::info("Spencer's method has no answer on it: {}", why);
    spdlog::info("it lies about {}, radius {:.4g} m, enters at {}, leaves at {}, lowest at {}",
                 place(bishop.at("circle").at("center")),
                 bishop.at("circle").at("radius").get<double>(), place(bishop.at("entry")),
                 place(bishop.at("exit")), place(bishop.at("lowest_point")));
    for (const char* name : {"composite", "given_circle", "given_polyline", "non_circular"})
        if (result.contains(name) && !result.at(name).is_null())
            spdlog::info("{}: factor of safety {:.3f} ({})", in_words(name),
                         result.at(name).at("factor_of_safety").get<double>(),
                         result.at(name).at("method") == "spencer" ? "Spencer" : "Bishop");
    if (!result.contains("stages")) return;
    for (const json& stage : result.at("stages"))
        spdlog::info("liquefied to {:.4g} m: factor of safety {:.3f}",
                     stage.at("liquefied_depth").get<double>(),
                     stage.at("factor_of_safety").get<double>());
    if (const nlohmann::json& depth = result.at("depth_at_fs_1"); depth.is_number())
        spdlog::info("F falls to 1 when {:.4g} m have liquefied", depth.get<double>());
    spdlog::info("the critical surface reaches a depth of {:.4g} m (critical_depth)",
                 result.at("critical_depth").get<double>());
}

}  // namespace

/// The whole model is built for it: a section that cannot be cut into strips is refused here, too.
process::Plan plan(const scene::Scene& whole) {
    const scene::Scene scene = limit_scene(whole);
    const Model model = make_model(scene);
    const scene::Lem& lem = scene::lem_of(scene);
    const auto use = [](bool on) { return on ? Use::on : Use::left_out; };
    const auto profiles = std::ranges::count_if(whole.materials, scene::lem_takes_profile);
    const auto goes_by_state = [](const scene::UndrainedRegion& each) {
        return each.strength.on_path.has_value();
    };
    const auto by_state = std::ranges::count_if(whole.lem->undrained, goes_by_state) +
                          std::ranges::count_if(whole.lem->liquefaction, goes_by_state);
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
         lem.non_circular ? "straight pieces, by Spencer's method"
                          : "not asked for: only from surfaces along thin weak layers",
         "/lem/non_circular"},
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
        {"liquefied layers", use(!lem.liquefaction.empty()),
         std::to_string(lem.liquefaction.size()) +
             " layers, one search per stage, below the phreatic line",
         "/lem/liquefaction"},
        {"probability of failure", use(lem.probability.has_value()),
         lem.probability ? std::to_string(lem.probability->samples) + " samples" : "not asked for",
         "/lem/probability"},
    };
}

namespace {

/// The result of the search or the given circle; puts facts of given surfaces into `given`.
Families first_families(const scene::Scene& scene, const Model& model, int threads, json& given) {
    const scene::Lem& lem = *scene.lem;
    if (lem.non_circular && !lem.non_circular->given.empty())
        given["given_polyline"] = given_polyline(scene, model);
    Families circle;
    if (lem.circle) circle = given_family(scene, model);
    // With both entries the search is the answer, and the given circle one more surface beside it.
    if (lem.circle && lem.search) given["given_circle"] = facts_of(circle.circles);
    if (!lem.search) return circle;
    Families found = search_families(scene, model, *lem.search, threads);
    if (!found.circles.found.critical)
        refuse_search(scene, found.circles.model, found.circles.found.tally);
    return found;
}

/// Flags each code and place once: stages repeat those of earlier stages.
void flag_each_once(process::Session& session, std::vector<fault::Flag>& flags) {
    std::set<std::pair<std::string, std::string>> said;
    for (fault::Flag& each : flags)
        if (said.emplace(each.code, each.pointer).second) session.flag(std::move(each));
}

}  // namespace

namespace {

/// The model of the last snapshot, to be analysed as any other; rows for all before it.
Shaken last_of(const scene::Scene& scene, process::Session& session, json& rows) {
    const Model sound = make_model(scene);
    const std::vector<std::filesystem::path> snapshots = snapshots_of(session.input());
    for (std::size_t i = 0;; ++i) {
        Shaken now = shaken(sound, session.scene(), snapshots[i]);
        if (i + 1 == snapshots.size() || session.stop_requested()) return now;
        json given;
        const Families found = first_families(scene, now.model, session.settings().threads, given);
        rows.push_back(row_of(now.time, answer(scene, found, given)));
        session.progress(static_cast<double>(i + 1) / static_cast<double>(snapshots.size()),
                         words::formatted("factor of safety at %.4g s", now.time));
    }
}

}  // namespace

process::Outcome run(process::Session& session) {
    const auto began = std::chrono::steady_clock::now();
    const bool has_shaken = !session.settings().inputs.empty();
    const scene::Scene scene =
        limit_scene(has_shaken ? without_states(session.scene()) : session.scene());
    const scene::Lem& lem = scene::lem_of(scene);
    const int threads = session.settings().threads;
    // With the scene as written: in limit_scene, laws give way to their strength.
    if (!has_shaken)
        for (fault::Flag& each : flags_of_drained(session.scene())) session.flag(std::move(each));
    json rows = json::array();
    const Shaken last = has_shaken ? last_of(scene, session, rows) : Shaken{0.0, make_model(scene)};
    if (session.stop_requested()) return process::Outcome::stopped;
    const Model& model = last.model;
    json& result = session.result();
    const Families found = first_families(scene, model, threads, result);
    result = answer(scene, found, result);
    result["surfaces"] = facts_of(found.circles.found.tally);
    result["surfaces_analysed"] = found.circles.found.tally.analysed;
    write_surfaces(session, found.circles);
    // All states add to one list, so that a bound is reported once, for the state it shows in
    // first.
    std::vector<fault::Flag> flags;
    add_flags_of_state(scene, {"", model, found, result}, threads, flags);
    if (!lem.liquefaction.empty()) {
        add_stages(scene, model, found, threads, result, flags);
        write_table(session, "stages", table_of(result.at("stages")));
        std::ranges::move(flags_of_stages(result.at("stages")), std::back_inserter(flags));
    }
    flag_each_once(session, flags);
    if (has_shaken) {
        rows.push_back(row_of(last.time, result));
        write_table(session, "after_shaking", table_of_times(rows));
        result["after_shaking"] = std::move(rows);
    }
    if (lem.probability) {
        const Samples samples = add_probability(session.scene(), threads, result);
        write_table(session, "samples", table_of(samples));
    }
    for (fault::Flag& each : flags_of_variations(result)) session.flag(std::move(each));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    result["seconds"] = took.count();
    say(result);
    session.progress(1.0, "factor of safety " + result["factor_of_safety"].dump());
    return process::Outcome::done;
}

}  // namespace breach::lem
