#include "services/report/figures/norsand_figures.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"

namespace breach::report {

using nlohmann::json;

std::vector<double> curve_column(const exchange::Archive& curves, const std::string& name,
                                 double unit) {
    const auto found = curves.reals.find(name);
    if (found == curves.reals.end()) {
        throw fault::BadInput(
            phases::files::element_tests,
            {{name, "missing", "run fem_solver element-test (or calibrate) again"}});
    }
    std::vector<double> values = found->second;
    for (double& each : values) each /= unit;
    return values;
}

namespace {

/// A column and its unit on an axis.
struct Shown {
    const char* column;
    double unit;  ///< unit of the axis in SI
};

/// Both curves of a test, the measured one as dots.
void add_test(const exchange::Archive& curves, const std::string& test, bool is_computed,
              const Shown& x, const Shown& y, Chart& chart) {
    const std::size_t measured = chart.series.size();
    for (const std::string kind : {"measured", "computed"}) {
        if (kind == "computed" && !is_computed) continue;
        const std::string from = test + "." + kind + ".";
        Series series{test + ", " + kind, curve_column(curves, from + x.column, x.unit),
                      curve_column(curves, from + y.column, y.unit),
                      kind == "measured" ? Style::dots : Style::line};
        if (kind == "computed") series.like = measured;
        chart.series.push_back(std::move(series));
    }
}

enum class Which { drained, undrained, all };

Chart curves_of(const json& tests, const exchange::Archive& curves, Which which, Chart chart,
                const Shown& x, const Shown& y) {
    for (const auto& [name, test] : tests.items()) {
        const bool drained = test.at("boundary") == "drained_compression";
        if (which != Which::all && drained != (which == Which::drained)) continue;
        add_test(curves, name, test.at("computed"), x, y, chart);
    }
    return chart;
}

/// Ends of the tests over the critical state line; filled: tests that define the line.
void add_line(const json& tests, const json& parameters, Chart& chart) {
    const json& names = parameters.at("Gamma").at("tests");
    Series ends{"ends of tests (hollow: not of the line)", {}, {}, Style::points};
    for (const auto& [name, test] : tests.items()) {
        ends.x.push_back(test.at("end").at("p_kPa"));
        ends.y.push_back(test.at("end").at("e"));
        const bool used = std::find(names.begin(), names.end(), name) != names.end();
        ends.certainty.push_back(used ? Certainty::certain : Certainty::doubtful);
    }
    const auto [low, high] = std::ranges::minmax(ends.x);
    const double Gamma = parameters.at("Gamma").at("value");
    const double lambda = parameters.at("lambda").at("value");
    Series line{"critical state line", {0.5 * low, 2.0 * high}, {}, Style::line};
    for (const double p : line.x) line.y.push_back(Gamma - lambda * std::log(p));
    chart.series.push_back(std::move(line));
    chart.series.push_back(std::move(ends));
}

/// Peaks, and a straight line y = a + b x over their range, from 0.
struct Straight {
    double a, b;
};
void add_peaks(const json& tests, const char* x, const char* y, const Straight& line, Figure figure,
               std::vector<Figure>& figures) {
    Series points{"peaks of drained tests", {}, {}, Style::points};
    for (const auto& [name, test] : tests.items()) {
        if (test.at("peak").is_null()) continue;
        points.x.push_back(test.at("peak").at(x));
        points.y.push_back(test.at("peak").at(y));
    }
    if (points.x.empty()) return;
    const double least = std::min(0.0, std::ranges::min(points.x));
    const double most = std::max(0.0, std::ranges::max(points.x));
    figure.chart.series.push_back(std::move(points));
    figure.chart.series.push_back(
        {"as calibrated", {least, most}, {line.a + line.b * least, line.a + line.b * most}});
    figures.push_back(std::move(figure));
}

}  // namespace

std::vector<Figure> norsand_figures(const json& calibration, const exchange::Archive& curves) {
    const json& tests = calibration.at("tests");
    const json& parameters = calibration.at("parameters");
    const auto value = [&](const char* name) {
        return parameters.at(name).at("value").get<double>();
    };
    const Axis strain{"axial strain, logarithmic [%]"}, q{"q [kPa]"}, p{"p′ [kPa]"};
    const Shown epsilon_1{"strain", 0.01}, in_q{"q", 1e3}, in_p{"p", 1e3};
    const std::string how = "Dots are measured, lines are the law with the calibrated parameters.";
    std::vector<Figure> figures;
    const auto add = [&](const char* name, Which which, Chart chart, const Shown& x,
                         const Shown& y) {
        chart = curves_of(tests, curves, which, std::move(chart), x, y);
        if (!chart.series.empty()) figures.push_back({name, std::move(chart), how});
    };
    add("drained_stress_strain", Which::drained, {"Drained compression", strain, q, {}}, epsilon_1,
        in_q);
    add("drained_volume", Which::drained,
        {"Drained compression: volume", strain, {"volume strain, contraction positive [%]"}, {}},
        epsilon_1, {"epsilon_v", 0.01});
    add("undrained_stress_strain", Which::undrained, {"Undrained compression", strain, q, {}},
        epsilon_1, in_q);
    add("undrained_pore_pressure", Which::undrained,
        {"Undrained compression: excess pore pressure", strain, {"u [kPa]"}, {}}, epsilon_1,
        {"u", 1e3});
    add("stress_paths", Which::all, {"Stress paths", p, q, {}}, in_p, in_q);
    Chart states{"State paths and critical state line",
                 {"p′ [kPa]", Scale::logarithmic},
                 {"void ratio e [-]"},
                 {}};
    states = curves_of(tests, curves, Which::all, std::move(states), in_p, {"e", 1.0});
    add_line(tests, parameters, states);
    figures.push_back({"critical_state_line", std::move(states),
                       how +
                           " Ends of tests are means over the last 15 % of their strain; where one "
                           "is still on its way, the law's own end is, too."});
    // D_min and psi are measured; the law's peaks are near chi_tc psi, not on it.
    add_peaks(tests, "psi", "D_min", {0.0, value("chi_tc")},
              {"dilatancy",
               {"Dilatancy against state", {"ψ at the peak [-]"}, {"D_min [-]"}, {}},
               "The line is D_min = chi_tc psi."},
              figures);
    add_peaks(tests, "D_min", "eta", {value("M_tc"), value("N") - 1.0},
              {"stress_dilatancy",
               {"Stress ratio against dilatancy", {"D_min [-]"}, {"largest q/p′ [-]"}, {}},
               "The line is eta = M_tc - (1 - N) D_min."},
              figures);
    return figures;
}

}  // namespace breach::report
