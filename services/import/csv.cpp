// Reads a section from a table of vertices. Spreadsheets write many dialects: separators, decimal
// commas, units in titles and a byte order mark are recognised, and what is ambiguous is refused.
#include "services/import/csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>

namespace breach::importing {

namespace {

constexpr const char* shape =
    "write a header region,x,y (or x,y for one line; x_ft,y_ft for feet), then one vertex a row";

/// Quotes as spreadsheets write them: "" within quotes is one quote. A quoted line break is not
/// read.
std::vector<std::string> fields_of(std::string_view row, char separator) {
    std::vector<std::string> fields;
    std::string field;
    bool quoted = false;
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (row[i] == '"') {
            if (quoted && i + 1 < row.size() && row[i + 1] == '"')
                field += row[++i];
            else
                quoted = !quoted;
        } else if (row[i] == separator && !quoted) {
            fields.emplace_back(trimmed(field));
            field.clear();
        } else {
            field += row[i];
        }
    }
    fields.emplace_back(trimmed(field));
    return fields;
}

/// Positions of the entries in a row.
struct Columns {
    std::optional<std::size_t> region, x, y;
    std::size_t count = 0;  ///< number of columns in the header
};

/// A column's name without its unit: "x" and "ft" of "x_ft", "X (ft)" and "x [feet]".
struct Title {
    std::string name, unit;
};

/// "x_ft" and "x_offset" look alike: the rest is a unit only if it is a known one, or in
/// brackets.
Title title_of(const std::string& column) {
    std::string name = lower(column);
    const std::size_t end = std::min(name.find_first_of("_ ([/"), name.size());
    std::string unit = name.substr(end);
    const bool in_brackets = unit.find_first_of("([") != std::string::npos;
    std::erase_if(unit, [](char each) {
        return std::string_view("_ ()[]/.").find(each) != std::string_view::npos;
    });
    if (unit.empty()) return {name.substr(0, end), ""};
    constexpr std::array<std::array<std::string_view, 2>, 11> spelt{{{"metres", "m"},
                                                                     {"meters", "m"},
                                                                     {"metre", "m"},
                                                                     {"meter", "m"},
                                                                     {"millimetres", "mm"},
                                                                     {"millimeters", "mm"},
                                                                     {"feet", "ft"},
                                                                     {"foot", "ft"},
                                                                     {"inches", "in"},
                                                                     {"inch", "in"},
                                                                     {"usft", "us-ft"}}};
    for (const auto& [word, symbol] : spelt)
        if (unit == word) unit = symbol;
    if (in_brackets || unit_named(unit)) return {name.substr(0, end), unit};
    return {name, ""};  // "x_offset" is another column
}

/// Positions of the columns with one of these names.
std::vector<std::size_t> columns_named(const std::vector<std::string>& header,
                                       std::initializer_list<std::string_view> names) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < header.size(); ++i)
        if (std::ranges::find(names, title_of(header[i]).name) != names.end()) found.push_back(i);
    return found;
}

/// "y and z"
std::string listed(const std::vector<std::string>& header,
                   const std::vector<std::size_t>& columns) {
    std::string all;
    for (const std::size_t each : columns) all += (all.empty() ? "" : " and ") + header[each];
    return as_utf8(std::string_view(all).substr(0, 60));
}

/// Reads line by line: the header first (columns_), then vertices. An outline is open (begun_)
/// from its first vertex to finish(). Stops at a header that is ambiguous, and at 100 faults.
class CsvReader {
  public:
    CsvReader(const LayerMap& layers, const std::optional<Unit>& asked, const std::string& alone)
        : layers_(layers), asked_(asked), unit_(asked.value_or(Unit{"m", 1.0})), alone_(alone) {}

    Drawing read(std::string_view text) {
        // Spreadsheets begin UTF-8 with a byte order mark; it would become part of the first title.
        if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
        while (!text.empty() && !stopped_) {
            const std::size_t end = text.find('\n');
            ++line_;
            take(trimmed(text.substr(0, end)));
            text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        }
        finish();
        drawing_.unit = unit_.name;
        if (!columns_) refuse("holds no table", shape);
        return std::move(drawing_);
    }

  private:
    /// At the line that is being read.
    void refuse(std::string cause, std::string remedy) {
        drawing_.faults.push_back({at_line(line_), std::move(cause), std::move(remedy)});
        stopped_ = drawing_.faults.size() >= 100;
    }

    /// A blank line ends an outline: a region may have several.
    void take(std::string_view row) {
        if (row.starts_with('#')) return;
        if (row.empty()) return finish();
        if (!columns_) return take_header(row);
        take_vertex(fields_of(row, separator_));
    }

    /// The column with one of these names; several are a fault.
    std::optional<std::size_t> only(const std::vector<std::string>& header,
                                    std::initializer_list<std::string_view> names,
                                    const std::string& meaning, const std::string& remedy) {
        const std::vector<std::size_t> found = columns_named(header, names);
        if (found.empty()) return std::nullopt;
        if (found.size() > 1) {
            refuse("the header names " + std::to_string(found.size()) + " columns of " + meaning +
                       ": " + listed(header, found),
                   remedy);
            stopped_ = true;
        }
        return found.front();
    }

    /// The separator is the first of tab, semicolon and comma that the header has.
    void take_header(std::string_view row) {
        for (const char each : {'\t', ';', ','})
            if (row.find(each) != std::string_view::npos) {
                separator_ = each;
                break;
            }
        const std::vector<std::string> names = fields_of(row, separator_);
        const Columns found{
            .region = only(names, {"region", "layer"}, "regions", "keep one column of regions"),
            .x = only(names, {"x"}, "x", "keep one, the distance along the section"),
            .y = only(names, {"y", "z"}, "levels",
                      "keep one column of levels and call it y; x is the distance along the "
                      "section"),
            .count = names.size()};
        columns_ = found;
        const bool whole = found.x && found.y && (found.region || !alone_.empty());
        if (whole) return take_unit(title_of(names[*found.x]), title_of(names[*found.y]));
        refuse("\"" + as_utf8(row.substr(0, 40)) + "\" does not name the columns " +
                   (alone_.empty() ? "region, x and y" : "x and y"),
               shape);
        stopped_ = true;
    }

    /// Both columns name one unit, or none does. A unit asked for must agree, instead of
    /// overruling the header in silence.
    void take_unit(const Title& x, const Title& y) {
        if (x.unit.empty() && y.unit.empty()) return;
        const auto stop = [&](std::string cause, std::string remedy) {
            refuse(std::move(cause), std::move(remedy));
            stopped_ = true;
        };
        const auto said = [](const Title& each) {
            return each.name +
                   (each.unit.empty() ? " without a unit" : " in " + as_utf8(each.unit));
        };
        const auto unit = unit_named(x.unit);
        if (x.unit != y.unit)
            return stop("the header gives " + said(x) + " and " + said(y),
                        "give x and y in one unit, and name it for both: x_ft,y_ft");
        if (!unit)
            return stop("\"" + as_utf8(x.unit) + "\" in the header is no unit",
                        "the units are " + unit_names());
        if (asked_ && asked_->name != unit->name)
            return stop("the header says that x and y are in " + unit->name +
                            ", and the unit asked for is " + asked_->name,
                        "leave --unit out, or correct the header");
        unit_ = *unit;
        drawing_.says_unit = true;
    }

    /// Decimal commas only where semicolons separate: else 1,5 is two fields.
    std::optional<double> number(const std::vector<std::string>& fields, std::size_t column) {
        if (column >= fields.size()) {
            refuse("has only " + std::to_string(fields.size()) + " columns", shape);
            return std::nullopt;
        }
        std::string field = fields[column];
        if (separator_ == ';') std::ranges::replace(field, ',', '.');
        const auto value = number_in(field);
        // Larger numbers are no coordinates; 1e300 would overflow in areas.
        if (value && std::abs(*value) < 1e12) return *value * unit_.metres;
        refuse("\"" + as_utf8(std::string_view(field).substr(0, 30)) + "\" is no number",
               "write coordinates as 12.5");
        return std::nullopt;
    }

    /// Whether the row has no more fields than the header, ignoring empty ones at its end.
    bool fits_header(const std::vector<std::string>& fields) {
        std::size_t count = fields.size();
        while (count > columns_->count && fields[count - 1].empty()) --count;
        if (count <= columns_->count) return true;
        refuse("has " + std::to_string(count) + " fields, and the header names " +
                   std::to_string(columns_->count) + " columns",
               "write 20.5 for 20,5, or separate the columns by ; or tabs where numbers have "
               "decimal commas; name what else the rows hold in the header");
        return false;
    }

    /// Checks the number of fields before their values, as a decimal comma between commas shifts
    /// all that follow.
    void take_vertex(const std::vector<std::string>& fields) {
        if (!fits_header(fields)) return;
        std::string layer = alone_;
        if (columns_->region && *columns_->region < fields.size())
            layer = as_utf8(fields[*columns_->region]);
        const auto x = number(fields, *columns_->x);
        const auto y = x ? number(fields, *columns_->y) : std::nullopt;
        if (!x || !y) return;
        if (layer.empty()) return refuse("names no region", shape);
        if (!begun_ || layer != current_.layer) {
            finish();
            begun_ = true;
            current_ = {layer, {}, false, {line_, "outline"}};
        }
        if (points_ + 1 > most_points) {
            refuse("more than " + std::to_string(most_points) + " points", "use fewer vertices");
            stopped_ = true;
            return;
        }
        ++points_;
        current_.points.emplace_back(*x, *y);
    }

    /// Ends an outline where the region changes, at a blank line and at the end.
    void finish() {
        if (!begun_) return;
        begun_ = false;
        if (drawing_.outlines.size() >= most_outlines) {
            refuse("more than " + std::to_string(most_outlines) + " outlines", "use fewer regions");
            stopped_ = true;
            return;
        }
        drawing_.layers.insert(current_.layer);
        const Role role = layers_.meaning_of(current_.layer).role;
        if (role == Role::none) return;
        if (role == Role::unknown) {
            UnknownLayer& unknown = drawing_.unknown[current_.layer];
            if (unknown.entities++ == 0)
                unknown.first = current_.points.front(), unknown.origin = current_.origin;
            return;
        }
        // A table has no mark for closed: what a layer means decides. A repeated first vertex,
        // which many programs write, is dropped.
        current_.closed = role == Role::soil;
        if (current_.closed && current_.points.size() > 1 &&
            current_.points.front() == current_.points.back())
            current_.points.pop_back();
        drawing_.outlines.push_back(current_);
    }

    const LayerMap& layers_;
    const std::optional<Unit>& asked_;
    Unit unit_;
    const std::string& alone_;
    Drawing drawing_;
    std::optional<Columns> columns_;
    char separator_ = ',';
    std::size_t line_ = 0, points_ = 0;
    Outline current_{};
    bool begun_ = false, stopped_ = false;
};

}  // namespace

Drawing read_csv(std::string_view text, const LayerMap& layers, const std::optional<Unit>& asked,
                 const std::string& alone) {
    return CsvReader(layers, asked, alone).read(text);
}

}  // namespace breach::importing
