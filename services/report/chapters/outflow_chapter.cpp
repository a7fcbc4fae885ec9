// Flow past sections: the envelope along x and hydrographs.
#include <cmath>

#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "services/outflow/envelopes.hpp"
#include "services/outflow/exports.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

Mark toe_of(const PhaseFolder& mpm) {
    return {Mark::At::x, mpm.scene.at("mpm").at("runout").at("toe").at(0), "toe"};
}

/// Leaves out places without a value.
Series along(const outflow::Envelope& envelope, const std::vector<double>& values,
             const std::string& name) {
    Series series{name, {}, {}};
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (std::isnan(values[k])) continue;
        series.x.push_back(envelope.x[k]);
        series.y.push_back(values[k]);
    }
    return series;
}

/// Three figures: depths, velocity, times; nothing without an envelope.
void add_envelope(const PhaseFolder& mpm, Chapter& chapter) {
    const auto file = mpm.files / phases::files::envelope;
    if (!std::filesystem::is_regular_file(file)) return;
    const outflow::Envelope e = outflow::read_envelope(file);
    const auto add = [&](const std::string& word, const std::string& what, const std::string& label,
                         std::vector<Series> series, const std::string& note) {
        chapter.figures.push_back(
            {"envelope_" + word + "_" + file_word(mpm),
             {what + ", " + of_transfer(mpm), {"x [m]"}, {label}, std::move(series), {toe_of(mpm)}},
             note});
    };
    add("depth", "Largest depth and deposit", "flow depth [m]",
        {along(e, e.largest_depth, "largest"), along(e, e.final_depth, "at the end")},
        "Mean over a cell each way, of mobile soil; fewer than three points there are grains and "
        "no flow.");
    add("velocity", "Largest velocity", "depth-averaged velocity [m/s]",
        {along(e, e.largest_velocity, "largest")}, "Either way.");
    add("times", "Arrival and time of the peak",
        mpm.transfer_time ? "time since transfer [s]" : "time [s]",
        {along(e, e.arrival, "arrival"), along(e, e.time_of_peak, "deepest")},
        "Nothing is drawn where the flow never came; 0 where soil lay already. Arrival: depth of "
        "/mpm/envelope/arrival_depth.");
}

json sections_in(const PhaseFolder& mpm) {
    return mpm.scene.at("mpm").value("sections", json::array());
}

void add_hydrograph(const PhaseFolder& mpm, Chapter& chapter) {
    const Telemetry telemetry(mpm.files / phases::files::telemetry);
    Figure figure{
        "hydrograph_" + file_word(mpm),
        {"Hydrographs, " + of_transfer(mpm),
         {mpm.transfer_time ? "time since transfer [s]" : "time [s]"},
         {"discharge per metre of width [m2/s]"},
         {}},
        "Mean from one telemetry line to the next, towards +x. " + outflow::slurry_warning};
    for (const json& section : sections_in(mpm)) {
        const std::string name = section.at("name");
        const std::string field = "section." + name + ".discharge";
        if (!telemetry.has(field)) continue;
        figure.chart.series.push_back(
            telemetry.series(field, name + " (x = " + short_number(section.at("x")) + " m)"));
    }
    if (!figure.chart.series.empty()) chapter.figures.push_back(std::move(figure));
}

/// Flow past each section, for every runout.
Table section_table(const Run& run) {
    Table table{"sections",
                "Sections",
                {"run", "t_T [s]", "variant", "section", "x [m]", "largest discharge [m2/s]",
                 "at [s]", "passed [m2]", "mass [kg/m]", "closure", "breach [m]",
                 "largest discharge [m3/s]", "passed [m3]"},
                {},
                "Per metre of width, net towards +x, as volume in place; breach: its likeliest "
                "width, and discharge and volume for it. Closure: volume that the momentum carried "
                "past the section, less the volume that came to rest beyond it, over all that "
                "moved. \u2265: a lower bound, the soil still "
                "moved."};
    for (const PhaseFolder* each : phases_named(run, phases::mpm.program)) {
        if (!each->result.is_object() || !each->result.contains("sections")) continue;
        for (const auto& [name, section] : each->result.at("sections").items()) {
            const json& seen = section;
            const auto grown = [&](const char* pointer) {
                return bounded(*each, fact(seen, pointer));
            };
            table.rows.push_back(
                {each->label, each->transfer_time ? short_number(*each->transfer_time) : "-",
                 each->variant, name, fact(seen, "/x"), grown("/largest_discharge"),
                 fact(seen, "/time_of_largest_discharge"), grown("/volume"), grown("/mass"),
                 fact(seen, "/closure"), fact(seen, "/breach/width/1"),
                 grown("/breach/largest_discharge/1"), grown("/breach/volume/1")});
        }
    }
    return table;
}

}  // namespace

void add_outflow(const Material& from, Document& document) {
    const auto runouts = chosen_runouts(from);
    if (runouts.empty()) return;  // the flow chapter reports it
    Chapter chapter{"What leaves the model"};
    for (const PhaseFolder* each : runouts) add_envelope(*each, chapter);
    if (chapter.figures.empty())
        document.left_out.push_back({"envelope along x", "the runouts kept no envelope.csv"});
    for (const PhaseFolder* each : runouts) add_hydrograph(*each, chapter);
    if (Table table = section_table(from.run); !table.rows.empty()) {
        chapter.tables.push_back(std::move(table));
    } else {
        document.left_out.push_back({"hydrographs", "the scene has no sections (/mpm/sections)"});
    }
    if (!chapter.figures.empty() || !chapter.tables.empty())
        document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
