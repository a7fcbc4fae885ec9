// Depth, elevation and vertical effective stress at a place of the undeformed section, for strength
// profiles of every phase. Vertical columns: no arching, no seepage apart from the drawn lines.
#pragma once

#include "core/materials/strength/profile.hpp"
#include "core/scene/scene.hpp"

namespace breach::scene {

/// Vertical stresses of the section as drawn, or of its present part. Total stress: weight of the
/// soil and free water above. Pore pressure: from the region's water line in /lem; if /lem has
/// none, hydrostatic below the line of /fem/water, else below the transfer's phreatic line.
class Ground {
  public:
    /// gone: [regions] removed or not yet placed: no weight, no ground. Empty: all are present.
    explicit Ground(const Scene& scene, const std::vector<bool>& gone = {});

    /// A place [m] in a region (index into the section's).
    materials::Place at(const Vec2& place, std::size_t region) const;

    /// Pore pressure ratio u / sigma_v on the region's base, where it slides: the mean pore pressure
    /// over the mean total vertical stress [-] (Bishop & Morgenstern 1960).
    double r_u_at_base(std::size_t region) const;

  private:
    struct Stress {
        double ground;    ///< level of the ground [m]
        double sigma, u;  ///< total vertical stress and pore pressure [Pa]
    };
    Stress stress(const Vec2& place, std::size_t region) const;

    struct Line {
        std::vector<Vec2> points;
        double gamma;  ///< [N/m3]
        PhreaticCorrection correction;
        bool stands_free;  ///< above the ground the line is the surface of free water
    };
    struct Layer {
        Polygon polygon;
        double gamma;              ///< [N/m3]
        std::optional<Line> line;  ///< water line of the region
        double r_u = 0.0;          ///< pore pressure ratio where the line gives no pressure [-]
        bool is_gone = false;
    };
    double pressure(const Line& line, const Vec2& place, double ground) const;

    std::vector<Layer> layers_;       ///< by region
    std::optional<Line> free_water_;  ///< line whose water above the ground has weight
};

/// Whether soil reaches so far below a water line that its pore pressure counts.
bool is_below_water(const Section& section, const Region& region, const std::vector<Vec2>& line);

}  // namespace breach::scene
