#include "services/report/chart/figure.hpp"

#include <algorithm>
#include <cmath>

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "services/report/chart/draw.hpp"

namespace breach::report {

namespace {

std::string as_csv(const Field& field) {
    std::string csv;
    for (std::size_t k = 0; k < field.corners; ++k) {
        const std::string of = field.corners > 1 ? std::to_string(k + 1) : "";
        csv += "x" + of + " [m],y" + of + " [m],";
    }
    csv += quoted(field.label) + '\n';
    for (std::size_t i = 0; i < field.value.size(); ++i) {
        for (std::size_t k = i * field.corners; k < (i + 1) * field.corners; ++k) {
            csv += exact(field.x[k]) + ',' + exact(field.y[k]) + ',';
        }
        csv += exact(field.value[i]) + '\n';
    }
    return csv;
}

}  // namespace

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + '"';
}

std::string as_csv(const Chart& chart) {
    check_columns(chart);
    if (chart.field) return as_csv(*chart.field);
    const bool told = std::ranges::any_of(
        chart.series, [](const Series& each) { return !each.certainty.empty(); });
    const bool errors =
        std::ranges::any_of(chart.series, [](const Series& each) { return !each.error.empty(); });
    const bool bands =
        std::ranges::any_of(chart.series, [](const Series& each) { return !each.low.empty(); });
    std::string csv = "series," + quoted(chart.x.label) + ',' + quoted(chart.y.label) +
                      (told ? ",\"certainty\"" : "") + (errors ? ",\"error\"" : "") +
                      (bands ? ",\"low\",\"high\"\n" : "\n");
    for (const Series& each : chart.series) {
        for (std::size_t i = 0; i < each.x.size(); ++i) {
            csv += quoted(each.name) + ',' + exact(each.x[i]) + ',' + exact(each.y[i]);
            if (told) {
                const Certainty one =
                    each.certainty.empty() ? Certainty::certain : each.certainty[i];
                csv += ',' + quoted(name_of(one));
            }
            if (errors) {
                const bool known = !each.error.empty() && !std::isnan(each.error[i]);
                csv += "," + (known ? exact(each.error[i]) : std::string());
            }
            if (bands) {
                const bool known = !each.low.empty() && !std::isnan(each.low[i]);
                csv += known ? "," + exact(each.low[i]) + "," + exact(each.high[i]) : ",,";
            }
            csv += '\n';
        }
    }
    return csv;
}

void write_figures(const std::filesystem::path& folder, const std::vector<Figure>& figures) {
    std::filesystem::create_directories(folder);
    for (const Figure& each : figures) {
        if (each.name.find('/') != std::string::npos) {
            throw fault::BadInput(each.name, {{"", "a test's name holds a /", "rename the test"}});
        }
        exchange::publish_text(folder / (each.name + ".svg"), as_svg(each.chart));
        exchange::publish_text(folder / (each.name + ".csv"), as_csv(each.chart));
    }
}

}  // namespace breach::report
