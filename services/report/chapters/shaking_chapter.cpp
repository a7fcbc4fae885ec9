// The FEM's measurements against time, with the thresholds of the transfer window.
#include <algorithm>

#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using namespace nlohmann::literals;

namespace {

using nlohmann::json;

struct Curve {
    const char* field;
    std::string name;
};

/// One figure of telemetry, without fields that no line has.
struct Plan {
    const char* file;
    const char* title;
    const char* label;
    double unit;  ///< of the label in SI
    std::vector<Curve> curves;
    std::vector<Mark> marks;
    std::string caption;
    const char* missing;     ///< why it may be missing
    const char* needs = "";  ///< entry that gives the values a meaning (pointer)
};

std::string threshold_of(const json& fem) {
    const json r_u = fem.value("/liquefaction/r_u"_json_pointer, json());
    return r_u.is_number() ? short_number(r_u) : "the threshold";
}

/// The place where the scene looks for liquefaction.
std::string liquefaction_caption(const json& fem) {
    const json asked = fem.value("liquefaction", json::object());
    std::string text = "Depth of the deepest liquefied node";
    if (const json level = asked.value("level", json()); level.is_number()) {
        text += " below y = " + short_number(level) + " m";
    }
    std::string where;
    for (const json& region : asked.value("regions", json::array())) {
        where += (where.empty() ? " in " : ", ") + region.get<std::string>();
    }
    if (const json x = asked.value("x", json()); x.is_array() && x.size() == 2) {
        where += " between x = " + short_number(x[0]) + " and " + short_number(x[1]) + " m";
    }
    return text + where + " (/fem/liquefaction).";
}

std::vector<Plan> plans(const json& fem) {
    std::vector<Mark> liquefied;
    if (const json r_u = fem.value("/liquefaction/r_u"_json_pointer, json()); r_u.is_number()) {
        liquefied = {{Mark::At::y, r_u, "liquefied: " + short_number(r_u)}};
    }
    const char* always = "the FEM's telemetry does not hold it";
    return {
        {"crest_displacement",
         "Displacement of the crest",
         "displacement [m]",
         1.0,
         {{"crest_displacement", "magnitude"},
          {"crest_dx", "downstream (x)"},
          {"crest_dy", "up (y)"}},
         {},
         "Displacement of the node nearest to /fem/crest since the first dynamic stage began.",
         always},
        {"liquefaction_depth",
         "Liquefaction depth",
         "depth [m]",
         1.0,
         {{"liquefaction_depth", "deepest r_u > " + threshold_of(fem)}},
         {},
         liquefaction_caption(fem),
         "nothing can liquefy: the scene is dry or gives no /fem/liquefaction",
         "/fem/liquefaction"},
        {"kinetic_energy",
         "Kinetic energy",
         "kinetic energy [kJ]",
         1e3,
         {{"kinetic_energy", "kinetic energy"}},
         {},
         "Of the whole mesh, for its thickness.",
         always},
        {"failure_surfaces",
         "Failure surfaces",
         "number [-]",
         1.0,
         {{"failure_surfaces", "failure surfaces"}},
         {},
         "Bands of strained elements that cut the section from ground to ground.",
         "the scene asks for none (/fem/failure_surfaces)"},
        {"pore_pressure_ratio",
         "Largest pore pressure ratio",
         "r_u [-]",
         1.0,
         {{"r_u_max", "largest r_u"}},
         liquefied,
         "Largest r_u = (u - u_0) / sigma'_v0 of the watched nodes (/fem/liquefaction).",
         "the scene is dry, or watches nothing (/fem/liquefaction)",
         "/fem/liquefaction"},
        {"jacobian_average",
         "Distortion of strained elements",
         "|J_t| / |J_0| [-]",
         1.0,
         {{"jacobian_centre_avg", "average, centres (area)"},
          {"jacobian_least_avg", "average, worst corners"},
          {"jacobian_least_min", "least corner of all"}},
         {},
         "Averages over the elements whose epsilon_q exceeds /fem/strain_threshold. The centre's "
         "ratio is the change of area and blind to shear; the worst corner's is not.",
         always},
        {"epsilon_q_average",
         "Strain of strained elements",
         "epsilon_q,avg [%]",
         0.01,
         {{"epsilon_q_avg", "average"}},
         {},
         "Volume average of epsilon_q = sqrt(2/3 e:e) over the elements whose epsilon_q exceeds "
         "/fem/strain_threshold.",
         always},
    };
}

/// Numbers with which the run's triggers and the scene's window compare these fields.
std::vector<Mark> thresholds_of(const Run& run, const Plan& plan) {
    std::vector<Mark> marks;
    for (const Threshold& each : thresholds_in(run)) {
        const bool mine = std::ranges::any_of(
            plan.curves, [&](const Curve& curve) { return curve.field == each.field; });
        const double value = each.value / plan.unit;
        const bool known = std::ranges::find(marks, value, &Mark::value) != marks.end();
        if (mine && !known) {
            marks.push_back({Mark::At::y, value, "threshold " + short_number(value)});
        }
    }
    return marks;
}

/// The FEM's end in a sentence, unless it was regular.
std::string end_of(const PhaseFolder& fem) {
    if (!fem.fault.empty()) return "The FEM ended early: " + fem.fault;
    return entanglement_of(fem);
}

/// Times of events, in the run and in the paper; nothing: none is known.
std::optional<Figure> timeline_of(const Material& from) {
    std::vector<PaperValue> events;
    for (const auto& [title, key] : {std::pair{"window of transfer times opens", "window_lower"},
                                     {"window closes", "window_upper"},
                                     {"mesh entangles", "time_entangled"}})
        events.push_back({key, title, "s", 0.0});
    if (from.paper) events = from.paper->values;
    Figure figure{"timeline",
                  {"What happens when", {"time [s]"}, {"", Scale::linear, {"here"}}, {}},
                  "By the telemetry."};
    if (from.paper) figure.chart.y.names.push_back("paper");
    for (const PaperValue& each : events) {
        if (!each.key.starts_with("time_") && !each.key.starts_with("window_")) continue;
        Series series{each.what, {}, {}, Style::points};
        if (const auto here = from.measures.find(each.key); here != from.measures.end()) {
            series.x.push_back(here->second.value);
            series.y.push_back(0.0);
        }
        if (from.paper) {
            series.x.push_back(each.value);
            series.y.push_back(1.0);
        }
        if (!series.x.empty()) figure.chart.series.push_back(std::move(series));
    }
    if (figure.chart.series.empty()) return std::nullopt;
    return figure;
}

}  // namespace

void mark_window(const WindowEdges& window, std::vector<Mark>& marks) {
    const bool none = window.is_none();
    if (window.lower)
        marks.push_back({Mark::At::x, *window.lower, none ? "failure developed" : "window opens"});
    if (window.upper)
        marks.push_back(
            {Mark::At::x, *window.upper, none ? "mesh too distorted" : "window closes"});
}

void add_shaking(const Material& from, Document& document) {
    const PhaseFolder* fem = phase_shown(from.run, phases::fem.program);
    if (!fem || !has_telemetry(*fem)) {
        document.left_out.push_back(
            {"courses of crest, energy, strain and distortion",
             fem ? "the FEM ended before its first line of telemetry: " + fem->fault
                 : "the run has no FEM: its points fill the section"});
        return;
    }
    const Telemetry telemetry = telemetry_of(from.run, *fem);
    Chapter chapter{"Motion and failure",
                    which_of_several(from.run, *fem, "finite element analyses") + end_of(*fem)};
    if (auto figure = timeline_of(from)) chapter.figures.push_back(std::move(*figure));
    for (const Plan& plan : plans(fem->scene.value("fem", json::object()))) {
        Figure figure{plan.file, {plan.title, {"time [s]"}, {plan.label}, {}}, plan.caption};
        const bool needed = *plan.needs == 0 || fem->scene.contains(json::json_pointer(plan.needs));
        for (const Curve& curve : plan.curves) {
            if (!telemetry.has(curve.field) || !needed) continue;
            figure.chart.series.push_back(telemetry.series(curve.field, curve.name, plan.unit));
        }
        if (figure.chart.series.empty()) {
            document.left_out.push_back({plan.title, plan.missing});
            continue;
        }
        figure.chart.marks = plan.marks;
        const std::vector<Mark> thresholds = thresholds_of(from.run, plan);
        figure.chart.marks.insert(figure.chart.marks.end(), thresholds.begin(), thresholds.end());
        mark_window(window_of(from.run, telemetry), figure.chart.marks);
        add_points(from.paper, figure);
        chapter.figures.push_back(std::move(figure));
    }
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
