#include "lem_tool/after_shaking.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/phases/files.hpp"
#include "lem_tool/snapshot_strength.hpp"

namespace breach::lem {

using nlohmann::json;
namespace fs = std::filesystem;

std::vector<fs::path> snapshots_of(const fs::path& input) {
    if (input.extension() != fs::path(phases::files::series).extension()) return {input};
    std::ifstream stream(input);
    if (!stream) throw fault::IoError(input.string() + ": cannot be opened");
    const json series = json::parse(stream, nullptr, false);
    std::vector<fs::path> found;
    if (series.is_object() && series.contains("files") && series.at("files").is_array())
        for (const json& each : series.at("files"))
            if (each.is_object() && each.contains("name") && each.at("name").is_string())
                found.push_back(input.parent_path() / each.at("name").get<std::string>());
    if (found.empty())
        throw fault::BadInput(input.string(),
                              {{"/files", "lists no snapshot",
                                "give the series of a FEM whose dynamic stage has written "
                                "snapshots (/fem/snapshot_interval), or one snapshot"}});
    return found;
}

scene::Scene without_states(scene::Scene scene) {
    scene.lem->liquefaction.clear();
    scene.lem->undrained.clear();
    scene.lem->probability.reset();
    return scene;
}

Shaken shaken(Model model, const scene::Scene& whole, const fs::path& snapshot) {
    const auto mesh = exchange::read_mesh_snapshot(snapshot).snapshot;
    const auto field = std::make_shared<const SnapshotStrength>(
        mesh, liquefied::SoilMap(mesh, whole, snapshot.string()));
    for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
        const auto region =
            std::ranges::find(whole.section.regions, mesh.regions[r], &scene::Region::name);
        Soil& soil = model.soils[static_cast<std::size_t>(region - whole.section.regions.begin())];
        soil.of_snapshot = field;
        soil.passage = field->closed()[r] ? Soil::Passage::closed : Soil::Passage::open;
    }
    return {mesh.time, std::move(model)};
}

json row_of(double time, const json& answer) {
    return {{"time", time},
            {"factor_of_safety", answer.at("factor_of_safety")},
            {"method", answer.at("method")},
            {"surface", answer.at("surface")}};
}

std::string table_of_times(const json& rows) {
    std::ostringstream table;
    table << "time_s,factor_of_safety,method,surface\n";
    for (const json& row : rows)
        table << row.at("time") << ',' << row.at("factor_of_safety") << ','
              << row.at("method").get<std::string>() << ',' << row.at("surface").get<std::string>()
              << '\n';
    return table.str();
}

}  // namespace breach::lem
