// Files and messages of a transfer; the method is in transfer.cpp. There is no checkpoint: a
// transfer that was stopped starts again.
#include "transfer_tool/run.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "core/phases/files.hpp"
#include "core/scene/words.hpp"
#include "core/words/number.hpp"
#include "transfer_tool/transfer.hpp"

namespace breach::transfer {
namespace {

nlohmann::json as_json(const exchange::Ledger& ledger) {
    nlohmann::json rows = nlohmann::json::array();
    for (const exchange::LedgerRow& row : ledger)
        rows.push_back({{"region", row.region},
                        {"quantity", row.quantity},
                        {"unit", row.unit},
                        {"before", row.before},
                        {"after", row.after},
                        {"relative_difference", row.difference}});
    return rows;
}

std::string named(const SoilOfPoints& soil) { return soil.region + " / " + soil.material; }

nlohmann::json soils_as_json(const Transferred& t) {
    nlohmann::json soils = nlohmann::json::array();
    for (const SoilShare& each : t.shares) {
        const SoilOfPoints& soil = t.soils[each.soil];
        soils.push_back({{"region", soil.region},
                         {"material", soil.material},
                         {"stress", words::name_of(soil.stress)},
                         {"points", each.points},
                         {"mass", each.mass}});
        const YieldShare& outside = t.yield[each.soil];
        if (outside.returned == 0) continue;
        soils.back()["outside_yield_surface"] = {{"points", outside.returned},
                                                 {"mass", outside.mass},
                                                 {"largest_excess", outside.largest_excess},
                                                 {"at", {outside.place.x(), outside.place.y()}}};
    }
    return soils;
}

/// Sum over all soils.
YieldShare outside_yield_surface(const YieldReport& report) {
    YieldShare all;
    for (const YieldShare& each : report) {
        all.returned += each.returned;
        all.largest_excess = std::max(all.largest_excess, each.largest_excess);
    }
    return all;
}

nlohmann::json softening_as_json(const Transferred& t) {
    nlohmann::json softening = nlohmann::json::array();
    for (const SofteningShare& each : t.softening) {
        softening.push_back({{"region", t.soils[each.soil].region},
                             {"material", t.soils[each.soil].material},
                             {"driver", words::name_of(each.driver)},
                             {"mean_epsilon_q", each.mean},
                             {"largest_epsilon_q", each.largest}});
    }
    return softening;
}

nlohmann::json rebuilt_as_json(const std::vector<RebuiltElement>& rebuilt) {
    nlohmann::json elements = nlohmann::json::array();
    for (const RebuiltElement& each : rebuilt)
        elements.push_back({{"element", each.element},
                            {"region", each.region},
                            {"centre", {each.centre.x(), each.centre.y()}},
                            {"least_jacobian_ratio", each.least},
                            {"area_on_mesh", each.area_on_mesh},
                            {"area", each.area}});
    return elements;
}

std::string collapse_criterion(const CollapseReport& collapse) {
    return "eta / eta_L >= " + words::text_of(liquefied::instability) + " and epsilon_q > " +
           words::text_of(collapse.epsilon_q);
}

void report_options(const Transferred& t, nlohmann::json& result) {
    if (t.supply)
        result["cells"] = {{"occupied", t.supply->occupied},
                           {"filled", t.supply->filled},
                           {"least_points_in_a_filled_cell", t.supply->least_in_filled},
                           {"short", t.supply->short_cells}};
    if (t.liquefaction) result["liquefied_share"] = t.liquefaction->share;
    if (t.liquefaction && t.liquefaction->columns) {
        const LiquefiedColumns& columns = *t.liquefaction->columns;
        result["liquefied_when"] = words::name_of(columns.when);
        result["liquefied_nodes"] = columns.nodes;
        result["liquefied_closed_width"] = columns.closed_width;
        if (columns.nodes > 0) result["deepest_liquefied_level"] = columns.deepest_level;
    }
    if (t.collapse)
        result["collapse"] = {{"criterion", collapse_criterion(*t.collapse)},
                              {"points_of_norsand", t.collapse->points},
                              {"saturated", t.collapse->saturated},
                              {"past_instability_line", t.collapse->past_line},
                              {"collapsed", t.collapse->collapsed},
                              {"collapsed_mass", t.collapse->mass}};
    if (t.base_displacement != 0.0) result["base_displacement_subtracted"] = t.base_displacement;
}

void log(const Transferred& t) {
    spdlog::info("{} points at t_T = {} s\n{}", t.state.size(), t.state.transfer_time,
                 as_text(t.ledger));
    for (const SoilShare& each : t.shares) {
        spdlog::info("{}: {} points, {:.6g} kg, {} stress", named(t.soils[each.soil]), each.points,
                     each.mass, words::name_of(t.soils[each.soil].stress));
        const YieldShare& outside = t.yield[each.soil];
        if (outside.returned > 0)
            spdlog::info(
                "    {} points, {:.3g} % of its mass, returned to the yield surface "
                "(largest excess {:.3g} Pa, at ({:.2f}, {:.2f}) m)",
                outside.returned, 100.0 * outside.mass / each.mass, outside.largest_excess,
                outside.place.x(), outside.place.y());
    }
    for (const SofteningShare& each : t.softening)
        spdlog::info("{} softens from epsilon_q {:.3g} on the mean, {:.3g} at most",
                     named(t.soils[each.soil]), each.mean, each.largest);
    for (const RebuiltElement& each : t.rebuilt)
        spdlog::warn(
            "element {} of region {} at ({:.3f}, {:.3f}) m, worst |J_t|/|J_0| {:.3g}, was "
            "rebuilt: {:.4g} m2 instead of {:.4g} m2",
            each.element, each.region, each.centre.x(), each.centre.y(), each.least, each.area,
            each.area_on_mesh);
    if (t.collapse)
        spdlog::info("collapsed ({}): {} of {} saturated points of NorSand, {} past the line",
                     collapse_criterion(*t.collapse), t.collapse->collapsed, t.collapse->saturated,
                     t.collapse->past_line);
    if (t.supply && t.supply->short_cells > 0)
        spdlog::warn("{} cells have fewer points than asked", t.supply->short_cells);
    spdlog::info("{} strains raised to zero, {} coincident Gauss points merged",
                 t.gauss_fields.raised_strains, t.gauss_fields.merged_centres);
}

void report(process::Session& session, const Transferred& t) {
    const scene::Transfer& settings = scene::transfer_of(session.scene());
    log(t);
    nlohmann::json& result = session.result();
    result["transfer_time"] = t.state.transfer_time;
    result["points"] = t.state.size();
    result["points_per_direction"] = settings.points_per_direction;
    result["point_shift"] = settings.point_shift;
    result["interpolation"] = words::name_of(settings.interpolation);
    result["soils"] = soils_as_json(t);
    result["softening"] = softening_as_json(t);
    result["rebuilt_elements"] = rebuilt_as_json(t.rebuilt);
    const YieldShare outside = outside_yield_surface(t.yield);
    result["returned_to_yield_surface"] = outside.returned;
    result["largest_yield_excess"] = outside.largest_excess;
    result["strains_raised_to_zero"] = t.gauss_fields.raised_strains;
    result["coincident_gauss_points"] = t.gauss_fields.merged_centres;
    result["ledger"] = as_json(t.ledger);
    report_options(t, result);
    if (t.liquefaction && t.liquefaction->columns) {
        const auto& mpm = session.scene().mpm;
        if (auto flag = flag_of(t.liquefaction->columns->gaps, mpm ? mpm->cell_size : 0.0))
            session.flag(std::move(*flag));
    }
}

}  // namespace

process::Outcome run(process::Session& session) {
    const std::string file = session.input().string();
    const auto output = session.output(phases::files::particles);
    std::filesystem::remove(output);  // an older file must not be mistaken for the result
    session.progress(0.0, "reading");
    const exchange::MeshSnapshot mesh = exchange::read_mesh_snapshot(session.input()).snapshot;
    if (session.stop_requested()) return process::Outcome::stopped;
    const std::string message = "transferring " + std::to_string(mesh.quads.size()) + " elements";
    const Work work{.threads = session.settings().threads, .watch = {[&](double share) {
                                                               session.progress(0.1 + 0.8 * share,
                                                                                message);
                                                               return !session.stop_requested();
                                                           }}};
    const auto transferred = transfer(mesh, session.scene(), work, file);
    if (!transferred) return process::Outcome::stopped;
    report(session, *transferred);
    // After the report: result.json and log show the rows that are refused. No particle file is
    // written.
    refuse_losses(transferred->ledger, scene::transfer_of(session.scene()));

    exchange::write_particle_state(output, transferred->state, session.provenance(),
                                   transferred->ledger);
    session.result()["particles"] = output.filename().string();
    session.announce(output, {{"kind", "particles"},
                              {"transfer_time", transferred->state.transfer_time},
                              {"points", transferred->state.size()}});
    session.progress(1.0, "done");
    return process::Outcome::done;
}

}  // namespace breach::transfer
