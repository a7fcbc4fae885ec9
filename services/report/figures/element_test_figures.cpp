#include "services/report/figures/element_test_figures.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "core/exchange/archive.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "services/report/figures/norsand_figures.hpp"
#include "services/report/read/read_results.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

/// The name under which the bench stored a test's curve.
std::string curve_of(const std::string& test, const json& row) {
    std::string name = test + "_sv" + short_number(row.at("sigma_v_kPa")) + "kPa";
    if (row.contains("CSR")) name += "_csr" + short_number(row.at("CSR"));
    return name;
}

/// Stress-strain, stress path and pore pressure of the curves of one page.
void add_curves(const exchange::Archive& curves, const std::string& page,
                const std::vector<std::string>& names, std::vector<Figure>& figures) {
    Chart strain{page + ": stress-strain", {"strain [%]"}, {"shear stress [kPa]"}, {}};
    Chart path{page + ": stress path", {"σ′v [kPa]"}, {"shear stress [kPa]"}, {}};
    Chart pore{page + ": pore pressure ratio", {"strain [%]"}, {"r_u [-]"}, {}};
    for (const std::string& each : names) {
        const std::vector<double> epsilon = curve_column(curves, each + ".strain", 0.01);
        const std::vector<double> tau = curve_column(curves, each + ".response", 1e3);
        strain.series.push_back({each, epsilon, tau});
        path.series.push_back({each, curve_column(curves, each + ".sigma_yy", 1e3), tau});
        pore.series.push_back({each, epsilon, curve_column(curves, each + ".r_u", 1.0)});
    }
    figures.push_back({page + "_stress_strain", strain});
    figures.push_back({page + "_stress_path", path});
    figures.push_back({page + "_pore_pressure", pore});
}

/// CSR against the cycles to the strain limit; tests that did not reach it have no point.
void add_crr(const std::string& test, const json& rows, std::vector<Figure>& figures) {
    std::map<double, Series> by_stress;
    for (const json& row : rows) {
        if (row.at("N_strain_limit").is_null()) continue;
        const double sigma_v = row.at("sigma_v_kPa");
        Series& s = by_stress[sigma_v];
        s.name = "σ′v0 = " + short_number(sigma_v) + " kPa";
        s.style = Style::line_and_points;
        s.x.push_back(row.at("N_strain_limit"));
        s.y.push_back(row.at("CSR"));
    }
    if (by_stress.empty()) return;
    Chart chart{test + ": cyclic resistance",
                {"cycles to the strain limit [-]", Scale::logarithmic},
                {"CSR [-]"},
                {}};
    for (const auto& [sigma_v, s] : by_stress) chart.series.push_back(s);
    figures.push_back({test + "_CRR", chart});
}

}  // namespace

std::vector<Figure> element_test_figures(const std::filesystem::path& folder) {
    const json result = read_json(folder / phases::files::result);
    const exchange::Archive curves =
        exchange::read_archive(folder / phases::files::element_tests, "element_tests", 1);
    std::vector<Figure> figures;
    try {
        if (result.contains("norsand_calibration"))
            return norsand_figures(result.at("norsand_calibration"), curves);
        for (const auto& [test, rows] : result.at("tests").items()) {
            if (rows.empty() || rows.front().contains("amplitude")) continue;
            std::vector<std::string> together;
            for (const json& row : rows) {
                const std::string name = curve_of(test, row);
                if (row.contains("CSR"))
                    add_curves(curves, name, {name}, figures);
                else
                    together.push_back(name);
            }
            if (!together.empty())
                add_curves(curves, test, together, figures);
            else
                add_crr(test, rows, figures);
        }
    } catch (const json::exception& error) {
        throw fault::BadInput((folder / phases::files::result).string(),
                              {{"/tests", error.what(), "give an element-test folder"}});
    }
    return figures;
}

}  // namespace breach::report
