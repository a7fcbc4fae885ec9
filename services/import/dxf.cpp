// Reads the outlines of a drawing. Layers have meanings by the user's map, or by materials'
// names; the reader takes polylines, lines and arcs of layers with a meaning, refuses what it
// cannot represent exactly (splines, blocks), and counts the rest. It collects faults instead of
// stopping, so that one pass shows all of them.
#include "services/import/dxf.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/words/list.hpp"
#include "services/import/dxf_outlines.hpp"
#include "services/import/hatch.hpp"

namespace breach::importing {

namespace {

/// INSERT is here because a block may hold part of the section; take_insert() decides.
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
        : records_(text),
          layers_(layers),
          asked_(request.unit),
          outlines_(drawing_, request.flatten) {}

    Drawing read() {
        Record record;
        while (records_.next(record)) take(record);
        outlines_.end_polyline();
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
            section_ = text_of(record, 2);
            if (section_ == "HEADER") take_header(record);
        } else if (record.type == "ENDSEC") {
            outlines_.end_polyline();
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

    /// In the header, code 9 names a variable and the groups after it are its values.
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

    /// A file without a unit goes on in metres, so that its other faults are found as well.
    void settle_unit() {
        if (settled_) return;
        settled_ = true;
        Unit unit{"m", 1.0};
        const auto of_file = unit_of_code(insunits_);
        if (asked_) {
            unit = *asked_;
            if (of_file && of_file->name != unit.name)
                drawing_.remarks.push_back("the drawing says that it is in " + of_file->name +
                                           " ($INSUNITS " + std::to_string(insunits_) +
                                           "); it was read in " + unit.name + ", as asked for");
        } else if (of_file) {
            unit = *of_file;
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
        drawing_.unit = unit.name;
        outlines_.metres = unit.metres;
    }

    /// Off: a negative colour (62). Frozen: bit 1 of the flags (70).
    void take_layer(const Record& record) {
        bool hidden = false;
        for (const Group& each : record.groups) {
            if (each.code == 62) hidden |= number_in(each.value).value_or(0.0) < 0.0;
            if (each.code == 70)
                hidden |=
                    (static_cast<long>(std::clamp(number_in(each.value).value_or(0.0), 0.0, 1e6)) &
                     1) != 0;
        }
        if (hidden) hidden_.insert(lower(text_of(record, 2)));
    }

    /// Blocks come before ENTITIES. What an INSERT places is not read; whether it holds soil
    /// decides if that is a fault.
    void take_block(const Record& record) {
        if (record.type == "BLOCK") {
            block_ = text_of(record, 2);
        } else if (record.type == "ENDBLK") {
            block_.clear();
        } else if (!block_.empty() && !is_one_of(record.type, writing)) {
            const Role role = layers_.meaning_of(layer_of(record)).role;
            if (is_area(record.type) ? role == Role::soil : role != Role::unknown)
                meaningful_blocks_.insert(lower(block_));
        }
    }

    // ------------------------------------------------------------ entities

    /// The order of the questions matters: paper space (67) and writing never count, hidden layers
    /// only if the user maps them, and a layer left out ("none") is still known to exist.
    void take_entity(const Record& record) {
        if (record.type == "VERTEX") return outlines_.take_vertex(record);
        outlines_.end_polyline();
        if (record.type == "SEQEND") return;
        const std::string layer = layer_of(record);
        if (outlines_.value_of(record, 67) == 1.0) {
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
        if (!area && !is_one_of(record.type, shapes)) return outlines_.refuse(record, layer);
        if (outlines_.is_full(record)) return;
        area ? outlines_.take_area(record, layer) : outlines_.take_shape(record, layer);
    }

    /// What is passed over on a layer with a meaning is remembered: if nothing else is drawn there,
    /// the layer was probably meant for an outline.
    void pass_over(const Record& record, const std::string& layer, const Meaning& meaning) {
        ++passed_over_[std::string(record.type)];
        if (meaning.role == Role::unknown) return;
        if (meaning.role == Role::none) {
            drawing_.layers.insert(layer);  // the user may map a layer of text to none
            return;
        }
        if (record.type != "TEXT" && record.type != "MTEXT") more_than_text_.insert(layer);
        count(bare_[layer], record);
    }

    /// Text on a layer named like a soil is its label. A layer named like the phreatic line is
    /// refused, because the dam would be dry.
    bool is_left_out(const std::string& layer, const Meaning& meaning) const {
        return !more_than_text_.contains(layer) && !meaning.told && meaning.role != Role::phreatic;
    }

    /// A layer with a meaning, and nothing on it that could have it.
    void refuse_bare_layers() {
        for (const auto& [layer, bare] : bare_) {
            if (drawn_.contains(lower(layer))) continue;
            const Meaning meaning = layers_.meaning_of(layer);
            if (is_left_out(layer, meaning)) {
                drawing_.remarks.push_back("layer " + layer + " has only text: it was left out");
                continue;
            }
            const bool soil = meaning.role == Role::soil;
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
        count(drawing_.unknown[layer], record);
    }

    void count(UnknownLayer& layer, const Record& record) {
        if (layer.entities++ > 0) return;
        layer.first = outlines_.first_point(record);
        layer.origin = {record.line, entity_of(record)};
    }

    /// A block on a layer left out ("none") is left out, too.
    void take_insert(const Record& record, const std::string& layer, const Meaning& meaning) {
        const std::string block = text_of(record, 2);
        const bool matters =
            (meaning.role != Role::unknown && meaning.role != Role::none) ||
            (meaningful_blocks_.contains(lower(block)) && meaning.role != Role::none);
        if (!matters) {
            ++passed_over_["INSERT"];
            return;
        }
        drawing_.faults.push_back({at_line(record.line),
                                   entity_of(record) + " on layer " + layer + " at " +
                                       text(outlines_.first_point(record)) + " is the block \"" +
                                       block + "\", and holds part of the section",
                                   "explode the block in the drawing program"});
    }

    /// Remarks, no faults: title blocks and dimensions are in nearly every drawing.
    void tell_passed_over() {
        const std::string list = words::list_of(passed_over_, [](const auto& each) {
            return std::to_string(each.second) + " " + as_utf8(each.first);
        });
        if (!list.empty()) drawing_.remarks.push_back("passed over: " + list);
        for (const auto& [layer, count] : hidden_entities_)
            drawing_.remarks.push_back("layer " + layer + " is frozen or off: its " +
                                       std::to_string(count) +
                                       " entities were left out; to take them, map the layer");
    }

    Records records_;
    const LayerMap& layers_;
    const std::optional<Unit> asked_;
    Drawing drawing_;
    DxfOutlines outlines_;
    std::string section_;
    int insunits_ = 0;
    std::size_t insunits_line_ = 0;
    bool settled_ = false;
    std::set<std::string> hidden_;
    std::map<std::string, std::size_t> hidden_entities_;
    std::map<std::string, std::size_t> passed_over_;
    std::map<std::string, UnknownLayer> bare_;  ///< layers with a meaning: what was passed over
    std::set<std::string> more_than_text_;      ///< those of them with other entities
    std::set<std::string> drawn_;               ///< lower-case layers of all other entities
    std::string block_;
    std::set<std::string> meaningful_blocks_;
};

}  // namespace

Drawing read_dxf(std::string_view text, const LayerMap& layers, const DxfOptions& request) {
    return DxfReader(text, layers, request).read();
}

}  // namespace breach::importing
