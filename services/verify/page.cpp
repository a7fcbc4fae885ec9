#include "services/verify/page.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/exchange/publish.hpp"
#include "core/words/number.hpp"
#include "services/report/chart/page.hpp"
#include "services/report/section/section_drawing.hpp"

namespace breach::verify {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

std::string digits(double value, int count) { return words::text_of(value, count); }

std::string difference_of(const Found& found) {
    if (!found.value) return "-";
    const bool relative = found.quantity->relative && found.quantity->right != 0.0;
    const double shown = relative ? 100.0 * found.difference() / std::abs(found.quantity->right)
                                  : found.difference();
    return (shown > 0.0 ? "+" : "") + digits(shown, 2) + (relative ? " %" : "");
}

std::string allowed_of(const Quantity& quantity) {
    return quantity.relative ? digits(100.0 * quantity.allowed, 2) + " %"
                             : digits(quantity.allowed, 2);
}

std::vector<const Outcome*> of_topic(const Topic& topic, const std::vector<Outcome>& outcomes) {
    std::vector<const Outcome*> own;
    for (const Outcome& each : outcomes)
        if (std::ranges::any_of(topic.cases, [&](const Case& one) { return &one == each.of; }))
            own.push_back(&each);
    return own;
}

const std::vector<std::string> heads{"case",       "quantity", "right", "here",
                                     "difference", "allowed",  "",      "CPU s"};

std::vector<std::vector<std::string>> rows_of(const std::vector<const Outcome*>& outcomes) {
    std::vector<std::vector<std::string>> rows;
    for (const Outcome* each : outcomes)
        for (const Found& found : each->found)
            rows.push_back({each->of->id, found.quantity->what, digits(found.quantity->right, 5),
                            found.value ? digits(*found.value, 5) : found.problem,
                            difference_of(found), allowed_of(*found.quantity),
                            found.passed() ? "passed" : "**failed**",
                            digits(each->cpu_seconds, 2)});
    return rows;
}

/// difference| from the right value against CPU seconds; nothing: no right value is above zero.
std::optional<report::Figure> error_figure(const Topic& topic,
                                           const std::vector<const Outcome*>& outcomes) {
    constexpr double least = 1e-8;  // exact results are drawn here [%]
    report::Series passed{"passed", {}, {}, report::Style::points},
        failed{"failed", {}, {}, report::Style::points};
    for (const Outcome* each : outcomes)
        for (const Found& found : each->found) {
            if (!found.value || found.quantity->right == 0.0 || each->cpu_seconds <= 0.0) continue;
            report::Series& series = found.passed() ? passed : failed;
            series.x.push_back(each->cpu_seconds);
            series.y.push_back(
                std::max(100.0 * std::abs(found.difference() / found.quantity->right), least));
        }
    report::Chart chart{topic.title + ": error against run time",
                        {"CPU time of the case [s]", report::Scale::logarithmic},
                        {"error [%]", report::Scale::logarithmic},
                        {}};
    for (report::Series* each : {&passed, &failed})
        if (!each->x.empty()) chart.series.push_back(std::move(*each));
    if (chart.series.empty()) return std::nullopt;
    return report::Figure{"error_" + topic.id, std::move(chart),
                          "One point per comparison; exact results are drawn at 1e-8 %."};
}

std::string drawing_of(const Case& of) {
    if (of.scene.empty()) return "";
    std::ifstream stream(of.scene);
    const json scene = json::parse(stream, nullptr, false);
    if (!scene.is_object()) return "";
    report::BaseScene base{.scene = scene, .overrides = {}, .pointer = ""};
    check::Checked checked =
        check::checked_document(base.scene, of.scene.string(), of.scene.parent_path(), {});
    const report::Draft draft = report::draft_of(std::move(base), std::move(checked));
    return report::can_be_drawn(draft) ? report::as_svg(draft, {}) : "";
}

std::string tolerances_of(const Case& of) {
    std::string text;
    for (const Quantity& each : of.quantities) {
        const std::string because =
            each.what + ": " + allowed_of(each) + ", " + each.because + ". ";
        if (text.find(because) == std::string::npos) text += because;
    }
    return text;
}

report::Chapter chapter_of(const Outcome& outcome) {
    report::Chapter chapter{outcome.of->id + ": " + outcome.of->question};
    chapter.text = "Source (" + outcome.of->kind + "): " + outcome.of->source +
                   ". Allowed: " + tolerances_of(*outcome.of);
    chapter.drawing = drawing_of(*outcome.of);
    chapter.tables.push_back(
        {"case_" + outcome.of->id, outcome.of->id, heads, rows_of({&outcome})});
    return chapter;
}

std::string line_of(const About& about) {
    return about.versions + "; " + about.machine +
           (about.quick ? "; --quick, without the slow cases" : "") + ".";
}

json as_json(const std::vector<Outcome>& outcomes, const About& about) {
    json all{{"versions", about.versions},
             {"machine", about.machine},
             {"quick", about.quick},
             {"cases", json::array()}};
    for (const Outcome& each : outcomes) {
        json one{
            {"id", each.of->id}, {"cpu_seconds", each.cpu_seconds}, {"quantities", json::array()}};
        for (const Found& found : each.found)
            one["quantities"].push_back(
                {{"what", found.quantity->what},
                 {"right", found.quantity->right},
                 {"value", found.value ? json(*found.value) : json()},
                 {"problem", found.problem},
                 {"used", std::isfinite(found.used()) ? json(found.used()) : json()},
                 {"passed", found.passed()}});
        all["cases"].push_back(std::move(one));
    }
    return all;
}

std::string markdown_row(const std::vector<std::string>& cells) {
    std::string row = "|";
    for (const std::string& each : cells) row += " " + each + " |";
    return row + "\n";
}

}  // namespace

Sum sum_of(const std::vector<Outcome>& outcomes) {
    Sum sum;
    for (const Outcome& each : outcomes) {
        sum.cpu_seconds += each.cpu_seconds;
        for (const Found& found : each.found) {
            ++sum.comparisons;
            sum.passed += found.passed() ? 1 : 0;
            if (found.value) sum.worst = std::max(sum.worst, found.used());
        }
    }
    return sum;
}

std::string in_words(const Sum& sum) {
    return std::to_string(sum.passed) + " of " + std::to_string(sum.comparisons) +
           " comparisons pass; the worst uses " + digits(100.0 * sum.worst, 3) +
           " % of what is allowed; " + digits(sum.cpu_seconds, 3) + " CPU seconds.";
}

report::Document document_of(const std::vector<Topic>& catalogue,
                             const std::vector<Outcome>& outcomes, const About& about) {
    report::Document document{"Verification", {in_words(sum_of(outcomes)), line_of(about)}, {}, {}};
    for (const Topic& topic : catalogue) {
        const auto own = of_topic(topic, outcomes);
        if (own.empty()) continue;
        report::Chapter chapter{topic.title};
        chapter.text = topic.text;
        chapter.tables.push_back({"comparisons_" + topic.id, topic.title, heads, rows_of(own)});
        if (auto figure = error_figure(topic, own)) chapter.figures.push_back(std::move(*figure));
        document.chapters.push_back(std::move(chapter));
    }
    for (const Topic& topic : catalogue)
        for (const Outcome* each : of_topic(topic, outcomes))
            document.chapters.push_back(chapter_of(*each));
    for (const Topic& topic : catalogue)
        for (const Case& each : topic.cases)
            if (std::ranges::none_of(outcomes, [&](const Outcome& one) { return one.of == &each; }))
                document.left_out.push_back(
                    {each.id + ": " + each.question, "slow; --full runs it"});
    return document;
}

std::string as_markdown(const std::vector<Topic>& catalogue, const std::vector<Outcome>& outcomes,
                        const About& about, const std::string& figures) {
    std::string page =
        "# Verification\n\nWritten by `breach verify`: " + in_words(sum_of(outcomes)) + "\n" +
        line_of(about) + "\n";
    for (const Topic& topic : catalogue) {
        const auto own = of_topic(topic, outcomes);
        if (own.empty()) continue;
        page += "\n## " + topic.title + "\n\n" + (topic.text.empty() ? "" : topic.text + "\n\n");
        if (error_figure(topic, own))
            page += "![error against run time](" + figures + "/error_" + topic.id + ".svg)\n\n";
        page += markdown_row(heads) + markdown_row(std::vector<std::string>(heads.size(), "---"));
        for (const auto& row : rows_of(own)) page += markdown_row(row);
        page += "\n";
        for (const Outcome* each : own)
            page += "- **" + each->of->id + "**: " + each->of->question + ". " + each->of->source +
                    " (" + each->of->kind + ").\n";
    }
    return page;
}

void write_pages(const fs::path& folder, const std::vector<Topic>& catalogue,
                 const std::vector<Outcome>& outcomes, const About& about) {
    const report::Document document = document_of(catalogue, outcomes, about);
    std::vector<report::Figure> figures;
    for (const report::Chapter& each : document.chapters)
        figures.insert(figures.end(), each.figures.begin(), each.figures.end());
    report::write_figures(folder / "figures", figures);
    exchange::publish_text(folder / "index.html", report::as_html(document, "figures"));
    exchange::publish_text(folder / "index.md", as_markdown(catalogue, outcomes, about, "figures"));
    exchange::publish_text(folder / "results.json", as_json(outcomes, about).dump(1) + "\n");
}

}  // namespace breach::verify
