#include "services/report/chart/page.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <stdexcept>

#include "services/report/chart/draw.hpp"
#include "services/report/chart/frame.hpp"

namespace breach::report {

namespace {

constexpr const char* style =
    "body{font:16px/1.5 Helvetica,Arial,sans-serif;color:#222;max-width:1180px;margin:2em auto;"
    "padding:0 1em}h1,h2{line-height:1.2}h2{margin-top:2em;border-bottom:1px solid #ccc}"
    "figure{margin:1.5em 0}figure svg{max-width:100%;height:auto}figcaption{font-size:14px;"
    "color:#444}"
    ".wide{overflow-x:auto}table{border-collapse:collapse;font-size:14px}caption{text-align:left;"
    "font-weight:bold;padding:.4em 0}th,td{border-bottom:1px solid #ddd;padding:.2em .7em;"
    "text-align:left;vertical-align:top}td{max-width:24em;overflow-wrap:break-word}td.n{text-align:"
    "right;font-variant-numeric:tabular-nums;"
    "white-space:nowrap}a{color:#0059a0}"
    ".front>p.headline{font-size:1.25em;font-weight:bold;color:#222;margin:.3em "
    "0}.people{margin:.4em 0;font-size:14px}.people div{display:inline-block;margin-right:2em}"
    ".people dt,.people dd{display:inline;margin:0 .4em 0 0}.people dt{color:#444}"
    ".people dd{font-weight:bold}.front figure{margin:.6em 0}"
    ".front>p{color:#444}.front h2{margin:.7em 0 .2em;font-size:1.15em}.front ul{margin:.2em 0}"
    ".sign{margin-top:2.5em}.sign span{display:inline-block;width:30%;margin-right:2.5%;border-top:"
    "1px solid #222;font-size:13px;color:#444}nav ol{padding-left:1.4em}nav "
    "ul{padding-left:1.2em;color:#444;"
    "font-size:14px}"
    ".verdict{border-left:4px solid #3b7a8c;background:#eaf4f6;padding:.4em 1em}.verdict.doubt{"
    "border-color:#b3132b;background:#fdecea}.verdict h2{margin:.2em 0;border:0;font-size:1.1em}"
    ".verdict.unusable h2{background:#b3132b;color:#fff;padding:.2em .5em}"
    ".cautions{padding-left:2.2em}td.b{white-space:nowrap;font-weight:bold}"
    // Printed pages do not scroll: tables take the full width, wide ones are in landscape with
    // their chapter if it has nothing else, rows stay whole, and only long texts break anywhere.
    "@page{margin:12mm;@bottom-right{content:counter(page) ' / ' counter(pages);font:8pt "
    "Helvetica,Arial,sans-serif;color:#666}}@page wide{size:landscape}"
    "@media print{body{max-width:none;margin:0;padding:0;font-size:11pt}figure{break-inside:avoid}"
    "figcaption{font-size:9pt}h2,caption{break-after:avoid}tr,.sign{break-inside:avoid}"
    ".front{break-after:page;font-size:8.5pt;line-height:1.25}.front table,.front .verdict,"
    ".front .wide p{font-size:8pt;margin:.2em 0}h1{font-size:14pt;margin:0}.front>p{margin:.3em 0}"
    ".front td:nth-child(2){white-space:nowrap}.front>p.headline{font-size:11pt}.front "
    "figure{margin:.2em 0}"
    ".front figure svg{max-height:36mm}.people,.front li{font-size:8pt}.front h2{margin:.3em 0 "
    ".1em}"
    ".sign{margin-top:2.2em}nav>ol{columns:2}nav li{break-inside:avoid}"
    // Browsers ignore page numbers of targets; WeasyPrint writes them.
    "nav a::after{content:', page ' target-counter(attr(href),page)}"
    "section>figure svg{max-height:105mm}section>figure.drawing svg{max-height:150mm}nav{"
    "font-size:8.5pt;line-height:1.25}nav li ul{font-size:8pt}"
    ".wide{overflow:visible}.wide p{font-size:9pt}table{width:100%;font-size:8pt}td{max-width:none}"
    "th,td{padding:.15em "
    ".4em}td.long{overflow-wrap:anywhere;min-width:6em}td.long:first-child{min-width:11em}"
    ".opens{break-before:page}.opens>h2{margin-top:0}.opens>p,.cautions,.opens .wide p{"
    "font-size:8.5pt;line-height:1.35;margin:.3em 0}"
    "tbody tr:first-child{break-before:avoid}.many,.sheet{page:wide}.sheet "
    "table,.many table{font-size:6.5pt}.many th,.many td{padding:.15em .25em}.many "
    "td.long:first-child{min-width:6em}}";

constexpr std::size_t many = 9;        // columns that do not fit in portrait
constexpr std::size_t long_text = 12;  // characters of a text that may break

bool is_number(const std::string& text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

/// SVG inside HTML needs no namespace, whose URL would look like network access.
std::string inlined(std::string svg, const std::string& title) {
    const std::string space = "xmlns=\"http://www.w3.org/2000/svg\"";
    svg.replace(svg.find(space), space.size(),
                "role=\"img\" aria-label=\"" + escaped(title) + "\"");
    return svg;
}

std::string link(const std::string& file, const std::string& text) {
    std::string html = "<a href=\"";
    return html.append(escaped(file)).append("\">").append(text).append("</a>");
}

/// " data, SVG, PNG", linked; empty where there are no files.
std::string links_to(const std::string& folder, const std::string& name,
                     const std::vector<std::pair<const char*, const char*>>& kinds) {
    std::string html;
    if (folder.empty()) return html;
    for (const auto& [ending, text] : kinds)
        html.append(html.empty() ? " " : ", ").append(link(folder + "/" + name + ending, text));
    return html;
}

std::string anchor_of(std::size_t chapter) {
    std::string name = "chapter-";
    return name.append(std::to_string(chapter + 1));
}

void write_figure(std::ostream& html, const Figure& figure, const std::string& folder) {
    html << "<figure id=\"" << escaped(figure.name) << "\">\n"
         << inlined(as_svg(figure.chart), figure.chart.title) << "<figcaption>"
         << escaped(figure.caption)
         << links_to(folder, figure.name, {{".csv", "data"}, {".svg", "SVG"}, {".png", "PNG"}})
         << "</figcaption>\n</figure>\n";
}

/// Right-aligns numbers, also with a mark, and marks lower bounds.
const char* opening_of(const std::string& cell) {
    if (is_number(cell.ends_with(" *") ? cell.substr(0, cell.size() - 2) : cell))
        return "<td class=\"n\">";
    if (cell.starts_with("\u2265")) return "<td class=\"n b\">";
    return cell.size() > long_text ? "<td class=\"long\">" : "<td>";
}

void write_verdict(std::ostream& html, const Verdict& verdict) {
    if (verdict.cautions.empty() && verdict.notes.empty()) return;
    const bool caution = !verdict.cautions.empty();
    html << "<section id=\"verdict\" class=\"verdict" << (caution ? " doubt" : "")
         << (verdict.usable ? "" : " unusable") << "\"><h2>Verdict of the checks";
    if (!verdict.word.empty()) html << ": " << escaped(verdict.word);
    html << "</h2>\n<ul>\n";
    for (const auto* sentences : {&verdict.cautions, &verdict.notes}) {
        for (const std::string& each : *sentences) html << "<li>" << escaped(each) << "</li>\n";
    }
    html << "</ul></section>\n";
}

bool has_many(const std::vector<Table>& tables) {
    return std::ranges::any_of(tables,
                               [](const Table& each) { return each.columns.size() >= many; });
}

void write_table(std::ostream& html, const Table& table, const std::string& folder) {
    html << (table.columns.size() >= many ? "<div class=\"wide many\">" : "<div class=\"wide\">")
         << "<table id=\"" << escaped(table.name) << "\"><caption>" << escaped(table.title)
         << "</caption>\n<thead><tr>";
    for (const std::string& each : table.columns) html << "<th>" << escaped(each) << "</th>";
    html << "</tr></thead>\n<tbody>";
    for (const auto& row : table.rows) {
        html << "<tr>";
        for (const std::string& cell : row) {
            html << opening_of(cell) << escaped(cell) << "</td>";
        }
        html << "</tr>\n";
    }
    html << "</tbody></table>\n<p>" << escaped(table.caption)
         << links_to(folder, table.name, {{".csv", "data"}}) << "</p></div>\n";
}

void write_list(std::ostream& html, const std::string& title,
                const std::vector<std::string>& sentences) {
    if (sentences.empty()) return;
    html << "<h2>" << title << "</h2>\n<ul>\n";
    for (const std::string& each : sentences) html << "<li>" << escaped(each) << "</li>\n";
    html << "</ul>\n";
}

void write_front(std::ostream& html, const Document& document, const std::string& folder) {
    const Front& front = document.front;
    html << "<header class=\"front\">\n<h1>" << escaped(document.title) << "</h1>\n";
    if (!front.headline.empty())
        html << "<p class=\"headline\">" << escaped(front.headline) << "</p>\n";
    if (!front.people.empty()) {
        html << "<dl class=\"people\">";
        for (const auto& [what, who] : front.people)
            html << "<div><dt>" << what << "</dt><dd>" << escaped(who) << "</dd></div>";
        html << "</dl>\n";
    }
    for (const Figure& each : front.pictures) write_figure(html, each, folder);
    if (!front.of.empty()) html << "<p>" << escaped(front.of) << "</p>\n";
    write_list(html, "What was asked", front.asked);
    for (const Table* each : {&front.found, &front.gauges})
        if (!each->rows.empty()) write_table(html, *each, folder);
    write_verdict(html, document.verdict);
    std::vector<std::string> limits = front.limits;
    limits.insert(limits.end(), document.remarks.begin(), document.remarks.end());
    write_list(html, "Limits", limits);
    const auto signed_by = [&](const char* what, const std::string& who) {
        html << "<span>" << what << (who.empty() ? "" : ": ") << escaped(who) << "</span>";
    };
    html << "<div class=\"sign\">";
    signed_by("prepared by", front.author);
    signed_by("checked by", front.reviewer);
    html << "<span>date</span></div>\n</header>\n";
}

/// Chapters with their contents, all linked.
void write_contents(std::ostream& html, const std::vector<Chapter>& chapters) {
    html << "<nav><h2>Contents</h2><ol>\n";
    for (std::size_t i = 0; i < chapters.size(); ++i) {
        html << "<li>" << link("#" + anchor_of(i), escaped(chapters[i].title)) << "<ul>";
        for (const Figure& each : chapters[i].figures)
            html << "<li>" << link("#" + each.name, escaped(each.chart.title)) << "</li>";
        for (const Table& each : chapters[i].tables)
            html << "<li>" << link("#" + each.name, escaped(each.title)) << "</li>";
        html << "</ul></li>\n";
    }
    html << "</ol></nav>\n";
}

}  // namespace

std::string as_csv(const Table& table) {
    std::string csv;
    const auto add = [&](const std::vector<std::string>& cells) {
        if (cells.size() != table.columns.size()) {
            throw std::invalid_argument("a row of " + table.name + " has " +
                                        std::to_string(cells.size()) + " cells");
        }
        for (std::size_t i = 0; i < cells.size(); ++i) {
            if (i > 0) csv += ',';
            csv += is_number(cells[i]) ? cells[i] : quoted(cells[i]);
        }
        csv += '\n';
    };
    add(table.columns);
    for (const auto& row : table.rows) add(row);
    return csv;
}

std::string as_html(const Document& document, const std::string& figures) {
    std::ostringstream html;
    html << "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         << "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>"
         << escaped(document.title) << "</title>\n<style>" << style
         << "</style>\n</head>\n<body>\n";
    write_front(html, document, figures);
    write_contents(html, document.chapters);
    for (std::size_t i = 0; i < document.chapters.size(); ++i) {
        const Chapter& chapter = document.chapters[i];
        const bool sheet =
            chapter.figures.empty() && chapter.drawing.empty() && has_many(chapter.tables);
        html << "<section"
             << (sheet                ? " class=\"sheet\">"
                 : chapter.opens_page ? " class=\"opens\">"
                                      : ">")
             << "<h2 id=\"" << anchor_of(i) << "\">" << i + 1 << " " << escaped(chapter.title)
             << "</h2>\n";
        if (!chapter.text.empty()) html << "<p>" << escaped(chapter.text) << "</p>\n";
        if (!chapter.cautions.empty()) {
            html << "<ul class=\"verdict doubt cautions\">\n";
            for (const std::string& each : chapter.cautions)
                html << "<li>" << escaped(each) << "</li>\n";
            html << "</ul>\n";
        }
        if (!chapter.drawing.empty())
            html << "<figure class=\"drawing\">\n"
                 << inlined(chapter.drawing, "The section") << "</figure>\n";
        for (const Figure& each : chapter.figures) write_figure(html, each, figures);
        for (const Table& each : chapter.tables) write_table(html, each, figures);
        html << "</section>\n";
    }
    if (!document.left_out.empty()) {
        html << "<h2>Left out</h2>\n<ul>\n";
        for (const LeftOut& each : document.left_out) {
            html << "<li>" << escaped(each.what) << ": " << escaped(each.why) << "</li>\n";
        }
        html << "</ul>\n";
    }
    html << "</body>\n</html>\n";
    return html.str();
}

}  // namespace breach::report
