#include "services/report/figure.hpp"

#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"

namespace breach::report {

namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + '"';
}

}  // namespace

std::string as_csv(const Chart& chart) {
    std::string csv = "series," + quoted(chart.x.label) + ',' + quoted(chart.y.label) + '\n';
    for (const Series& each : chart.series) {
        for (std::size_t i = 0; i < each.x.size(); ++i) {
            csv += quoted(each.name) + ',' + exact(each.x[i]) + ',' + exact(each.y[i]) + '\n';
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
