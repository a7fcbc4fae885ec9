// The critical polyline: starts from the critical circle and moves vertices while Spencer's factor
// of safety decreases. Deterministic.
// Called by non_circular.cpp. The descent only goes down from its start, so that the circle's
// factor by Spencer's method is an upper bound of the result.
#pragma once

#include <cstdint>
#include <optional>

#include "lem_tool/polyline.hpp"
#include "lem_tool/search.hpp"
#include "lem_tool/spencer.hpp"

namespace breach::lem {

/// A surface with its result by Spencer's method.
struct Bent {
    Polyline surface;
    Spencer spencer;
    double depth;         ///< greatest vertical depth of the mass [m]
    double frictionless;  ///< share of the base length without friction [-]
};

/// Spencer's method on a polyline that slides towards its lower end. Empty if the polyline leaves
/// the soil or no equilibrium is found. near: as in spencer().
std::optional<Bent> analyse(const Model& model, const Polyline& polyline, Slices& slices,
                            const std::optional<Spencer>& near = std::nullopt);

/// Limits of a surface: ends, depth, number of vertices.
struct Room {
    std::array<double, 2> upper;  ///< x of the upper end [m]
    std::array<double, 2> lower;  ///< x of the lower end [m]
    double minimum_depth;         ///< [m]
    int vertices;
};
Room room_of(const scene::Lem& lem, const Strata& strata);

struct Optimised {
    Bent best;
    double start;  ///< Spencer's factor of safety of the circle as a polyline [-]
    std::int64_t analysed;
};

/// The optimised polyline; convex (no vertex above the line through others), so that the mass can
/// slide on all of it. Empty if Spencer's method fails for the circle.
std::optional<Optimised> optimise(const Model& model, const Room& room, const Surface& circle);

}  // namespace breach::lem
