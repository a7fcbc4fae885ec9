#include "services/report/chart/frame.hpp"

#include <algorithm>
#include <sstream>

namespace breach::report {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return out;
}

std::string text_at(double x, double y, const std::string& text, const std::string& more) {
    std::ostringstream svg;
    svg << "<text x=\"" << x << "\" y=\"" << y << "\" " << more << ">" << escaped(text)
        << "</text>\n";
    return svg.str();
}

double width_of(const std::string& text) {
    const auto begins_letter = [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    };
    return 7.6 * static_cast<double>(std::count_if(text.begin(), text.end(), begins_letter));
}

double dot_size(const Frame& frame) {
    std::size_t dots =
        frame.chart.field && frame.chart.field->corners == 1 ? frame.chart.field->value.size() : 0;
    for (const Series& each : frame.chart.series) {
        if (each.style == Style::dots) dots += each.x.size();
    }
    const double share =
        frame.width * frame.height / static_cast<double>(std::max<std::size_t>(1, dots));
    return std::clamp(0.75 * std::sqrt(share), 2.0, 6.0);
}

}  // namespace breach::report
