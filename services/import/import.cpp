// The order of an import: check the options, read the drawing, sort outlines by meaning, take
// lines, heal, divide into depth layers, write the scene. A step that fails ends the import where
// later faults would mislead. Called by `breach import` and by POST of the dashboard with bytes;
// it writes no file.
#include "services/import/import.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/check/check.hpp"
#include "core/words/number.hpp"
#include "services/import/csv.hpp"
#include "services/import/depth_layers.hpp"
#include "services/import/document.hpp"
#include "services/import/dxf.hpp"
#include "services/import/dxf_records.hpp"
#include "services/import/guess.hpp"
#include "services/import/join_lines.hpp"
#include "services/import/shake.hpp"

namespace breach::importing {

using nlohmann::json;

namespace {

/// Outside of these a drawing was most likely read in a wrong unit.
constexpr double longest_section = 10'000.0, shortest_section = 1.0;  // m
constexpr std::size_t most_faults = 200;

std::set<std::string> names_in(const json& materials) {
    std::set<std::string> names;
    if (materials.is_object())
        for (const auto& [name, material] : materials.items()) names.insert(name);
    return names;
}

/// By the name if it says so, because a CSV file may contain the word SECTION.
bool is_dxf(const Sent& sent) {
    const std::string extension = lower(std::filesystem::path(sent.name).extension().string());
    if (extension == ".dxf" || extension == ".dwg") return true;
    if (extension == ".csv" || extension == ".txt") return false;
    return sent.bytes.starts_with("AutoCAD") || sent.bytes.starts_with("AC10") ||
           sent.bytes.substr(0, 4096).find("SECTION") != std::string::npos;
}

/// Replaces characters that names of scenes or regions must not have.
std::string as_name(const std::string& text, const std::string& otherwise) {
    std::string name;
    for (const char each : text) {
        const bool fits = (each >= 'a' && each <= 'z') || (each >= 'A' && each <= 'Z') ||
                          (each >= '0' && each <= '9') || each == '_' || each == '-';
        if (fits || (!name.empty() && name.back() != '_')) name += fits ? each : '_';
    }
    name.resize(std::min<std::size_t>(name.size(), 40));
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name.empty() ? otherwise : name;
}

std::string scene_name(const Request& request) {
    const std::string stem = std::filesystem::path(request.drawing.name).stem().string();
    std::string name = lower(as_name(request.name.empty() ? stem : request.name, "section"));
    if (name.front() == '_' || name.front() == '-') name.insert(0, "s");
    return name;
}

/// Steps fill members in order: drawing_ by read_drawing, soils_ and drawn_lines_ by sort_out,
/// lines by take_lines and read_line. Any step adds to result_.faults; give_up() then drops the
/// scene and keeps the sketch, on which the faults are drawn.
class Import {
  public:
    explicit Import(const Request& request)
        : request_(request),
          materials_(materials_in(request.materials)),
          map_(request.map, names_in(materials_), result_.faults) {}

    Imported result() {
        result_.report = {{"unit", request_.unit},    {"tolerance", request_.tolerance},
                          {"healed", json::array()},  {"areas", json::array()},
                          {"guessed", json::array()}, {"remarks", json::array()}};
        if (check_request() && read_drawing()) {
            sort_out();
            if (is_turned()) {  // the faults of lines would mislead
                result_.faults.push_back(result_.to_confirm.front());
                give_up();
                return std::move(result_);
            }
            take_lines();
            for (auto& [role, sent] :
                 std::map<Role, const std::optional<Sent>*>{{Role::phreatic, &request_.phreatic},
                                                            {Role::terrain, &request_.terrain},
                                                            {Role::ground, &request_.ground}})
                if (*sent) read_line(**sent, role);
            if (has_sound_size()) fit();
        }
        if (!result_.faults.empty()) give_up();
        return std::move(result_);
    }

  private:
    void refuse(std::string pointer, std::string cause, std::string remedy) {
        result_.faults.push_back({std::move(pointer), std::move(cause), std::move(remedy)});
    }
    void remark(std::string text) { result_.report["remarks"].push_back(std::move(text)); }
    void take(Drawing& drawing) {
        for (Fault& each : drawing.faults) result_.faults.push_back(std::move(each));
        for (std::string& each : drawing.remarks) remark(std::move(each));
    }

    // ------------------------------------------------------------ reading

    bool check_request() {
        bool sound = true;
        if (!materials_.is_object() || materials_.empty()) {
            refuse("materials", "hold no material",
                   "give a JSON file with a scene's \"materials\": {\"NAME\": {...}}");
            sound = false;
        }
        if (!(request_.tolerance > 0.0 && request_.tolerance <= 10.0)) {
            refuse("tolerance",
                   std::to_string(request_.tolerance) + " m is no distance to heal over",
                   "give more than 0 and at most 10 m");
            sound = false;
        }
        if (request_.flatten && !(*request_.flatten > 0.0 && *request_.flatten <= 10.0)) {
            refuse("flatten", "is no distance that chords may be off",
                   "give more than 0 and at most 10 m");
            sound = false;
        }
        if (!request_.unit.empty() && !unit_named(request_.unit)) {
            refuse("unit", "\"" + as_utf8(request_.unit) + "\" is no unit",
                   "the units are " + unit_names());
            sound = false;
        }
        if (const auto& motion = request_.motion) {
            sound &=
                is_between("pga", motion->pga, earthquake::least_pga, earthquake::most_pga, "g");
            sound &= is_between("shaking", motion->shaking, earthquake::least_shaking,
                                earthquake::most_shaking, "s");
        }
        for (const std::string& each : request_.layers)
            if (auto wanted = layer_request_from(each, result_.faults))
                layers_.push_back(std::move(*wanted));
        return sound;
    }

    bool is_between(const char* option, double value, double least, double most,
                    const std::string& unit) {
        if (value >= least && value <= most) return true;
        refuse(option, "is " + words::text_of(value) + " " + unit,
               "give " + words::text_of(least) + " to " + words::text_of(most) + " " + unit);
        return false;
    }

    bool read_drawing() {
        if (auto faults = form_faults(request_.drawing.bytes); !faults.empty()) {
            for (Fault& each : faults) result_.faults.push_back(std::move(each));
            return false;
        }
        const auto unit = unit_named(request_.unit);
        drawing_ = is_dxf(request_.drawing)
                       ? read_dxf(request_.drawing.bytes, map_, {unit, request_.flatten})
                       : read_csv(request_.drawing.bytes, map_, unit);
        take(drawing_);
        result_.report["unit"] = drawing_.unit;
        result_.report["unit_from"] = !request_.unit.empty()     ? "asked"
                                      : is_dxf(request_.drawing) ? "drawing"
                                      : drawing_.says_unit       ? "header"
                                                                 : "default";
        for (const auto& [layer, found] : drawing_.unknown)
            refuse(at_line(found.origin.line),
                   "layer " + layer + " has no material: " + std::to_string(found.entities) +
                       (found.entities == 1 ? " entity, " : " entities, the first one ") +
                       found.origin.entity + " at " + text(found.first),
                   "map " + layer + "=MATERIAL, or " + layer +
                       "=phreatic, terrain, ground or none (left out)");
        for (const std::string& each : map_.unused(drawing_.layers))
            refuse("map", "nothing is drawn on layer \"" + each + "\"",
                   "the layers are " + listed(drawing_.layers));
        return true;
    }

    static std::string listed(const std::set<std::string>& names) {
        std::string all;
        for (const std::string& each : names) all += (all.empty() ? "" : ", ") + each;
        return all.empty() ? "none" : as_utf8(std::string_view(all).substr(0, 400));
    }

    /// Sorts outlines by their meaning, and joins the lines of a layer.
    void sort_out() {
        std::vector<std::string> order;
        std::map<std::string, std::vector<Outline>> by_layer;
        for (Outline& each : drawing_.outlines) {
            if (!by_layer.contains(each.layer)) order.push_back(each.layer);
            by_layer[each.layer].push_back(std::move(each));
        }
        for (const std::string& layer : order) {
            const Meaning meaning = map_.meaning_of(layer);
            std::vector<Outline>& pieces = by_layer[layer];
            const auto areas = std::ranges::stable_partition(
                pieces, [](const Outline& each) { return !each.fills; });
            std::vector<Outline> fills(std::make_move_iterator(areas.begin()),
                                       std::make_move_iterator(areas.end()));
            pieces.erase(areas.begin(), areas.end());
            std::vector<Outline> whole = joined(std::move(pieces), request_.tolerance);
            take_areas(std::move(fills), whole);
            if (meaning.role == Role::soil) {
                take_soils(std::move(whole), layer, meaning.material);
            } else {
                for (Outline& each : whole) drawn_lines_[meaning.role].push_back(std::move(each));
            }
        }
        if (soils_.empty())
            refuse("drawing",
                   "there is no closed polyline on a layer with a material; the layers are " +
                       listed(drawing_.layers),
                   "map a layer to a material, or name layers as the materials are named");
    }

    /// Adds areas to the outlines of their layer, except those that lie in one: a hatch repeats it.
    void take_areas(std::vector<Outline> areas, std::vector<Outline>& whole) {
        std::ranges::stable_sort(areas, std::ranges::greater(), [](const Outline& each) {
            return std::abs(geometry::signed_area(each.points));
        });
        for (Outline& each : areas) {
            const auto around = std::ranges::find_if(whole, [&](const Outline& outline) {
                return outline.closed && lies_in(each.points, outline.points);
            });
            if (around == whole.end()) {
                whole.push_back(std::move(each));
            } else if (around->fills && around->origin.line == each.origin.line) {
                refuse(at_line(each.origin.line),
                       named(each) + " has an island at " + text(each.points.front()),
                       "a region has no holes: draw its parts around the island as closed "
                       "polylines");
            }
        }
    }

    /// Whether corners and middles of the sides lie in the polygon.
    bool lies_in(const std::vector<Vec2>& inner, const std::vector<Vec2>& outer) const {
        const double off = request_.tolerance + request_.flatten.value_or(0.0);
        for (std::size_t i = 0; i < inner.size(); ++i) {
            const Vec2 middle = 0.5 * (inner[i] + inner[(i + 1) % inner.size()]);
            if (!geometry::contains(outer, inner[i], off) ||
                !geometry::contains(outer, middle, off))
                return false;
        }
        return true;
    }

    void take_lines() {
        for (auto& [role, pieces] : drawn_lines_)
            take_line(joined(std::move(pieces), request_.tolerance), role, "");
    }

    /// Whether the section is higher than long, without confirmation.
    bool is_turned() {
        if (soils_.empty()) return false;
        const geometry::Box box = geometry::extent(outlines_of(soils_));
        const Vec2 size = box.high - box.low;
        if (size.y() <= size.x()) return false;
        ask_to_confirm("drawing",
                       "the section is " + extent(size.x()) + " long and " + extent(size.y()) +
                           " high: x and y look swapped, or the levels exaggerated",
                       "give the distance along the section as x and the level as y, both to one "
                       "scale");
        return !request_.confirmed;
    }

    void take_soils(std::vector<Outline> outlines, const std::string& layer,
                    const std::string& material) {
        const std::string base = as_name(layer, "region");
        if (base != layer) remark("regions of layer " + layer + " are named " + base);
        std::size_t number = 0;
        for (Outline& each : outlines) {
            std::string name = base;
            if (outlines.size() > 1) name += "_" + std::to_string(++number);
            while (!names_.insert(name).second) name += "_b";
            soils_.push_back({name, layer, material, each.points, each.origin});
            if (each.closed) continue;
            const Vec2 &a = each.points.front(), &b = each.points.back();
            refuse(at_line(each.origin.line),
                   named(each) + " is open: its ends " + text(a) + " and " + text(b) + " are " +
                       metres((a - b).norm()) + " apart",
                   "close the polyline, or map its layer to phreatic, terrain, ground or none");
        }
    }

    std::vector<Vec2>& line_of(Role role) {
        return role == Role::phreatic  ? lines_.phreatic
               : role == Role::terrain ? lines_.terrain
                                       : lines_.ground;
    }

    static const char* word_of(Role role) {
        return role == Role::phreatic  ? "phreatic line"
               : role == Role::terrain ? "terrain"
                                       : "ground line";
    }

    /// `file`: source of the line, if not the drawing.
    void take_line(std::vector<Outline> pieces, Role role, const std::string& file) {
        const std::string word = word_of(role);
        const auto place = [&](const Outline& each) {
            return (file.empty() ? "" : file + " ") + at_line(each.origin.line);
        };
        for (std::size_t i = 1; i < pieces.size(); ++i)
            refuse(place(pieces[i]),
                   named(pieces[i]) + " at " + text(pieces[i].points.front()) +
                       " is another piece of the " + word,
                   "draw the " + word + " as one line");
        if (pieces.empty() || pieces.size() > 1) return;
        std::vector<Vec2> line = pieces.front().points;
        if (pieces.front().closed || line.size() < 2)
            return refuse(place(pieces.front()),
                          named(pieces.front()) + " at " + text(line.front()) +
                              (line.size() < 2 ? " is a point, no " : " is closed: no ") + word,
                          "draw it open, from left to right");
        if (line.front().x() > line.back().x()) std::ranges::reverse(line);
        for (std::size_t i = 1; i < line.size(); ++i)
            if (line[i].x() <= line[i - 1].x())
                refuse(place(pieces.front()), "the " + word + " runs back at " + text(line[i]),
                       "a line has one level at every x: draw it from left to right");
        if (!line_of(role).empty())
            refuse(place(pieces.front()),
                   "the " + word + " is drawn, and given as a file: " + text(line.front()),
                   "leave one of them out");
        line_of(role) = std::move(line);
    }

    void read_line(const Sent& sent, Role role) {
        if (const auto faults = form_faults(sent.bytes); !faults.empty()) {
            for (const Fault& each : faults)
                refuse(as_utf8(sent.name) + " " + each.pointer, each.cause,
                       "give a text with columns x,y");
            return;
        }
        const std::string layer = role == Role::phreatic  ? "phreatic"
                                  : role == Role::terrain ? "terrain"
                                                          : "ground";
        std::vector<Fault> none;
        const LayerMap own({layer + "=" + layer}, {}, none);
        Drawing read = read_csv(sent.bytes, own, unit_named(request_.unit), layer);
        for (Fault& each : read.faults) each.pointer = as_utf8(sent.name) + " " + each.pointer;
        const bool sound = read.faults.empty();
        take(read);
        if (request_.unit.empty() && !read.says_unit && drawing_.unit != read.unit)
            remark(as_utf8(sent.name) + " was read in " + read.unit +
                   " because it names no unit, the drawing in " + drawing_.unit +
                   "; --unit sets that of both");
        if (sound) take_line(std::move(read.outlines), role, as_utf8(sent.name));
    }

    bool has_sound_size() {
        if (soils_.empty()) return false;
        const geometry::Box box = geometry::extent(outlines_of(soils_));
        const double length = (box.high - box.low).maxCoeff();
        const std::string size = "the section reaches from " + text(box.low) + " to " +
                                 text(box.high) + ": it is " + metres(length) + " long";
        const bool odd = length > longest_section || length < shortest_section;
        if (!odd) return true;
        if (!drawing_.knows_unit) return false;
        if (length > longest_section) {
            refuse("unit", size + ", as if millimetres were read as metres",
                   "say its unit: with mm it is " + metres(1e-3 * length) + ", with ft " +
                       metres(0.3048 * length) + " long");
        } else {
            refuse("unit", size + ", as if metres were read as a smaller unit",
                   "say its unit, m or ft");
        }
        return false;
    }

    // ------------------------------------------------------------ fitting

    void fit() {
        drawn_ = soils_;
        if (request_.motion) tell_changes(straightened(soils_, request_.tolerance));
        Healed healed = importing::healed(soils_, request_.tolerance, lines_.terrain);
        std::erase_if(healed.faults, [&](const Fault& each) {  // open ones are reported already
            return each.cause.ends_with("encloses no area") && is_told(each.pointer);
        });
        tell(healed);
        if (result_.faults.empty()) check_for_air(healed.soils);
        if (!healed.terrain.empty()) lines_.terrain = healed.terrain;
        for (const LayerRequest& each : layers_) {
            if (!result_.faults.empty()) return;
            if (lines_.phreatic.empty())
                return refuse(
                    "layers",
                    "there is no phreatic line below which " + each.region + " has depths",
                    "draw it on a layer PHREATIC, or give it as a file");
            healed =
                with_layers(std::move(healed.soils), each, lines_.phreatic, request_.tolerance);
            tell(healed);
        }
        if (!result_.faults.empty()) return;
        if (!request_.motion)
            choose_materials(healed.soils);
        else if (!can_be_shaken(healed.soils))
            return;
        tell_size(healed.soils);
        tell_areas(healed.soils);
        finish(healed.soils);
    }

    /// A gap that is open to a side is not a face of the drawing, but not a valley either.
    void check_for_air(const std::vector<Soil>& soils) {
        const auto air = highest_void(soils, request_.tolerance);
        if (!air) return;
        const Soil &above = soils[air->above], &below = soils[air->below];
        refuse(at_line(above.origin.line),
               "air below " + above.name + " at " + text(air->at) + ": it stands " +
                   metres(air->height) + " above " + below.name,
               "let both share a border, or draw the soil that lies between them");
    }

    bool is_told(const std::string& pointer) const {
        return std::ranges::any_of(result_.faults,
                                   [&](const Fault& each) { return each.pointer == pointer; });
    }

    /// Materials first: later steps need their entries.
    bool can_be_shaken(const std::vector<Soil>& soils) {
        Document bare = document_of(scene_name(request_), request_.materials, soils, {});
        bare.scene.erase("lem");
        result_.faults = seen_from_drawing(checked(bare.scene).faults, soils);
        if (!result_.faults.empty()) return false;
        result_.faults = faults_of_shaking(soils, lines_, materials_);
        if (!result_.faults.empty()) return false;
        guesses_terrain_ = lines_.terrain.empty();
        if (guesses_terrain_) lines_.terrain = guessed_terrain(soils);
        return true;
    }

    void tell(const Healed& healed) {
        for (const Fault& each : healed.faults) result_.faults.push_back(each);
        tell_changes(healed.changes);
    }

    void tell_changes(const std::vector<Change>& changes) {
        for (const Change& each : changes)
            result_.report["healed"].push_back({{"kind", each.kind},
                                                {"regions", each.regions},
                                                {"at", as_json(each.at)},
                                                {"size", each.size}});
    }

    /// A depth layer has the material with its own name, if there is one. Case does not count.
    void choose_materials(std::vector<Soil>& soils) {
        std::map<std::string, std::string> own;
        for (const std::string& each : names_in(materials_)) own[lower(each)] = each;
        for (Soil& each : soils) {
            if (names_.contains(each.name)) continue;  // a region as drawn: its layer decides
            const auto found = own.find(lower(each.name));
            if (found == own.end() || found->second == each.material) continue;
            remark("region " + each.name + " is of the material of its name, no longer of " +
                   each.material);
            each.material = found->second;
        }
    }

    /// The section's length and height [m], also for other units.
    void tell_size(const std::vector<Soil>& soils) {
        const geometry::Box box = geometry::extent(outlines_of(soils));
        const Vec2 size = box.high - box.low;
        result_.report["size"] = as_json(size);
        const double own = unit_named(drawing_.unit).value_or(Unit{"m", 1.0}).metres;
        std::string all;
        for (const char* each : {"m", "cm", "mm", "ft"}) {
            const Vec2 other = size * (unit_named(each)->metres / own);
            all += (all.empty() ? "" : ", ") + extent(other.x()) + " by " + extent(other.y()) +
                   " in " + each;
        }
        result_.report["other_units"] = all;
    }

    void ask_to_confirm(const std::string& pointer, const std::string& cause,
                        const std::string& remedy) {
        if (request_.confirmed) return remark(cause + ": confirmed");
        result_.to_confirm.push_back(
            {pointer, cause,
             remedy + "; or confirm it with --yes (\"confirmed\": true in a request)"});
    }

    /// Sizes and shapes that suggest a mistake.
    void check_shape(const std::vector<Soil>& soils, const std::optional<Slope>& slope) {
        constexpr double least = 3.0, most = 500.0;  // m
        const geometry::Box box = geometry::extent(outlines_of(soils));
        const Vec2 size = box.high - box.low;
        const double height = slope ? slope->fall() : size.y();
        if (height < least || height > most)
            ask_to_confirm(
                "unit",
                std::string(slope ? "the slope" : "the section") + " is " + extent(height) +
                    (height < least ? " high only, read in " : " high, read in ") + drawing_.unit +
                    "; the section would be " + result_.report.at("other_units").get<std::string>(),
                "say its unit: --unit m, cm, mm or ft");
        if (looks_upside_down(soils))
            ask_to_confirm(
                "drawing",
                "the section's top is level and its bottom has a slope: the drawing looks "
                "as if depths were given as levels",
                "give levels as y, positive upwards: -depth");
    }

    void tell_areas(const std::vector<Soil>& soils) {
        for (const Soil& before : drawn_) {
            double after = 0.0;
            for (const Soil& each : soils)
                if (each.origin.line == before.origin.line && each.layer == before.layer)
                    after += geometry::area(each.ring);
            result_.report["areas"].push_back({{"region", before.name},
                                               {"drawn", geometry::area(before.ring)},
                                               {"imported", after}});
        }
    }

    // ------------------------------------------------------------ the scene

    /// Without the motion, whose file is not written yet.
    check::Checked checked(json document) const {
        if (document.contains("fem")) document["fem"].erase("motion");
        return check::checked_document(std::move(document), request_.drawing.name, ".", {});
    }

    Document made(const std::vector<Soil>& soils, double share) const {
        Document document =
            document_of(scene_name(request_), request_.materials, soils, lines_, share);
        if (guesses_terrain_)
            document.guessed.push_back({{"pointer", "/mpm/terrain"},
                                        {"value", document.scene["mpm"]["terrain"]},
                                        {"from",
                                         "the section's base, then the ground's level at "
                                         "its right end"}});
        if (request_.motion)
            add_earthquake({*request_.motion, thinnest_layer()}, soils, lines_, document);
        return document;
    }

    double thinnest_layer() const {
        double thinnest = std::numeric_limits<double>::infinity();
        for (const LayerRequest& each : layers_)
            for (std::size_t i = 0; i < each.depths.size(); ++i)
                thinnest = std::min(thinnest, each.depths[i] - (i ? each.depths[i - 1] : 0.0));
        return thinnest;
    }

    /// Replaces the regions' pointers by lines of the drawing in the reader's faults.
    std::vector<Fault> seen_from_drawing(std::vector<Fault> faults,
                                         const std::vector<Soil>& soils) const {
        constexpr std::string_view regions = "/section/regions/";
        for (Fault& each : faults) {
            if (!each.pointer.starts_with(regions)) continue;
            const auto index = number_in(each.pointer.substr(
                regions.size(), each.pointer.find('/', regions.size()) - regions.size()));
            if (!index || *index >= static_cast<double>(soils.size())) continue;
            const Soil& soil = soils[static_cast<std::size_t>(*index)];
            each.pointer = at_line(soil.origin.line);
            each.cause = "region " + soil.name + " " + each.cause;
        }
        return faults;
    }

    /// Halves the cells for thin layers until the scene's check accepts them, at most to an eighth
    /// of an element. The report names layers that are still too thin.
    std::pair<Document, check::Checked> with_sound_cells(const std::vector<Soil>& soils) const {
        const auto is_coarse = [](const Fault& each) { return each.pointer == "/mpm/cell_size"; };
        constexpr double finest = 0.125;
        for (double share = 1.0;; share *= 0.5) {
            Document document = made(soils, share);
            check::Checked read = checked(document.scene);
            const auto coarse = std::ranges::find_if(read.faults, is_coarse);
            if (coarse == read.faults.end()) return {std::move(document), std::move(read)};
            if (share > finest) continue;
            document = made(soils, 1.0);
            document.scene["mpm"]["allow_coarse_cells"] = true;
            document.remarks.push_back("/mpm/cell_size " + coarse->cause +
                                       ": runouts will be questionable; merge thin layers, or give "
                                       "them fewer depths");
            read = checked(document.scene);
            return {std::move(document), std::move(read)};
        }
    }

    void finish(const std::vector<Soil>& soils) {
        auto [document, read] = with_sound_cells(soils);
        if (!read.faults.empty() && lines_.phreatic.empty() && document.scene.contains("lem")) {
            json without = document.scene;
            without.erase("lem");
            check::Checked again = checked(without);
            if (again.faults.empty()) {
                document.remarks.push_back("the scene has no /lem: " + read.faults.front().pointer +
                                           " " + read.faults.front().cause);
                std::erase_if(document.guessed.get_ref<json::array_t&>(), [](const json& each) {
                    return each.at("pointer").get<std::string>().starts_with("/lem");
                });
                document.scene = std::move(without);
                read = std::move(again);
            }
        }
        for (std::string& each : document.remarks) remark(std::move(each));
        for (const fault::Flag& each : read.scene.warnings)
            remark(each.pointer + ": " + each.message);
        result_.report["guessed"] = document.guessed;
        if (document.slope)
            result_.report["slope"] = {{"crest", as_json(document.slope->crest)},
                                       {"toe", as_json(document.slope->toe)}};
        result_.faults = seen_from_drawing(std::move(read.faults), soils);
        check_shape(soils, document.slope);
        for (const Fault& each : result_.to_confirm) result_.faults.push_back(each);
        result_.scene = std::move(document.scene);
        if (request_.motion) {
            result_.study = {{"format", "breachline-study/1"}, {"name", scene_name(request_)}};
            result_.study.update(json(earthquake::transfers_of(*request_.motion)));
            result_.motion = earthquake::text_of(*request_.motion);
        }
        result_.sketch = std::move(read.scene);
    }

    /// Keeps only the faults and the outlines as sent.
    void give_up() {
        result_.scene = nullptr;
        auto& faults = result_.faults;
        if (faults.size() > most_faults) {
            const std::size_t more = faults.size() - most_faults;
            faults.resize(most_faults);
            refuse("drawing", "has " + std::to_string(more) + " more faults",
                   "correct these, then import it again");
        }
        json draft{{"format", "breachline-scene/1"},
                   {"name", scene_name(request_)},
                   {"title", "What is wrong with " + as_utf8(request_.drawing.name)},
                   {"materials", materials_}};
        const std::string dumped = draft.dump(-1, ' ', false, json::error_handler_t::replace);
        result_.sketch = check::checked_text(dumped, request_.drawing.name, ".", {}).scene;
        result_.sketch.section.regions.clear();
        const auto& known = result_.sketch.materials;
        for (const Soil& each : soils_) {
            scene::Region region{};
            region.name = each.name;
            const auto at = std::ranges::find(known, each.material, &scene::Material::name);
            region.material = static_cast<std::size_t>(at - known.begin());
            region.polygon = each.ring;
            result_.sketch.section.regions.push_back(std::move(region));
        }
    }

    const Request& request_;
    const json& materials_;
    Imported result_;
    LayerMap map_;
    std::vector<LayerRequest> layers_;
    Drawing drawing_;
    std::map<Role, std::vector<Outline>> drawn_lines_;
    std::vector<Soil> soils_, drawn_;
    std::set<std::string> names_;
    Lines lines_;
    bool guesses_terrain_ = false;
};

}  // namespace

Imported import_section(const Request& request) { return Import(request).result(); }

}  // namespace breach::importing
