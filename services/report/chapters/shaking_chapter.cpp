// What the FEM measured against time, with the thresholds of the transfer window.
#include <algorithm>

#include "services/report/chapters/chapters.hpp"

namespace breach::report {

using namespace nlohmann::literals;

namespace {

struct Curve {
    const char* field;
    const char* name;
};

/// One figure of telemetry. Fields that no line has are left out of it.
struct Plan {
    const char* file;
    const char* title;
    const char* label;
    double unit;  ///< of the label in SI
    std::vector<Curve> curves;
    std::vector<Mark> marks;
    const char* caption;
    const char* missing;     ///< why there may be none
    const char* needs = "";  ///< what the scene must have, or its values mean nothing (pointer)
};

std::vector<Plan> plans() {
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
         "Displacement of the node nearest to /fem/crest since the shaking began.",
         always},
        {"liquefaction_depth",
         "Liquefaction depth beneath the crest",
         "depth [m]",
         1.0,
         {{"liquefaction_depth", "deepest r_u > 0.7"}},
         {},
         "Depth of the deepest liquefied node beneath the upper dam's crest.",
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
         {{Mark::At::y, 0.7, "liquefied: 0.7"}},
         "Largest r_u = (u - u_0) / sigma'_v0 of all nodes.",
         "the scene is dry: no pore pressure",
         "/fem/water"},
        {"jacobian_average",
         "Distortion of strained elements",
         "|J_t| / |J_0| [-]",
         1.0,
         {{"jacobian_centre_avg", "average, centres (area)"},
          {"jacobian_least_avg", "average, worst corners"},
          {"jacobian_least_min", "least corner of all"}},
         {{Mark::At::y, 0.97, "threshold 0.97"}},
         "Averages over the elements whose epsilon_q exceeds /fem/strain_threshold. The centre's "
         "ratio is the change of area and blind to shear; the worst corner's is not.",
         always},
        {"epsilon_q_average",
         "Strain of strained elements",
         "epsilon_q,avg [%]",
         0.01,
         {{"epsilon_q_avg", "average"}},
         {{Mark::At::y, 20, "threshold 20 %"}},
         "Volume average of epsilon_q = sqrt(2/3 e:e) over the elements whose epsilon_q exceeds "
         "/fem/strain_threshold.",
         always},
    };
}

}  // namespace

void add_shaking(const Material& from, Document& document) {
    const PhaseFolder* fem = phase_named(from.run, "fem_solver");
    if (!fem || !has_telemetry(*fem)) {
        document.left_out.push_back(
            {"courses of crest, energy, strain and distortion",
             fem ? "the FEM ended before its first line of telemetry: " + fem->fault
                 : "the run has no FEM: its points fill the section"});
        return;
    }
    const Telemetry telemetry = telemetry_of(from.run, *fem);
    Chapter chapter{"Shaking and failure",
                    fem->fault.empty() ? "" : "The FEM ended early: " + fem->fault};
    for (const Plan& plan : plans()) {
        Figure figure{plan.file, {plan.title, {"time [s]"}, {plan.label}, {}}, plan.caption};
        const bool needed =
            *plan.needs == 0 || fem->scene.contains(nlohmann::json::json_pointer(plan.needs));
        for (const Curve& curve : plan.curves) {
            if (!telemetry.has(curve.field) || !needed) continue;
            figure.chart.series.push_back(telemetry.series(curve.field, curve.name, plan.unit));
        }
        if (figure.chart.series.empty()) {
            document.left_out.push_back({plan.title, plan.missing});
            continue;
        }
        figure.chart.marks = plan.marks;
        const WindowEdges window = window_of(from.run, telemetry);
        if (window.lower)
            figure.chart.marks.push_back({Mark::At::x, *window.lower, "window opens"});
        if (window.upper)
            figure.chart.marks.push_back({Mark::At::x, *window.upper, "window closes"});
        add_points(from.paper, figure);
        chapter.figures.push_back(std::move(figure));
    }
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
