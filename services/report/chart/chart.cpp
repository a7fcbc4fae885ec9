#include "services/report/chart/chart.hpp"

#include <stdexcept>

namespace breach::report {

const char* name_of(Certainty certainty) {
    switch (certainty) {
        case Certainty::certain:
            return "certain";
        case Certainty::at_least:
            return "lower bound";
        case Certainty::doubtful:
            return "questionable";
    }
    return "";
}

void check_columns(const Chart& chart) {
    for (const Series& each : chart.series) {
        if (each.x.size() != each.y.size()) {
            throw std::invalid_argument("\"" + each.name + "\" has " +
                                        std::to_string(each.x.size()) + " values of x and " +
                                        std::to_string(each.y.size()) + " of y");
        }
        if (!each.certainty.empty() && each.certainty.size() != each.x.size()) {
            throw std::invalid_argument("\"" + each.name + "\" has " +
                                        std::to_string(each.x.size()) + " points and says of " +
                                        std::to_string(each.certainty.size()) +
                                        " how certain they are");
        }
        if (!each.error.empty() && each.error.size() != each.x.size()) {
            throw std::invalid_argument("\"" + each.name + "\" has " +
                                        std::to_string(each.x.size()) + " points and " +
                                        std::to_string(each.error.size()) + " errors");
        }
        if (each.low.size() != each.high.size() ||
            (!each.low.empty() && each.low.size() != each.x.size())) {
            throw std::invalid_argument("\"" + each.name + "\" has " +
                                        std::to_string(each.x.size()) +
                                        " points and a band of another length");
        }
        if ((each.style == Style::segments || each.style == Style::bars) &&
            each.x.size() % 2 != 0) {
            throw std::invalid_argument("\"" + each.name + "\" has a segment without an end");
        }
    }
    if (!chart.field) return;
    const std::size_t places = chart.field->corners * chart.field->value.size();
    if (chart.field->x.size() != places || chart.field->y.size() != places) {
        throw std::invalid_argument("\"" + chart.field->label + "\" has " +
                                    std::to_string(chart.field->value.size()) +
                                    " values that do not fit its corners");
    }
}

}  // namespace breach::report
