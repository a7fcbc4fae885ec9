// The critical polyline: descents of Spencer's factor of safety from wedges and circles.
// Deterministic.
// Called by non_circular.cpp. The critical circle is among the starts, and a descent only goes
// down: its factor by Spencer's method is an upper bound of the result.
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
    /// share of the mass's area without friction, if most of the base is [-]
    double frictionless_mass;
};

/// Whether most of a polyline's base is without friction, other than in a thin layer under soil
/// with friction, by how much: from 0 on its factor neglects the shearing of the mass at the kinks.
double kinked_without_friction(double share_of_base, double share_of_mass);

/// Spencer's method on a polyline that slides towards its lower end. Empty if the polyline leaves
/// the soil or no equilibrium is found. similar: for spencer(); null: nothing is known or kept.
std::optional<Bent> analyse(const Model& model, const Polyline& polyline, Slices& slices,
                            Similar* similar = nullptr);

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
    double start;  ///< Spencer's factor of safety of the circle as a polyline; infinite: none [-]
    double error;  ///< relative gap between the two best descents; infinite: only one ended
    std::int64_t analysed;
};

/// A surface from which a descent starts, in its own strata: a composite one has its own floor.
struct Start {
    const Strata& strata;
    const Surface& surface;
};

/// The optimised polyline; convex (no vertex above the line through others), so that the mass can
/// slide on all of it. Starts: the critical circle first. Empty if no descent ends within the
/// limits.
std::optional<Optimised> optimise(const Model& model, const Room& room,
                                  const std::vector<Start>& starts);

}  // namespace breach::lem
