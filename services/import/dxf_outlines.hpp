// Inside services/import only: outlines of DXF entities. An old POLYLINE is several records: it
// stays open while its VERTEX records follow, and any other record ends it.
#pragma once

#include <optional>

#include "services/import/arcs.hpp"
#include "services/import/drawing.hpp"
#include "services/import/dxf_records.hpp"

namespace breach::importing {

/// The last value with this group code; empty: none.
std::string text_of(const Record& record, int code);
std::string layer_of(const Record& record);
/// "LWPOLYLINE 2F": type and handle.
std::string entity_of(const Record& record);

/// Adds outlines and faults to the drawing, up to the limits on both.
class DxfOutlines {
  public:
    DxfOutlines(Drawing& drawing, std::optional<double> flatten)
        : drawing_(drawing), flatten_(flatten) {}

    double metres = 1.0;  ///< per unit of the drawing; known at the first entity

    /// begin() to finish() for one record; a POLYLINE only begins.
    void take_shape(const Record& record, const std::string& layer);
    void take_area(const Record& record, const std::string& layer);
    void take_vertex(const Record& record);
    void end_polyline();
    /// Whether no further outline fits; the first time a fault.
    bool is_full(const Record& record);
    /// For an entity that is no polyline.
    void refuse(const Record& record, const std::string& layer);

    double value_of(const Record& record, int code, double otherwise = 0.0);
    /// The place of the entity [m].
    Vec2 first_point(const Record& record) { return metres * point(record, 10); }

  private:
    double number(const Group& group);
    Vec2 point(const Record& record, int code_of_x);
    long flags_of(const Record& record);
    void refuse_amount(const Record& record);
    void take_light_polyline(const Record& record);
    void take_arc(const Record& record);
    void begin(const Record& record, const std::string& layer);
    void finish(bool own_plane);

    Drawing& drawing_;
    std::optional<double> flatten_;
    std::size_t points_ = 0, bad_numbers_ = 0;
    bool too_many_ = false;
    // The outline between begin() and finish().
    Outline current_{};
    std::vector<Corner> corners_;
    bool open_ = false, solid_ = false, mirrored_ = false, tilted_ = false;
};

}  // namespace breach::importing
