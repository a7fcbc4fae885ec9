#include "services/report/chart/draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "services/report/chart/field.hpp"
#include "services/report/chart/frame.hpp"

namespace breach::report {

namespace {

constexpr double left = 80, top = 50, bottom = 65, row = 22;
constexpr double free_width = 560, free_height = 360;
constexpr double bar_height = 34;
constexpr double equal_width = 860, least_equal_height = 150;
// distinguishable with colour blindness (Okabe and Ito, then Tol)
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9",
                                "#117733", "#000000", "#882255", "#999933", "#332288", "#aa4499"};
constexpr std::array earths = {"#b08d57", "#d9c9a5", "#8c8c7a", "#c2b280", "#a3a380"};

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
    const auto add = [&](const std::vector<double>& x, const std::vector<double>& y) {
        const std::vector<double>& own = at == Mark::At::x ? x : y;
        values.insert(values.end(), own.begin(), own.end());
    };
    for (const Series& each : chart.series) {
        add(each.x, each.y);
        for (std::size_t i = 0; i < each.error.size(); ++i) {
            if (std::isnan(each.error[i])) continue;
            add({each.x[i], each.x[i]}, {each.y[i] - each.error[i], each.y[i] + each.error[i]});
        }
        for (std::size_t i = 0; i < each.low.size(); ++i)
            if (!std::isnan(each.low[i])) add({each.x[i], each.x[i]}, {each.low[i], each.high[i]});
    }
    if (chart.field) add(chart.field->x, chart.field->y);
    for (const Mark& mark : chart.marks) {
        if (mark.at == at) values.push_back(mark.value);
    }
    if (at == Mark::At::y && !chart.y.names.empty())
        return {-0.6, static_cast<double>(chart.y.names.size()) - 0.4};
    return covering(values, at == Mark::At::x ? chart.x.scale : chart.y.scale);
}

void draw_ticks(std::ostream& svg, const Frame& f) {
    const double base = f.top + f.height;
    const auto ticks = [](const Range& r, Scale s, double length) {
        return s == Scale::linear ? linear_ticks(r, std::clamp(length / 60.0, 1.5, 8.0))
                                  : log_ticks(r);
    };
    for (const double t : ticks(f.x, f.chart.x.scale, f.width)) {
        svg << "<path d=\"M" << f.px(t) << ' ' << base << "V" << f.top << "\" stroke=\"#ddd\"/>\n"
            << text_at(f.px(t), base + 20, short_number(t), "text-anchor=\"middle\"");
    }
    for (std::size_t i = 0; i < f.chart.y.names.size(); ++i)
        svg << text_at(f.left - 8, f.py(static_cast<double>(i)) + 5, f.chart.y.names[i],
                       "text-anchor=\"end\"");
    if (!f.chart.y.names.empty()) return;
    for (const double t : ticks(f.y, f.chart.y.scale, f.height)) {
        svg << "<path d=\"M" << f.left << ' ' << f.py(t) << "h" << f.width
            << "\" stroke=\"#ddd\"/>\n"
            << text_at(f.left - 8, f.py(t) + 5, short_number(t), "text-anchor=\"end\"");
    }
}

void draw_axes(std::ostream& svg, const Frame& f, const std::string& y_label) {
    draw_ticks(svg, f);
    svg << "<rect x=\"" << f.left << "\" y=\"" << f.top << "\" width=\"" << f.width
        << "\" height=\"" << f.height << "\" fill=\"none\" stroke=\"#333\"/>\n"
        << text_at(f.left + f.width / 2, f.top + f.height + 46, f.chart.x.label,
                   "text-anchor=\"middle\"");
    std::ostringstream turn;
    turn << "text-anchor=\"middle\" transform=\"rotate(-90 20 " << f.top + f.height / 2 << ")\"";
    svg << text_at(20, f.top + f.height / 2, y_label, turn.str())
        << text_at(f.left, 28, f.chart.title, "font-size=\"17\" font-weight=\"bold\"");
}

void draw_line(std::ostream& svg, const Frame& f, const Series& s, const std::string& colour) {
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

/// Meshes and clouds, with many points.
void draw_many(std::ostream& svg, const Frame& f, const Series& s, const std::string& colour) {
    const bool dots = s.style == Style::dots;
    svg << "<path transform=\"scale(.1)\" fill=\"none\" stroke=\"" << colour
        << "\" stroke-linecap=\"round\" stroke-width=\"" << (dots ? 10.0 * dot_size(f) : 5.0)
        << "\" d=\"";
    Pen pen(svg, f);
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        if (dots) {
            pen.dot(s.x[i], s.y[i]);
        } else if (i % 2 == 0) {
            pen.move(s.x[i], s.y[i]);
        } else {
            pen.line(s.x[i], s.y[i]);
        }
    }
    svg << "\"/>\n";
}

/// Filled: reliable; hollow with an arrow upwards: lower bound; hollow and dashed: questionable;
/// pale: certainty unknown.
void draw_point(std::ostream& svg, double x, double y, const std::string& colour,
                Certainty certainty) {
    svg << "<circle cx=\"" << x << "\" cy=\"" << y << "\" r=\"4\" ";
    switch (certainty) {
        case Certainty::certain:
            svg << "fill=\"" << colour << "\"/>\n";
            return;
        case Certainty::at_least:
            svg << "fill=\"#fff\" stroke=\"" << colour << "\" stroke-width=\"2\"/>\n<path d=\"M"
                << x << ' ' << y - 7 << "v-9m-3.5 3.5l3.5-3.5l3.5 3.5\" fill=\"none\" stroke=\""
                << colour << "\" stroke-width=\"1.8\"/>\n";
            return;
        case Certainty::doubtful:
            svg << "fill=\"#fff\" stroke=\"" << colour
                << "\" stroke-width=\"2\" stroke-dasharray=\"2.4 1.6\"/>\n";
            return;
    }
}

/// Fills between the ends of the band, where neighbouring points both have them.
void draw_band(std::ostream& svg, const Frame& f, const Series& s, const std::string& colour) {
    const auto known = [&](std::size_t i) { return !std::isnan(s.low[i]); };
    for (std::size_t from = 0; from < s.low.size(); ++from) {
        if (!known(from)) continue;
        std::size_t to = from;
        while (to + 1 < s.low.size() && known(to + 1)) ++to;
        svg << "<path d=\"";
        for (std::size_t i = from; i <= to; ++i)
            svg << (i == from ? 'M' : 'L') << f.px(s.x[i]) << ' ' << f.py(s.high[i]);
        for (std::size_t i = to + 1; i-- > from;)
            svg << 'L' << f.px(s.x[i]) << ' ' << f.py(s.low[i]);
        svg << "Z\" fill=\"" << colour << "\" fill-opacity=\"0.16\" stroke=\"none\"/>\n";
        from = to;
    }
}

void draw_bars(std::ostream& svg, const Frame& f, const Series& s, const std::string& colour) {
    for (std::size_t i = 0; i + 1 < s.x.size(); i += 2)
        svg << "<path d=\"M" << f.px(s.x[i]) << ' ' << f.py(s.y[i]) << 'L' << f.px(s.x[i + 1])
            << ' ' << f.py(s.y[i + 1]) << "\" stroke=\"" << colour
            << "\" stroke-width=\"18\" stroke-opacity=\"0.75\"/>\n";
}

/// A whisker at each point with a known error, and a band between neighbours that both have one.
void draw_errors(std::ostream& svg, const Frame& f, const Series& s, const std::string& colour) {
    const auto end = [&](std::size_t i, double side) {
        std::ostringstream place;
        place << f.px(s.x[i]) << ' ' << f.py(s.y[i] + side * s.error[i]);
        return place.str();
    };
    for (std::size_t i = 0; i < s.error.size(); ++i) {
        if (std::isnan(s.error[i])) continue;
        svg << "<path d=\"M" << end(i, -1.0) << 'L' << end(i, 1.0) << "\" stroke=\"" << colour
            << "\" stroke-opacity=\"0.7\"/>\n";
        if (i + 1 == s.error.size() || std::isnan(s.error[i + 1]) || s.style == Style::points)
            continue;
        svg << "<path d=\"M" << end(i, 1.0) << 'L' << end(i + 1, 1.0) << 'L' << end(i + 1, -1.0)
            << 'L' << end(i, -1.0) << "Z\" fill=\"" << colour
            << "\" fill-opacity=\"0.16\" stroke=\"none\"/>\n";
    }
}

void draw_series(std::ostream& svg, const Frame& f, const Series& s, const std::string& colour) {
    if (s.x.empty()) return;
    if (s.style == Style::segments || s.style == Style::dots) return draw_many(svg, f, s, colour);
    if (s.style == Style::bars) return draw_bars(svg, f, s, colour);
    draw_band(svg, f, s, colour);
    draw_errors(svg, f, s, colour);
    if (s.style != Style::points) draw_line(svg, f, s, colour);
    if (s.style != Style::points && s.style != Style::line_and_points) return;
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        draw_point(svg, f.px(s.x[i]), f.py(s.y[i]), colour,
                   s.certainty.empty() ? Certainty::certain : s.certainty[i]);
    }
}

/// Draws the labels of vertical marks on separate lines, on the side with more room.
void draw_marks(std::ostream& svg, const Frame& f) {
    int upright_ones = 0;
    for (const Mark& mark : f.chart.marks) {
        const bool upright = mark.at == Mark::At::x;
        const double x = upright ? f.px(mark.value) : f.left + f.width;
        const double y = upright ? f.top : f.py(mark.value);
        svg << "<path d=\"M" << x << ' ' << y << (upright ? "v" : "h")
            << (upright ? f.height : -f.width) << "\" stroke=\"#333\" stroke-dasharray=\"6 4\"/>\n";
        const bool room = !upright || x - f.left > width_of(mark.label) + 12;
        const double below = upright ? 18 + 18 * (upright_ones++ % 6) : -6;
        svg << text_at(room ? x - 6 : x + 6, y + below, mark.label,
                       room ? "text-anchor=\"end\"" : "");
    }
}

/// Areas have earth colours, so that a line never looks like the ground that it crosses; meshes are
/// grey.
std::vector<std::string> colours_of(const Chart& chart) {
    std::vector<std::string> result;
    std::size_t areas = 0, others = 0;
    for (const Series& each : chart.series) {
        if (each.like)
            result.push_back(result.at(*each.like));
        else if (each.style == Style::segments)
            result.emplace_back("#555");
        else if (each.style == Style::area)
            result.emplace_back(earths[areas++ % earths.size()]);
        else
            result.emplace_back(colours[others++ % colours.size()]);
    }
    return result;
}

/// Names in columns: one column beside a free chart, as many as fit below a chart of equal aspect.
struct Legend {
    double x, y, column_width;
    std::size_t columns, rows;
};

/// A line of the legend: a series, or the look of uncertain points.
struct Entry {
    std::string name;
    std::string colour;
    Certainty certainty = Certainty::certain;
};

std::vector<Entry> entries_of(const Chart& chart, const std::vector<std::string>& colour) {
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        if (!chart.series[i].like && chart.series[i].style != Style::area)
            entries.push_back({chart.series[i].name, colour[i]});
    }
    for (const Certainty each : {Certainty::at_least, Certainty::doubtful}) {
        const bool there = std::ranges::any_of(chart.series, [&](const Series& s) {
            return std::ranges::find(s.certainty, each) != s.certainty.end();
        });
        if (there) entries.push_back({name_of(each), "#333", each});
    }
    return entries;
}

Legend legend_of(const Chart& chart, const Frame& f, const std::vector<Entry>& entries) {
    double widest = 0.0;
    for (const Entry& each : entries) widest = std::max(widest, width_of(each.name));
    const double column = widest + 60;
    if (chart.aspect == Aspect::free) {
        return {f.left + f.width + 14, f.top + 12, column, 1, entries.size()};
    }
    const std::size_t fit = static_cast<std::size_t>(std::max(1.0, (f.width + 10) / column));
    return {f.left, f.top + f.height + bottom + (chart.field ? colour_bar_height : 8.0), column,
            fit, (entries.size() + fit - 1) / fit};
}

void draw_legend(std::ostream& svg, const Legend& legend, const std::vector<Entry>& entries) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double x = legend.x + legend.column_width * static_cast<double>(i % legend.columns);
        const std::size_t line = i / legend.columns;
        const double y = legend.y + row * static_cast<double>(line);
        if (entries[i].certainty != Certainty::certain) {
            draw_point(svg, x + 10, y + 4, entries[i].colour, entries[i].certainty);
        } else {
            svg << "<path d=\"M" << x << ' ' << y << "h20\" stroke=\"" << entries[i].colour
                << "\" stroke-width=\"4\"/>\n";
        }
        svg << text_at(x + 28, y + 5, entries[i].name);
    }
}

/// Keeps equal aspect unless the picture becomes too low.
Frame frame_of(const Chart& chart, std::string& y_label) {
    Frame f{chart,
            range_of(chart, Mark::At::x),
            range_of(chart, Mark::At::y),
            left,
            top,
            free_width,
            free_height};
    y_label = chart.y.label;
    if (!chart.y.names.empty()) {
        for (const std::string& each : chart.y.names)
            f.left = std::max(f.left, 24 + width_of(each));
        f.height = 60.0 + bar_height * static_cast<double>(chart.y.names.size());
    }
    if (chart.aspect == Aspect::free) return f;
    f.width = equal_width;
    f.height = f.width * (f.y.high - f.y.low) / (f.x.high - f.x.low);
    const double times = std::ceil(least_equal_height / f.height);
    if (times > 1.0) {
        f.height *= times;
        y_label += ", heights x " + short_number(times);
    }
    return f;
}

}  // namespace

std::string as_svg(const Chart& chart) {
    check_columns(chart);
    std::string y_label;
    const Frame f = frame_of(chart, y_label);
    const std::vector<std::string> colour = colours_of(chart);
    const std::vector<Entry> entries = entries_of(chart, colour);
    const Legend legend = legend_of(chart, f, entries);
    const bool below = chart.aspect == Aspect::equal;
    const double legend_end = legend.y + row * static_cast<double>(legend.rows);
    const double total_width = f.left + f.width + (below ? 30.0 : legend.column_width);
    const double total_height = std::max(f.top + f.height + bottom, legend_end);
    std::ostringstream svg;
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << total_width << ' '
        << total_height << "\" width=\"" << total_width << "\" height=\"" << total_height
        << "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\" fill=\"#222\">\n"
        << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
    draw_axes(svg, f, y_label);
    if (chart.field) {
        draw_field(svg, f, *chart.field);
        draw_colour_bar(svg, f.left, f.top + f.height + bottom, *chart.field);
    }
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        draw_series(svg, f, chart.series[i], colour[i]);
    }
    draw_legend(svg, legend, entries);
    draw_marks(svg, f);
    svg << "</svg>\n";
    return svg.str();
}

}  // namespace breach::report
