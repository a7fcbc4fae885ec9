// Flow downstream: arrival, depth, velocity and deposit.
#include <algorithm>

#include "core/exchange/archive.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

/// The scene's gauges; null when it has none.
json gauges_in(const PhaseFolder& mpm) { return mpm.scene.at("mpm").value("gauges", json()); }

/// Depth or velocity at every gauge against time, of one runout.
Figure gauge_figure(const PhaseFolder& mpm, const std::string& quantity, const std::string& label) {
    const Telemetry telemetry(mpm.files / phases::files::telemetry);
    Figure figure{"gauge_" + quantity + "_" + file_word(mpm),
                  {"Gauges: " + quantity + ", " + of_transfer(mpm),
                   {mpm.transfer_time ? "time since transfer [s]" : "time [s]"},
                   {label},
                   {}},
                  "Mean over a cell each way: of the depth of mobile soil, and of its horizontal "
                  "velocity by mass."};
    for (const json& gauge : gauges_in(mpm)) {
        const std::string name = gauge.at("name");
        const std::string field = "gauge." + name + "." + quantity;
        if (!telemetry.has(field)) continue;
        figure.chart.series.push_back(
            telemetry.series(field, name + " (x = " + short_number(gauge.at("x")) + " m)"));
    }
    return figure;
}

/// Arrival and largest values at every gauge, for every runout.
Table gauge_table(const Run& run) {
    Table table{
        "gauges",
        "Gauges",
        {"t_T [s]", "variant", "gauge", "x [m]", "arrival [s]", "largest depth [m]", "at [s]",
         "largest velocity [m/s]"},
        {},
        "Arrival: first time at which the flow is as deep as the gauge's arrival_depth, in "
        "seconds since the transfer; - when it never is, or was not yet where the soil still "
        "moved at the end. \u2265: a lower bound, the soil still moved."};
    for (const PhaseFolder* each : phases_named(run, phases::mpm.program)) {
        if (!each->result.is_object() || !each->result.contains("gauges")) continue;
        for (const auto& [name, seen] : each->result.at("gauges").items()) {
            table.rows.push_back(
                {each->transfer_time ? short_number(*each->transfer_time) : "-", each->variant,
                 name, fact(seen, "/x"), fact(seen, "/arrival_time"),
                 bounded(*each, fact(seen, "/largest_depth")), fact(seen, "/time_of_largest_depth"),
                 bounded(*each, fact(seen, "/largest_velocity"))});
        }
    }
    return table;
}

/// Final depth of the deposit over x; nothing: the archive has no envelope. The last profile is of
/// the last frame, which may be much earlier.
std::optional<Series> deposit_of(const PhaseFolder& mpm) {
    const auto archive =
        exchange::read_archive(mpm.files / phases::files::history, "mpm_history", 1);
    const auto x = archive.reals.find("envelope.x");
    const auto depths = archive.reals.find("envelope.final_depth");
    if (x == archive.reals.end() || depths == archive.reals.end()) return {};
    return Series{of_transfer(mpm) + (still_moves(mpm) ? " (still moving)" : ""), x->second,
                  depths->second};
}

void add_gauges(const Material& from, Chapter& chapter, Document& document) {
    for (const PhaseFolder* each : chosen_runouts(from)) {
        for (const auto& [quantity, label] :
             {std::pair{"depth", "flow depth [m]"}, std::pair{"velocity", "velocity [m/s]"}}) {
            Figure figure = gauge_figure(*each, quantity, label);
            if (!figure.chart.series.empty()) chapter.figures.push_back(std::move(figure));
        }
    }
    if (Table table = gauge_table(from.run); !table.rows.empty()) {
        chapter.tables.push_back(std::move(table));
    } else {
        document.left_out.push_back(
            {"arrival, depth and velocity at gauges", "the scene has no gauges (/mpm/gauges)"});
    }
}

}  // namespace

void add_flow(const Material& from, Document& document) {
    const auto runouts = chosen_runouts(from);
    if (runouts.empty()) {
        document.left_out.push_back({"gauges and deposit profile", "the run has no runout"});
        return;
    }
    Chapter chapter{"Flow and deposit"};
    Figure deposit{"deposit_profile",
                   {"Depth of the deposit", {"x [m]"}, {"depth of mobile soil [m]"}, {}},
                   "At the end of the runout."};
    for (const PhaseFolder* each : runouts) {
        if (auto series = deposit_of(*each)) deposit.chart.series.push_back(std::move(*series));
    }
    if (deposit.chart.series.empty()) {
        document.left_out.push_back({"deposit profile", "the runouts kept no envelope"});
    } else {
        deposit.chart.marks = {
            {Mark::At::x, runouts.front()->scene.at("mpm").at("runout").at("toe").at(0), "toe"}};
        chapter.figures.push_back(std::move(deposit));
    }
    add_gauges(from, chapter, document);
    if (!chapter.figures.empty() || !chapter.tables.empty()) {
        document.chapters.push_back(std::move(chapter));
    }
}

}  // namespace breach::report
