#include "services/report/figures/uncertainty_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace breach::report {

using nlohmann::json;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double number_or_unknown(const json& value) {
    return value.is_number() ? value.get<double>() : unknown;
}

struct Along {
    const char* quantity;
    const char* words;
};
constexpr std::array along_x{Along{"largest_depth", "Largest depth"},
                             Along{"largest_velocity", "Largest depth-averaged velocity"},
                             Along{"largest_momentum_flux", "Largest momentum flux h v2"},
                             Along{"arrival", "First arrival"},
                             Along{"time_of_peak", "Time of the largest depth"},
                             Along{"final_depth", "Final deposit"}};

/// p50 where it exists. The line ends where it is missing: the flow does not arrive in half of the
/// samples.
Series median_of(const std::vector<double>& x, const json& band) {
    Series series{"p50, between p10 and p90", {}, {}, Style::line};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double p50 = number_or_unknown(band.at("p50")[i]);
        if (std::isnan(p50)) continue;
        const double low = number_or_unknown(band.at("p10")[i]);
        const double high = number_or_unknown(band.at("p90")[i]);
        const bool both = !std::isnan(low) && !std::isnan(high);
        series.x.push_back(x[i]);
        series.y.push_back(p50);
        series.low.push_back(both ? low : unknown);
        series.high.push_back(both ? high : unknown);
    }
    return series;
}

Series line_of(const std::string& name, const std::vector<double>& x, const json& values) {
    Series series{name, {}, {}, Style::line};
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double y = number_or_unknown(values[i]);
        if (std::isnan(y)) continue;
        series.x.push_back(x[i]);
        series.y.push_back(y);
    }
    return series;
}

}  // namespace

Figure exceedance_figure(const json& quantity, const std::string& label,
                         std::optional<double> bound_from) {
    Series curve{quantity.at("count").dump() + " of " + quantity.at("of").dump() + " samples",
                 {},
                 {},
                 Style::line};
    const auto add = [&](const json& value, const json& at) {
        curve.x.push_back(value);
        curve.y.push_back(at.at("probability"));
        curve.low.push_back(at.at("low"));
        curve.high.push_back(at.at("high"));
    };
    const json* before = nullptr;
    for (const json& each : quantity.at("exceedance")) {
        if (before) add(each.at("value"), *before);  // the share is constant up to the next value
        add(each.at("value"), each);
        before = &each;
    }
    // With 90 % confidence at most this share of all values is above the largest of n samples.
    const double count = quantity.at("count");
    const double beyond = 100.0 * (1.0 - std::pow(0.1, 1.0 / count));
    Figure figure{"exceedance",
                  {"Probability of more", {label}, {"probability of more [-]"}, {curve}},
                  "Share of the samples that exceed a value, with its 90 % interval. Larger values "
                  "are possible: up to " +
                      rounded(beyond, 2) +
                      " % of them may lie beyond the largest sample (90 % confidence)."};
    if (bound_from) {
        figure.chart.marks.push_back({Mark::At::x, *bound_from, "from here a lower bound"});
        figure.caption +=
            " From the mark on the curve is a lower bound: samples were stopped there while their "
            "soil still moved.";
    }
    return figure;
}

std::optional<Figure> tornado_figure(const json& quantity, const std::string& label) {
    const json& tornado = quantity.at("tornado");
    if (tornado.contains("refused")) return {};
    const double middle = tornado.at("at_median");
    std::vector<json> bars = tornado.at("bars");
    const auto reach = [&](const json& bar) {
        const double a = bar.at("p10"), b = bar.at("p90");
        return std::max({a, b, middle}) - std::min({a, b, middle});
    };
    std::ranges::stable_sort(bars, {}, reach);  // the last bar is on top
    Series at_p10{"parameter at its p10", {}, {}, Style::bars};
    Series at_p90{"parameter at its p90", {}, {}, Style::bars};
    Axis names{""};
    for (std::size_t i = 0; i < bars.size(); ++i) {
        names.names.push_back(bars[i].at("parameter"));
        for (auto [series, key] : {std::pair{&at_p10, "p10"}, std::pair{&at_p90, "p90"}}) {
            series->x.insert(series->x.end(), {middle, bars[i].at(key).get<double>()});
            series->y.insert(series->y.end(), 2, static_cast<double>(i));
        }
    }
    return Figure{"tornado",
                  {"One parameter at a time",
                   {label},
                   names,
                   {at_p10, at_p90},
                   {{Mark::At::x, middle, "all at their medians"}}},
                  "From a surrogate fitted to the samples, Q2 = " +
                      rounded(tornado.at("q2").get<double>(), 2) +
                      " by cross-validation: each parameter from its p10 to its p90, the others at "
                      "their medians. It is the surrogate's answer, not a run's."};
}

namespace {

/// " of 64", and that the other samples are excluded; "": there are no others.
std::string without_envelope(const json& envelopes) {
    const std::size_t others = envelopes.value("left_out", json::array()).size();
    if (others == 0) return "";
    const auto all = envelopes.at("samples").get<std::size_t>() + others;
    return " of " + std::to_string(all) +
           " (the percentiles leave out the others, such as dams that did not fail)";
}

}  // namespace

std::vector<Figure> envelope_figures(const json& envelopes) {
    std::vector<Figure> figures;
    const std::vector<double> x = envelopes.at("x");
    const json& bands = envelopes.at("bands");
    for (const auto& [quantity, words] : along_x) {
        if (!bands.contains(quantity)) continue;
        const json& band = bands.at(quantity);
        const std::string unit = band.at("unit");
        Figure figure{std::string("envelope_") + quantity,
                      {std::string(words) + " along x",
                       {"x [m]"},
                       {std::string(words) + " [" + unit + "]"},
                       {}},
                      ""};
        for (Series& each : std::vector{median_of(x, band), line_of("p10", x, band.at("p10")),
                                        line_of("p90", x, band.at("p90"))})
            if (!each.x.empty()) figure.chart.series.push_back(std::move(each));
        if (figure.chart.series.empty()) continue;
        const bool time = unit == "s";
        const std::size_t least =
            std::ranges::min(band.at("rests_on").get<std::vector<std::size_t>>());
        figure.caption =
            "Over " + envelopes.at("samples").dump() + " samples" + without_envelope(envelopes) +
            (time ? ". One that the flow never came to arrives after all others, so that a "
                    "percentile ends where too few came; at the far end " +
                        std::to_string(least) + " did."
                  : "; where the flow of a sample never came it is 0 there.");
        figures.push_back(std::move(figure));
    }
    return figures;
}

}  // namespace breach::report
