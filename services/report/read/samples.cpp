#include "services/report/read/samples.hpp"

#include <algorithm>
#include <cmath>

#include "core/phases/phases.hpp"
#include "core/statistics/percentiles.hpp"
#include "services/findings/flags.hpp"
#include "services/report/chart/axis.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

bool has_samples(const Run& run) { return run.uncertainty.is_object(); }

bool is_back_analysis(const Run& run) {
    return has_samples(run) && run.uncertainty.value("inverse", json()).is_object();
}

const json* percentile_in(const json& quantity, double p) {
    const json& list = quantity.at("percentiles");
    if (!list.is_array()) return nullptr;
    for (const json& each : list)
        if (each.at("p") == p && each.value("value", json()).is_number()) return &each;
    return nullptr;
}

std::string why_no_percentile(const json& quantity, double p) {
    const json& list = quantity.at("percentiles");
    if (list.is_object()) return list.value("refused", "not told");
    std::string why = rounded(quantity.at("count").get<double>(), 6) + " samples are not enough";
    for (const json& each : quantity.value("percentiles_lacking", json::array()))
        if (each.at("p") == p) why += ", " + each.at("needs").dump() + " are needed";
    return why;
}

std::vector<const PhaseFolder*> sampled_runouts(const Run& run) {
    std::vector<const PhaseFolder*> found;
    const auto all = phases_named(run, phases::mpm.program);
    for (const json& row : run.uncertainty.at("rows")) {
        const auto own = std::ranges::find_if(all, [&](const PhaseFolder* each) {
            return json(each->variant) == row.at("sample") && each->result.is_object();
        });
        if (own != all.end()) found.push_back(*own);
    }
    return found;
}

std::vector<const PhaseFolder*> moving_samples(const Run& run) {
    auto found = sampled_runouts(run);
    std::erase_if(found, [](const PhaseFolder* each) { return !still_moves(*each); });
    return found;
}

bool is_lower_bound(const Run& run, const std::string& quantity, double value) {
    if (!findings::grows(quantity)) return false;
    const auto moving = moving_samples(run);
    return std::ranges::any_of(moving, [&](const PhaseFolder* each) {
        const json own = each->result.value(quantity, json());
        return !own.is_number() || own.get<double>() <= value;
    });
}

std::optional<double> Spread::percentile(double p) const {
    if (of < statistics::samples_needed(p)) return {};
    const double place = static_cast<double>(of - 1) * p / 100.0;
    const auto below = static_cast<std::size_t>(place);
    const double rest = place - static_cast<double>(below);
    const double low = ascending[below];
    return rest > 0.0 && std::isfinite(low) ? low + rest * (ascending[below + 1] - low) : low;
}

Spread spread_of(const Run& run, const json::json_pointer& fact, double absent) {
    Spread spread;
    for (const PhaseFolder* each : sampled_runouts(run)) {
        const json value = each->result.contains(fact) ? each->result.at(fact) : json();
        if (value.is_number()) ++spread.count;
        spread.ascending.push_back(value.is_number() ? value.get<double>() : absent);
    }
    spread.of = spread.ascending.size();
    std::ranges::sort(spread.ascending);
    return spread;
}

}  // namespace breach::report
