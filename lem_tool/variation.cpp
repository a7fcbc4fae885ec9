// Samples vary a copy of limit_scene's scene: its strengths are numbers by now, and no undrained
// path is computed again. Only Bishop's factor is varied; flags_of_variations says where another
// method's is lower.
#include "lem_tool/variation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/numerics/blocks.hpp"
#include "core/statistics/distribution.hpp"
#include "core/statistics/points.hpp"
#include "core/statistics/repeats.hpp"
#include "lem_tool/answer.hpp"
#include "lem_tool/facts.hpp"
#include "lem_tool/limit_scene.hpp"

namespace breach::lem {

using nlohmann::json;
using scene::Parameter;

namespace {

constexpr double steepest_friction = 89.0 * M_PI / 180.0;

void scale(scene::UndrainedStrength& strength, double factor) {
    strength.constant *= factor;
    strength.coefficient *= factor;
    strength.factor *= factor;
}

/// The original scene, whose entries the parameters name, and the analysed one.
struct Varied {
    explicit Varied(const scene::Scene& scene)
        : asked(scene), limit(limit_scene(scene)), undrained(undrained_parts(scene)) {}

    const scene::Scene& asked;
    scene::Scene limit;
    std::vector<std::vector<std::size_t>> undrained;  ///< [original entries] entries of `limit`
};

/// Multiplies one parameter in a copy of the analysed scene.
void vary(const Varied& of_scene, scene::Scene& scene, Parameter parameter, std::size_t of,
          double factor) {
    switch (parameter) {
        case Parameter::cohesion:
            *materials::strength_entries(scene.materials[of].law).c *= factor;
            if (scene.materials[of].strength) scene.materials[of].strength->peak.factor *= factor;
            break;
        case Parameter::friction_angle: {
            double& phi = *materials::strength_entries(scene.materials[of].law).phi;
            phi = std::min(phi * factor, steepest_friction);
            break;
        }
        case Parameter::density:
            scene.materials[of].density *= factor;
            break;
        case Parameter::undrained_strength:
            for (const std::size_t part : of_scene.undrained[of])
                scale(scene.lem->undrained[part].strength, factor);
            break;
        case Parameter::residual_strength:
            scale(scene.lem->liquefaction[of].strength, factor);
            break;
        case Parameter::seismic_coefficient:
            scene.lem->seismic_coefficient *= factor;
            break;
    }
}

std::string name_of(const Varied& of_scene, Parameter parameter, std::size_t of) {
    const scene::Scene& scene = of_scene.limit;
    switch (parameter) {
        case Parameter::cohesion:
            return "cohesion of " + scene.materials[of].name;
        case Parameter::friction_angle:
            return "friction_angle of " + scene.materials[of].name;
        case Parameter::density:
            return "density of " + scene.materials[of].name;
        case Parameter::undrained_strength:
            return "undrained_strength of " +
                   of_scene.asked.section.regions[of_scene.asked.lem->undrained[of].region].name;
        case Parameter::residual_strength:
            return "residual_strength of " +
                   scene.section.regions[scene.lem->liquefaction[of].region].name;
        case Parameter::seismic_coefficient:
            break;
    }
    return "seismic_coefficient";
}

/// Bishop's factor of varied scenes, on the unvaried critical surface or on new ones.
class Variations {
  public:
    Variations(const scene::Scene& scene, scene::VariedSurface surface, std::size_t layers,
               int threads)
        : surface_(surface), layers_(layers) {
        const Model model = model_of(scene);
        const Families families = scene.lem->search
                                      ? search_families(scene, model, *scene.lem->search, threads)
                                      : given_family(scene, model);
        const Searched& least = families.least();
        if (!least.found.critical) refuse_search(scene, least.model, least.found.tally);
        base_ = *least.found.critical;
        floor_ = least.floor;
        crack_share_ = least.model.strata.crack.share;
        Slices slices = make_slices(least.model.strata, model.slices);
        cut(least.model.strata, model.soils, base_.surface, model.slices, slices);
        slide_ = slide_of(slices);
    }

    double unvaried() const { return base_.bishop.factor_of_safety; }

    /// Infinite without driving moment.
    double factor_of(scene::Scene varied) const {
        if (surface_ == scene::VariedSurface::searched && varied.lem->search) {
            const double circles = searched(varied);
            if (floor_.empty()) return circles;
            varied.lem->floor = floor_;
            return std::min(circles, searched(varied));
        }
        if (!floor_.empty()) varied.lem->floor = floor_;
        const Model model = model_of(varied);
        Slices slices = make_slices(model.strata, model.slices);
        cut(model.strata, model.soils, base_.surface, model.slices, slices);
        const Bishop result = bishop(slices, slide_, model.k_h);
        // A small m_alpha counts: else the sample would be taken as stable.
        const bool answered =
            result.balance == Balance::found || result.balance == Balance::small_m_alpha;
        return answered ? result.factor_of_safety : stable;
    }

  private:
    static constexpr double stable = std::numeric_limits<double>::infinity();

    double searched(const scene::Scene& varied) const {
        const SearchResult found = search(model_of(varied), *varied.lem->search, 1, Effort::sample);
        return found.critical ? found.critical->bishop.factor_of_safety : stable;
    }

    Model model_of(const scene::Scene& varied) const {
        Model model = make_model(varied);
        model.soils = liquefied(model, varied.lem->liquefaction, layers_);
        // The crack of the unvaried slope: searching its depth per sample would multiply the cost.
        model.strata.crack.share = crack_share_;
        return model;
    }

    scene::VariedSurface surface_;
    std::size_t layers_;
    Critical base_{};
    std::vector<scene::Vec2> floor_;  ///< along the weak layer of the surface; or none
    double crack_share_ = 1.0;
    Slide slide_ = Slide::to_left;
};

/// Distribution of the parameter over its mean.
statistics::Distribution distribution_of(const scene::RandomVariable& variable) {
    const double cov = variable.variation;
    if (variable.distribution == scene::Distribution::normal)
        return {statistics::DistributionKind::normal, {1.0, cov}};
    return {statistics::DistributionKind::lognormal, {1.0 / std::sqrt(1.0 + cov * cov), cov}};
}

json statistics_of(const std::vector<double>& factors) {
    std::vector<double> driven;
    std::ranges::copy_if(factors, std::back_inserter(driven),
                         // Masses without a driving moment have no factor; they count as stable in
                         // the probability.
                         [](double F) { return std::isfinite(F); });
    const auto failed = std::ranges::count_if(driven, [](double F) { return F < 1.0; });
    const auto repeats = driven.empty() ? statistics::Repeats{} : statistics::repeats_of(driven);
    const double deviation = repeats.deviation.value_or(0.0);
    json facts{{"samples", factors.size()},
               {"mean", repeats.mean},
               {"standard_deviation", deviation},
               {"failures", failed},
               {"not_driven", factors.size() - driven.size()},
               {"probability_of_failure",
                static_cast<double>(failed) / static_cast<double>(factors.size())},
               {"reliability_index", nullptr}};
    if (deviation > 0.0) facts["reliability_index"] = (repeats.mean - 1.0) / deviation;
    return facts;
}

}  // namespace

Samples add_probability(const scene::Scene& scene, int threads, json& result) {
    constexpr std::size_t block = 32;
    const Varied of_scene(scene);
    const scene::Probability& asked = *scene.lem->probability;
    const Variations variations(of_scene.limit, asked.surface, asked.layers_liquefied, threads);
    const auto count = static_cast<std::size_t>(asked.samples);
    const statistics::Points cube =
        statistics::latin_hypercube(count, count, asked.variables.size(), asked.seed);
    Samples samples{{}, {}, std::vector<double>(count)};
    for (std::size_t v = 0; v < asked.variables.size(); ++v) {
        const scene::RandomVariable& variable = asked.variables[v];
        samples.names.push_back(name_of(of_scene, variable.parameter, variable.of));
        const statistics::Distribution distribution = distribution_of(variable);
        std::vector<double> column;
        for (const auto& point : cube)
            column.push_back(std::max(0.0, statistics::quantile(distribution, point[v])));
        samples.factors.push_back(std::move(column));
    }
    numerics::run_blocks((count + block - 1) / block, threads, [&](std::size_t n) {
        for (std::size_t i = n * block; i < std::min(count, (n + 1) * block); ++i) {
            scene::Scene varied = of_scene.limit;
            for (std::size_t v = 0; v < asked.variables.size(); ++v) {
                vary(of_scene, varied, asked.variables[v].parameter, asked.variables[v].of,
                     samples.factors[v][i]);
            }
            samples.factor_of_safety[i] = variations.factor_of(std::move(varied));
        }
    });
    result["probability"] = statistics_of(samples.factor_of_safety);
    result["probability"]["seed"] = asked.seed;
    result["probability"]["layers_liquefied"] = asked.layers_liquefied;
    result["probability"]["factor_of_safety"] = variations.unvaried();
    return samples;
}

std::vector<fault::Flag> flags_of_variations(const json& result) {
    constexpr double telling = 0.03;
    std::vector<fault::Flag> flags;
    if (!result.contains("probability")) return flags;
    const std::size_t layers = result.at("probability").at("layers_liquefied");
    const json& state = layers == 0 ? result : result.at("stages").at(layers);
    const double reported = state.at("factor_of_safety");
    const double varied = result.at("probability").at("factor_of_safety");
    if (reported >= varied * (1.0 - telling)) return flags;
    std::ostringstream words;
    words.precision(4);
    words << "probability varies Bishop's factor, " << varied << ", and the least factor is "
          << reported << " by Spencer's method: failure is likelier than it says. Vary the "
          << "strengths in a study instead, whose samples have the least factor each";
    flags.push_back(
        {"varies_higher_factor", fault::Severity::questionable, words.str(), "/lem/probability"});
    return flags;
}

std::string table_of(const Samples& samples) {
    std::ostringstream table;
    table.precision(10);
    for (const std::string& name : samples.names) table << name << ',';
    table << "factor_of_safety\n";
    for (std::size_t i = 0; i < samples.factor_of_safety.size(); ++i) {
        for (const auto& column : samples.factors) table << column[i] << ',';
        table << samples.factor_of_safety[i] << '\n';
    }
    return table.str();
}

}  // namespace breach::lem
