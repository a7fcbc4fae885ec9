#include "services/report/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace breach::report {

namespace {

constexpr double left = 80, top = 50, width = 560, legend_width = 240, bottom = 65;
// colours that stay apart for colour-blind eyes (Okabe and Ito)
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                "#e69f00", "#56b4e9", "#555555", "#000000"};
constexpr std::array earths = {"#b08d57", "#d9c9a5", "#8c8c7a", "#c2b280", "#a3a380"};

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '"')
            out += "&quot;";
        else if (static_cast<unsigned char>(c) >= 0x20)
            out += c;
    }
    return out;
}

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
    std::ostringstream svg;
    svg << "<text x=\"" << x << "\" y=\"" << y << "\" " << more << ">" << escaped(text)
        << "</text>\n";
    return svg.str();
}

Range covering(const std::vector<double>& values, Scale scale) {
    if (values.empty()) throw std::invalid_argument("a chart without data");
    for (const double v : values) {
        if (!std::isfinite(v) || (scale == Scale::logarithmic && v <= 0.0)) {
            throw std::invalid_argument("a value that has no place on its axis");
        }
    }
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (scale == Scale::logarithmic) return {*low / 1.2, *high * 1.2};
    double margin = 0.04 * (*high - *low);
    if (margin <= 0.0) margin = *high == 0.0 ? 1.0 : 0.1 * std::abs(*high);
    return {*low - margin, *high + margin};
}

Range range_of(const Chart& chart, Mark::At at) {
    std::vector<double> values;
    for (const Series& each : chart.series) {
        const std::vector<double>& own = at == Mark::At::x ? each.x : each.y;
        values.insert(values.end(), own.begin(), own.end());
    }
    for (const Mark& mark : chart.marks) {
        if (mark.at == at) values.push_back(mark.value);
    }
    return covering(values, at == Mark::At::x ? chart.x.scale : chart.y.scale);
}

struct Frame {
    const Chart& chart;
    Range x, y;
    double height;
    double px(double v) const { return left + width * place(v, x, chart.x.scale); }
    double py(double v) const { return top + height * (1.0 - place(v, y, chart.y.scale)); }
};

void draw_axes(std::ostream& svg, const Frame& f) {
    const double base = top + f.height;
    const auto ticks = [](const Range& r, Scale s, double length) {
        return s == Scale::linear ? linear_ticks(r, std::clamp(length / 60.0, 1.5, 6.0))
                                  : log_ticks(r);
    };
    for (const double t : ticks(f.x, f.chart.x.scale, width)) {
        svg << "<path d=\"M" << f.px(t) << ' ' << base << "V" << top << "\" stroke=\"#ddd\"/>\n"
            << text_at(f.px(t), base + 20, short_number(t), "text-anchor=\"middle\"");
    }
    for (const double t : ticks(f.y, f.chart.y.scale, f.height)) {
        svg << "<path d=\"M" << left << ' ' << f.py(t) << "h" << width << "\" stroke=\"#ddd\"/>\n"
            << text_at(left - 8, f.py(t) + 5, short_number(t), "text-anchor=\"end\"");
    }
    svg << "<rect x=\"" << left << "\" y=\"" << top << "\" width=\"" << width << "\" height=\""
        << f.height << "\" fill=\"none\" stroke=\"#333\"/>\n"
        << text_at(left + width / 2, base + 46, f.chart.x.label, "text-anchor=\"middle\"");
    std::ostringstream turn;
    turn << "text-anchor=\"middle\" transform=\"rotate(-90 20 " << top + f.height / 2 << ")\"";
    svg << text_at(20, top + f.height / 2, f.chart.y.label, turn.str())
        << text_at(left, 28, f.chart.title, "font-size=\"17\" font-weight=\"bold\"");
}

void draw_series(std::ostream& svg, const Frame& f, const Series& s, const std::string& colour) {
    if (s.style != Style::points && !s.x.empty()) {
        svg << "<path d=\"";
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            svg << (i == 0 ? 'M' : 'L') << f.px(s.x[i]) << ' ' << f.py(s.y[i]);
        }
        if (s.style == Style::area) {
            svg << "Z\" fill=\"" << colour << "\" fill-opacity=\"0.55\" stroke=\"#777\"/>\n";
        } else {
            svg << "\" fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"1.8\"/>\n";
        }
    }
    if (s.style != Style::points && s.style != Style::line_and_points) return;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        svg << "<circle cx=\"" << f.px(s.x[i]) << "\" cy=\"" << f.py(s.y[i]) << "\" r=\"4\" fill=\""
            << colour << "\"/>\n";
    }
}

void draw_mark(std::ostream& svg, const Frame& f, const Mark& mark) {
    const bool upright = mark.at == Mark::At::x;
    const double x = upright ? f.px(mark.value) : left + width;
    const double y = upright ? top : f.py(mark.value);
    svg << "<path d=\"M" << x << ' ' << y << (upright ? "v" : "h") << (upright ? f.height : -width)
        << "\" stroke=\"#333\" stroke-dasharray=\"6 4\"/>\n"
        << text_at(x - 6, upright ? y + 18 : y - 6, mark.label, "text-anchor=\"end\"");
}

}  // namespace

std::string as_svg(const Chart& chart) {
    Frame f{chart, range_of(chart, Mark::At::x), range_of(chart, Mark::At::y), 360};
    if (chart.aspect == Aspect::equal) {
        f.height = width * (f.y.high - f.y.low) / (f.x.high - f.x.low);
    }
    const double legend = 22.0 * static_cast<double>(chart.series.size());
    const double total_width = left + width + legend_width;
    const double total_height = top + std::max(f.height + bottom, legend + 20);
    std::ostringstream svg;
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << total_width << ' '
        << total_height << "\" width=\"" << total_width << "\" height=\"" << total_height
        << "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\" fill=\"#222\">\n"
        << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    draw_axes(svg, f);
    std::size_t areas = 0;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        // Areas have earth colours of their own, so that a line never looks like the ground it
        // crosses.
        const bool area = chart.series[i].style == Style::area;
        const std::string colour =
            area ? earths[areas % earths.size()] : colours[(i - areas) % colours.size()];
        areas += area ? 1 : 0;
        draw_series(svg, f, chart.series[i], colour);
        const double y = top + 12 + 22.0 * static_cast<double>(i);
        svg << "<path d=\"M" << left + width + 14 << ' ' << y << "h20\" stroke=\"" << colour
            << "\" stroke-width=\"4\"/>\n"
            << text_at(left + width + 42, y + 5, chart.series[i].name);
    }
    for (const Mark& mark : chart.marks) draw_mark(svg, f, mark);
    svg << "</svg>\n";
    return svg.str();
}

}  // namespace breach::report
