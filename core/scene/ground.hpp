// Position of a place in the undeformed section, as strength profiles need it, the same for every
// phase. Vertical columns: no arching, no seepage except that in the lines.
#pragma once

#include "core/materials/strength/profile.hpp"
#include "core/scene/scene.hpp"

namespace breach::scene {

/// Vertical stresses of the section as drawn, or of its present part. The total stress is the weight of
/// soil and free water above. The pore pressure comes from the line of the place's region in /lem; if the
/// scene's /lem has none, it is hydrostatic below /fem/water's line, else below the transfer's phreatic
/// line.
class Ground {
  public:
    /// gone: [regions] those that stages have removed or not yet placed, which have no weight and
    /// are not ground; empty: all are present.
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
