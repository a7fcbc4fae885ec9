#include <algorithm>
#include <cmath>
#include <limits>

#include "core/check/section.hpp"
#include "core/check/subjects.hpp"
#include "core/scene/resolution.hpp"
#include "core/scene/stiffness.hpp"
#include "core/words/number.hpp"
#include "core/words/remedy.hpp"

namespace breach::check {

namespace {

/// Refuses terrain that cuts through the section: that soil would start inside the terrain.
void check_terrain(const scene::Scene& scene, Problems& problems) {
    const scene::Mpm& mpm = *scene.mpm;
    if (mpm.terrain.empty()) return;
    // inaccuracy of a drawing: no material point is that deep
    const double allowed = 0.05 * mpm.cell_size;
    for (const scene::Region& region : scene.section.regions) {
        if (region.polygon.empty()) continue;
        const Depth deepest = deepest_below(region.polygon, mpm.terrain, straight_level_at);
        if (deepest.below <= allowed) continue;
        refuse(problems, "/mpm/terrain",
               "passes through region \"" + region.name + "\", which reaches " +
                   metres(deepest.below) + " below it at " + text(deepest.place),
               "lower the terrain to " + metres(deepest.place.y()) +
                   " at x = " + metres(deepest.place.x()) + ", or cut the section at it");
    }
}

/// Where the section is above terrain or floor: its soil falls freely before it flows.
struct Clearance {
    double size = 0.0;  ///< maximum [m]
    double x = 0.0;     ///< x of the maximum [m]
    double from = std::numeric_limits<double>::infinity();
    double to = -std::numeric_limits<double>::infinity();
};

Clearance clearance_below_section(const scene::Scene& scene, double told) {
    const scene::Mpm& mpm = *scene.mpm;
    const geometry::Box box = extent(scene.section);
    const double near = 1e-6 * (box.high.x() - box.low.x());
    std::vector<double> places = abscissae(scene.section);
    for (const Vec2& kink : mpm.terrain) places.push_back(kink.x());
    Clearance gap;
    const auto lowest = [&](double x) {
        const std::vector<Stratum> strata = strata_at(scene.section, x);
        return strata.empty() ? std::numeric_limits<double>::quiet_NaN()
                              : std::ranges::min(strata, {}, &Stratum::bottom).bottom;
    };
    const auto look = [&](double place, double side) {
        const double x = place + side;
        const double bottom = lowest(x);
        const bool overhangs =
            std::abs(lowest(x + side) - bottom) > near;  // steeper than 45 degrees
        if (std::isnan(bottom) || overhangs) return;
        const double size =
            bottom - (mpm.terrain.empty() ? mpm.floor.level : straight_level_at(mpm.terrain, x));
        if (size <= told) return;
        gap.from = std::min(gap.from, place);
        gap.to = std::max(gap.to, place);
        if (size > gap.size) gap.size = size, gap.x = place;
    };
    for (const double place : places)
        for (const double side : {-near, near}) look(place, side);
    return gap;
}

void check_support(const scene::Scene& scene, Problems& problems) {
    const scene::Mpm& mpm = *scene.mpm;
    const Clearance gap = clearance_below_section(scene, 0.1 * mpm.cell_size);
    if (gap.size == 0.0) return;
    const bool on_floor = mpm.terrain.empty();
    const double support = on_floor ? mpm.floor.level : straight_level_at(mpm.terrain, gap.x);
    warn(problems, "implausible", on_floor ? "/mpm/floor/level" : "/mpm/terrain",
         "the section lies up to " + metres(gap.size) + " above the " +
             (on_floor ? "floor" : "terrain") + " (from x = " + text(gap.from) + " to " +
             metres(gap.to) + ", most at x = " + metres(gap.x) +
             "): the soil falls as far before it flows; " +
             (on_floor ? words::set("/mpm/floor/level", support + gap.size)
                       : "raise the terrain to y = " + metres(support + gap.size) + " there") +
             ", or draw the soil that fills the gap");
}

/// Flags stiffness so low that the flow compresses the soil.
void check_stiffness(const scene::Scene& scene, Problems& problems) {
    const scene::Mpm& mpm = *scene.mpm;
    if (mpm.stiffness_scale == 1.0) return;
    const double flow = scene::fall_speed(scene, mpm);
    const double wave = scene::fastest_wave(scene, mpm);
    if (!(flow > scene::refused_mach * wave)) return;
    const double enough = mpm.stiffness_scale * std::pow(flow / (scene::refused_mach * wave), 2);
    const double unit = std::pow(10.0, std::floor(std::log10(enough)) - 1.0);
    const auto shown = [](double value) { return words::text_of(value, 3); };
    refuse(problems, "/mpm/stiffness_scale",
           "leaves the fastest wave " + shown(wave) + " m/s, and soil can fall at " + shown(flow) +
               " m/s: Mach " + shown(flow / wave) + ", more than " + shown(scene::refused_mach),
           "write at least " + shown(std::min(std::ceil(enough / unit) * unit, 1.0)) +
               ", or \"auto\"");
}

void check_toe(const scene::Scene& scene, Problems& problems) {
    const scene::Mpm& mpm = *scene.mpm;
    const Vec2& toe = mpm.runout.toe;
    const bool inside = toe.x() >= mpm.domain_x[0] && toe.x() <= mpm.domain_x[1] &&
                        toe.y() >= mpm.domain_y[0] && toe.y() <= mpm.domain_y[1];
    if (!inside)
        refuse(problems, "/mpm/runout/toe", text(toe) + " lies outside the grid",
               "give a point inside /mpm/domain_x, " + text(mpm.domain_x[0]) + " to " +
                   metres(mpm.domain_x[1]) + ", and /mpm/domain_y, " + text(mpm.domain_y[0]) +
                   " to " + metres(mpm.domain_y[1]));
}

/// Warns of an upstream face that is held in the FEM and free in the MPM: the MPM's wall supports
/// the soil only if it touches it.
void check_upstream_end(const scene::Scene& scene, Problems& problems) {
    if (!scene.fem) return;
    const scene::Mpm& mpm = *scene.mpm;
    const double end = extent(scene.section).low.x();
    const double gap = end - mpm.domain_x[0];
    if (!(gap > mpm.cell_size)) return;
    const double held = mpm.terrain.empty() ? -std::numeric_limits<double>::infinity()
                                            : straight_level_at(mpm.terrain, end - mpm.cell_size);
    double face = 0.0;
    for (const scene::Region& region : scene.section.regions) {
        if (!scene::is_mobile(region, mpm)) continue;
        for (const auto& [a, b] : sides_of(region.polygon)) {
            if (std::max(a.x(), b.x()) > end + 1e-6 * mpm.cell_size) continue;
            face += std::max(std::max(a.y(), b.y()) - std::max(held, std::min(a.y(), b.y())), 0.0);
        }
    }
    if (face <= 2.0 * mpm.cell_size) return;
    warn(problems, "free_upstream_end", "/mpm/domain_x",
         "begins " + metres(gap) + " before the section, whose soil ends at x = " + metres(end) +
             " in a free face of " + metres(face) +
             ": the FEM supports it there, but in the runout it falls upstream, which shortens the "
             "runout; begin the grid there: " +
             words::set("/mpm/domain_x", std::array{end, mpm.domain_x[1]}));
}

/// x of the crest's downstream edge: the last place before the toe that is nearly as high as any
/// [m].
double crest_of(const scene::Scene& scene) {
    const geometry::Box box = extent(scene.section);
    const double near = 0.02 * (box.high.y() - box.low.y());
    const double toe = scene.mpm->runout.toe.x();
    double highest = -std::numeric_limits<double>::infinity(), crest = highest;
    for (const auto& piece : geometry::ground_between(scene.section, box.low.x(), toe))
        for (const Vec2& each : piece) {
            if (each.y() >= highest - near) crest = each.x();
            highest = std::max(highest, each.y());
        }
    return crest;
}

/// A flow section records what leaves the dam: not upstream of its crest.
void check_flow_sections(const scene::Scene& scene, Problems& problems) {
    const scene::Mpm& mpm = *scene.mpm;
    if (mpm.sections.empty()) return;
    const double crest = crest_of(scene);
    for (std::size_t i = 0; i < mpm.sections.size(); ++i) {
        const double x = mpm.sections[i].x;
        if (!(x < crest - mpm.cell_size)) continue;
        warn(problems, "section_upstream", "/mpm/sections/" + std::to_string(i) + "/x",
             "is " + metres(x) + ", upstream of the crest at x = " + metres(crest) + ": \"" +
                 mpm.sections[i].name +
                 "\" records what moves within the pond, not what leaves the dam; for the toe " +
                 words::set("/mpm/sections/" + std::to_string(i) + "/x",
                            std::max(crest, std::min(mpm.runout.toe.x(), mpm.domain_x[1]))));
    }
}

/// Warns of runs that end while soil could only have begun to collapse.
void check_duration(const scene::Scene& scene, Problems& problems) {
    const scene::Mpm& mpm = *scene.mpm;
    const double H = scene::mobile_height(scene, mpm);
    if (!(H > 0.0) || !(scene.gravity > 0.0)) return;
    const double fall = std::sqrt(2.0 * H / scene.gravity);
    const double least = std::ceil(20.0 * fall) / 10.0;  // a granular column collapses in 2 falls
    if (mpm.duration >= least) return;
    warn(problems, "short_runout", mpm.until_rest ? "/mpm/longest_duration" : "/mpm/duration",
         "is " + text(mpm.duration) + " s, and soil needs " + words::text_of(fall, 2) +
             " s to fall " + words::text_of(H, 3) + " m" +
             " freely: the run ends before the soil has collapsed, and its runout is too short; " +
             (mpm.until_rest ? words::set("/mpm/longest_duration", least)
                             : words::set("/mpm/duration", "until_rest")));
}

}  // namespace

void check_ground(const scene::Scene& scene, Problems& problems) {
    check_terrain(scene, problems);
    check_support(scene, problems);
    check_toe(scene, problems);
    check_stiffness(scene, problems);
    check_upstream_end(scene, problems);
    check_flow_sections(scene, problems);
    check_duration(scene, problems);
}

}  // namespace breach::check
