// Layout of a chart [px], and text of its shapes. Private to the charts.
#pragma once

#include <cmath>
#include <ostream>
#include <string>

#include "services/report/chart/chart.hpp"

namespace breach::report {

/// The rectangle between the axes.
struct Frame {
    const Chart& chart;
    Range x, y;
    double left, top, width, height;
    double px(double v) const { return left + width * place(v, x, chart.x.scale); }
    double py(double v) const { return top + height * (1.0 - place(v, y, chart.y.scale)); }
};

/// Writes many points in few characters: tenths of a pixel as whole numbers, relative to the
/// previous point. Use inside <g transform="scale(.1)">.
class Pen {
  public:
    Pen(std::ostream& out, const Frame& frame) : out_(out), frame_(frame) {}
    void move(double x, double y) { go('m', x, y); }
    void line(double x, double y) { go('l', x, y); }
    void close() {
        out_ << 'z';
        at_x_ = start_x_, at_y_ = start_y_;
    }
    /// A line of length zero: with round ends, a dot.
    void dot(double x, double y) {
        move(x, y);
        out_ << "h0";
    }

  private:
    void go(char how, double x, double y) {
        const long to_x = std::lround(10.0 * frame_.px(x)), to_y = std::lround(10.0 * frame_.py(y));
        out_ << how << to_x - at_x_ << ' ' << to_y - at_y_;
        at_x_ = to_x, at_y_ = to_y;
        if (how == 'm') start_x_ = at_x_, start_y_ = at_y_;
    }

    std::ostream& out_;
    const Frame& frame_;
    long at_x_ = 0, at_y_ = 0, start_x_ = 0, start_y_ = 0;
};

/// Text for SVG and HTML: escapes markup, replaces control characters by blanks.
std::string escaped(const std::string& text);
/// `more`: further attributes of the tag.
std::string text_at(double x, double y, const std::string& text, const std::string& more = "");
/// Estimated width of a text of 14 px [px].
double width_of(const std::string& text);

/// Diameter of the dots of clouds: they nearly touch where points are dense [px].
double dot_size(const Frame& frame);

}  // namespace breach::report
