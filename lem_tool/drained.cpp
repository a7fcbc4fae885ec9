#include "lem_tool/drained.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "core/words/remedy.hpp"
#include "lem_tool/limit_scene.hpp"
#include "lem_tool/search.hpp"

namespace breach::lem {

namespace {

/// A place of wet soil that is looser than critical.
struct Loose {
    double x, y, psi;
};

bool liquefies(const scene::Lem& lem, std::size_t region, double y) {
    return std::ranges::any_of(lem.liquefaction, [&](const scene::UndrainedRegion& layer) {
        return layer.region == region &&
               (!layer.levels || (y >= (*layer.levels)[0] && y <= (*layer.levels)[1]));
    });
}

class WetAndLoose {
  public:
    explicit WetAndLoose(const scene::Scene& scene) : scene_(scene), model_(drained(scene)) {}

    /// The loosest such place of each region.
    std::map<std::size_t, Loose> found() {
        for (const Strip& strip : model_.strata.strips)
            for (std::size_t k = strip.first; k < strip.last; ++k) look(strip, k);
        return std::move(found_);
    }

  private:
    /// Keeps layers whole, so that regions keep their indices, and computes no undrained paths.
    static Model drained(scene::Scene scene) {
        scene.lem->undrained.clear();
        scene.lem->liquefaction.clear();
        return make_model(limit_scene(scene));
    }

    /// Boundaries are straight within a strip: the extremes of depth and pore pressure are at its
    /// sides.
    void look(const Strip& strip, std::size_t k) {
        constexpr int steps = 20;  // along a vertical, as psi_0 may vary with depth
        const Layer& layer = model_.strata.layers[k];
        if (!materials::has_state_parameter(scene_.material_of(layer.region).law) ||
            model_.soils[layer.region].tan_phi == 0.0 ||
            std::ranges::count(scene_.lem->undrained, layer.region,
                               &scene::UndrainedRegion::region) > 0)
            return;
        for (const double x : {strip.from, 0.5 * (strip.from + strip.to), strip.to}) {
            const double top = layer.top.at(x);
            double bottom = strip.bottom.at(x);
            if (k + 1 < strip.last)
                bottom = std::max(bottom, model_.strata.layers[k + 1].top.at(x));
            for (int step = 0; step <= steps && bottom < top; ++step)
                look_at(strip, layer, x, top - (top - bottom) * step / steps);
        }
    }

    void look_at(const Strip& strip, const Layer& layer, double x, double y) {
        constexpr double dry = 100.0;  // [Pa]: 1 cm of water
        const Strata& strata = model_.strata;
        const Soil& soil = model_.soils[layer.region];
        const double ground = strata.ground(strip).at(x);
        const double weight = layer.weight_above.at(x) + layer.gamma * (layer.top.at(x) - y);
        double u = soil.line ? strata.pressures[strip.pressures + *soil.line].at(x, y) : 0.0;
        // The same order as in SliceMaker: the flag and the analysis must agree on what is wet.
        if (u == 0.0) u = soil.r_u * weight;
        if (u <= dry || liquefies(*scene_.lem, layer.region, y)) return;
        const double free_water = strata.gamma_w * std::max(0.0, strip.water.at(x) - ground);
        const double sigma_v0 = weight + free_water - u - layer.unconsolidated.at(x);
        const materials::Place place{ground - y, y, std::max(sigma_v0, 0.0)};
        double psi = 0.0;
        materials::if_state_parameter(scene_.material_of(layer.region).law,
                                      [&](const auto& law) { psi = psi_at(law, place); });
        if (psi <= 0.0) return;
        const auto [spot, is_new] = found_.try_emplace(layer.region, Loose{x, y, psi});
        if (!is_new && psi > spot->second.psi) spot->second = {x, y, psi};
    }

    const scene::Scene& scene_;
    Model model_;
    std::map<std::size_t, Loose> found_;
};

}  // namespace

std::vector<fault::Flag> flags_of_drained(const scene::Scene& scene) {
    std::vector<fault::Flag> flags;
    const auto has_psi = [&](const scene::Region& region) {
        return materials::has_state_parameter(scene.materials[region.material].law);
    };
    if (std::ranges::none_of(scene.section.regions, has_psi)) return flags;
    for (const auto& [region, at] : WetAndLoose(scene).found()) {
        const std::string& name = scene.section.regions[region].name;
        std::ostringstream words;
        words.precision(3);
        words << "region \"" << name << "\" is of "
              << materials::traits(scene.material_of(region).law).name
              << " looser than critical and wet (psi " << at.psi << " at x = " << at.x
              << " m, y = " << at.y
              << " m), and judged by its drained strength alone: it can fail undrained at a factor "
                 "of "
                 "safety far above 1; "
              << words::set("/lem/undrained/-",
                            "{\"region\":\"" + name + "\",\"norsand\":\"peak\"}");
        flags.push_back(
            {"drained_only", fault::Severity::questionable, words.str(), "/lem/undrained"});
    }
    return flags;
}

}  // namespace breach::lem
