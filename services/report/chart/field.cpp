#include "services/report/chart/field.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "services/report/chart/colour_map.hpp"

namespace breach::report {

namespace {

constexpr std::size_t classes = 40;  // the eye distinguishes no more

std::size_t class_of(double value, const Range& range) {
    const double share = std::clamp(place(value, range, Scale::linear), 0.0, 1.0);
    return std::min(classes - 1, static_cast<std::size_t>(share * classes));
}

std::string colour_of(std::size_t c) {
    return colour_at((static_cast<double>(c) + 0.5) / static_cast<double>(classes));
}

void draw_place(Pen& pen, const Field& field, std::size_t i) {
    const std::size_t first = i * field.corners;
    if (field.corners == 1) return pen.dot(field.x[first], field.y[first]);
    pen.move(field.x[first], field.y[first]);
    for (std::size_t k = first + 1; k < first + field.corners; ++k) {
        pen.line(field.x[k], field.y[k]);
    }
    pen.close();
}

}  // namespace

/// One path per colour: keeps the page small and fast to draw.
void draw_field(std::ostream& svg, const Frame& frame, const Field& field) {
    std::array<std::vector<std::size_t>, classes> members;
    for (std::size_t i = 0; i < field.value.size(); ++i) {
        members[class_of(field.value[i], field.range)].push_back(i);
    }
    const bool dots = field.corners == 1;
    svg << "<g transform=\"scale(.1)\" stroke-width=\"" << (dots ? 10.0 * dot_size(frame) : 4.0)
        << "\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    for (std::size_t c = 0; c < classes; ++c) {
        if (members[c].empty()) continue;
        const std::string colour = colour_of(c);
        svg << "<path fill=\"" << (dots ? "none" : colour) << "\" stroke=\"" << colour << "\" d=\"";
        Pen pen(svg, frame);
        for (const std::size_t i : members[c]) draw_place(pen, field, i);
        svg << "\"/>\n";
    }
    svg << "</g>\n";
}

void draw_colour_bar(std::ostream& svg, double x, double y, const Field& field) {
    constexpr double length = 400, thickness = 14;
    const double step = length / static_cast<double>(classes);
    for (std::size_t c = 0; c < classes; ++c) {
        svg << "<rect x=\"" << x + step * static_cast<double>(c) << "\" y=\"" << y << "\" width=\""
            << step + 0.5 << "\" height=\"" << thickness << "\" fill=\"" << colour_of(c)
            << "\"/>\n";
    }
    for (const double t : linear_ticks(field.range, 5)) {
        const double at = x + length * place(t, field.range, Scale::linear);
        svg << "<path d=\"M" << at << ' ' << y + thickness << "v4\" stroke=\"#333\"/>\n"
            << text_at(at, y + thickness + 19, short_number(t), "text-anchor=\"middle\"");
    }
    svg << text_at(x + length + 24, y + thickness - 1, field.label);
}

}  // namespace breach::report
