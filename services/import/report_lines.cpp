// Writes the import's report as text, called by `breach import` after the scene is written. Unit
// and size come first, because a wrong unit spoils all that follows.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/words/list.hpp"
#include "services/import/drawing.hpp"
#include "services/import/import.hpp"

namespace breach::importing {

using nlohmann::json;

namespace {

/// The unit and its source, and the size of the section.
std::string unit_line(const json& report) {
    const std::string unit = report.at("unit"), from = report.at("unit_from");
    const char* why = from == "asked"     ? "as asked"
                      : from == "drawing" ? "the drawing's $INSUNITS"
                      : from == "header"  ? "the table's header"
                                          : "metres, as nothing says otherwise";
    const json& size = report.at("size");
    return "read in " + unit + " (" + why + "): the section is " + extent(size[0]) + " long and " +
           extent(size[1]) + " high";
}

/// The crest and the toe of the slope that is searched.
/// In the report because most guesses follow from it.
std::string slope_line(const json& slope) {
    const auto place = [&](const char* name) {
        return Vec2(slope.at(name)[0].get<double>(), slope.at(name)[1].get<double>());
    };
    const Vec2 crest = place("crest"), toe = place("toe");
    return "guessed: the slope from its crest " + text(crest) + " to its toe " + text(toe) + ", " +
           extent(crest.y() - toe.y()) + " high";
}

}  // namespace

std::vector<std::string> lines_of(const json& report, std::size_t most) {
    std::vector<std::string> lines;
    if (report.contains("size")) {
        lines.push_back(unit_line(report));
        lines.push_back("the same numbers would be " + report.at("other_units").get<std::string>());
    }
    if (report.contains("slope")) lines.push_back(slope_line(report.at("slope")));
    const json& healed = report.at("healed");
    std::map<std::string, std::size_t> counts;
    double largest = 0.0;
    for (const json& each : healed) {
        ++counts[each.at("kind")];
        largest = std::max(largest, each.at("size").get<double>());
    }
    // The largest one tells whether healing was rounding or redrawing.
    if (!healed.empty()) {
        const auto count_of = [](const auto& kind_and_count) {
            return std::to_string(kind_and_count.second) + " " + kind_and_count.first;
        };
        lines.push_back("healed: " + words::list_of(counts, count_of) + "; the largest " +
                        metres(largest));
    }
    for (std::size_t i = 0; i < std::min(most, healed.size()); ++i) {
        const json& each = healed[i];
        const Vec2 at(each.at("at")[0].get<double>(), each.at("at")[1].get<double>());
        lines.push_back("  " + each.at("kind").get<std::string>() + " at " + text(at) + ", " +
                        metres(each.at("size")) + ": " +
                        words::list_of(each.at("regions").get<std::vector<std::string>>()));
    }
    if (healed.size() > most)
        lines.push_back("  and " + std::to_string(healed.size() - most) + " more");
    for (const json& each : report.at("areas")) {
        const double drawn = each.at("drawn"), imported = each.at("imported");
        lines.push_back("area of " + each.at("region").get<std::string>() + ": " +
                        square_metres(drawn) + " as drawn, changed by " +
                        square_metres(imported - drawn));
    }
    for (const json& each : report.at("guessed"))
        lines.push_back("guessed: " + each.at("pointer").get<std::string>() + " " +
                        each.at("value").dump() + ", from " + each.at("from").get<std::string>());
    for (const json& each : report.at("remarks")) lines.push_back(each.get<std::string>());
    return lines;
}

}  // namespace breach::importing
