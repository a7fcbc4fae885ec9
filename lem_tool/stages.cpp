// Each stage is a whole search: the critical surface moves as layers liquefy.
#include "lem_tool/stages.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "lem_tool/facts.hpp"

namespace breach::lem {

using nlohmann::json;

namespace {

double top_of(const scene::Region& region) {
    return geometry::bounding_box(region.polygon).high.y();
}
double bottom_of(const scene::Region& region) {
    return geometry::bounding_box(region.polygon).low.y();
}

/// Depth at which F decreases through 1, linear between stages; 0 if F is below 1 from the
/// beginning.
json depth_at_one(const json& stages) {
    if (stages[0].at("factor_of_safety") < 1.0) return 0.0;
    for (std::size_t i = 1; i < stages.size(); ++i) {
        const double before = stages[i - 1].at("factor_of_safety");
        const double after = stages[i].at("factor_of_safety");
        if (before < 1.0 || after >= 1.0) continue;
        const double from = stages[i - 1].at("liquefied_depth");
        const double to = stages[i].at("liquefied_depth");
        return from + (to - from) * (before - 1.0) / (before - after);
    }
    return nullptr;
}

double depth_of_layers(const json& stages) { return stages.back().at("liquefied_depth"); }

/// Depth of the critical surface with the least F over all stages and methods.
double depth_of_surface(const json& stages) {
    const auto lowest =
        std::min_element(stages.begin(), stages.end(), [](const json& a, const json& b) {
            // Ignores stages that only repeat the minimum.
            return a.at("factor_of_safety").get<double>() <
                   b.at("factor_of_safety").get<double>() * (1.0 - 1e-6);
        });
    return lowest->at("lowest_point_depth");
}

/// Depth of the lowest point of the stage with the least F, at most that of liquefiable soil; 0 if
/// the slope fails without liquefaction.
double critical_depth(const json& stages) {
    if (stages[0].at("factor_of_safety") < 1.0) return 0.0;
    // A trigger on a depth that no liquefaction can reach would never fire.
    return std::min(depth_of_surface(stages), depth_of_layers(stages));
}

std::string name_of_state(std::size_t layers) {
    if (layers == 0) return "";
    return " with " + std::to_string(layers) + (layers == 1 ? " layer" : " layers") + " liquefied";
}

}  // namespace

void add_stages(const scene::Scene& scene, const Model& sound, const Families& unliquefied,
                int threads, json& result, std::vector<fault::Flag>& flags) {
    const std::vector<scene::UndrainedRegion>& layers = scene.lem->liquefaction;
    const std::vector<scene::Region>& regions = scene.section.regions;
    const double top = top_of(regions[layers.front().region]);
    std::int64_t analysed = 0;
    double deepest = 0.0;
    json stages = json::array();
    for (std::size_t count = 0; count <= layers.size(); ++count) {
        Model model = sound;
        // From the sound soils each time: layers above keep their liquefied strength, as `count`
        // includes them.
        model.soils = liquefied(sound, layers, count);
        const Families found =
            // The first stage is the sound slope, which analysis.cpp has searched.
            count == 0 ? unliquefied : search_families(scene, model, *scene.lem->search, threads);
        if (!found.circles.found.critical)
            refuse_search(scene, found.circles.model, found.circles.found.tally);
        json stage = answer(scene, found);
        stage["layers_liquefied"] = count;
        if (count > 0)
            // A layer may lie beside the one before instead of below it: depth never falls.
            deepest = std::max(deepest, top - bottom_of(regions[layers[count - 1].region]));
        stage["liquefied_depth"] = deepest;
        stage["lowest_point_depth"] = top - stage.at("lowest_point")[1].get<double>();
        analysed += found.circles.found.tally.analysed;
        if (count > 0)
            add_flags_of_state(scene, {name_of_state(count), model, found, stage}, threads, flags);
        stages.push_back(stage);
    }
    result["stages"] = stages;
    result["critical_depth"] = critical_depth(stages);
    result["depth_at_fs_1"] = depth_at_one(stages);
    result["surfaces_analysed_in_stages"] = analysed;
}

std::vector<fault::Flag> flags_of_stages(const json& stages) {
    const double dry = stages.front().at("factor_of_safety");
    double least = dry;
    for (const json& stage : stages)
        least = std::min(least, stage.at("factor_of_safety").get<double>());
    std::ostringstream words;
    words.precision(3);
    if (dry < 1.0) {
        words << "the factor of safety is " << dry
              << " before any layer has liquefied: the slope fails without liquefaction, "
                 "critical_depth is "
                 "0 and every trigger on it fires at once; check strength and water";
        return {{"fails_unliquefied", fault::Severity::warning, words.str(), "/lem"}};
    }
    if (least < 1.0) {
        const double layers = depth_of_layers(stages);
        const double below = depth_of_surface(stages) - layers;
        if (below <= 1e-3 * layers) return {};
        words << "the critical surface passes " << below << " m below all that liquefies: "
              << "critical_depth, " << layers
              << " m, is the bottom of the layers, which the last of "
              << "them must reach; F falls through 1 at " << depth_at_one(stages).get<double>()
              << " m: trigger on that depth, or both";
        return {{"below_layers", fault::Severity::warning, words.str(), "/lem/liquefaction"}};
    }
    words << "the factor of safety is " << least
          << " at least with every layer liquefied: critical_depth is where that surface lies, not "
             "a depth at which the slope fails";
    return {{"stands_liquefied", fault::Severity::warning, words.str(), "/lem/liquefaction"}};
}

std::string table_of(const json& stages) {
    std::ostringstream table;
    table << "layers_liquefied,liquefied_depth_m,factor_of_safety,method,surface,bishop,spencer,"
             "center_x_m,center_y_m,radius_m,entry_x_m,entry_y_m,exit_x_m,exit_y_m,"
             "lowest_point_depth_m\n";
    for (const json& stage : stages) {
        const json& bishop = stage.at("bishop");
        const json& rigorous = bishop.at("spencer");
        const json& center = bishop.at("circle").at("center");
        table << stage.at("layers_liquefied") << ',' << stage.at("liquefied_depth") << ','
              << stage.at("factor_of_safety") << ',' << stage.at("method").get<std::string>() << ','
              << stage.at("surface").get<std::string>() << ',' << bishop.at("factor_of_safety")
              << ',' << (rigorous.is_null() ? "" : rigorous.at("factor_of_safety").dump()) << ','
              << center[0] << ',' << center[1] << ',' << bishop.at("circle").at("radius") << ','
              << stage.at("entry")[0] << ',' << stage.at("entry")[1] << ',' << stage.at("exit")[0]
              << ',' << stage.at("exit")[1] << ',' << stage.at("lowest_point_depth") << '\n';
    }
    return table.str();
}

}  // namespace breach::lem
