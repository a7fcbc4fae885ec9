#include "mpm_solver/share.hpp"

#include <algorithm>
#include <iterator>

namespace breach::mpm {

namespace {

PointArrays arrays_of(Points& points) {
    PointArrays arrays{};
    for (std::size_t k = 0; k < std::size(reals_of_points<Reals>); ++k) {
        Reals& values = points.*reals_of_points<Reals>[k].array;
        if (!values.empty()) arrays.*reals_of_points<double*>[k].array = values.data();
    }
    arrays.cell = points.cell.data();
    return arrays;
}

GridArrays arrays_of(Grid& grid, const scene::StandingWater& water, const WallRows& walls_y) {
    return {.mass = grid.mass.data(),
            .motion = grid.motion.data()->data(),
            .still = water.nodes().data(),
            .rows = grid.rows,
            .h = grid.h,
            .per_h = grid.per_h,
            .x_0 = grid.origin.x(),
            .y_0 = grid.origin.y(),
            .low_x = grid.low.x(),
            .high_x = grid.high.x(),
            .low_y = grid.low.y(),
            .high_y = grid.high.y(),
            .walls_x = grid.walls_x,
            .walls_y = walls_y};
}

/// Flowing soil does not yield in every step; soil that has not yielded for about 20 eta / G is at
/// rest.
double damping_return(const Zone& zone, double dt) {
    if (zone.damping == 0.0) return 0.0;
    return std::min(dt * zone.elasticity.shear_modulus() / (20.0 * zone.damping), 1.0);
}

ZoneWork work_of(Body& body, const PointArrays& points, std::size_t z, double dt) {
    const Zone& zone = body.zones[z];
    return {.points = points,
            .grid = arrays_of(body.grid, body.water, zone.walls_y),
            .cells = body.averages[z].empty() ? nullptr : body.averages[z].data(),
            .law = std::visit([](const auto& law) -> const void* { return &law; }, zone.lanes),
            .moduli = materials::make_moduli(zone.elasticity),
            .eta = zone.viscosity,
            .damping = zone.damping,
            .damping_return = damping_return(zone, dt),
            .gimp_half_size = body.gimp_half_size,
            .dt = dt,
            .blend = std::min(body.blending_rate * dt, 1.0),
            .overlap_rate = body.overlap_rate,
            .widest = body.widest};
}

void add(Totals& whole, const Totals& part) {
    whole.kinetic += part.kinetic;
    whole.fastest_squared = std::max(whole.fastest_squared, part.fastest_squared);
    whole.farthest = std::max(whole.farthest, part.farthest);
    whole.lost = std::min(whole.lost, part.lost);
    whole.plastic += part.plastic;
    whole.viscous += part.viscous;
    whole.pushed_in += part.pushed_in;
}

}  // namespace

Totals for_all_points(Body& body, Loop Loops::*loop, Writes writes, double dt) {
    const auto has_it = [&](const Loops& loops) { return loops.*loop != nullptr; };
    if (std::ranges::none_of(body.loops, has_it)) return {};
    const PointArrays points = arrays_of(body.points);
    const Strips& strips = body.strips;
    const std::size_t zones = body.zones.size();
    body.sums.resize(strips.count() * zones);
    const auto over = [&](const std::vector<std::size_t>& together) {
        body.team->share(together.size(), [&](std::size_t task) {
            const std::size_t strip = together[task];
            for (std::size_t z = 0; z < zones; ++z) {
                const Span span = strips.span(strip, z);
                const Loop chosen = body.loops[z].*loop;
                // One entry per task, so that no thread waits for another; find_lightest (step.cpp)
                // reads them too.
                Totals& sums = body.sums[strip * zones + z] = {};
                if (chosen && span.begin < span.end)
                    chosen(work_of(body, points, z, dt), span, sums);
            }
        });
    };
    if (writes == Writes::nodes) {
        // All even strips end before the odd ones begin: they share nodes.
        for (const std::vector<std::size_t>& together : strips.apart()) over(together);
    } else {
        over(strips.all());
    }
    Totals whole;
    for (const std::size_t strip : strips.all()) {
        for (std::size_t z = 0; z < zones; ++z) add(whole, body.sums[strip * zones + z]);
    }
    return whole;
}

void forget_averages(Body& body) {
    for (std::size_t z = 0; z < body.averages.size(); ++z) {
        std::vector<CellSum>& sums = body.averages[z];
        if (sums.empty()) continue;
        for (const std::int32_t cell : body.strips.cells(z)) sums[cell] = {};
    }
}

}  // namespace breach::mpm
