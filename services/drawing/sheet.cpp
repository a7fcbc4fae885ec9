// Places a section on a page: one scale for x and y, because slopes must look as steep as they
// are.
#include "services/drawing/sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/words/number.hpp"

namespace breach::drawing {

namespace {

constexpr double page_left = 60, most_width = 960, least_width = 420;
constexpr double beside = 28, above = 46, below = 24;  // free border [px]

/// Multiples of 1, 2 or 5 times a power of ten from low to high, about `wanted` of them.
/// +0.0 below turns -0 into 0, which would be written as "-0".
std::vector<double> ticks(double low, double high, double wanted) {
    const double rough = (high - low) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double share = rough / power;
    const double step = power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
    std::vector<double> all;
    const double slack = 1e-9;  // of a step: keeps the last tick despite round-off
    const double first = std::ceil(low / step - slack);
    const double more = std::floor(high / step + slack) - first;
    if (!(more < 1e3)) return all;  // no ticks in a range within round-off
    for (int k = 0; k <= more; ++k) all.push_back((first + k) * step + 0.0);
    return all;
}

}  // namespace

Panel::Panel(const geometry::Box& world, double top, double most_height)
    : left_(page_left), top_(top) {
    const Vec2 size = (world.high - world.low).cwiseMax(1e-6);
    scale_ =
        std::min((most_width - 2 * beside) / size.x(), (most_height - above - below) / size.y());
    // A high and narrow section still gets room for its legend and axis.
    width_ = std::max(size.x() * scale_ + 2 * beside, least_width);
    height_ = size.y() * scale_ + above + below;
    const double free = 0.5 * (width_ - size.x() * scale_);
    low_ = world.low - Vec2(free, below) / scale_;
}

Vec2 Panel::at(const Vec2& place) const {
    const Vec2 pixel = (place - low_) * scale_;
    return {left_ + pixel.x(), top_ + height_ - pixel.y()};
}

Vec2 Panel::back(const Vec2& pixel) const {
    return low_ + Vec2(pixel.x() - left_, top_ + height_ - pixel.y()) / scale_;
}

geometry::Box Panel::world() const { return {low_, low_ + Vec2(width_, height_) / scale_}; }

Vec2 Panel::inside(const Vec2& place) const {
    const Vec2 margin = Vec2::Constant(12.0 / scale_);
    const geometry::Box shown = world();
    return place.cwiseMax(shown.low + margin).cwiseMin(shown.high - margin);
}

/// Names come from users; in SVG they must not become elements.
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

/// A tenth of a pixel is invisible, and whole files of them are small.
std::string px(double value) { return words::text_of(std::round(10.0 * value) / 10.0); }

std::string path_of(const Panel& panel, const std::vector<Vec2>& line) {
    std::string path;
    for (const Vec2& each : line) {
        const Vec2 pixel = panel.at(each);
        path += (path.empty() ? "M" : "L") + px(pixel.x()) + " " + px(pixel.y());
    }
    return path;
}

/// One tick per 80 pixels or so, at most ten: the vertical axis is short and gets them closer.
void draw_axes(std::ostream& svg, const Panel& panel) {
    const Room room = panel.room();
    const geometry::Box world = panel.world();
    const auto wanted = [](double pixels) { return std::clamp(pixels / 80.0, 1.5, 10.0); };
    svg << "<g class=\"axes\" font-size=\"12\">\n";
    for (const double t : ticks(world.low.x(), world.high.x(), wanted(room.right - room.left))) {
        const std::string x = px(panel.at({t, 0.0}).x());
        svg << "<path d=\"M" << x << " " << px(room.bottom) << "V" << px(room.top)
            << "\" stroke=\"#e4e4e4\"/>\n"
            << text_at(std::stod(x), room.bottom + 16, words::text_of(t), "text-anchor=\"middle\"");
    }
    for (const double t :
         ticks(world.low.y(), world.high.y(), wanted(1.6 * (room.bottom - room.top)))) {
        const std::string y = px(panel.at({0.0, t}).y());
        svg << "<path d=\"M" << px(room.left) << " " << y << "H" << px(room.right)
            << "\" stroke=\"#e4e4e4\"/>\n"
            << text_at(room.left - 6, std::stod(y) + 4, words::text_of(t), "text-anchor=\"end\"");
    }
    svg << "<rect x=\"" << px(room.left) << "\" y=\"" << px(room.top) << "\" width=\""
        << px(room.right - room.left) << "\" height=\"" << px(room.bottom - room.top)
        << "\" fill=\"none\" stroke=\"#555\"/>\n"
        << text_at(room.right, room.bottom + 32, "x and y in m, one scale",
                   "text-anchor=\"end\" fill=\"#555\"")
        << "</g>\n";
}

/// Estimated: no font is loaded here, and the reader's is not known. In UTF-8, bytes that continue
/// a letter do not count.
double Labels::width_of(const std::string& text) {
    const auto begins_letter = [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    };
    const auto letters =
        static_cast<double>(std::count_if(text.begin(), text.end(), begins_letter));
    return 1.1 * (7.6 * letters) * size / 14.0 + 4.0;  // fits the widest usual fonts
}

Room Labels::around(const Vec2& centre, const std::string& text) {
    const double half = 0.5 * width_of(text);
    return {centre.x() - half, centre.y() - 0.5 * height, centre.x() + half,
            centre.y() + 0.5 * height};
}

bool Labels::is_free(const Room& room) const {
    return page_.holds(room) &&
           std::ranges::none_of(taken_, [&](const Room& each) { return each.meets(room); });
}

void Labels::write(std::ostream& svg, const Vec2& centre, const std::string& text,
                   const std::string& colour, Ground ground) {
    const Room room = around(centre, text);
    take(room);
    if (ground == Ground::lines)  // not a halo by paint-order, which writers of PDF ignore
        svg << "<rect x=\"" << px(room.left) << "\" y=\"" << px(room.top) << "\" width=\""
            << px(room.right - room.left) << "\" height=\"" << px(height)
            << "\" fill=\"#fff\" fill-opacity=\"0.7\"/>\n";
    svg << text_at(
        centre.x(), centre.y() + 4, text,
        "class=\"label\" text-anchor=\"middle\" font-size=\"12\" fill=\"" + colour + "\"");
}

bool Labels::beside(std::ostream& svg, const Vec2& point, const std::string& text,
                    const std::string& colour) {
    const double aside = 0.5 * width_of(text) + 8;
    for (const double far : {0.0, 14.0, 28.0}) {
        // Above first, then to the sides, then below.
        const std::array<Vec2, 6> around_it{Vec2(0, -14 - far),      Vec2(aside, -10 - far),
                                            Vec2(-aside, -10 - far), Vec2(aside, far),
                                            Vec2(-aside, far),       Vec2(0, 16 + far)};
        for (const Vec2& each : around_it) {
            if (!is_free(around(point + each, text))) continue;
            write(svg, point + each, text, colour, Ground::lines);
            return true;
        }
    }
    return false;
}

}  // namespace breach::drawing
