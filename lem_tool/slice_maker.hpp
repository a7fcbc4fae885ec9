// Makes slices one by one: weight, water, strength and moments above a piece of the base. The
// surface defines the pieces (arc.cpp, polyline.cpp).
// Also used by weak_layers.cpp to ask for the strength at a place, so that a layer is weak there by
// the same rules as in a slice.
#pragma once

#include <algorithm>
#include <cmath>

#include "lem_tool/slices.hpp"

namespace breach::lem {

/// End points of a slice's base [m].
struct Chord {
    double x0, y0, x1, y1;
};

class SliceMaker {
  public:
    /// pivot: circle of the arc bases; moments are about its centre, divided by its radius.
    SliceMaker(const Strata& strata, const std::vector<Soil>& soils, const scene::Circle& pivot,
               double target_width, Slices& slices)
        : strata_(strata),
          soils_(soils),
          pivot_(pivot),
          target_width_(target_width),
          tolerance_(1e-9 * pivot.radius),
          slices_(slices) {
        slices_.count = 0;
        slices_.depth = 0.0;
    }

    /// Places closer than this are the same [m].
    double tolerance() const { return tolerance_; }

    /// Slices of equal width between two abscissae of a strip, with a smooth base within one layer.
    /// level(x): y of the base.
    template <class Level>
    Cut add_piece(const Strip& strip, double from, double to, Base kind, const Level& level) {
        const double middle = 0.5 * (from + to);
        // A straight base on a boundary takes the soil above it.
        const double above = level(middle) + (kind == Base::straight ? tolerance_ : 0.0);
        const Layer& layer = layer_at(strip, middle, above);
        const Soil& soil = in_force(strip, soils_[layer.region], middle, above);
        if (soil.passage == Soil::Passage::closed) return Cut::closed_region;
        const int parts =
            std::max(1, static_cast<int>(std::ceil((to - from) / target_width_ - 1e-6)));
        const double width = (to - from) / parts;
        double x = from;
        double y = level(x);
        for (int part = 1; part <= parts; ++part) {
            const double next_x = part == parts ? to : from + part * width;
            const double next_y = level(next_x);
            add_slice(strip, layer, soil, kind, {x, y, next_x, next_y});
            x = next_x;
            y = next_y;
        }
        return Cut::done;
    }

  private:
    const Layer& layer_at(const Strip& strip, double x, double y) const {
        std::size_t k = strip.first;
        while (k + 1 < strip.last && strata_.layers[k + 1].top.at(x) > y) ++k;
        return strata_.layers[k];
    }

    /// Only soil below its phreatic line liquefies; without a line, all of it.
    const Soil& in_force(const Strip& strip, const Soil& soil, double x, double y) const {
        if (!soil.above_water || !soil.line) return soil;
        const PorePressure& water = strata_.pressures[strip.pressures + *soil.line];
        return water.at(x, y) > 0.0 ? soil : *soil.above_water;
    }
    void add_slice(const Strip& strip, const Layer& layer, const Soil& soil, Base kind,
                   const Chord& ends);
    double undrained(const Strip& strip, const Layer& layer, const Soil& soil, double x,
                     std::size_t i) const;
    double by_place(const Strip& strip, const Layer& layer, const Soil& soil, double x,
                    std::size_t i) const;
    void take_snapshot(const SnapshotStrength& snapshot, double x, std::size_t i);
    double add_free_water(const Strip& strip, std::size_t i, const Chord& ends);

    const Strata& strata_;
    const std::vector<Soil>& soils_;
    const scene::Circle& pivot_;
    double target_width_;
    double tolerance_;
    Slices& slices_;
};

/// End of a mass: the vertical from its base to the ground, at a face or crack.
struct MassEnd {
    double x;
    double base;  ///< y of the surface there [m]
    enum class Kind { ground, crack } kind;
};

/// Adds the water's thrust on vertical faces between the ends.
void add_pushes(const Strata& strata, const scene::Circle& pivot, double left, double right,
                Slices& slices);

/// Adds the water thrust on the end of the mass, in its crack or in front of its face.
void add_end(const Strata& strata, const scene::Circle& pivot, const MassEnd& end, From outside,
             Slices& slices);

}  // namespace breach::lem
