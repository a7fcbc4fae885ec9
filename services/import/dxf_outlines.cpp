// Turns DXF entities into outlines: corners in the entity's own plane and in units of the drawing,
// then one pass (finish) that mirrors, scales and replaces arcs by chords. The group codes 210,
// 220, 230 are the direction from which an entity is seen: (0, 0, -1) mirrors x, any tilt is a
// fault.
#include "services/import/dxf_outlines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "services/import/hatch.hpp"
#include "services/import/numbers.hpp"

namespace breach::importing {

namespace {

/// The import is refused already; the picture of the faults needs some line.
constexpr double flatten_meanwhile = 0.05;  // m: for drawing arcs that are refused

/// Two corners enclose an area only if one side is an arc.
bool is_round(const std::vector<Corner>& corners) {
    return corners.size() == 2 && (corners[0].bulge != 0.0 || corners[1].bulge != 0.0);
}

}  // namespace

std::string text_of(const Record& record, int code) {
    std::string text;
    for (const Group& each : record.groups)
        if (each.code == code) text = as_utf8(each.value);
    return text;
}

/// The format's default: an entity without code 8 is on layer 0.
std::string layer_of(const Record& record) {
    for (const Group& each : record.groups)
        if (each.code == 8) return as_utf8(each.value);
    return "0";
}

/// The handle (code 5) is what a CAD program searches for; R12 files may have none.
std::string entity_of(const Record& record) {
    std::string entity(record.type);
    for (const Group& each : record.groups)
        if (each.code == 5) return as_utf8(entity + " " + std::string(each.value));
    return as_utf8(entity);
}

/// Bad numbers read as 0, and only the first 20 are reported: a broken export has thousands.
double DxfOutlines::number(const Group& group) {
    const auto value = number_in(group.value);
    if (value && std::abs(*value) < 1e12) return *value;
    if (bad_numbers_++ < 20)
        drawing_.faults.push_back(
            {at_line(group.line),
             "\"" + as_utf8(group.value.substr(0, 30)) + "\" is no number that a drawing can hold",
             "export the drawing again"});
    return 0.0;
}

double DxfOutlines::value_of(const Record& record, int code, double otherwise) {
    for (const Group& each : record.groups)
        if (each.code == code) return number(each);
    return otherwise;
}

Vec2 DxfOutlines::point(const Record& record, int code_of_x) {
    const double x = value_of(record, code_of_x);  // before y: faults in the order of the file
    return {x, value_of(record, code_of_x + 10)};
}

/// Bits of group 70. POLYLINE: 1 closed, 8 in space, 4, 16 and 64 fitted curves and meshes, which
/// are refused.
long DxfOutlines::flags_of(const Record& record) {
    return static_cast<long>(std::clamp(value_of(record, 70), 0.0, 1e6));
}

/// Once for a drawing: the next entity would repeat it.
void DxfOutlines::refuse_amount(const Record& record) {
    if (too_many_) return;
    too_many_ = true;
    drawing_.faults.push_back(
        {at_line(record.line),
         "the layers of the section hold more than " + std::to_string(most_outlines) +
             " outlines or " + std::to_string(most_points) + " points",
         "leave only the section on them, in fewer vertices, and map others to none"});
}

void DxfOutlines::refuse(const Record& record, const std::string& layer) {
    const bool curve = record.type == "SPLINE" || record.type == "ELLIPSE";
    drawing_.faults.push_back(
        {at_line(record.line),
         entity_of(record) + " on layer " + layer + " at " + text(first_point(record)) +
             (curve ? " is a curve that has no exact polyline" : " is no polyline"),
         curve ? "convert it to a polyline in the drawing program (FLATTEN, PEDIT)"
               : "redraw it as a closed polyline, or map its layer to none"});
}

void DxfOutlines::end_polyline() {
    if (std::exchange(open_, false)) finish(!solid_);
}

bool DxfOutlines::is_full(const Record& record) {
    if (drawing_.outlines.size() < most_outlines && points_ < most_points) return false;
    refuse_amount(record);
    return true;
}

void DxfOutlines::take_shape(const Record& record, const std::string& layer) {
    begin(record, layer);
    if (record.type == "POLYLINE") {
        const long flags = flags_of(record);
        current_.closed = (flags & 1) != 0;
        solid_ = (flags & 8) != 0;
        open_ = (flags & (4 | 16 | 64)) == 0;
        if (!open_) refuse(record, layer);
        return;
    }
    if (record.type == "LWPOLYLINE") {
        take_light_polyline(record);
    } else if (record.type == "LINE") {
        corners_ = {{point(record, 10), value_of(record, 30)},
                    {point(record, 11), value_of(record, 31)}};
    } else {
        take_arc(record);
    }
    finish(record.type != "LINE");
}

void DxfOutlines::take_area(const Record& record, const std::string& layer) {
    const auto value = [&](const Group& group) { return number(group); };
    for (Boundary& each : boundaries_of(record, value)) {
        begin(record, layer);
        current_.closed = current_.fills = true;
        corners_ = std::move(each.corners);
        if (corners_.size() >= 3 || is_round(corners_)) {
            finish(record.type != "3DFACE");
            continue;
        }
        const Vec2 at = corners_.empty() ? each.at : corners_.front().at;
        drawing_.faults.push_back({at_line(record.line),
                                   named(current_) + " at " + text(metres * at) + " " + each.cause,
                                   "draw its outline as a closed polyline"});
    }
}

/// Group 10 begins a vertex; 20 and 42 belong to the last one. Values before the first vertex
/// belong to the entity.
void DxfOutlines::take_light_polyline(const Record& record) {
    for (const Group& each : record.groups) {
        if (each.code == 10) corners_.push_back({{number(each), 0.0}, 0.0, 0.0, each.line});
        if (corners_.empty()) continue;
        if (each.code == 20) corners_.back().at.y() = number(each);
        if (each.code == 42) corners_.back().bulge = number(each);
    }
    current_.closed = (flags_of(record) & 1) != 0;
}

/// Angles are degrees, counter-clockwise; an arc from 350 to 10 passes 0, hence fmod().
void DxfOutlines::take_arc(const Record& record) {
    const Vec2 centre = point(record, 10);
    const double radius = std::abs(value_of(record, 40));
    constexpr double pi = std::numbers::pi;
    if (record.type == "CIRCLE") {
        corners_ = corners_of_arc(centre, radius, 0.0, 2.0 * pi);
        corners_.pop_back();
        current_.closed = true;
        return;
    }
    const double from = value_of(record, 50) * pi / 180.0;
    const double angle = std::fmod(value_of(record, 51) * pi / 180.0 - from + 8.0 * pi, 2.0 * pi);
    corners_ = corners_of_arc(centre, radius, from, angle);
}

/// A VERTEX without an open POLYLINE belongs to one that was passed over or refused.
void DxfOutlines::take_vertex(const Record& record) {
    if (!open_) return;
    const long flags = flags_of(record);
    if ((flags & 16) != 0) return;  // control point of a spline's frame
    corners_.push_back(
        {point(record, 10), value_of(record, 30), value_of(record, 42), record.line});
    if (points_ + corners_.size() <= most_points) return;
    refuse_amount(record);
    open_ = false;
}

/// LINE and 3DFACE have points in space; other entities have a plane with one elevation.
void DxfOutlines::begin(const Record& record, const std::string& layer) {
    current_ = {layer, {}, false, {record.line, entity_of(record)}};
    corners_.clear();
    open_ = false;
    solid_ = record.type == "LINE" || record.type == "3DFACE";
    mirrored_ = false;
    // The direction may be left out where it is (0, 0, 1).
    if (const double z = value_of(record, 230, 1.0); z != 1.0) mirrored_ = z == -1.0;
    const double aside = std::abs(value_of(record, 210)) + std::abs(value_of(record, 220));
    tilted_ = aside > 1e-6;
}

/// `own_plane`: coordinates in the entity's plane, which may face away.
void DxfOutlines::finish(bool own_plane) {
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
                 text(corners_.empty() ? Vec2::Zero() : Vec2(metres * corners_.front().at)) +
                 " does not lie in the plane of the drawing",
             "turn the section into the xy plane: x to the right, y up"});
        return;
    }
    if (own_plane && mirrored_)
        for (Corner& each : corners_) each.at.x() *= -1.0, each.bulge *= -1.0;
    bool refused = false;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Corner& corner = corners_[i];
        current_.points.push_back(metres * corner.at);
        const bool last = i + 1 == corners_.size();
        if (corner.bulge == 0.0 || (last && !current_.closed)) continue;
        const Vec2 to = metres * corners_[(i + 1) % corners_.size()].at;
        if (!flatten_ && !refused) {
            refused = true;
            drawing_.faults.push_back(
                {at_line(corner.line > 0 ? corner.line : current_.origin.line),
                 named(current_) + " has an arc at " + text(current_.points.back()),
                 "say how far its chords may be off (flatten 0.05), or draw straight lines"});
        }
        for (const Vec2& each : points_on_arc(current_.points.back(), to, corner.bulge,
                                              flatten_.value_or(flatten_meanwhile)))
            current_.points.push_back(each);
    }
    points_ += current_.points.size();
    if (current_.points.size() >= 2) drawing_.outlines.push_back(current_);
}

}  // namespace breach::importing
