#include "core/scene/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>
#include <string_view>
#include <tuple>
#include <variant>

#include "core/scene/beds.hpp"
#include "core/words/number.hpp"

namespace breach::scene {

namespace {

std::string text_of(double value) { return words::text_of(value, 3); }

/// A number below a limit must not be rounded up to it.
std::string rounded_down(double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return text_of(std::floor(value / unit) * unit);
}

// ---------------------------------------------------------------- thickness

struct Segment {
    Vec2 from;
    Vec2 to;
};

struct Disc {
    Vec2 center;
    double radius;
};

/// Polygons that touch, as one shape: what two of them share is inside.
struct Shape {
    std::vector<Polygon> parts;
    std::vector<Segment> border;
};

bool lies_on(const Vec2& point, const Polygon& polygon, double tolerance) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        if (geometry::distance_to_segment(point, polygon[i], polygon[(i + 1) % polygon.size()]) <
            tolerance)
            return true;
    }
    return false;
}

/// An edge cut where a vertex of another polygon lies on it.
std::vector<Segment> pieces_of(const Segment& edge, const std::vector<Polygon>& others,
                               double tolerance) {
    std::vector<Vec2> cuts{edge.from, edge.to};
    for (const Polygon& other : others) {
        for (const Vec2& vertex : other) {
            if (geometry::distance_to_segment(vertex, edge.from, edge.to) < tolerance)
                cuts.push_back(vertex);
        }
    }
    std::ranges::sort(cuts, {}, [&](const Vec2& cut) { return (cut - edge.from).norm(); });
    std::vector<Segment> pieces;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if ((cuts[i] - cuts[i - 1]).norm() > tolerance) pieces.push_back({cuts[i - 1], cuts[i]});
    }
    return pieces;
}

/// The pieces of a polygon's edges that lie on another's border, or those that do not.
enum class Sides { shared, own };
std::vector<Segment> sides_of(const Polygon& polygon, const std::vector<Polygon>& others,
                              Sides wanted) {
    const Box box = geometry::bounding_box(polygon);
    const double tolerance = 1e-6 * (box.high - box.low).norm();
    std::vector<Segment> found;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Segment edge{polygon[i], polygon[(i + 1) % polygon.size()]};
        for (const Segment& piece : pieces_of(edge, others, tolerance)) {
            const Vec2 middle = 0.5 * (piece.from + piece.to);
            const bool shared = std::ranges::any_of(
                others, [&](const Polygon& other) { return lies_on(middle, other, tolerance); });
            if (shared == (wanted == Sides::shared)) found.push_back(piece);
        }
    }
    return found;
}

Shape shape_of(const std::vector<Polygon>& parts) {
    Shape shape{parts, {}};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        std::vector<Polygon> others = parts;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        std::ranges::move(sides_of(parts[i], others, Sides::own), std::back_inserter(shape.border));
    }
    return shape;
}

double distance_to_border(const Shape& shape, const Vec2& point) {
    double least = std::numeric_limits<double>::max();
    for (const Segment& side : shape.border)
        least = std::min(least, geometry::distance_to_segment(point, side.from, side.to));
    return least;
}

double perimeter(const Polygon& polygon) {
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
    return sum;
}

bool holds(const Shape& shape, const Vec2& point) {
    return std::ranges::any_of(
        shape.parts, [&](const Polygon& part) { return geometry::contains(part, point); });
}

constexpr double places_wanted = 250.0;

double spacing_of(const Polygon& polygon) {
    return std::sqrt(geometry::area(polygon) / places_wanted);
}

/// Places inside on a lattice, a few hundred.
std::vector<Vec2> places_inside(const Polygon& polygon) {
    const Box box = geometry::bounding_box(polygon);
    const Vec2 extent = box.high - box.low;
    const auto lines = [&](double length) {
        const double wanted = std::ceil(length / spacing_of(polygon));
        return static_cast<int>(std::clamp(wanted, 4.0, places_wanted));
    };
    const int columns = lines(extent.x());
    const int rows = lines(extent.y());
    std::vector<Vec2> places;
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            const Vec2 share{(i + 0.5) / columns, (j + 0.5) / rows};
            const Vec2 place = box.low + extent.cwiseProduct(share);
            if (geometry::contains(polygon, place)) places.push_back(place);
        }
    }
    return places;
}

/// Middle of the shortest way across the shape through a place: near its medial axis, where the
/// largest discs have their centres.
Vec2 middle_of_shortest_chord(const Shape& shape, const Vec2& place) {
    constexpr int directions = 16;
    double shortest = std::numeric_limits<double>::max();
    Vec2 middle = place;
    for (int k = 0; k < directions; ++k) {
        const double angle = std::numbers::pi * k / directions;
        const Vec2 along{std::cos(angle), std::sin(angle)};
        const Vec2 normal{-along.y(), along.x()};
        double ahead = std::numeric_limits<double>::max();
        double behind = ahead;
        for (const Segment& side : shape.border) {
            const Vec2 a = side.from - place;
            const Vec2 b = side.to - place;
            const double from = normal.dot(a);
            const double to = normal.dot(b);
            if ((from > 0.0) == (to > 0.0)) continue;
            const double s = along.dot(a) + along.dot(b - a) * from / (from - to);
            if (s >= 0.0) ahead = std::min(ahead, s);
            if (s <= 0.0) behind = std::min(behind, -s);
        }
        if (ahead + behind >= shortest) continue;
        shortest = ahead + behind;
        middle = place + 0.5 * (ahead - behind) * along;
    }
    return middle;
}

/// The largest disc near a place inside: uphill, in steps that are halved down to a share of it.
Disc largest_disc_near(const Shape& shape, const Vec2& place) {
    Disc disc{place, distance_to_border(shape, place)};
    for (double step = 0.5 * disc.radius; step > 0.03 * disc.radius; step *= 0.5) {
        for (bool climbs = true; climbs;) {
            climbs = false;
            for (const Vec2& way : {Vec2{step, 0}, Vec2{-step, 0}, Vec2{0, step}, Vec2{0, -step}}) {
                const Vec2 center = disc.center + way;
                if (!holds(shape, center)) continue;
                const double radius = distance_to_border(shape, center);
                if (radius < 1.02 * disc.radius) continue;
                disc = {center, radius};
                climbs = true;
            }
        }
    }
    return disc;
}

// ---------------------------------------------------------------- what has to be resolved

bool is_mobile(const Region& region, const Mpm& mpm) {
    const auto& names = mpm.runout.regions;
    return names.empty() || std::ranges::find(names, region.name) != names.end();
}

bool as_strong(const Material& a, const Material& b) {
    if (&a == &b) return true;
    const std::string_view type = materials::traits(a.law).type;
    if (type != materials::traits(b.law).type || !materials::traits(a.law).c_and_phi) return false;
    const auto one = materials::limit_strength(a.law);
    const auto other = materials::limit_strength(b.law);
    if (one->c != other->c || one->tan_phi != other->tan_phi) return false;
    const materials::Softening* here = materials::softening(a.law);
    const materials::Softening* there = materials::softening(b.law);
    if (!here || !there) return here == there;
    const auto numbers = [](const materials::Softening& s) {
        return std::tuple{s.epsilon_q_start, s.epsilon_q_end, s.c_residual, s.tan_phi_residual,
                          s.driver};
    };
    return numbers(*here) == numbers(*there);
}

bool touch(const Polygon& a, const Polygon& b) { return !sides_of(a, {b}, Sides::shared).empty(); }

/// Mobile regions as strong as this one that it touches, directly or through others: wet and dry
/// soil of a dam. Their borders stop no band of shear.
std::vector<Polygon> attached_to(const Region& region, const Scene& scene) {
    std::vector<const Region*> mass{&region};
    for (std::size_t done = 0; done < mass.size(); ++done) {
        for (const Region& other : scene.section.regions) {
            if (other.polygon.empty() || !is_mobile(other, *scene.mpm)) continue;
            if (std::ranges::find(mass, &other) != mass.end()) continue;
            if (!as_strong(scene.materials.at(region.material), scene.materials.at(other.material)))
                continue;
            if (touch(mass[done]->polygon, other.polygon)) mass.push_back(&other);
        }
    }
    std::vector<Polygon> attached;
    for (std::size_t i = 1; i < mass.size(); ++i) attached.push_back(mass[i]->polygon);
    return attached;
}

/// Elements across a block: as many as its divisions say; sizes are always met by two or more.
double elements_across(const Region& region, double thickness) {
    const auto [along, up] = region.divisions;
    if (region.mesh == RegionMesh::block && along > 0) return std::min(along, up);
    if (region.mesh == RegionMesh::block) return std::max(2.0, thickness / region.element_size);
    return thickness / region.element_size;
}

void judge_cells(const Scene& scene, Resolved& resolved) {
    const std::vector<Across> all = cells_across(scene);
    const auto coarsest = std::ranges::min_element(all, {}, &Across::number);
    if (coarsest == all.end() || coarsest->number >= cells_wanted) return;
    const double h = scene.mpm->cell_size;
    const std::string found = text_of(coarsest->number) + " cells of " + text_of(h) + " m across " +
                              coarsest->what + ", " + text_of(coarsest->length) + " m";
    const std::string fine = rounded_down(coarsest->length / cells_wanted) + " m";
    const bool refused = coarsest->number < least_cells;
    if (refused && !scene.mpm->allow_coarse_cells) {
        resolved.faults.push_back(
            {"/mpm/cell_size", "gives " + found + ": it could not shear within itself",
             "take cells of at most " + rounded_down(coarsest->length / least_cells) + " m (" +
                 fine + " for " + text_of(cells_wanted) +
                 " across it), or for a quick look set /mpm/allow_coarse_cells to true: the result "
                 "is then questionable"});
        return;
    }
    resolved.flags.push_back(
        {"coarse_cells", refused ? fault::Severity::questionable : fault::Severity::warning,
         "only " + found + " (" + text_of(cells_wanted) +
             " are wanted): coarse cells shorten the runout; compare with cells of " + fine +
             " before relying on it",
         "/mpm/cell_size"});
}

void judge_length(const Material& soil, const Mpm& mpm, Resolved& resolved) {
    const std::string pointer = "/materials/" + soil.name + "/nonlocal_length";
    if (!materials::softening(soil.law)) {
        resolved.faults.push_back({pointer, "belongs to a law that does not soften",
                                   "give " + std::string("/materials/").append(soil.name) +
                                       "/law/softening, or leave the length out"});
        return;
    }
    if (!mpm.softening_length) {
        resolved.faults.push_back(
            {pointer, "needs to know for which band the softening strains hold",
             "give /mpm/softening_length, the cell size that they were found with"});
    }
    const double cells = *soil.nonlocal_length / mpm.cell_size;
    if (cells >= nonlocal_cells_wanted) return;
    const std::string found = "is " + text_of(cells) + " cells of " + text_of(mpm.cell_size) + " m";
    const std::string wanted = "take cells of at most " +
                               rounded_down(*soil.nonlocal_length / nonlocal_cells_wanted) +
                               " m or a longer length";
    if (cells < least_nonlocal_cells) {
        resolved.faults.push_back(
            {pointer, found + ": an average over so few nodes leaves the band to the lattice",
             wanted});
    } else {
        resolved.flags.push_back({"short_nonlocal_length", fault::Severity::warning,
                                  found + " (" + text_of(nonlocal_cells_wanted) +
                                      " are wanted): bands hang on the lattice; " + wanted,
                                  pointer});
    }
}

void judge_band(const Material& soil, const Region& region, Resolved& resolved) {
    const double band = band_in_nonlocal_lengths * *soil.nonlocal_length;
    const double thickness = thickness_of(region.polygon);
    if (band <= widest_band_share * thickness) return;
    resolved.flags.push_back({"wide_band", fault::Severity::warning,
                              "bands of shear are " + text_of(band) + " m wide in region \"" +
                                  region.name + "\" of " + text_of(thickness) +
                                  " m: it cannot break into blocks; a shorter nonlocal_length "
                                  "needs smaller cells",
                              "/materials/" + soil.name + "/nonlocal_length"});
}

void judge_bands(const Scene& scene, Resolved& resolved) {
    const std::vector<Soil> soils = soils_of(scene);
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const Material& soil = scene.materials[m];
        if (!soil.nonlocal_length) continue;
        judge_length(soil, *scene.mpm, resolved);
        if (std::ranges::find(soils, m, &Soil::material) != soils.end()) continue;
        resolved.faults.push_back(
            {"/materials/" + soil.name + "/nonlocal_length",
             "averages over a group without points: no region is or becomes \"" + soil.name + "\"",
             "give a region this material (/section/regions, /transfer/mapping or "
             "/transfer/liquefied/layers), or leave the length out"});
    }
    for (const Soil& each : soils) {
        const Material& soil = scene.materials[each.material];
        const Region& region = scene.section.regions[each.region];
        if (soil.nonlocal_length && !region.polygon.empty()) judge_band(soil, region, resolved);
    }
}

/// Cells that divide the height up to a bed: just below the scene's own size, and just above it.
std::string cells_dividing(const Mpm& mpm, double height) {
    const double rows = height / mpm.cell_size;
    std::string sizes = words::text_of(height / std::ceil(rows)) + " m";
    if (rows > 1.0) sizes += " or " + words::text_of(height / std::floor(rows)) + " m";
    return sizes;
}

/// A floor below terrain carries nothing: it may lie lower, with lines of the grid through a level.
std::string floor_with_a_line_at(const Mpm& mpm, double level) {
    const double h = mpm.cell_size;
    const double floor = level - h * std::ceil(cells_up_to(mpm, level));
    const double low = floor - (mpm.floor.level - mpm.domain_y[0]);
    const double high = low + (mpm.domain_y[1] - mpm.domain_y[0]) + h;
    return "set /mpm/floor/level to " + words::text_of(floor, 9) + " and /mpm/domain_y to [" +
           words::text_of(low, 9) + ", " + words::text_of(high, 9) +
           "], which moves a line of the grid there (the terrain carries the soil, not the floor)";
}

struct CutBed {
    std::string how;
    std::string remedy;
};

/// How a bed shares cells with what lies on it; nothing where its points' domains end at its top.
std::optional<CutBed> cut_of(const Scene& scene, const Bed& bed) {
    const Mpm& mpm = *scene.mpm;
    if (!bed.level)
        return CutBed{
            "slopes through the cells",
            "where it is to stay as it is, leave it out and give its top as /mpm/terrain"};
    if (rows_below_bed(scene, bed.material)) return std::nullopt;
    const double rows = cells_up_to(mpm, *bed.level);
    const std::string at = "lies at " + text_of(*bed.level) + " m, ";
    if (line_at(mpm, *bed.level))
        return CutBed{at + "but soil of the same material lies above it",
                      "give it a material of its own"};
    const std::string how =
        at + text_of(rows - std::floor(rows)) + " of a cell above a line of the grid";
    if (!mpm.terrain.empty()) return CutBed{how, floor_with_a_line_at(mpm, *bed.level)};
    return CutBed{how,
                  "take cells that divide the " + text_of(*bed.level - mpm.floor.level) +
                      " m from the floor up to it (" +
                      cells_dividing(mpm, *bed.level - mpm.floor.level) +
                      "; the domain's lengths are to be whole numbers of them), or move the floor "
                      "and the domain"};
}

/// Soil that is to move on firm soil that is not.
void judge_beds(const Scene& scene, Resolved& resolved) {
    for (const Bed& bed : beds_of(scene)) {
        const Region& below = scene.section.regions[bed.region];
        const Region& above = scene.section.regions[bed.above];
        if (is_mobile(below, *scene.mpm) || !is_mobile(above, *scene.mpm)) continue;
        const auto cut = cut_of(scene, bed);
        if (!cut) continue;
        resolved.flags.push_back({"shared_cells", fault::Severity::warning,
                                  "the top of firm region \"" + below.name + "\" " + cut->how +
                                      ": in the cells that it shares with \"" + above.name +
                                      "\" it holds what slides on it, and the runout is too short "
                                      "(10 to 30 % were seen); " +
                                      cut->remedy,
                                  "/mpm/cell_size"});
    }
}

double measured_thickness(const Polygon& polygon, const std::vector<Polygon>& parts) {
    const Shape shape = shape_of(parts);
    const std::vector<Vec2> places = places_inside(polygon);
    std::vector<Disc> discs;
    for (const Vec2& place : places) {
        discs.push_back(largest_disc_near(shape, middle_of_shortest_chord(shape, place)));
    }
    std::vector<double> thickness;
    for (const Vec2& place : places) {
        double radius = distance_to_border(shape, place);
        for (const Disc& disc : discs) {
            if (disc.radius > radius && (disc.center - place).norm() <= disc.radius)
                radius = disc.radius;
        }
        thickness.push_back(2.0 * radius);
    }
    // A hair's breadth, which no place of the lattice has met.
    if (thickness.empty()) return 2.0 * geometry::area(polygon) / perimeter(polygon);
    const auto middle = thickness.begin() + static_cast<std::ptrdiff_t>(thickness.size() / 2);
    std::ranges::nth_element(thickness, middle);
    return *middle;
}

/// What was measured lately: the variants of a study have most of their shapes in common, and are
/// checked by several threads.
class KnownThicknesses {
  public:
    template <class Measure>
    double of(const std::vector<Polygon>& parts, Measure measure) {
        std::vector<double> key;
        for (const Polygon& part : parts) {
            key.push_back(static_cast<double>(part.size()));
            for (const Vec2& vertex : part) key.insert(key.end(), {vertex.x(), vertex.y()});
        }
        {
            const std::lock_guard lock(mutex_);
            if (const auto known = known_.find(key); known != known_.end()) return known->second;
        }
        const double thickness = measure();
        const std::lock_guard lock(mutex_);
        if (known_.size() >= most) known_.clear();
        known_.emplace(std::move(key), thickness);
        return thickness;
    }

  private:
    static constexpr std::size_t most = 256;
    std::mutex mutex_;
    std::map<std::vector<double>, double> known_;
};

KnownThicknesses known_thicknesses;

}  // namespace

double thickness_of(const Polygon& polygon, const std::vector<Polygon>& attached) {
    std::vector<Polygon> parts = attached;
    parts.push_back(polygon);
    return known_thicknesses.of(parts, [&] { return measured_thickness(polygon, parts); });
}

double mobile_height(const Scene& scene, const Mpm& mpm) {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const Region& region : scene.section.regions) {
        if (region.polygon.empty() || !is_mobile(region, mpm)) continue;
        const Box box = geometry::bounding_box(region.polygon);
        low = std::min(low, box.low.y());
        high = std::max(high, box.high.y());
    }
    return std::max(high - low, 0.0);
}

std::vector<Across> cells_across(const Scene& scene) {
    const Mpm& mpm = mpm_of(scene);
    std::vector<Across> all;
    const auto add = [&](std::string what, double length) {
        all.push_back({std::move(what), "/mpm/cell_size", length, length / mpm.cell_size});
    };
    double top = std::numeric_limits<double>::lowest();
    for (const Region& region : scene.section.regions) {
        if (region.polygon.empty() || !is_mobile(region, mpm)) continue;
        add("the thickness of region \"" + region.name + "\"",
            thickness_of(region.polygon, attached_to(region, scene)));
        top = std::max(top, geometry::bounding_box(region.polygon).high.y());
    }
    if (top > mpm.runout.toe.y()) add("the height of the slope", top - mpm.runout.toe.y());
    return all;
}

std::vector<Across> elements_across(const Scene& scene) {
    std::vector<Across> all;
    if (!scene.fem || scene.fem->mesh.msh_file) return all;
    for (std::size_t i = 0; i < scene.section.regions.size(); ++i) {
        const Region& region = scene.section.regions[i];
        const bool sized = region.element_size > 0.0 || region.divisions[0] > 0;
        if (region.polygon.empty() || !sized) continue;
        const double thickness = thickness_of(region.polygon);
        all.push_back({"region \"" + region.name + "\"",
                       "/section/regions/" + std::to_string(i) + "/mesh", thickness,
                       elements_across(region, thickness)});
    }
    return all;
}

Resolved resolution_of(const Scene& scene) {
    Resolved resolved;
    const auto known = [&](const Region& r) { return r.material < scene.materials.size(); };
    if (!std::ranges::all_of(scene.section.regions, known)) return resolved;
    if (scene.mpm) judge_cells(scene, resolved);
    if (scene.mpm) judge_bands(scene, resolved);
    if (scene.mpm) judge_beds(scene, resolved);
    for (const Across& each : elements_across(scene)) {
        if (each.number >= elements_wanted) continue;
        resolved.flags.push_back(
            {"coarse_elements", fault::Severity::warning,
             each.what + ", " + text_of(each.length) + " m thick, is " + text_of(each.number) +
                 " elements thick: it can hardly bend, and no band of failure can form within it; "
                 "take elements of at most " +
                 rounded_down(each.length / elements_wanted) + " m",
             each.pointer});
    }
    return resolved;
}

}  // namespace breach::scene
