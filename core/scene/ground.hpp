// Where a place lies in the undeformed section: what strength profiles ask for, the same for every
// phase. Vertical columns: no arching, no seepage beyond what the lines say.
#pragma once

#include "core/materials/strength/profile.hpp"
#include "core/scene/scene.hpp"

namespace breach::scene {

/// Vertical stresses of the section as it is drawn, or of the part of it that is there. The total one is the weight of soil and free
/// water above; the pore pressure is that of the line of the place's region in /lem, in a scene
/// whose /lem has none the hydrostatic one below /fem/water's line, else below the transfer's
/// phreatic line.
class Ground {
  public:
    /// gone: [regions] those that stages have removed or not yet placed, which weigh nothing and
    /// are no ground; empty: all are there.
    explicit Ground(const Scene& scene, const std::vector<bool>& gone = {});

    /// A place [m] in a region (index into the section's).
    materials::Place at(const Vec2& place, std::size_t region) const;

  private:
    struct Line {
        std::vector<Vec2> points;
        double gamma;  ///< [N/m3]
        PhreaticCorrection correction;
        bool stands_free;  ///< above the ground it is free water
    };
    struct Layer {
        Polygon polygon;
        double gamma;              ///< [N/m3]
        std::optional<Line> line;  ///< whose water fills it
        double r_u = 0.0;          ///< where no water reaches [-]
        bool is_gone = false;
    };
    double pressure(const Line& line, const Vec2& place, double ground) const;

    std::vector<Layer> layers_;       ///< by region
    std::optional<Line> free_water_;  ///< weighs where it stands above the ground
};

}  // namespace breach::scene
