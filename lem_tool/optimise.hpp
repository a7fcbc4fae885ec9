// The critical polyline: starts from the critical circle and moves the vertices until Spencer's
// factor of safety stops falling. Deterministic.
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
    double frictionless;  ///< share of the base's length without friction [-]
};

/// Spencer's method on a given polyline; it slides towards its lower end. Empty where the polyline
/// leaves the soil or no balance is found.
std::optional<Bent> analyse(const Model& model, const Polyline& polyline, Slices& slices);

/// Limits of a surface: its ends, its depth and its number of vertices.
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

/// Convex below: no vertex lies above the straight line between others, so that the mass can slide
/// on all of them. Empty when already the circle has no answer.
std::optional<Optimised> optimise(const Model& model, const Room& room, const Surface& circle);

}  // namespace breach::lem
