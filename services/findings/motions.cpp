// For studies with one FEM per earthquake record: which measure of a record goes with liquefaction
// and runout. http_motions.cpp collects the FEMs for each request. Sentences are made here so that
// every view says the same.
#include "services/findings/motions.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/motion/measures.hpp"
#include "core/statistics/importance.hpp"
#include "core/words/number.hpp"

namespace breach::findings {

using nlohmann::json;

namespace {

using Values = std::vector<double>;

json as_json(const std::optional<statistics::Interval>& found) {
    if (!found) return nullptr;
    return {{"value", found->value}, {"low", found->low}, {"high", found->high}};
}

json correlation(const Values& measure, const Values& result) {
    const statistics::Drawn drawn{.name = "", .values = measure};
    return as_json(statistics::importance_of({&drawn, 1}, result).front().rank_correlation);
}

/// Motions with a runout.
/// A motion without a runout counts for the liquefied depth, not for the rest: its transfer never
/// came, or has not ended.
std::vector<Shaken> followed(const std::vector<Shaken>& shaken) {
    std::vector<Shaken> known;
    std::ranges::copy_if(shaken, std::back_inserter(known),
                         [](const Shaken& each) { return each.runout.has_value(); });
    return known;
}

template <class Of>
Values values_of(const std::vector<Shaken>& shaken, const Of& of) {
    Values values;
    for (const Shaken& each : shaken) values.push_back(of(each));
    return values;
}

/// 0 is a dam that stood, or soil that stayed short of the toe.
bool passed(const Shaken& each) { return *each.runout > 0.0; }

struct Probit {
    double a, b;        ///< P = Phi(a + b ln x)
    double aa, ab, bb;  ///< covariance
};

/// Maximum likelihood by Fisher scoring (Baker 2015, Earthquake Spectra 31). Nothing: a value
/// separates the motions that passed from the others, so that any large slope fits.
std::optional<Probit> probit(const Values& logs, const std::vector<bool>& yes) {
    const auto [least, most] = std::ranges::minmax(logs);
    Probit fit{.a = 0.0, .b = 0.0, .aa = 0.0, .ab = 0.0, .bb = 0.0};
    for (int step = 0; step < 100; ++step) {
        double waa = 0.0, wab = 0.0, wbb = 0.0, ga = 0.0, gb = 0.0;
        for (std::size_t k = 0; k < logs.size(); ++k) {
            const double z = fit.a + fit.b * logs[k];
            // Keeps the weights finite where a motion is far from the fitted curve.
            const double p = std::clamp(statistics::normal_cdf(z), 1e-12, 1.0 - 1e-12);
            const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::acos(-1.0));
            const double slope = ((yes[k] ? 1.0 : 0.0) - p) * density / (p * (1.0 - p));
            const double weight = density * density / (p * (1.0 - p));
            ga += slope, gb += slope * logs[k];
            waa += weight, wab += weight * logs[k], wbb += weight * logs[k] * logs[k];
        }
        const double determinant = waa * wbb - wab * wab;
        // All motions have nearly the same value: no slope can be found.
        if (!(determinant > 1e-12 * waa * wbb)) return std::nullopt;
        const double da = (wbb * ga - wab * gb) / determinant;
        const double db = (waa * gb - wab * ga) / determinant;
        fit = {fit.a + da, fit.b + db, wbb / determinant, -wab / determinant, waa / determinant};
        // The slope grows without end when a value separates the motions; 40 standard deviations
        // over the range are that case.
        if (std::abs(fit.b) * (most - least) > 40.0) return std::nullopt;
        if (std::abs(da) + std::abs(db) < 1e-9) return fit;
    }
    return std::nullopt;
}

/// median: half of the motions send soil past the toe; beta: standard deviation of ln x.
/// "refused" with the reason instead of a curve that the data do not support.
json fragility(const Values& measure, const std::vector<Shaken>& known) {
    const auto of = static_cast<std::size_t>(std::ranges::count_if(known, passed));
    const auto refused = [&](const char* why) { return json{{"refused", why}}; };
    if (of == 0) return refused("no motion sends soil past the toe");
    if (of == known.size()) return refused("every motion sends soil past the toe");
    if (std::ranges::min(measure) <= 0.0) return refused("a motion has a value of 0");
    Values logs;
    std::vector<bool> yes;
    for (std::size_t k = 0; k < known.size(); ++k) {
        logs.push_back(std::log(measure[k]));
        yes.push_back(passed(known[k]));
    }
    const auto fit = probit(logs, yes);
    if (!fit) return refused("one value separates the motions that send soil past the toe");
    if (fit->b <= statistics::normal_quantile_of_95 * std::sqrt(fit->bb))
        return refused("no significant effect of this measure");
    const double median = -fit->a / fit->b;
    // Delta method: d median = -(da + median db) / b.
    const double variance =
        (fit->aa + 2.0 * median * fit->ab + median * median * fit->bb) / (fit->b * fit->b);
    const double half = statistics::normal_quantile_of_95 * std::sqrt(std::max(variance, 0.0));
    // beta = 1 / b, because P = Phi((ln x - ln median) / beta).
    return {{"median", std::exp(median)},
            {"low", std::exp(median - half)},
            {"high", std::exp(median + half)},
            {"beta", 1.0 / fit->b}};
}

/// The depth with the fewest motions on its wrong side, midway between two motions.
json onset_of(std::vector<Shaken> known) {
    std::ranges::sort(known, {}, &Shaken::liquefaction_depth);
    auto wrong = std::ranges::count_if(known, [](const Shaken& each) { return !passed(each); });
    if (wrong == 0 || wrong == std::ssize(known)) return nullptr;
    json best;
    for (std::size_t k = 0; k + 1 < known.size(); ++k) {
        // At the start, the depth is above no motion: every motion that did not pass is wrong. Each
        // step moves one motion to the other side.
        wrong += passed(known[k]) ? 1 : -1;  // now below the depth
        const double low = known[k].liquefaction_depth, high = known[k + 1].liquefaction_depth;
        if (low == high || (!best.is_null() && wrong >= best.at("wrong"))) continue;
        best = {{"depth", 0.5 * (low + high)}, {"low", low}, {"high", high}, {"wrong", wrong}};
    }
    return best;
}

/// Least depth from which the runout has 90 % of its largest value, on the best non-decreasing fit
/// (pool adjacent violators, Ayer et al. 1955).
json saturation_of(std::vector<Shaken> known) {
    std::ranges::sort(known, {}, &Shaken::liquefaction_depth);
    if (std::ranges::count_if(known, passed) < 3) return nullptr;
    struct Block {
        double sum;
        std::size_t count, first;
        double mean() const { return sum / static_cast<double>(count); }
    };
    std::vector<Block> blocks;
    for (std::size_t k = 0; k < known.size(); ++k) {
        blocks.push_back({*known[k].runout, 1, k});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() >= blocks.back().mean()) {
            blocks[blocks.size() - 2].sum += blocks.back().sum;
            blocks[blocks.size() - 2].count += blocks.back().count;
            blocks.pop_back();
        }
    }
    const double largest = blocks.back().mean();
    const auto enough = std::ranges::find_if(
        blocks, [&](const Block& each) { return each.mean() >= 0.9 * largest; });
    return {{"depth", known[enough->first].liquefaction_depth}, {"runout", largest}};
}

std::string three_digits_of(const json& value) { return words::text_of(value.get<double>(), 3); }

std::string interval(const json& found) {
    return three_digits_of(found.at("value")) + " (" + three_digits_of(found.at("low")) + " to " +
           three_digits_of(found.at("high")) + ")";
}

/// -1 sorts a measure without a correlation behind all others.
double strength(const json& measure, const char* with) {
    return measure.at(with).is_null() ? -1.0 : std::abs(measure.at(with).at("value").get<double>());
}

/// The two measures that go best with one of the results.
std::string best_two(const json& measures, const char* with, const std::string& result) {
    std::vector<json> sorted = measures;
    std::ranges::stable_sort(sorted, std::greater(),
                             [&](const json& each) { return strength(each, with); });
    // The sentence names two; a single correlation is no comparison.
    if (strength(sorted[1], with) < 0.0) return "";
    const auto named = [&](const json& each) {
        return each.at("title").get<std::string>() + ", " + interval(each.at(with));
    };
    return result + " correlates best with " + named(sorted[0]) + ", then with " +
           named(sorted[1]) + " (rank correlation and its 90 % interval).";
}

std::vector<std::string> sentences_of(const json& found, std::size_t of, std::size_t known,
                                      std::size_t passing) {
    std::vector<std::string> sentences{
        std::to_string(passing) + " of " + std::to_string(known) +
        " motions send soil past the toe." +
        (known < of ? " Without a runout: " + std::to_string(of - known) + "." : "")};
    for (const auto& [with, result] :
         {std::pair{"with_depth", "Liquefaction depth"}, std::pair{"with_runout", "Runout"}})
        if (std::string said = best_two(found.at("measures"), with, result); !said.empty())
            sentences.push_back(std::move(said));
    if (const json& onset = found.at("onset"); !onset.is_null())
        sentences.push_back("Soil passes the toe from " + three_digits_of(onset.at("depth")) +
                            " m of liquefaction on (" + three_digits_of(onset.at("low")) + " to " +
                            three_digits_of(onset.at("high")) + "); " + onset.at("wrong").dump() +
                            " of " + std::to_string(known) + " motions contradict.");
    if (const json& end = found.at("saturation"); !end.is_null())
        sentences.push_back("From " + three_digits_of(end.at("depth")) +
                            " m of liquefaction on, the runout has 90 % of its largest, " +
                            three_digits_of(end.at("runout")) + " m past the toe.");
    for (const json& each : found.at("measures")) {
        const json& curve = each.at("fragility");
        if (each.at("name") != found.at("best") || curve.contains("refused")) continue;
        sentences.push_back(
            "At a " + each.at("title").get<std::string>() + " of " +
            three_digits_of(curve.at("median")) + " " + each.at("unit").get<std::string>() + " (" +
            three_digits_of(curve.at("low")) + " to " + three_digits_of(curve.at("high")) +
            ") half of these motions send soil past the toe. They are no "
            "sample of the site's earthquakes.");
    }
    return sentences;
}

json row_of(const Shaken& each) {
    json row{{"variant", each.variant},
             {"liquefaction_depth", each.liquefaction_depth},
             {"runout", each.runout ? json(*each.runout) : json()},
             {"lower_bound", each.lower_bound}};
    for (std::size_t m = 0; m < motion::named_measures.size(); ++m)
        row[motion::named_measures[m].name] = each.measures[m];
    return row;
}

}  // namespace

json motions_of(const std::vector<Shaken>& shaken) {
    const std::vector<Shaken> known = followed(shaken);
    const auto depth = [](const Shaken& each) { return each.liquefaction_depth; };
    const auto runout = [](const Shaken& each) { return *each.runout; };
    json found{{"rows", json::array()}, {"measures", json::array()}, {"best", nullptr}};
    for (const Shaken& each : shaken) found["rows"].push_back(row_of(each));
    for (std::size_t m = 0; m < motion::named_measures.size(); ++m) {
        const motion::NamedMeasure& measure = motion::named_measures[m];
        const auto own = [m](const Shaken& each) { return each.measures[m]; };
        json entry{{"name", measure.name},
                   {"title", measure.title},
                   {"unit", measure.unit},
                   {"with_depth", correlation(values_of(shaken, own), values_of(shaken, depth))},
                   {"with_runout", nullptr},
                   {"fragility", {{"refused", "too few runouts"}}}};
        if (known.size() >= fewest_motions) {
            entry["with_runout"] = correlation(values_of(known, own), values_of(known, runout));
            entry["fragility"] = fragility(values_of(known, own), known);
        }
        found["measures"].push_back(entry);
    }
    // By liquefaction, not by runout: every motion has a depth, only some have a runout.
    const auto best = std::ranges::max_element(
        found["measures"], {}, [](const json& each) { return strength(each, "with_depth"); });
    if (strength(*best, "with_depth") >= 0.0) found["best"] = best->at("name");
    found["onset"] = known.size() >= fewest_motions ? onset_of(known) : json();
    found["saturation"] = known.size() >= fewest_motions ? saturation_of(known) : json();
    found["sentences"] =
        sentences_of(found, shaken.size(), known.size(),
                     static_cast<std::size_t>(std::ranges::count_if(known, passed)));
    return found;
}

}  // namespace breach::findings
