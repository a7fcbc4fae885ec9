#include "core/scene/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <variant>

#include "core/geometry/thickness.hpp"
#include "core/scene/beds.hpp"
#include "core/words/number.hpp"
#include "core/words/remedy.hpp"

namespace breach::scene {

namespace {

std::string text_of(double value) { return words::text_of(value, 3); }

std::string with_cells_of(double size) { return words::set("/mpm/cell_size", size); }

std::string with_cells_below(double size) { return with_cells_of(words::rounded_down(size)); }

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

/// Mobile regions of the same strength that this one touches, directly or through others (wet and
/// dry soil of a dam): shear bands cross their borders.
std::vector<Polygon> attached_to(const Region& region, const Scene& scene) {
    std::vector<const Region*> mass{&region};
    for (std::size_t done = 0; done < mass.size(); ++done) {
        for (const Region& other : scene.section.regions) {
            if (other.polygon.empty() || !is_mobile(other, *scene.mpm)) continue;
            if (std::ranges::find(mass, &other) != mass.end()) continue;
            if (!as_strong(scene.materials.at(region.material), scene.materials.at(other.material)))
                continue;
            if (geometry::touch(mass[done]->polygon, other.polygon)) mass.push_back(&other);
        }
    }
    std::vector<Polygon> attached;
    for (std::size_t i = 1; i < mass.size(); ++i) attached.push_back(mass[i]->polygon);
    return attached;
}

/// A length that cells must resolve.
struct Across {
    std::string what;  ///< "the thickness of region \"dam\""
    double length;     ///< [m]
};

/// The place with the fewest cells: a mobile region with touching ones of the same strength, or the
/// slope from the toe to the highest mobile soil. None: all have enough.
std::optional<Across> coarsest_place(const Scene& scene) {
    const Mpm& mpm = *scene.mpm;
    Across coarsest{"", cells_wanted * mpm.cell_size};
    double top = std::numeric_limits<double>::lowest();
    for (const Region& region : scene.section.regions) {
        if (region.polygon.empty() || !is_mobile(region, mpm)) continue;
        if (const auto thickness = geometry::thickness_below(coarsest.length, region.polygon,
                                                             attached_to(region, scene)))
            coarsest = {"the thickness of region \"" + region.name + "\"", *thickness};
        top = std::max(top, geometry::bounding_box(region.polygon).high.y());
    }
    const double height = top - mpm.runout.toe.y();
    if (height > 0.0 && height < coarsest.length) coarsest = {"the height of the slope", height};
    return coarsest.what.empty() ? std::nullopt : std::optional(coarsest);
}

/// Flags far too fine cells, usually a wrong unit.
void judge_fine_cells(const Scene& scene, Resolved& resolved) {
    const double area = area_of_section(scene);
    const double h = scene.mpm->cell_size, cells = area / (h * h);
    if (cells <= most_cells) return;
    resolved.flags.push_back(
        {"implausible", fault::Severity::warning,
         text_of(h) + " m fills the section with " + std::to_string(std::lround(cells)) +
             " cells, and the time to compute grows with the third power of their number across; a "
             "tenth of them: " +
             with_cells_below(std::sqrt(area / (0.1 * most_cells))),
         "/mpm/cell_size"});
}

void judge_cells(const Scene& scene, Resolved& resolved) {
    judge_fine_cells(scene, resolved);
    const auto coarsest = coarsest_place(scene);
    if (!coarsest) return;
    const double h = scene.mpm->cell_size;
    const double number = coarsest->length / h;
    const std::string found = text_of(number) + " cells of " + text_of(h) + " m across " +
                              coarsest->what + ", " + text_of(coarsest->length) + " m";
    const std::string fine = with_cells_below(coarsest->length / cells_wanted);
    const bool refused = number < least_cells;
    if (refused && !scene.mpm->allow_coarse_cells) {
        resolved.faults.push_back(
            {"/mpm/cell_size", "gives " + found + ": it could not shear within itself",
             "write " + with_cells_below(coarsest->length / least_cells) + " or less (" + fine +
                 " for " + text_of(cells_wanted) + " across it), or for a quick look " +
                 words::set("/mpm/allow_coarse_cells", "true") + " (a questionable result)"});
        return;
    }
    resolved.flags.push_back({"coarse_cells",
                              refused ? fault::Severity::questionable : fault::Severity::warning,
                              "only " + found + " (" + text_of(cells_wanted) +
                                  " are wanted): coarse cells shorten the runout; compare with " +
                                  fine + " before relying on it",
                              "/mpm/cell_size"});
}

/// At this normal stress [Pa].
bool is_weaker(const Material& a, const Material& b, double stress) {
    const auto one = materials::limit_strength(a.law), other = materials::limit_strength(b.law);
    return one && other &&
           one->c + stress * one->tan_phi < 0.95 * (other->c + stress * other->tan_phi);
}

/// Flags immobile weak layers, on which the mobile soil may slide.
void judge_weak_layers(const Scene& scene, Resolved& resolved) {
    const double h = scene.mpm->cell_size, H = mobile_height(scene, *scene.mpm);
    for (const Region& layer : scene.section.regions) {
        if (layer.polygon.empty() || is_mobile(layer, *scene.mpm)) continue;
        const bool carries_stronger =
            std::ranges::any_of(scene.section.regions, [&](const Region& each) {
                if (each.polygon.empty() || !is_mobile(each, *scene.mpm)) return false;
                const Material& soil = scene.materials.at(each.material);
                return is_weaker(scene.materials.at(layer.material), soil,
                                 0.5 * soil.density * scene.gravity * H) &&
                       geometry::touch(layer.polygon, each.polygon);
            });
        const auto thickness = geometry::thickness_below(least_cells * h, layer.polygon, {});
        if (!carries_stronger || !thickness) continue;
        resolved.flags.push_back(
            {"coarse_cells",
             *thickness < h ? fault::Severity::questionable : fault::Severity::warning,
             "only " + text_of(*thickness / h) + " cells of " + text_of(h) + " m across region \"" +
                 layer.name + "\", " + text_of(*thickness) +
                 " m, which is weaker than the soil that it carries: slides along it are missed or "
                 "too short; " +
                 with_cells_below(*thickness / least_cells),
             "/mpm/cell_size"});
    }
}

std::string length_of(const Material& soil) {
    return "/materials/" + soil.name + "/nonlocal_length";
}

void judge_length_in_mpm(const Material& soil, const Mpm& mpm, Resolved& resolved) {
    const std::string pointer = length_of(soil);
    if (!mpm.softening_length) {
        resolved.faults.push_back(
            {pointer, "needs the width of the shear band for which the softening strains hold",
             "give /mpm/softening_length, the cell size that they were found with"});
    }
    const double cells = *soil.nonlocal_length / mpm.cell_size;
    if (cells >= nonlocal_cells_wanted) return;
    if (!nonlocal_length_in_runout(soil, mpm) && mpm.allow_coarse_cells) {
        resolved.flags.push_back({"short_nonlocal_length", fault::Severity::questionable,
                                  "is " + text_of(cells) + " cells of " + text_of(mpm.cell_size) +
                                      " m and left out: bands are as wide as a cell",
                                  pointer});
        return;
    }
    const std::string found = "is " + text_of(cells) + " cells of " + text_of(mpm.cell_size) + " m";
    const std::string wanted =
        with_cells_below(*soil.nonlocal_length / nonlocal_cells_wanted) + ", or a longer length";
    if (cells < least_nonlocal_cells) {
        resolved.faults.push_back(
            {pointer, found + ": an average over so few nodes leaves the band to the lattice",
             wanted});
    } else {
        resolved.flags.push_back({"short_nonlocal_length", fault::Severity::warning,
                                  found + " (" + text_of(nonlocal_cells_wanted) +
                                      " are wanted): bands depend on the lattice; " + wanted,
                                  pointer});
    }
}

/// Edge length of a region's elements: wanted, or from the divisions of a block [m].
double element_size(const Region& region) {
    const auto [along, up] = region.divisions;
    if (along == 0) return region.element_size;
    return std::sqrt(geometry::area(region.polygon) / (along * up));
}

/// The largest elements of a soil whose law acts in the FEM [m]; 0: unknown, in a mesh from a file.
/// None: the FEM has no such soil.
std::optional<double> largest_element(const Scene& scene, std::size_t material) {
    if (!scene.fem || std::ranges::find(scene.fem->stages, StageLaws::scene, &Stage::laws) ==
                          scene.fem->stages.end())
        return std::nullopt;
    std::optional<double> largest;
    for (const Region& region : scene.section.regions) {
        if (region.material != material || region.polygon.empty()) continue;
        const double size = scene.fem->mesh.msh_file ? 0.0 : element_size(region);
        largest = std::max(largest.value_or(0.0), size);
    }
    return largest;
}

void judge_lack_of_length_in_mpm(const Material& soil, const Mpm& mpm, Resolved& resolved) {
    resolved.flags.push_back(
        {"local_softening", fault::Severity::warning,
         "softens without a length: its shear bands are as wide as a cell, and cells half as large "
         "have changed runouts by up to 30 %; give it a length of two cells: " +
             words::set(length_of(soil), 2.0 * mpm.cell_size) +
             (mpm.softening_length ? ""
                                   : " " + words::set("/mpm/softening_length", mpm.cell_size) +
                                         " (the cells that its softening strains are for)"),
         "/materials/" + soil.name});
}

void judge_lack_of_length_in_fem(const Material& soil, double size, Resolved& resolved) {
    const std::string remedy =
        !materials::softening(soil.law)
            ? "compare two element sizes before you use a time of failure"
        : size > 0.0
            ? "give it a length of two elements: " + words::set(length_of(soil), 2.0 * size)
            : "give it a length of two elements: " + length_of(soil);
    resolved.flags.push_back(
        {"local_softening", fault::Severity::warning,
         "softens without a length: its shear bands are as wide as an element, and with smaller "
         "elements it loses its strength at smaller displacements; " +
             remedy,
         "/materials/" + soil.name});
}

/// NorSand has no length. Its peak does not depend on the elements, what follows does
/// (tests/verification/fem/biaxial_bands.py).
bool is_brittle(const Material& soil) {
    const materials::Softening* softening = materials::softening(soil.law);
    return softening ? softening->epsilon_q_end <= brittle_until
                     : materials::has_state_parameter(soil.law);
}

void judge_softening(const Scene& scene, std::size_t material, bool in_mpm, Resolved& resolved) {
    const Material& soil = scene.materials[material];
    const auto element = largest_element(scene, material);
    if (soil.nonlocal_length && !materials::softening(soil.law)) {
        resolved.faults.push_back({length_of(soil), "belongs to a law that does not soften",
                                   "give " + std::string("/materials/").append(soil.name) +
                                       "/law/softening, or leave the length out"});
    } else if (soil.nonlocal_length) {
        if (in_mpm) judge_length_in_mpm(soil, *scene.mpm, resolved);
        if (const auto flag = element ? short_length(soil, *element) : std::nullopt)
            resolved.flags.push_back(*flag);
    } else if (is_brittle(soil) && in_mpm) {
        judge_lack_of_length_in_mpm(soil, *scene.mpm, resolved);
    } else if (is_brittle(soil) && element) {
        judge_lack_of_length_in_fem(soil, *element, resolved);
    }
}

/// A region whose soil fails in shear bands.
struct BandAcross {
    const Material* soil;
    const Region* region;
    double thickness;  ///< [m]
};

/// Flags the region with the least space for its shear bands.
void judge_widest_band(const Scene& scene, const std::vector<Soil>& soils, Resolved& resolved) {
    std::optional<BandAcross> widest;
    double share = widest_band_share;
    for (const Soil& each : soils) {
        const Material& soil = scene.materials[each.material];
        const Region& region = scene.section.regions[each.region];
        if (!nonlocal_length_in_runout(soil, *scene.mpm) || region.polygon.empty()) continue;
        const double band = band_width(soil, *scene.mpm);
        const auto thickness = geometry::thickness_below(band / share, region.polygon);
        if (!thickness) continue;
        share = band / *thickness;
        widest = {&soil, &region, *thickness};
    }
    if (!widest) return;
    const std::string pointer = "/materials/" + widest->soil->name + "/nonlocal_length";
    const double h = scene.mpm->cell_size;
    const double length =
        words::rounded_down(widest_band_share * widest->thickness / band_in_nonlocal_lengths);
    resolved.flags.push_back(
        {"wide_band", fault::Severity::warning,
         "bands of shear are " + text_of(band_width(*widest->soil, *scene.mpm)) +
             " m wide in region \"" + widest->region->name + "\" of " + text_of(widest->thickness) +
             " m: it cannot break into blocks; " + words::set(pointer, length) +
             (length < nonlocal_cells_wanted * h
                  ? " " + with_cells_below(length / nonlocal_cells_wanted)
                  : ""),
         pointer});
}

void judge_bands(const Scene& scene, Resolved& resolved) {
    const std::vector<Soil> soils = scene.mpm ? soils_of(scene) : std::vector<Soil>{};
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const bool in_mpm = std::ranges::find(soils, m, &Soil::material) != soils.end();
        const bool drawn = std::ranges::find(scene.section.regions, m, &Region::material) !=
                           scene.section.regions.end();
        if (in_mpm || drawn) judge_softening(scene, m, in_mpm, resolved);
    }
    if (scene.mpm) judge_widest_band(scene, soils, resolved);
}

/// Cell sizes that divide the height of a bed: just below and just above the scene's.
std::string cells_dividing(const Mpm& mpm, double height) {
    const double rows = height / mpm.cell_size;
    std::string sizes = with_cells_of(height / std::ceil(rows));
    if (rows > 1.0) sizes += " or " + with_cells_of(height / std::floor(rows));
    return sizes;
}

/// The floor below terrain has no contact: it may be lower, to put a grid line at a level.
std::string floor_with_a_line_at(const Mpm& mpm, double level) {
    const double h = mpm.cell_size;
    const double floor = level - h * std::ceil(cells_up_to(mpm, level));
    return words::set("/mpm/floor/level", floor) + " " +
           words::set("/mpm/domain_y",
                      std::array{std::min(floor, mpm.domain_y[0]), mpm.domain_y[1]}) +
           " moves a line of the grid there (the terrain carries the soil, not the floor)";
}

struct CutBed {
    std::string how;
    std::string remedy;
};

/// How a bed shares cells with the soil on it; none if its points' domains end at its top.
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
    return CutBed{how, "take cells that divide the " + text_of(*bed.level - mpm.floor.level) +
                           " m from the floor up to it (" +
                           cells_dividing(mpm, *bed.level - mpm.floor.level) +
                           "), or move the floor"};
}

/// Flags mobile soil on beds of firm soil.
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
                                      "\" it slows the soil that slides on it, and the runout is "
                                      "too short (10 to 30 % in tests); " +
                                      cut->remedy,
                                  "/mpm/cell_size"});
    }
}

/// Flags a region with fewer than two elements across. A block meshed by element_size has at least
/// two.
void judge_elements(const Region& region, const std::string& pointer, Resolved& resolved) {
    const auto [along, up] = region.divisions;
    const bool divided = region.mesh == RegionMesh::block && along > 0;
    if (divided ? std::min(along, up) >= elements_wanted : region.mesh == RegionMesh::block) return;
    constexpr double any = std::numeric_limits<double>::infinity();
    const auto thickness = geometry::thickness_below(
        divided ? any : elements_wanted * region.element_size, region.polygon);
    if (!thickness) return;
    const double number = divided ? std::min(along, up) : *thickness / region.element_size;
    const std::string size = words::text_of(words::rounded_down(*thickness / elements_wanted));
    resolved.flags.push_back(
        {"coarse_elements", fault::Severity::warning,
         "region \"" + region.name + "\", " + text_of(*thickness) + " m thick, is " +
             text_of(number) +
             " elements thick: it can hardly bend, and no band of failure can form within it; " +
             (divided
                  ? "take elements of at most " + size + " m"
                  : words::set(pointer, R"({"type":"unstructured","element_size":)" + size + "}")),
         pointer});
}

void judge_elements(const Scene& scene, Resolved& resolved) {
    if (!scene.fem || scene.fem->mesh.msh_file) return;
    for (std::size_t i = 0; i < scene.section.regions.size(); ++i) {
        const Region& region = scene.section.regions[i];
        if (region.polygon.empty()) continue;
        judge_elements(region, "/section/regions/" + std::to_string(i) + "/mesh", resolved);
    }
}

}  // namespace

std::optional<double> nonlocal_length_in_runout(const Material& material, const Mpm& mpm) {
    const auto& length = material.nonlocal_length;
    return length && *length >= least_nonlocal_cells * mpm.cell_size ? length : std::nullopt;
}

double band_width(const Material& material, const Mpm& mpm) {
    const auto length = nonlocal_length_in_runout(material, mpm);
    return length ? band_in_nonlocal_lengths * *length : mpm.cell_size;
}

bool is_mobile(const Region& region, const Mpm& mpm) {
    const auto& names = mpm.runout.regions;
    return names.empty() || std::ranges::find(names, region.name) != names.end();
}

geometry::Box mobile_extent(const Scene& scene, const Mpm& mpm) {
    geometry::Outlines mobile;
    for (const Region& region : scene.section.regions)
        if (is_mobile(region, mpm)) mobile.push_back(&region.polygon);
    return geometry::extent(mobile);
}

std::string why_enough_upstream() {
    return "from " + text_of(enough_heights_upstream) +
           " heights upstream of the crest on, a longer section changed Mochikoshi's runout by "
           "less than 5 %";
}

double area_of_section(const Scene& scene) {
    double area = 0.0;
    for (const Region& region : scene.section.regions) area += geometry::area(region.polygon);
    return area;
}

double mobile_height(const Scene& scene, const Mpm& mpm) {
    const geometry::Box box = mobile_extent(scene, mpm);
    return std::max(box.high.y() - box.low.y(), 0.0);
}

std::optional<fault::Flag> short_length(const Material& soil, double element) {
    const double wanted = *soil.nonlocal_length / nonlocal_cells_wanted;
    // The size of divisions has round-off.
    if (element <= wanted * (1.0 + 1e-9)) return std::nullopt;
    return fault::Flag{
        "short_nonlocal_length",
        element > *soil.nonlocal_length ? fault::Severity::questionable : fault::Severity::warning,
        "is " + text_of(*soil.nonlocal_length / element) + " elements of " + text_of(element) +
            " m (" + text_of(nonlocal_cells_wanted) +
            " are wanted): bands depend on the mesh; take elements of at most " +
            text_of(words::rounded_down(wanted)) + " m, or a longer length",
        length_of(soil)};
}

Resolved resolution_of(const Scene& scene) {
    Resolved resolved;
    const auto known = [&](const Region& r) { return r.material < scene.materials.size(); };
    if (!std::ranges::all_of(scene.section.regions, known)) return resolved;
    if (scene.mpm) {
        judge_cells(scene, resolved);
        judge_weak_layers(scene, resolved);
    }
    judge_bands(scene, resolved);
    if (scene.mpm) judge_beds(scene, resolved);
    judge_elements(scene, resolved);
    return resolved;
}

}  // namespace breach::scene
