// The lines of a section. Drawn lines come first, so that a file for a line that is drawn is the
// one refused. A file of its own is read as CSV with a layer of its own; its faults name the file,
// as line numbers alone would point into the drawing.
#include <algorithm>

#include "services/import/csv.hpp"
#include "services/import/dxf_records.hpp"
#include "services/import/join_lines.hpp"
#include "services/import/steps.hpp"

namespace breach::importing {

namespace {

/// A line's role, its words in messages, and its places in Lines and Request.
struct Kind {
    Role role;
    const char* layer;  ///< of a file of its own
    std::string word;
    std::vector<Vec2> Lines::*line;
    std::optional<Sent> Request::*sent;
};
const Kind kinds[]{
    {Role::phreatic, "phreatic", "phreatic line", &Lines::phreatic, &Request::phreatic},
    {Role::terrain, "terrain", "terrain", &Lines::terrain, &Request::terrain},
    {Role::ground, "ground", "ground line", &Lines::ground, &Request::ground}};

/// `file`: source of the line with a blank, if not the drawing.
/// Two pieces are refused, not joined over the gap: the line would be invented there.
void take_line(const std::vector<Outline>& pieces, const Kind& kind, const std::string& file,
               Lines& lines, Notes& notes) {
    if (pieces.empty()) return;
    const auto place = [&](const Outline& each) { return file + at_line(each.origin.line); };
    for (std::size_t i = 1; i < pieces.size(); ++i)
        notes.refuse(place(pieces[i]),
                     named(pieces[i]) + " at " + text(pieces[i].points.front()) +
                         " is another piece of the " + kind.word,
                     "draw the " + kind.word + " as one line");
    if (pieces.size() > 1) return;
    const Outline& only = pieces.front();
    std::vector<Vec2> line = only.points;
    if (only.closed || line.size() < 2)
        return notes.refuse(place(only),
                            named(only) + " at " + text(line.front()) +
                                (line.size() < 2 ? " is a point, no " : " is closed: no ") +
                                kind.word,
                            "draw it open, from left to right");
    if (line.front().x() > line.back().x()) std::ranges::reverse(line);
    for (std::size_t i = 1; i < line.size(); ++i)
        if (line[i].x() <= line[i - 1].x())
            notes.refuse(place(only), "the " + kind.word + " runs back at " + text(line[i]),
                         "a line has one level at every x: draw it from left to right");
    if (!(lines.*kind.line).empty())
        notes.refuse(place(only),
                     "the " + kind.word + " is drawn, and given as a file: " + text(line.front()),
                     "leave one of them out");
    lines.*kind.line = std::move(line);
}

/// A file that names no unit, beside a drawing in another one, is legal: it becomes a remark.
void read_line(const Sent& sent, const Kind& kind, const std::string& drawn_in, Lines& lines,
               Notes& notes) {
    const std::string file = as_utf8(sent.name) + " ", layer = kind.layer;
    if (const auto faults = form_faults(sent.bytes); !faults.empty()) {
        for (const Fault& each : faults)
            notes.refuse(file + each.pointer, each.cause, "give a text with columns x,y");
        return;
    }
    std::vector<Fault> none;
    const LayerMap own({layer + "=" + layer}, {}, none);
    Drawing read = read_csv(sent.bytes, own, unit_named(notes.request.unit), layer);
    for (Fault& each : read.faults) each.pointer = file + each.pointer;
    notes.add(read);
    if (notes.request.unit.empty() && !read.says_unit && drawn_in != read.unit)
        notes.remark(file + "was read in " + read.unit +
                     " because it names no unit, the drawing in " + drawn_in +
                     "; --unit sets that of both");
    if (read.faults.empty()) take_line(read.outlines, kind, file, lines, notes);
}

}  // namespace

Lines section_lines(Sorted& drawn, const std::string& drawn_in, Notes& notes) {
    Lines lines;
    for (const Kind& kind : kinds)
        take_line(joined(std::move(drawn.lines[kind.role]), notes.request.tolerance), kind, "",
                  lines, notes);
    for (const Kind& kind : kinds)
        if (const auto& sent = notes.request.*kind.sent)
            read_line(*sent, kind, drawn_in, lines, notes);
    return lines;
}

}  // namespace breach::importing
