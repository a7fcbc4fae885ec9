// Reads the outlines of a drawing. Layers have meanings by the user's map, or by materials'
// names; the reader takes polylines, lines and arcs of layers with a meaning, refuses what it
// cannot represent exactly (splines, blocks), and counts the rest. It collects faults instead of
// stopping, so that one pass shows all of them.
#include "services/import/dxf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "services/import/arcs.hpp"
#include "services/import/dxf_records.hpp"
#include "services/import/hatch.hpp"

namespace breach::importing {

namespace {

/// The import is refused already; the picture of the faults needs some line.
constexpr double flatten_meanwhile = 0.05;  // m: for drawing arcs that are refused
constexpr std::array<std::string_view, 6> shapes{"LWPOLYLINE", "POLYLINE", "LINE",
                                                 "ARC",        "CIRCLE",   "INSERT"};
/// Entities without soil; passing over them needs no word of the user's.
constexpr std::array<std::string_view, 19> writing{
    "TEXT",   "MTEXT",      "DIMENSION", "POINT",     "LEADER",           "MLEADER", "MULTILEADER",
    "ATTDEF", "ATTRIB",     "VIEWPORT",  "IMAGE",     "WIPEOUT",          "SEQEND",  "VERTEX",
    "SHAPE",  "ACAD_TABLE", "TOLERANCE", "OLE2FRAME", "ACAD_PROXY_ENTITY"};

template <class Words>
bool is_one_of(std::string_view word, const Words& words) {
    return std::ranges::find(words, word) != words.end();
}

/// State while reading: section_ is set by SECTION and cleared by ENDSEC; block_ is set by BLOCK
/// and cleared by ENDBLK; current_ and corners_ are the outline being read, from begin() to
/// finish(). An old POLYLINE stays open (in_polyline_) while its VERTEX records follow, and any
/// other record finishes it. The unit must be known before the first coordinate: settle_unit()
/// runs at the first entity.
class DxfReader {
  public:
    DxfReader(std::string_view text, const LayerMap& layers, const DxfOptions& request)
        : records_(text), layers_(layers), request_(request) {}

    Drawing read() {
        Record record;
        while (records_.next(record)) take(record);
        finish_polyline();
        for (const Fault& each : records_.faults()) drawing_.faults.push_back(each);
        settle_unit();
        refuse_bare_layers();
        tell_passed_over();
        return std::move(drawing_);
    }

  private:
    // ------------------------------------------------------------ sections

    void take(const Record& record) {
        if (record.type == "SECTION") {
            section_.clear();
            for (const Group& each : record.groups)
                if (each.code == 2) section_ = each.value;
            if (section_ == "HEADER") take_header(record);
        } else if (record.type == "ENDSEC") {
            finish_polyline();
            section_.clear();
        } else if (section_ == "TABLES" && record.type == "LAYER") {
            take_layer(record);
        } else if (section_ == "BLOCKS") {
            take_block(record);
        } else if (section_ == "ENTITIES") {
            settle_unit();
            take_entity(record);
        }
    }

    void take_header(const Record& record) {
        std::string_view variable;
        for (const Group& each : record.groups) {
            if (each.code == 9) {
                variable = each.value;
            } else if (variable == "$INSUNITS" && each.code == 70) {
                insunits_ = static_cast<int>(number_in(each.value).value_or(-1.0));
                insunits_line_ = each.line;
            }
        }
    }

    void settle_unit() {
        if (settled_) return;
        settled_ = true;
        const auto of_file = unit_of_code(insunits_);
        if (request_.unit) {
            unit_ = *request_.unit;
            if (of_file && of_file->name != unit_.name)
                drawing_.remarks.push_back("the drawing says that it is in " + of_file->name +
                                           " ($INSUNITS " + std::to_string(insunits_) +
                                           "); it was read in " + unit_.name + ", as asked for");
        } else if (of_file) {
            unit_ = *of_file;
        } else {
            const bool unitless = insunits_ == 0;
            drawing_.knows_unit = false;
            drawing_.faults.push_back(
                {at_line(std::max<std::size_t>(insunits_line_, 1)),
                 unitless ? "does not say its unit ($INSUNITS is absent or 0)"
                          : "is in a unit that no section is drawn in ($INSUNITS " +
                                std::to_string(insunits_) + ")",
                 "say it: unit m, mm or ft, for example"});
        }
        drawing_.unit = unit_.name;
    }

    void take_layer(const Record& record) {
        std::string name;
        bool hidden = false;
        for (const Group& each : record.groups) {
            if (each.code == 2) name = as_utf8(each.value);
            if (each.code == 62) hidden |= number_in(each.value).value_or(0.0) < 0.0;
            if (each.code == 70)
                hidden |=
                    (static_cast<long>(std::clamp(number_in(each.value).value_or(0.0), 0.0, 1e6)) &
                     1) != 0;
        }
        if (hidden) hidden_.insert(lower(name));
    }

    void take_block(const Record& record) {
        if (record.type == "BLOCK") {
            block_.clear();
            for (const Group& each : record.groups)
                if (each.code == 2) block_ = as_utf8(each.value);
        } else if (record.type == "ENDBLK") {
            block_.clear();
        } else if (!block_.empty() && !is_one_of(record.type, writing)) {
            const Role role = layers_.meaning_of(layer_of(record)).role;
            if (is_area(record.type) ? role == Role::soil : role != Role::unknown)
                meaningful_blocks_.insert(lower(block_));
        }
    }

    // ------------------------------------------------------------ entities

    static std::string layer_of(const Record& record) {
        for (const Group& each : record.groups)
            if (each.code == 8) return as_utf8(each.value);
        return "0";
    }

    static std::string entity_of(const Record& record) {
        std::string entity(record.type);
        for (const Group& each : record.groups)
            if (each.code == 5) return as_utf8(entity + " " + std::string(each.value));
        return as_utf8(entity);
    }

    double number(const Group& group) {
        const auto value = number_in(group.value);
        if (value && std::abs(*value) < 1e12) return *value;
        if (bad_numbers_++ < 20)
            drawing_.faults.push_back({at_line(group.line),
                                       "\"" + as_utf8(group.value.substr(0, 30)) +
                                           "\" is no number that a drawing can hold",
                                       "export the drawing again"});
        return 0.0;
    }

    double value_of(const Record& record, int code, double otherwise) {
        for (const Group& each : record.groups)
            if (each.code == code) return number(each);
        return otherwise;
    }

    Vec2 scaled(const Vec2& place) const { return unit_.metres * place; }

    void take_entity(const Record& record) {
        if (record.type == "VERTEX") return take_vertex(record);
        finish_polyline();
        if (record.type == "SEQEND") return;
        const std::string layer = layer_of(record);
        if (value_of(record, 67, 0.0) == 1.0) {
            ++passed_over_["entities of paper space"];
            return;
        }
        const Meaning meaning = layers_.meaning_of(layer);
        const bool area = is_area(record.type);
        if (is_one_of(record.type, writing) || (area && meaning.role != Role::soil))
            return pass_over(record, layer, meaning);
        // A hidden layer that the user maps by name is wanted.
        if (hidden_.contains(lower(layer)) && !meaning.told) {
            ++hidden_entities_[layer];
            return;
        }
        drawing_.layers.insert(layer);
        drawn_.insert(lower(layer));
        if (record.type == "INSERT") return take_insert(record, layer, meaning);
        if (meaning.role == Role::none) return;
        if (meaning.role == Role::unknown) return take_unknown(record, layer);
        if (!area && !is_one_of(record.type, shapes)) return refuse_entity(record, layer);
        if (drawing_.outlines.size() >= most_outlines || points_ >= most_points)
            return refuse_amount(record);
        area ? take_area(record, layer) : take_shape(record, layer);
    }

    void pass_over(const Record& record, const std::string& layer, const Meaning& meaning) {
        ++passed_over_[std::string(record.type)];
        if (meaning.role == Role::unknown || meaning.role == Role::none) return;
        UnknownLayer& bare = bare_[layer];
        if (bare.entities++ > 0) return;
        bare.first = first_point(record);
        bare.origin = {record.line, entity_of(record)};
    }

    /// A layer with a meaning, and nothing on it that could have it.
    void refuse_bare_layers() {
        for (const auto& [layer, bare] : bare_) {
            if (drawn_.contains(lower(layer))) continue;
            const bool soil = layers_.meaning_of(layer).role == Role::soil;
            drawing_.layers.insert(layer);
            drawing_.faults.push_back(
                {at_line(bare.origin.line),
                 "layer " + layer + (soil ? " has a material and no outline" : " has no line") +
                     ", only " + bare.origin.entity + " at " + text(bare.first) +
                     (bare.entities == 1 ? ""
                                         : " and " + std::to_string(bare.entities - 1) + " more"),
                 std::string("draw a ") + (soil ? "closed polyline" : "polyline") +
                     " on it, or map " + layer + "=none"});
        }
    }

    void take_unknown(const Record& record, const std::string& layer) {
        if (drawing_.unknown.size() >= most_outlines) return;
        UnknownLayer& unknown = drawing_.unknown[layer];
        if (unknown.entities++ == 0) {
            unknown.first = first_point(record);
            unknown.origin = {record.line, entity_of(record)};
        }
    }

    Vec2 first_point(const Record& record) {
        return scaled({value_of(record, 10, 0.0), value_of(record, 20, 0.0)});
    }

    void refuse_amount(const Record& record) {
        if (too_many_) return;
        too_many_ = true;
        drawing_.faults.push_back(
            {at_line(record.line),
             "the layers of the section hold more than " + std::to_string(most_outlines) +
                 " outlines or " + std::to_string(most_points) + " points",
             "leave only the section on them, in fewer vertices, and map others to none"});
    }

    void refuse_entity(const Record& record, const std::string& layer) {
        const bool curve = record.type == "SPLINE" || record.type == "ELLIPSE";
        drawing_.faults.push_back(
            {at_line(record.line),
             entity_of(record) + " on layer " + layer + " at " + text(first_point(record)) +
                 (curve ? " is a curve that has no exact polyline" : " is no polyline"),
             curve ? "convert it to a polyline in the drawing program (FLATTEN, PEDIT)"
                   : "redraw it as a closed polyline, or map its layer to none"});
    }

    void take_insert(const Record& record, const std::string& layer, const Meaning& meaning) {
        std::string block;
        for (const Group& each : record.groups)
            if (each.code == 2) block = as_utf8(each.value);
        const bool matters =
            (meaning.role != Role::unknown && meaning.role != Role::none) ||
            (meaningful_blocks_.contains(lower(block)) && meaning.role != Role::none);
        if (!matters) {
            ++passed_over_["INSERT"];
            return;
        }
        drawing_.faults.push_back({at_line(record.line),
                                   entity_of(record) + " on layer " + layer + " at " +
                                       text(first_point(record)) + " is the block \"" + block +
                                       "\", and holds part of the section",
                                   "explode the block in the drawing program"});
    }

    void take_shape(const Record& record, const std::string& layer) {
        if (record.type == "POLYLINE") return begin_polyline(record, layer);
        begin(record, layer, false);
        if (record.type == "LWPOLYLINE") {
            take_light_polyline(record);
        } else if (record.type == "LINE") {
            corners_ = {
                {{value_of(record, 10, 0.0), value_of(record, 20, 0.0)}, value_of(record, 30, 0.0)},
                {{value_of(record, 11, 0.0), value_of(record, 21, 0.0)},
                 value_of(record, 31, 0.0)}};
        } else {
            take_arc(record);
        }
        finish(record.type != "LINE");
    }

    void take_area(const Record& record, const std::string& layer) {
        const auto value = [&](const Group& group) { return number(group); };
        for (Boundary& each : boundaries_of(record, value)) {
            begin(record, layer, false);
            current_.closed = current_.fills = true;
            corners_ = std::move(each.corners);
            if (corners_.size() >= 3 || is_round(corners_)) {
                finish(record.type != "3DFACE");
                continue;
            }
            const Vec2 at = corners_.empty() ? each.at : corners_.front().at;
            drawing_.faults.push_back(
                {at_line(record.line),
                 named(current_) + " at " + text(scaled(at)) + " " + each.cause,
                 "draw its outline as a closed polyline"});
        }
    }

    static bool is_round(const std::vector<Corner>& corners) {
        return corners.size() == 2 && (corners[0].bulge != 0.0 || corners[1].bulge != 0.0);
    }

    void take_light_polyline(const Record& record) {
        for (const Group& each : record.groups) {
            if (each.code == 10) corners_.push_back({{number(each), 0.0}, 0.0, 0.0, each.line});
            if (corners_.empty()) continue;
            if (each.code == 20) corners_.back().at.y() = number(each);
            if (each.code == 42) corners_.back().bulge = number(each);
        }
        current_.closed = (flags_of(record) & 1) != 0;
    }

    void take_arc(const Record& record) {
        const Vec2 centre(value_of(record, 10, 0.0), value_of(record, 20, 0.0));
        const double radius = std::abs(value_of(record, 40, 0.0));
        constexpr double pi = std::numbers::pi;
        if (record.type == "CIRCLE") {
            corners_ = corners_of_arc(centre, radius, 0.0, 2.0 * pi);
            corners_.pop_back();
            current_.closed = true;
            return;
        }
        const double from = value_of(record, 50, 0.0) * pi / 180.0;
        const double angle =
            std::fmod(value_of(record, 51, 0.0) * pi / 180.0 - from + 8.0 * pi, 2.0 * pi);
        corners_ = corners_of_arc(centre, radius, from, angle);
    }

    long flags_of(const Record& record) {
        return static_cast<long>(std::clamp(value_of(record, 70, 0.0), 0.0, 1e6));
    }

    void begin_polyline(const Record& record, const std::string& layer) {
        begin(record, layer, true);
        const long flags = flags_of(record);
        current_.closed = (flags & 1) != 0;
        solid_ = (flags & 8) != 0;
        if ((flags & (4 | 16 | 64)) == 0) return;
        refuse_entity(record, layer);
        in_polyline_ = false;
    }

    void take_vertex(const Record& record) {
        if (!in_polyline_) return;
        const long flags = flags_of(record);
        if ((flags & 16) != 0) return;  // control point of a spline's frame
        corners_.push_back({{value_of(record, 10, 0.0), value_of(record, 20, 0.0)},
                            value_of(record, 30, 0.0),
                            value_of(record, 42, 0.0),
                            record.line});
        if (points_ + corners_.size() <= most_points) return;
        refuse_amount(record);
        in_polyline_ = false;
    }

    void begin(const Record& record, const std::string& layer, bool in_polyline) {
        current_ = {layer, {}, false, {record.line, entity_of(record)}};
        corners_.clear();
        in_polyline_ = in_polyline;
        solid_ = record.type == "LINE" || record.type == "3DFACE";
        mirrored_ = false;
        if (const double z = value_of(record, 230, 1.0); z != 1.0) mirrored_ = z == -1.0;
        const double aside =
            std::abs(value_of(record, 210, 0.0)) + std::abs(value_of(record, 220, 0.0));
        tilted_ = aside > 1e-6;
    }

    void finish_polyline() {
        if (!in_polyline_) return;
        in_polyline_ = false;
        finish(!solid_);
    }

    /// `own_plane`: coordinates in the entity's plane, which may face away.
    void finish(bool own_plane) {
        if (points_ + corners_.size() > most_points) corners_.resize(most_points - points_);
        double lowest = INFINITY, highest = -INFINITY;
        for (const Corner& each : corners_) {
            lowest = std::min(lowest, each.z);
            highest = std::max(highest, each.z);
        }
        if (tilted_ || (solid_ && highest - lowest > 1e-6 * (1.0 + std::abs(highest)))) {
            drawing_.faults.push_back(
                {at_line(current_.origin.line),
                 named(current_) + " at " +
                     text(corners_.empty() ? Vec2::Zero() : scaled(corners_.front().at)) +
                     " does not lie in the plane of the drawing",
                 "turn the section into the xy plane: x to the right, y up"});
            return;
        }
        if (own_plane && mirrored_)
            for (Corner& each : corners_) each.at.x() *= -1.0, each.bulge *= -1.0;
        bool refused = false;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const Corner& corner = corners_[i];
            current_.points.push_back(scaled(corner.at));
            const bool last = i + 1 == corners_.size();
            if (corner.bulge == 0.0 || (last && !current_.closed)) continue;
            const Vec2 to = scaled(corners_[(i + 1) % corners_.size()].at);
            if (!request_.flatten && !refused) {
                refused = true;
                drawing_.faults.push_back(
                    {at_line(corner.line > 0 ? corner.line : current_.origin.line),
                     named(current_) + " has an arc at " + text(current_.points.back()),
                     "say how far its chords may be off (flatten 0.05), or draw straight lines"});
            }
            for (const Vec2& each : points_on_arc(current_.points.back(), to, corner.bulge,
                                                  request_.flatten.value_or(flatten_meanwhile)))
                current_.points.push_back(each);
        }
        points_ += current_.points.size();
        if (current_.points.size() >= 2) drawing_.outlines.push_back(current_);
    }

    void tell_passed_over() {
        std::string list;
        for (const auto& [what, count] : passed_over_)
            list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + as_utf8(what);
        if (!list.empty()) drawing_.remarks.push_back("passed over: " + list);
        for (const auto& [layer, count] : hidden_entities_)
            drawing_.remarks.push_back("layer " + layer + " is frozen or off: its " +
                                       std::to_string(count) +
                                       " entities were left out; to take them, map the layer");
    }

    Records records_;
    const LayerMap& layers_;
    const DxfOptions& request_;
    Drawing drawing_;
    std::string section_;
    int insunits_ = 0;
    std::size_t insunits_line_ = 0;
    bool settled_ = false;
    Unit unit_{"m", 1.0};
    std::set<std::string> hidden_;
    std::map<std::string, std::size_t> hidden_entities_;
    std::map<std::string, std::size_t> passed_over_;
    std::map<std::string, UnknownLayer> bare_;  ///< layers with a meaning: what was passed over
    std::set<std::string> drawn_;               ///< lower-case layers of all other entities
    std::string block_;
    std::set<std::string> meaningful_blocks_;
    std::size_t points_ = 0;
    std::size_t bad_numbers_ = 0;
    bool too_many_ = false;
    Outline current_{};
    std::vector<Corner> corners_;
    bool in_polyline_ = false, solid_ = false, mirrored_ = false, tilted_ = false;
};

}  // namespace

Drawing read_dxf(std::string_view text, const LayerMap& layers, const DxfOptions& request) {
    return DxfReader(text, layers, request).read();
}

}  // namespace breach::importing
