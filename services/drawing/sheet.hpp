// Layout of a drawing: a panel of true aspect ratio, and space for labels without overlap. Private
// to the section's drawing; independent of scenes.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "core/geometry/polygon.hpp"

namespace breach::drawing {

using mechanics::Vec2;

/// A rectangle of the page [px], y downwards.
struct Room {
    double left, top, right, bottom;
    bool meets(const Room& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
    bool holds(const Room& other) const {
        return left <= other.left && other.right <= right && top <= other.top &&
               other.bottom <= bottom;
    }
};

/// A window on the section with equal scales in x and y, and a free border.
class Panel {
  public:
    /// As large as fits into the available pixels; its top is at `top`.
    Panel(const geometry::Box& world, double top, double most_height);

    Room room() const { return {left_, top_, left_ + width_, top_ + height_}; }
    double scale() const { return scale_; }  ///< [px/m]
    /// On the page [px].
    Vec2 at(const Vec2& place) const;
    Vec2 back(const Vec2& pixel) const;
    /// The part of the world in the panel [m].
    geometry::Box world() const;
    bool shows(const Vec2& place) const {
        return room().holds({at(place).x(), at(place).y(), at(place).x(), at(place).y()});
    }
    /// The nearest place well inside the panel [m].
    Vec2 inside(const Vec2& place) const;

  private:
    double left_, top_, width_, height_, scale_;
    Vec2 low_;  ///< world at the panel's lower left corner [m]
};

/// Text for SVG: escapes markup, replaces control characters by blanks.
std::string escaped(const std::string& text);
/// `more`: further attributes of the tag.
std::string text_at(double x, double y, const std::string& text, const std::string& more = "");
/// Rounded to a tenth of a pixel.
std::string px(double value);
/// "M0 1L2 3", a closed ring with "Z".
std::string path_of(const Panel& panel, const std::vector<Vec2>& line);

/// Metres along both sides.
void draw_axes(std::ostream& svg, const Panel& panel);

/// Labels without overlap.
class Labels {
  public:
    explicit Labels(const Room& page) : page_(page) {}
    static constexpr double size = 12.0;    ///< font [px]
    static constexpr double height = 14.0;  ///< of a line [px]
    static double width_of(const std::string& text);
    /// The text's rectangle when centred at this place [px].
    static Room around(const Vec2& centre, const std::string& text);
    bool is_free(const Room& room) const;
    void take(const Room& room) { taken_.push_back(room); }
    /// Writes at the nearest free place around a point; false: there is none, and nothing is
    /// written.
    bool beside(std::ostream& svg, const Vec2& point, const std::string& text,
                const std::string& colour);
    /// What lies under a label. lines: it gets a white plate.
    enum class Ground { plain, lines };
    /// Reserves the space and writes.
    void write(std::ostream& svg, const Vec2& centre, const std::string& text,
               const std::string& colour, Ground ground = Ground::plain);

  private:
    Room page_;
    std::vector<Room> taken_;
};

}  // namespace breach::drawing
