// Values of samples from the plan alone: plan, seed and number give the same values on every
// machine. More samples later keep the first ones, so that an extended run reuses its results.
#include "services/orchestrator/study/samples.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/statistics/points.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

/// The last option takes what rounding leaves over.
double place_of_choice(const std::vector<Choice>& choices, double u) {
    double all = 0.0;
    for (const Choice& each : choices) all += each.weight;
    double below = 0.0;
    for (std::size_t i = 0; i + 1 < choices.size(); ++i) {
        below += choices[i].weight / all;
        if (u < below) return static_cast<double>(i);
    }
    return static_cast<double>(choices.size() - 1);
}

/// Whole hypercubes are drawn and cut to the number wanted: an extension goes on in the same block.
statistics::Points points_of(const UncertaintyPlan& plan, std::size_t count) {
    const std::size_t dimensions = plan.parameters.size();
    const statistics::Matrix wanted = correlation_matrix(plan);
    if (plan.sampling == Sampling::sobol) {
        statistics::Points points = statistics::sobol_points(count, dimensions, plan.seed);
        if (!plan.correlations.empty()) statistics::couple(points, wanted);
        return points;
    }
    const std::vector<std::size_t> ends = statistics::blocks_of(count, plan.first);
    statistics::Points points =
        statistics::latin_hypercube(ends.back(), plan.first, dimensions, plan.seed);
    std::size_t from = 0;
    for (const std::size_t to : ends) {
        // Block by block, so that a later block does not move the samples of an earlier one.
        statistics::correlate(points, from, to, wanted);
        from = to;
    }
    points.resize(count);
    return points;
}

}  // namespace

double draw_at(const Parameter& parameter, double u) {
    switch (parameter.kind) {
        case ParameterKind::choice:
            return place_of_choice(parameter.choices, u);
        case ParameterKind::numerical:
            return std::min(static_cast<double>(parameter.lattices - 1),
                            std::floor(u * static_cast<double>(parameter.lattices)));
        case ParameterKind::factor:
        case ParameterKind::value:
            break;
    }
    // Rounded first: the number is stored as text and must be the same when it is read again.
    const double value = statistics::in_six_digits(statistics::quantile(parameter.distribution, u));
    const auto& between = parameter.distribution.between;
    // Rounding may step over a bound.
    return between ? std::clamp(value, (*between)[0], (*between)[1]) : value;
}

std::vector<DrawnSample> samples_of(const UncertaintyPlan& plan, std::size_t count) {
    std::vector<DrawnSample> samples;
    for (const std::vector<double>& point : points_of(plan, count)) {
        DrawnSample sample{.number = samples.size() + 1, .draws = {}};
        for (std::size_t k = 0; k < point.size(); ++k)
            sample.draws.push_back(draw_at(plan.parameters[k], point[k]));
        samples.push_back(std::move(sample));
    }
    return samples;
}

std::string name_of_sample(std::size_t number) {
    std::string digits = std::to_string(number);
    if (digits.size() < 4) digits.insert(0, 4 - digits.size(), '0');
    return "s" + digits;
}

json values_of(const UncertaintyPlan& plan, const DrawnSample& sample) {
    json values = json::object();
    for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
        const Parameter& parameter = plan.parameters[k];
        const double draw = sample.draws[k];
        if (parameter.kind == ParameterKind::choice)
            values[parameter.name] = parameter.choices[static_cast<std::size_t>(draw)].name;
        else if (parameter.kind == ParameterKind::numerical)
            values[parameter.name] = static_cast<std::size_t>(draw);
        else
            values[parameter.name] = draw;
    }
    return values;
}

std::vector<std::string> overrides_of(const Parameter& parameter, double draw, const json& scene,
                                      const Lattice& lattice) {
    const auto place = static_cast<std::size_t>(std::max(draw, 0.0));
    if (parameter.kind == ParameterKind::choice) return parameter.choices[place].overrides;
    if (parameter.kind == ParameterKind::numerical) return lattice(place);
    std::vector<std::string> overrides;
    for (const std::string& each : parameter.entries) {
        double value = draw;
        if (parameter.kind == ParameterKind::factor)
            value =
                statistics::in_six_digits(draw * scene.at(json::json_pointer(each)).get<double>());
        overrides.push_back(each + "=" + json(value).dump());
    }
    return overrides;
}

}  // namespace breach::orchestrator
