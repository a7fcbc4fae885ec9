#include "core/scene/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/geometry/polyline.hpp"
#include "core/scene/resolution.hpp"
#include "core/scene/slips.hpp"

namespace breach::scene {

namespace {

constexpr const char* code = "implausible";
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string metres(double value) { return plain_number(value) + " m"; }
std::string seconds(double value) { return plain_number(value) + " s"; }
/// Two digits.
double rounded_up(double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return unit * std::ceil(value / unit);
}

struct Warner {
    Reader& reader;
    Scene& scene;
    Box extent;  ///< of all regions

    double height() const { return extent.high.y() - extent.low.y(); }
    double width() const { return extent.high.x() - extent.low.x(); }
    /// One flag per entry: a second warning is appended as a sentence.
    void warn(const std::string& pointer, const std::string& message) {
        const auto said = std::ranges::find(scene.warnings, pointer, &fault::Flag::pointer);
        if (said != scene.warnings.end() && said->code == code) {
            said->message += "; " + message;
        } else {
            scene.warnings.push_back({code, fault::Severity::warning, message, pointer});
        }
    }
};

/// The highest dams have 300 m, the highest mountains 9 km; sections have a few kilometres.
void warn_about_section(Warner& d) {
    constexpr double least = 0.1, high = 1500.0, most = 9000.0, longest = 50000.0;
    const char* pointer = "/section/regions";
    const std::string size = metres(d.height()) + " high and " + metres(d.width()) + " long";
    const double larger = std::max(d.height() / most, d.width() / (20.0 * longest));
    if (larger > 1.0) {
        d.reader.add(pointer, "make a section " + size,
                     "give vertices in m; these look like mm: divide by 1000");
    } else if (d.height() > high || d.width() > longest) {
        d.warn(pointer,
               "the section is " + size + ": vertices are in m, these look like cm, mm or feet");
    } else if (d.height() < least) {
        d.warn(pointer, "the section is " + size + ": vertices are in m, these look like km");
    }
}

/// Free water is level. A sloping line above the ground loads the face with water that does not
/// exist, which hides the uplift inside.
void warn_about_slope_of_free_water(Warner& d, const std::vector<Vec2>& line,
                                    const std::string& pointer) {
    std::vector<double> places;
    for (const Vec2& point : line) places.push_back(point.x());
    for (const Region& region : d.scene.section.regions)
        for (const Vec2& corner : region.polygon) places.push_back(corner.x());
    std::erase_if(places, [&](double x) { return x < d.extent.low.x() || x > d.extent.high.x(); });
    std::ranges::sort(places);
    double most = 0.05 * d.height(), where = -infinity;
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
        const double left = geometry::level_at(line, places[i]);
        const double right = geometry::level_at(line, places[i + 1]);
        if (std::abs(right - left) <= 0.01 * (places[i + 1] - places[i])) continue;
        const double x = 0.5 * (places[i] + places[i + 1]);
        const double above = 0.5 * (left + right) - geometry::ground_at(d.scene.section, x);
        if (above > most && std::isfinite(above)) most = above, where = x;
    }
    if (where == -infinity) return;
    d.warn(pointer, "the water stands " + metres(most) +
                        " above the ground at x = " + metres(where) +
                        " and slopes there, as no free water does: it presses on the ground "
                        "there; let the line end on the ground, or run along it");
}

/// Warns of water above the highest ground, which drowns the whole section: possible for a lake
/// bed, if the water is level.
void warn_about_water(Warner& d, const std::vector<Vec2>& line, const std::string& pointer) {
    if (line.empty() || !d.reader.sound(pointer)) return;
    const double left = d.extent.low.x(), right = d.extent.high.x();
    auto [lowest, highest] =
        std::minmax({geometry::level_at(line, left), geometry::level_at(line, right)});
    for (const Vec2& point : line) {
        if (point.x() < left || point.x() > right) continue;
        lowest = std::min(lowest, point.y());
        highest = std::max(highest, point.y());
    }
    const double ground = d.extent.high.y();
    const double above = highest - ground;
    if (above <= 1e-6 * d.height()) {
        warn_about_slope_of_free_water(d, line, pointer);
        return;
    }
    const std::string what =
        "stands " + metres(above) + " above the section's highest ground (" + metres(ground) + ")";
    const bool slopes = highest - lowest > 0.01 * d.height();
    if (above > d.height() && slopes) {
        d.reader.add(pointer, what + " and slopes there, as no free water does",
                     "give levels in m and in the section's own datum");
    } else {
        const std::string drowned =
            lowest > ground ? ": the whole section is drowned" : ": the highest ground is drowned";
        d.warn(pointer,
               "the water " + what + drowned + "; levels are in m and in the section's own datum");
    }
}

/// Largest distance of two water tables within the section, and its x [m].
std::pair<double, double> farthest_apart(const Warner& d, const std::vector<Vec2>& a,
                                         const std::vector<Vec2>& b) {
    std::pair<double, double> farthest{0.0, d.extent.low.x()};
    const auto compare = [&](double x) {
        if (x < d.extent.low.x() || x > d.extent.high.x()) return;
        const double here = std::abs(geometry::level_at(a, x) - geometry::level_at(b, x));
        if (here > farthest.first) farthest = {here, x};
    };
    for (const double x : {d.extent.low.x(), d.extent.high.x()}) compare(x);
    for (const auto* line : {&a, &b})
        for (const Vec2& point : *line) compare(point.x());
    return farthest;
}

/// Compares the water table of three phases; any stage of the FEM may match.
void warn_about_tables(Warner& d) {
    struct Table {
        std::string pointer;
        std::vector<const std::vector<Vec2>*> lines;
    };
    std::vector<Table> tables;
    if (d.scene.fem && d.scene.fem->water) {
        tables.push_back({"/fem/water/line", {&d.scene.fem->water->line}});
        for (const Stage& stage : d.scene.fem->stages)
            if (stage.phreatic_line) tables[0].lines.push_back(&*stage.phreatic_line);
    }
    if (d.scene.lem && d.scene.lem->water)
        tables.push_back({"/lem/water/line", {&d.scene.lem->water->line}});
    if (d.scene.transfer && !d.scene.transfer->phreatic_line.empty())
        tables.push_back({"/transfer/phreatic_line", {&d.scene.transfer->phreatic_line}});
    if (d.scene.mpm && d.scene.mpm->water)
        tables.push_back({"/mpm/water/line", {&d.scene.mpm->water->line}});
    for (const Table& table : tables) {
        if (!d.reader.sound(table.pointer)) return;
    }
    constexpr double much = 0.05;  // of the section's height
    for (std::size_t i = 1; i < tables.size(); ++i) {
        std::pair<double, double> nearest{std::numeric_limits<double>::infinity(), 0.0};
        for (const auto* line : tables[0].lines)
            nearest = std::min(nearest, farthest_apart(d, *line, *tables[i].lines[0]));
        const auto [apart, place] = nearest;
        if (apart <= much * d.height()) continue;
        d.warn(tables[i].pointer, "this water table lies " + metres(apart) + " from that of " +
                                      tables[0].pointer + " at x = " + metres(place) +
                                      ": is one of them out of date?");
    }
}

/// The intended time step, if it looks like milliseconds.
std::string meant_step(double step, double duration) {
    const double meant = 1e-3 * step;
    if (meant > 0.05 || meant > 0.1 * duration) return "give a step well below it";
    return plain_number(step) + " looks like ms: write " + seconds(meant);
}

/// T = 4 H / V_s with the section's height H and V_s of its softest soil; 0 without soil.
double natural_period(const Warner& d) {
    double slowest = infinity;
    for (const Region& region : d.scene.section.regions) {
        if (region.material >= d.scene.materials.size()) continue;
        const Material& soil = d.scene.materials[region.material];
        const double G = materials::elasticity(soil.law).shear_modulus();
        slowest = std::min(slowest, std::sqrt(G / soil.density));
    }
    return d.height() > 0.0 && std::isfinite(slowest) ? 4.0 * d.height() / slowest : 0.0;
}

void warn_about_steps(Warner& d) {
    const Fem& fem = *d.scene.fem;
    constexpr double hopeless = 0.5;  // [s]: the shortest relevant periods are 0.1 s
    const double period = natural_period(d);
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        const Stage& stage = fem.stages[i];
        if (stage.kind != StageKind::dynamic) continue;
        const std::string pointer = "/fem/stages/" + std::to_string(i) + "/time_step";
        if (stage.time_step > stage.duration * (1.0 + 1e-9)) {
            d.reader.add(pointer,
                         "is " + seconds(stage.time_step) + ", longer than the stage's " +
                             seconds(stage.duration),
                         meant_step(stage.time_step, stage.duration));
        } else if (fem.motion && stage.time_step > hopeless) {
            d.reader.add(
                pointer,
                "is " + seconds(stage.time_step) + ", longer than the periods of an earthquake",
                meant_step(stage.time_step, stage.duration));
        } else if (stage.time_step > 0.25 * period && period > 0.0) {
            d.warn(pointer, "four steps of " + seconds(stage.time_step) +
                                " are longer than the section's natural period of about " +
                                seconds(period));
        }
    }
}

/// Warns of dynamic stages that end before a shear wave has crossed the section.
void warn_about_brief_stages(Warner& d) {
    const Fem& fem = *d.scene.fem;
    const double crossing = 0.25 * natural_period(d);
    double sum = 0.0;
    std::size_t last = fem.stages.size();
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        if (fem.stages[i].kind != StageKind::dynamic) continue;
        sum += fem.stages[i].duration;
        last = i;
    }
    if (last == fem.stages.size() || sum >= crossing) return;
    d.warn("/fem/stages/" + std::to_string(last) + "/duration",
           "the dynamic stages last " + seconds(sum) + ", and a shear wave needs " +
               seconds(rounded_up(crossing)) +
               " to cross the section: nothing can fail before; write \"duration\": " +
               plain_number(rounded_up(4.0 * crossing)) + " or more");
}

/// Warns of more elements or cells than memory holds, or larger than what they divide.
void warn_about_size(Warner& d, double size, double area, const std::string& pointer,
                     const char* what) {
    constexpr double many = 3e6, most = 3e8;
    const double count = area / (size * size);
    const std::string cause = "make " + plain_number(std::round(count)) + " " + what;
    if (count > most) {
        d.reader.add(pointer, cause, "is " + metres(size) + " meant? sizes are in m");
    } else if (count > many) {
        d.warn(pointer, metres(size) + " " + cause + ": sizes are in m");
    } else if (size > std::max(d.height(), d.width())) {
        d.reader.add(pointer, "is " + metres(size) + ", more than the whole section",
                     "sizes are in m: " + metres(1e-3 * size) + " when mm are meant");
    }
}

void warn_about_sizes(Warner& d) {
    if (d.scene.fem && !d.scene.fem->mesh.msh_file) {
        for (std::size_t i = 0; i < d.scene.section.regions.size(); ++i) {
            const Region& region = d.scene.section.regions[i];
            if (region.polygon.empty() || region.element_size <= 0.0) continue;
            const std::string own = "/section/regions/" + std::to_string(i) + "/mesh/element_size";
            const bool has_own = d.reader.document().contains(nlohmann::json::json_pointer(own));
            warn_about_size(d, region.element_size, geometry::area(region.polygon),
                            has_own ? own : "/section/element_size", "elements");
        }
    }
    if (!d.scene.mpm) return;
    const Mpm& mpm = *d.scene.mpm;
    warn_about_size(d, mpm.cell_size,
                    (mpm.domain_x[1] - mpm.domain_x[0]) * (mpm.domain_y[1] - mpm.domain_y[0]),
                    "/mpm/cell_size", "cells");
    if (mpm.time_step && *mpm.time_step > mpm.duration) {
        d.reader.add("/mpm/time_step",
                     "is " + seconds(*mpm.time_step) + ", longer than the duration of " +
                         seconds(mpm.duration),
                     meant_step(*mpm.time_step, mpm.duration));
    }
}

/// Area of the polygon with x above the given one [m2].
double area_beyond(const Polygon& polygon, double x) {
    const Box box = geometry::bounding_box(polygon);
    if (x <= box.low.x()) return geometry::area(polygon);
    if (x >= box.high.x()) return 0.0;
    const double below = box.low.y() - 1.0, above = box.high.y() + 1.0;
    const Polygon beyond{
        {x, below}, {box.high.x() + 1.0, below}, {box.high.x() + 1.0, above}, {x, above}};
    return geometry::overlap_area(polygon, beyond);
}

/// Farthest x of soil above a level; -infinity: there is none [m].
double foot_above(const Scene& scene, double level) {
    double foot = -infinity;
    for (const Region& region : scene.section.regions) {
        for (const auto& [a, b] : geometry::sides_of(region.polygon)) {
            if (a.y() > level) foot = std::max(foot, a.x());
            if ((a.y() > level) == (b.y() > level)) continue;
            const double share = (level - a.y()) / (b.y() - a.y());
            foot = std::max(foot, a.x() + share * (b.x() - a.x()));
        }
    }
    return foot;
}

/// Runout is measured downstream (+x) from the toe: soil beyond it at the start counts as runout.
void warn_about_toe(Warner& d) {
    constexpr double some = 0.02,
                     most = 0.5;  // of the mobile soil; the runout is that of 1 %
    const Runout& runout = d.scene.mpm->runout;
    double all = 0.0, beyond = 0.0, end = -infinity;
    for (const Region& region : d.scene.section.regions) {
        if (!is_mobile(region, *d.scene.mpm) || region.polygon.empty()) continue;
        end = std::max(end, geometry::bounding_box(region.polygon).high.x());
        all += geometry::area(region.polygon);
        beyond += area_beyond(region.polygon, runout.toe.x());
    }
    if (!(all > 0.0)) return;
    const char* pointer = "/mpm/runout/toe";
    const std::string share =
        plain_number(std::round(100.0 * beyond / all)) +
        " % of the soil that counts lie beyond the toe (x = " + metres(runout.toe.x()) +
        ") before anything has moved";
    if (beyond > most * all) {
        d.reader.add(pointer, "lies upstream: " + share,
                     "x points downstream: give the foot of the downstream face, near x = " +
                         plain_number(end) + "; turn a slope that faces -x by breach mirror");
    } else if (beyond > some * all) {
        d.warn(pointer,
               share + ": they are part of every runout; x points downstream, and " +
                   (runout.regions.empty() ? "/mpm/runout/regions should name the soil that moves"
                                           : "the soil ends at x = " + metres(end)));
    } else if (const double foot = foot_above(d.scene, runout.toe.y() + 0.05 * d.height());
               runout.toe.x() - foot > std::max(d.height(), 2.0 * d.scene.mpm->cell_size)) {
        d.warn(pointer, "the ground rises only " + metres(runout.toe.x() - foot) +
                            " before the toe (x = " + metres(runout.toe.x()) +
                            "), at x = " + metres(foot) +
                            ": runout is counted from the toe, and is shorter by that");
    }
}

/// Between and beside zones of friction the floor is smooth: probably unintended.
void warn_about_floor(Warner& d) {
    const Mpm& mpm = *d.scene.mpm;
    const char* pointer = "/mpm/floor/friction";
    if (mpm.floor.friction.empty() || !d.reader.sound(pointer)) return;
    double covered = mpm.domain_x[0];
    const auto leave_out = [&](double until) {
        if (until - covered <= mpm.cell_size) return;
        d.warn(pointer, "no zone covers x = " + plain_number(covered) + " to " + metres(until) +
                            ": the floor and the terrain are smooth there; give a zone, of "
                            "coefficient 0 if that is meant");
    };
    for (const FrictionZone& zone : mpm.floor.friction) {
        leave_out(zone.from);
        covered = std::max(covered, zone.to);
    }
    leave_out(mpm.domain_x[1]);
}

}  // namespace

void warn_about_together(Reader& reader, Scene& scene) {
    Warner d{reader, scene, geometry::extent(scene.section)};
    if (reader.sound("/gravity") && reader.document().at("gravity") == 0.0) {
        d.warn("/gravity", "gravity is zero: no soil has weight, nothing fails or runs out");
    }
    if (scene.fem) warn_about_steps(d);
    if (scene.fem) warn_about_brief_stages(d);
    if (d.height() > 0.0) {  // some region is valid
        warn_about_section(d);
        if (scene.lem && scene.lem->water) {
            warn_about_water(d, scene.lem->water->line, "/lem/water/line");
        }
        if (scene.fem && scene.fem->water) {
            warn_about_water(d, scene.fem->water->line, "/fem/water/line");
        }
        if (scene.mpm && scene.mpm->water) {
            warn_about_water(d, scene.mpm->water->line, "/mpm/water/line");
        }
        if (scene.transfer) {
            warn_about_water(d, scene.transfer->phreatic_line, "/transfer/phreatic_line");
        }
        warn_about_tables(d);
        warn_about_sizes(d);
        if (scene.mpm) warn_about_toe(d);
        if (scene.mpm) warn_about_floor(d);
    }
    for (const fault::Flag& warn : scene.warnings) reader.explain(warn);
}

}  // namespace breach::scene
