#include "services/verify/page.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/exchange/publish.hpp"
#include "core/words/number.hpp"

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

std::string tolerances_of(const Case& of) {
    std::string text;
    for (const Quantity& each : of.quantities) {
        const std::string because = each.what + ": " + allowed_of(each) + ", " + each.because;
        if (text.find(because) == std::string::npos) text += (text.empty() ? "" : "; ") + because;
    }
    return text;
}

std::string line_of(const About& about) {
    return about.versions + "; " + about.machine +
           (about.quick ? "; --quick, without the slow cases" : "") + ".";
}

json as_json(const std::vector<Topic>& catalogue, const std::vector<Outcome>& outcomes,
             const About& about) {
    json all{{"versions", about.versions},
             {"machine", about.machine},
             {"quick", about.quick},
             {"cases", json::array()}};
    for (const Topic& topic : catalogue)
        for (const Outcome* each : of_topic(topic, outcomes)) {
            json one{{"id", each->of->id},
                     {"topic", topic.id},
                     {"cpu_seconds", each->cpu_seconds},
                     {"quantities", json::array()}};
            for (const Found& found : each->found)
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

/// One line each.
std::string slow_cases(const std::vector<Topic>& catalogue, const std::vector<Outcome>& outcomes) {
    std::string text;
    for (const Topic& topic : catalogue)
        for (const Case& each : topic.cases)
            if (std::ranges::none_of(outcomes, [&](const Outcome& one) { return one.of == &each; }))
                text += "- **" + each.id + "**: " + each.question + "\n";
    return text;
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

std::string as_markdown(const std::vector<Topic>& catalogue, const std::vector<Outcome>& outcomes,
                        const About& about) {
    std::string page =
        "# Verification\n\nWritten by `breach verify`: " + in_words(sum_of(outcomes)) + "\n" +
        line_of(about) + "\n";
    for (const Topic& topic : catalogue) {
        const auto own = of_topic(topic, outcomes);
        if (own.empty()) continue;
        page += "\n## " + topic.title + "\n\n" + (topic.text.empty() ? "" : topic.text + "\n\n");
        page += markdown_row(heads) + markdown_row(std::vector<std::string>(heads.size(), "---"));
        for (const auto& row : rows_of(own)) page += markdown_row(row);
        page += "\n";
        for (const Outcome* each : own)
            page += "- **" + each->of->id + "**: " + each->of->question + ". " + each->of->source +
                    " (" + each->of->kind + "). Allowed: " + tolerances_of(*each->of) + ".\n";
    }
    const std::string left_out = slow_cases(catalogue, outcomes);
    if (!left_out.empty())
        page += "\n## Left out\n\nSlow cases, which `--full` runs:\n\n" + left_out;
    return page;
}

void write_pages(const fs::path& folder, const std::vector<Topic>& catalogue,
                 const std::vector<Outcome>& outcomes, const About& about) {
    exchange::publish_text(folder / "index.md", as_markdown(catalogue, outcomes, about));
    exchange::publish_text(folder / "results.json",
                           as_json(catalogue, outcomes, about).dump(1) + "\n");
}

}  // namespace breach::verify
