// Nothing but the values tried so far is stored (in the study's entry "values"); the next value
// follows from their results (uncertainty/inverse_search.cpp).
#include "services/orchestrator/study/target.hpp"

#include <algorithm>

#include "services/orchestrator/records/result_columns.hpp"
#include "services/orchestrator/study/sampled_variants.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;
using statistics::DistributionKind;

namespace {

constexpr std::size_t usual_lattices = 3;

/// Start of the search: "between", or the ends of the distribution.
std::optional<std::array<double, 2>> ends_of(const statistics::Distribution& distribution) {
    if (distribution.between) return distribution.between;
    switch (distribution.kind) {
        case DistributionKind::uniform:
        case DistributionKind::log_uniform:
            return std::array{distribution.numbers[0], distribution.numbers[1]};
        case DistributionKind::triangular:
            return std::array{distribution.numbers[0], distribution.numbers[2]};
        case DistributionKind::normal:
        case DistributionKind::lognormal:
            break;
    }
    return std::nullopt;
}

/// Factors and lognormal numbers vary by ratios, so the search works on their logarithms.
bool is_logarithmic(const Parameter& parameter, double low) {
    const DistributionKind kind = parameter.distribution.kind;
    return low > 0.0 &&
           (parameter.kind == ParameterKind::factor || kind == DistributionKind::log_uniform ||
            kind == DistributionKind::lognormal);
}

/// The median; for a choice the likeliest option.
double middle_of(const Parameter& parameter) {
    if (parameter.kind != ParameterKind::choice) return draw_at(parameter, 0.5);
    const auto likeliest = std::ranges::max_element(parameter.choices, {}, &Choice::weight);
    return static_cast<double>(likeliest - parameter.choices.begin());
}

/// Two digits, so that the names sort in the order of the values' requests.
std::string name_of(std::size_t number, std::size_t lattice) {
    return "v" + std::string(number < 10 ? "0" : "") + std::to_string(number) +
           (lattice == 0 ? "" : "_d" + std::to_string(lattice + 1));
}

}  // namespace

Target read_target(const json& entry, const UncertaintyPlan& plan, Reach reach,
                   std::vector<Fault>& faults) {
    const json& asked = entry.at("target");
    Target target{.question = {}, .parameter = plan.parameters.size(), .values = {}};
    const auto fault = [&](const std::string& below, std::string cause, std::string remedy) {
        faults.push_back({"/uncertainty/target" + below, std::move(cause), std::move(remedy)});
    };
    if (plan.batch)
        fault("", "an inverse study ends by itself", "leave \"until\" or \"target\" out");
    if (!plan.correlations.empty())
        fault("", "the other parameters stay at their medians: nothing is correlated",
              "leave \"correlation\" or \"target\" out");
    const std::string vary = asked.at("vary");
    const auto found = std::ranges::find(plan.parameters, vary, &Parameter::name);
    if (found == plan.parameters.end() ||
        (found->kind != ParameterKind::factor && found->kind != ParameterKind::value)) {
        fault("/vary", "\"" + vary + "\" is no parameter with a factor or a value",
              "name one of /uncertainty/parameters with factor_on or sets");
        return target;
    }
    target.parameter = static_cast<std::size_t>(found - plan.parameters.begin());
    const auto ends = ends_of(found->distribution);
    if (!ends) {
        fault("/vary", "the distribution of \"" + vary + "\" has no ends to search between",
              "give the parameter \"between\": [low, high]");
        return target;
    }
    target.lattices = asked.value("draws", has_lattice(reach) ? usual_lattices : 1);
    if (target.lattices > 1 && !has_lattice(reach))
        fault("/draws", "repeats move the lattice of material points, and there are no points",
              "leave \"draws\" out");
    const std::string quantity = asked.value("quantity", plan.quantity);
    const auto columns = result_columns();
    const auto column = std::ranges::find(columns, quantity, &ResultColumn::name);
    if (column == columns.end() || column->kind != ColumnKind::number)
        fault("/quantity", "\"" + quantity + "\" is no number of the results",
              "give one of " + names_of_results() + ", or factor_of_safety");
    else
        target.question.unit = column->unit;
    target.question.quantity = quantity;
    target.question.target = asked.at("value");
    target.question.low = (*ends)[0];
    target.question.high = (*ends)[1];
    target.question.logarithmic = is_logarithmic(*found, (*ends)[0]);
    target.question.tolerance = asked.at("tolerance");
    // "samples" is the most runs that the search may take; each value takes one per lattice.
    target.question.most_values = plan.samples / target.lattices;
    // A new search begins with both ends: they say whether the target lies between them.
    target.values = asked.value("values", std::vector<double>{(*ends)[0], (*ends)[1]});
    if (target.values.size() * target.lattices > plan.samples)
        fault("",
              std::to_string(target.values.size()) + " values on " +
                  std::to_string(target.lattices) + " lattices are more than the " +
                  std::to_string(plan.samples) + " runs of \"samples\"",
              "raise /uncertainty/samples: the most runs that the search may take");
    return target;
}

std::vector<VariantEntry> variants_of(const Target& target, const UncertaintyPlan& plan,
                                      const json& scene, Reach reach) {
    std::vector<VariantEntry> entries;
    for (std::size_t i = 0; i < target.values.size(); ++i) {
        for (std::size_t lattice = 0; lattice < target.lattices; ++lattice) {
            DrawnSample sample{.number = entries.size() + 1, .draws = {}};
            for (const Parameter& each : plan.parameters)
                sample.draws.push_back(each.kind == ParameterKind::numerical
                                           ? static_cast<double>(lattice)
                                           : middle_of(each));
            sample.draws[target.parameter] = target.values[i];
            VariantEntry entry{.name = name_of(i + 1, lattice),
                               .overrides = lattice_of_draw(lattice, reach),
                               .name_pointer = "/uncertainty/target",
                               .pointer = "/uncertainty/target",
                               .made_by = "uncertainty"};
            give_sample(plan, sample, scene, nullptr, entry);
            entries.push_back(std::move(entry));
        }
    }
    return entries;
}

}  // namespace breach::orchestrator
