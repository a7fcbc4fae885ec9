// Reads /mpm.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/polyline.hpp"
#include "core/scene/checks.hpp"
#include "core/scene/resolution.hpp"
#include "core/scene/standing_water.hpp"
#include "core/scene/stiffness.hpp"
#include "core/words/number.hpp"

namespace breach::scene {

using nlohmann::json;

namespace {

/// Whether more than a tenth of the terrain is steeper than 30 degrees: debris then falls on other
/// soil. A smaller share is a single step, as at the base of a dam.
bool is_steep(const std::vector<mechanics::Vec2>& terrain) {
    constexpr double tan_30 = 0.5774;
    return geometry::share_steeper_than(tan_30, terrain) > 0.1;
}

/// `from` plus or minus whole cells, at or beyond `to`; `to` itself if it is one of them.
double whole_cells(double from, double to, double h) {
    const double cells = (to - from) / h;
    const double round_off = std::max(1e-6, 1e-9 * std::abs(cells));
    if (std::abs(cells - std::nearbyint(cells)) < round_off) return to;
    return from + std::copysign(std::ceil(std::abs(cells)) * h, cells);
}

/// Lines of the grid count from its left end and from the floor, so the other ends move outwards.
void grow_to_whole_cells(Mpm& mpm) {
    const double right = mpm.domain_x[1], level = mpm.floor.level;
    mpm.domain_x[1] = whole_cells(mpm.domain_x[0], right, mpm.cell_size);
    for (double& end : mpm.domain_y) end = whole_cells(level, end, mpm.cell_size);
    for (FrictionZone& zone : mpm.floor.friction)  // the end's friction reaches the new end
        if (zone.to >= right - 1e-9) zone.to = std::max(zone.to, mpm.domain_x[1]);
}

void check_floor(Reader& reader, const Mpm& mpm) {
    const double level = mpm.floor.level;
    if (level >= mpm.domain_y[0] - 1e-9 && level <= mpm.domain_y[1]) return;
    reader.add("/mpm/floor/level", "is " + words::text_of(level) + " m, outside domain_y",
               "write a level from " + words::text_of(mpm.domain_y[0]) + " to " +
                   words::text_of(mpm.domain_y[1]) + ", or move domain_y");
}

/// Terrain needs a row of nodes below it everywhere: they apply its contact.
void check_terrain(Reader& reader, const Mpm& mpm) {
    const double lowest = mpm.floor.level + mpm.cell_size;
    for (std::size_t i = 0; i < mpm.terrain.size(); ++i) {
        const double y = mpm.terrain[i].y();
        if (y >= lowest - 1e-9 && y < mpm.domain_y[1]) continue;
        reader.add("/mpm/terrain/" + std::to_string(i),
                   "does not lie inside the grid, a cell above /mpm/floor/level",
                   "lower floor/level and domain_y[0], or raise domain_y[1]");
        return;
    }
    const auto not_ahead = [](const Vec2& a, const Vec2& b) { return a.x() >= b.x(); };
    if (mpm.terrain.empty() ||
        std::ranges::adjacent_find(mpm.terrain, not_ahead) != mpm.terrain.end())
        return;                            // reported by the line's reader
    for (const double x : mpm.domain_x) {  // beyond its ends it continues straight
        const double y = geometry::straight_level_at(mpm.terrain, x);
        if (y >= lowest - 1e-9) continue;
        reader.add("/mpm/terrain",
                   "continues straight beyond its ends, and at x = " + words::text_of(x) +
                       " m lies at " + words::text_of(y) +
                       " m, less than a cell above /mpm/floor/level: the flow would run on the "
                       "floor there",
                   "lower floor/level and domain_y[0], or draw the terrain on to the end of "
                   "domain_x");
    }
}

/// Named places (gauges, sections) must be inside the grid, with unique names.
template <class Place>
void check_places(Reader& reader, const Mpm& mpm, const std::vector<Place>& places,
                  const std::string& list, const std::string& kind) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        const std::string pointer = list + "/" + std::to_string(i);
        if (places[i].x < mpm.domain_x[0] || places[i].x > mpm.domain_x[1]) {
            reader.add(pointer + "/x", "lies outside the grid", "give an x inside domain_x");
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (places[j].name != places[i].name) continue;
            reader.add(pointer + "/name", "is given twice", "give every " + kind + " its own name");
        }
    }
}

/// The pool must lie in the grid, over some soil and below the crest.
void check_pool(Reader& reader, const Scene& scene, const Mpm& mpm) {
    if (!mpm.water || mpm.water->line.empty()) return;
    const char* pointer = "/mpm/water/line";
    const double highest = highest_level(*mpm.water, mpm.domain_x[0], mpm.domain_x[1]);
    const bool inside =
        mpm.water->line.size() == 1 || std::ranges::any_of(mpm.water->line, [&](const Vec2& point) {
            return point.x() >= mpm.domain_x[0] && point.x() <= mpm.domain_x[1];
        });
    if (!inside || highest <= mpm.floor.level || highest > mpm.domain_y[1]) {
        reader.add(pointer, "lies outside the grid",
                   "give levels in m, in the section's datum, between /mpm/floor/level and "
                   "/mpm/domain_y");
        return;
    }
    double crest = -std::numeric_limits<double>::infinity(), deepest = crest;
    for (const Region& region : scene.section.regions) {
        if (region.polygon.empty()) continue;
        crest = std::max(crest, geometry::bounding_box(region.polygon).high.y());
        const auto [below, place] =
            geometry::deepest_below(region.polygon, mpm.water->line, geometry::level_at);
        deepest = std::max(deepest, below);
    }
    if (!std::isfinite(crest)) return;
    if (highest >= crest)
        reader.add(pointer,
                   "stands at " + words::text_of(highest) + " m, and the highest ground lies at " +
                       words::text_of(crest) + " m: water over the crest is out of scope",
                   "lower the water below the crest; overtopping asks for a program of erosion");
    else if (deepest <= 0.0)
        reader.add(pointer, "lies below all soil: no point feels its pressure",
                   "raise it to the water level, or leave /mpm/water out");
}

void read_sections(Reader& reader, const json& mpm, Mpm& result) {
    result.arrival_depth = mpm.at("envelope").at("arrival_depth");
    for (const json& section : mpm.at("sections")) {
        result.sections.push_back({section.at("name"), section.at("x")});
    }
    if (!mpm.contains("breach_width")) return;
    const json& width = mpm.at("breach_width");
    if (width.is_number()) {
        result.breach_width = {width, width, width};
        return;
    }
    result.breach_width = {width.at(0), width.at(1), width.at(2)};
    const BreachWidth& b = *result.breach_width;
    if (b.low <= b.best && b.best <= b.high) return;
    reader.add("/mpm/breach_width", "does not ascend",
               "write [low, best, high] with low <= best <= high, or one number");
}

/// Shaking needs the base motion of the scene's FEM. Without a FEM, the input file decides.
void check_shaking(Reader& reader, const Mpm& mpm) {
    const json& document = reader.document();
    if (mpm.shaking == Shaking::off || !document.contains("fem")) return;
    for (const char* part : {"base", "motion", "free_field"}) {
        if (document.at("fem").contains(part)) continue;
        reader.add("/mpm/shaking", std::string("is on, and the FEM has no /fem/") + part,
                   "give /fem/base, /fem/motion and /fem/free_field, or switch it off");
    }
}

bool is_in_grid(const Box& box, const Mpm& mpm) {
    return box.low.x() >= mpm.domain_x[0] - 1e-9 && box.high.x() <= mpm.domain_x[1] + 1e-9 &&
           box.low.y() >= mpm.floor.level - 1e-9 && box.high.y() <= mpm.domain_y[1] + 1e-9;
}

/// The correction that would bring the whole section into the grid; empty: none.
std::string slip_of_drawing(const Section& section, const Mpm& mpm) {
    Polygon all;
    for (const Region& each : section.regions)
        all.insert(all.end(), each.polygon.begin(), each.polygon.end());
    const Box box = geometry::bounding_box(all);
    const auto scaled = [&](double unit) { return Box{unit * box.low, unit * box.high}; };
    if (is_in_grid({Vec2(box.low.y(), box.low.x()), Vec2(box.high.y(), box.high.x())}, mpm))
        return "x and y look swapped: write each vertex as [x, y], x downstream, y upwards";
    if (is_in_grid({Vec2(box.low.x(), -box.high.y()), Vec2(box.high.x(), -box.low.y())}, mpm))
        return "y points upwards: the section looks drawn with depths; write every y with the "
               "other sign";
    if (is_in_grid(scaled(0.3048), mpm))
        return "the section looks drawn in ft: multiply its coordinates by 0.3048, to m";
    if (is_in_grid(scaled(1e-3), mpm))
        return "the section looks drawn in mm: divide its coordinates by 1000, to m";
    return "";
}

void check_mpm(Reader& reader, const Scene& scene, const Mpm& mpm) {
    check_shaking(reader, mpm);
    check_terrain(reader, mpm);
    check_pool(reader, scene, mpm);
    check_places(reader, mpm, mpm.gauges, "/mpm/gauges", "gauge");
    check_places(reader, mpm, mpm.sections, "/mpm/sections", "section");
    check_order(
        reader, mpm.floor.friction,
        [](const FrictionZone& a, const FrictionZone& b) { return a.to <= b.from + 1e-9; },
        "/mpm/floor/friction", "list the zones from left to right without overlap");
    for (std::size_t i = 0; i < mpm.runout.regions.size(); ++i) {
        const auto& regions = scene.section.regions;
        const auto same = [&](const Region& r) { return r.name == mpm.runout.regions[i]; };
        if (std::any_of(regions.begin(), regions.end(), same)) continue;
        reader.add("/mpm/runout/regions/" + std::to_string(i),
                   "names \"" + mpm.runout.regions[i] + "\", which is no region of the section",
                   "use a name from /section/regions");
    }
    for (std::size_t i = 0; i < scene.section.regions.size(); ++i) {
        const Polygon& polygon = scene.section.regions[i].polygon;
        if (polygon.empty() || is_in_grid(geometry::bounding_box(polygon), mpm)) continue;
        const std::string slip = slip_of_drawing(scene.section, mpm);
        reader.add(
            "/section/regions/" + std::to_string(i) + "/polygon",
            "reaches outside the MPM grid or below its floor",
            slip.empty() ? "enlarge /mpm/domain_x, /mpm/domain_y or lower /mpm/floor/level" : slip);
    }
}

double number_or(const json& entry, double automatic) {
    return entry.is_string() ? automatic : entry.get<double>();
}

/// Without gravity a scene has no time scale: uses that of the earth.
double gravity_of(const Reader& reader) {
    constexpr double of_the_earth = 9.81;
    if (!reader.sound("/gravity")) return of_the_earth;
    const double g = reader.document().at("gravity");
    return g > 0.0 ? g : of_the_earth;
}

/// Scaled with T = sqrt(H / g), H the height of the mobile soil. A granular column collapses within
/// 3 T, so a front that is still for 3 T does not pause within the collapse; 5 T allow a slow
/// start. 3 T and H / 400 mean a front slower than sqrt(g H) / 1200 (1.4 cm/s for 30 m).
Rest rest_from(const json& mpm, double H, double g) {
    const double T = std::sqrt(H / g);
    return {.change = number_or(mpm.at("rest_change"), H / 400.0),
            .window = number_or(mpm.at("rest_window"), 3.0 * T),
            .earliest = number_or(mpm.at("rest_earliest"), 5.0 * T),
            .speed = number_or(mpm.at("rest_speed"), std::min(0.05, 0.01 * std::sqrt(g * H))),
            .body_share = mpm.at("rest_body_share"),
            .kinetic_share = mpm.at("rest_kinetic_share"),
            .peak_share = mpm.at("rest_peak_share")};
}

void read_scales(const Reader& reader, const Scene& scene, const json& mpm, Mpm& result) {
    const double g = gravity_of(reader);
    const double W = result.domain_x[1] - result.domain_x[0];
    const double D = std::hypot(W, result.domain_y[1] - result.domain_y[0]);
    result.until_rest = mpm.at("duration").is_string();
    result.duration = result.until_rest
                          ? number_or(mpm.at("longest_duration"), 100.0 * std::sqrt(D / g))
                          : mpm.at("duration").get<double>();
    const double mobile = mobile_height(scene, result);
    const double H = mobile > 0.0 ? mobile : D;
    result.rest = rest_from(mpm, H, g);
    result.blending_rate = number_or(mpm.at("blending_rate"), std::sqrt(g / H));
}

}  // namespace

void read_mpm(Reader& reader, Scene& scene) {
    if (!reader.sound("/mpm")) return;
    const json& mpm = reader.document().at("mpm");
    Mpm result{};
    result.cell_size = mpm.at("cell_size");
    result.allow_coarse_cells = mpm.at("allow_coarse_cells");
    result.domain_x = range_from(mpm.at("domain_x"));
    result.domain_y = range_from(mpm.at("domain_y"));
    check_ascending(reader, result.domain_x, "/mpm/domain_x");
    check_ascending(reader, result.domain_y, "/mpm/domain_y");
    result.left = word_at<Wall>(mpm, "left");
    result.right = word_at<Wall>(mpm, "right");
    result.floor.level = mpm.at("floor").at("level");
    for (const json& zone : mpm.at("floor").at("friction")) {
        result.floor.friction.push_back({zone.at("from"), zone.at("to"), zone.at("coefficient")});
        if (zone.at("from") < zone.at("to")) continue;
        reader.add("/mpm/floor/friction/" + std::to_string(result.floor.friction.size() - 1),
                   "ends before it begins", "give from < to");
    }
    check_floor(reader, result);
    grow_to_whole_cells(result);
    if (mpm.contains("terrain")) {
        result.terrain = line_from(reader, mpm.at("terrain"), "/mpm/terrain");
    }
    if (mpm.contains("water"))
        result.water = {line_from(reader, mpm.at("water").at("line"), "/mpm/water/line"),
                        mpm.at("water").at("density")};
    result.gimp_half_size = mpm.at("gimp_half_size");
    result.tension_share = mpm.at("tension_share");
    result.damping_ratio = mpm.at("damping_ratio");
    result.anti_locking = word_at<AntiLocking>(mpm, "anti_locking");
    result.gap_closure = mpm.at("gap_closure");
    result.gap_room =
        mpm.contains("gap_room") ? mpm.at("gap_room").get<bool>() : is_steep(result.terrain);
    result.overlap_correction = {mpm.at("overlap_correction").at("rate"),
                                 mpm.at("overlap_correction").at("tolerance")};
    if (mpm.contains("softening_length")) {
        result.softening_length = mpm.at("softening_length").get<double>();
    }
    result.stiffness_scale = number_or(mpm.at("stiffness_scale"), 1.0);
    if (mpm.contains("time_step")) result.time_step = mpm.at("time_step").get<double>();
    result.cfl = mpm.at("cfl");
    result.runout.toe = point_from(mpm.at("runout").at("toe"));
    result.runout.regions = mpm.at("runout").at("regions").get<std::vector<std::string>>();
    result.runout.front_depth = mpm.at("runout").at("front_depth");
    read_scales(reader, scene, mpm, result);
    for (const json& gauge : mpm.at("gauges")) {
        result.gauges.push_back({gauge.at("name"), gauge.at("x"), gauge.at("arrival_depth")});
    }
    read_sections(reader, mpm, result);
    result.snapshot_interval = mpm.at("snapshot_interval");
    for (const json& field : mpm.at("output").at("fields")) {
        result.output.fields.push_back(
            words::named<PointField>(field.get_ref<const std::string&>()));
    }
    result.telemetry_interval = mpm.at("telemetry_interval");
    result.checkpoint_interval = mpm.at("checkpoint_interval");
    result.largest_energy_gain = mpm.at("largest_energy_gain");
    result.fill_points = mpm.at("fill_points");
    result.fill_shift = range_from(mpm.at("fill_shift"));
    result.fill_stress = word_at<FillStress>(mpm, "fill_stress");
    result.shaking = word_at<Shaking>(mpm, "shaking");
    if (mpm.at("stiffness_scale").is_string())
        result.wave_speed_limit = wave_speed_limit(scene, result);
    check_mpm(reader, scene, result);
    scene.mpm = std::move(result);
}

}  // namespace breach::scene
