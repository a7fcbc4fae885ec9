#include "services/report/figures/transfer_figures.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/exchange/excess_pressure.hpp"
#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "services/report/chart/draw.hpp"
#include "services/report/figures/mesh_figures.hpp"
#include "services/report/read/read_results.hpp"

namespace breach::report {

using exchange::MeshSnapshot;
using exchange::ParticleState;
using nlohmann::json;

namespace {

constexpr std::size_t most_drawn = 15000;

/// Vertical effective stress, compression positive [kPa], mean over each element's Gauss points.
std::vector<double> sigma_v(const MeshSnapshot& mesh) {
    const auto per_element = static_cast<std::size_t>(mesh.gauss_per_element);
    std::vector<double> mean(mesh.quads.size(), 0.0);
    for (std::size_t g = 0; g < mesh.stress.size(); ++g) {
        mean[g / per_element] -= 1e-3 * mesh.stress[g][1] / static_cast<double>(per_element);
    }
    return mean;
}

/// The same for points: subtracts the pore pressure from total stress.
std::vector<double> sigma_v(const ParticleState& points) {
    std::vector<double> values;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const double u = points.pore_pressure.empty() ? 0.0 : points.pore_pressure[p];
        values.push_back(-1e-3 * (points.stress[p][1] + (u - points.pressure_beside(p))));
    }
    return values;
}

/// Number of the layer, from 1; 0: not liquefied.
std::vector<double> layer_numbers(const MeshSnapshot& mesh, const LayerColours& layers) {
    const std::vector<double> r_u = layers.ever
                                        ? element_r_u(mesh, exchange::largest_excess_pressure(mesh))
                                        : element_r_u(mesh);
    std::vector<double> numbers;
    for (std::size_t e = 0; e < r_u.size(); ++e) {
        double sigma_v0 = 0.0;
        for (const std::int32_t node : mesh.quads[e]) {
            sigma_v0 += 0.25 * mesh.sigma_v0[static_cast<std::size_t>(node)];
        }
        const auto layer = std::ranges::upper_bound(layers.ends, sigma_v0) - layers.ends.begin();
        const auto last = static_cast<std::ptrdiff_t>(layers.ends.size()) - 1;
        numbers.push_back(r_u[e] > layers.r_u ? static_cast<double>(std::min(layer, last) + 1)
                                              : 0.0);
    }
    return numbers;
}

std::vector<double> layer_numbers(const ParticleState& points, const LayerColours& layers) {
    std::vector<double> numbers;
    for (const std::int32_t region : points.region) {
        const auto found = std::ranges::find(
            layers.materials, points.materials_of_regions[static_cast<std::size_t>(region)]);
        numbers.push_back(found == layers.materials.end()
                              ? 0.0
                              : static_cast<double>(found - layers.materials.begin() + 1));
    }
    return numbers;
}

/// Evenly picked points where there are too many.
Field on_points(const ParticleState& points, const std::vector<double>& value,
                const std::string& label, const Range& range) {
    Field field{label, 1, {}, {}, {}, range};
    const std::size_t stride = (points.size() + most_drawn - 1) / most_drawn;
    for (std::size_t p = 0; p < points.size(); p += std::max<std::size_t>(stride, 1)) {
        field.x.push_back(points.position[p].x());
        field.y.push_back(points.position[p].y());
        field.value.push_back(value[p]);
    }
    return field;
}

/// From 0 to the next 50 kPa.
Range stress_range(const std::vector<double>& stress) {
    const double largest = stress.empty() ? 0.0 : *std::ranges::max_element(stress);
    return {0.0, 50.0 * std::max(1.0, std::ceil(largest / 50.0))};
}

/// The quantity whose pair is drawn.
struct Quantity {
    std::string name;
    std::string title;
    std::string label;
    Range range;
};

BeforeAndAfter pair_of(const Quantity& q, const MeshSnapshot& mesh,
                       const std::vector<double>& on_mesh, const ParticleState& points,
                       const std::vector<double>& at_points) {
    const auto chart = [&](const std::string& when) {
        return Chart{q.title + ", " + when, {"x [m]"}, {"y [m]"}, {}, {}, Aspect::equal};
    };
    BeforeAndAfter pair{{q.name + "_before", chart("before (mesh)")},
                        {q.name + "_after", chart("after (points)")}};
    pair.before.chart.field = on_deformed_mesh(mesh, on_mesh, q.label, q.range);
    pair.before.chart.series.push_back(borders_of(mesh));
    pair.after.chart.field = on_points(points, at_points, q.label, q.range);
    pair.after.chart.series.push_back(borders_of(mesh));
    return pair;
}

/// The snapshot from which the particles were made.
MeshSnapshot snapshot_of(const std::filesystem::path& folder,
                         const exchange::Provenance& provenance) {
    for (const exchange::InputDigest& input : provenance.inputs) {
        const std::filesystem::path named = input.path;
        for (const auto& file :
             {named, folder / named, folder / named.filename(), folder.parent_path() / named}) {
            if (!std::filesystem::exists(file)) continue;
            if (exchange::sha256_of_file(file) != input.sha256) continue;
            return exchange::read_mesh_snapshot(file).snapshot;
        }
    }
    const std::string wanted =
        provenance.inputs.empty() ? "the snapshot" : provenance.inputs.front().path;
    throw fault::IoError(wanted + ", from which " + (folder / phases::files::particles).string() +
                         " was made, is not there any more; put it into " + folder.string());
}

std::vector<BeforeAndAfter> pairs_of(const std::filesystem::path& folder) {
    const auto file = exchange::read_particle_state(folder / phases::files::particles);
    const json scene = read_json(folder / phases::files::scene);
    try {
        return compare(snapshot_of(folder, file.provenance), file.state, layers_of(scene));
    } catch (const json::exception& error) {
        throw fault::BadInput((folder / phases::files::scene).string(),
                              {{"/transfer", error.what(), "give a folder of transfer_tool"}});
    }
}

/// Reads `attribute="123"` of an SVG's first tag.
double size_of(const std::string& svg, const std::string& attribute) {
    const std::size_t at = svg.find(" " + attribute + "=\"");
    return std::stod(svg.substr(at + attribute.size() + 3));
}

}  // namespace

LayerColours layers_of(const json& scene) {
    LayerColours layers;
    const json liquefied = scene.at("transfer").value("liquefied", json::object());
    if (liquefied.empty()) return layers;
    layers.r_u = liquefied.at("r_u");
    layers.ever = liquefied.value("when", "at_transfer") == "ever";  // older results lack it
    for (const json& layer : liquefied.at("layers")) {
        layers.ends.push_back(1e3 * layer.at("sigma_v0_kPa").at(1).get<double>());
        const std::string made =
            layer.contains("material")
                ? layer.at("material").get<std::string>()
                : liquefied.at("residual_strength").at("like").get<std::string>() + "_" +
                      std::to_string(layers.ends.size());
        layers.materials.push_back(made);
    }
    return layers;
}

std::vector<BeforeAndAfter> compare(const MeshSnapshot& mesh, const ParticleState& points,
                                    const LayerColours& layers) {
    std::vector<BeforeAndAfter> pairs;
    const std::vector<double> stress = sigma_v(mesh);
    pairs.push_back(
        pair_of({"sigma_v", "vertical effective stress", "σ′v [kPa]", stress_range(stress)}, mesh,
                stress, points, sigma_v(points)));
    const std::vector<double> r_u = element_r_u(mesh);
    if (r_u.empty() || points.r_u.empty()) return pairs;
    pairs.push_back(pair_of({"r_u", "excess pore pressure ratio", "r_u [-]", {0.0, 1.0}}, mesh, r_u,
                            points, points.r_u));
    if (layers.ends.empty()) return pairs;
    pairs.push_back(pair_of({"liquefied",
                             "liquefied layers",
                             "layer by σ′v0 (0: not liquefied)",
                             {0.0, static_cast<double>(layers.ends.size())}},
                            mesh, layer_numbers(mesh, layers), points,
                            layer_numbers(points, layers)));
    return pairs;
}

std::string side_by_side(const std::vector<BeforeAndAfter>& pairs) {
    std::ostringstream rows;
    double width = 0.0;
    double y = 0.0;
    for (const BeforeAndAfter& pair : pairs) {
        double x = 0.0;
        double height = 0.0;
        for (const Figure* each : {&pair.before, &pair.after}) {
            const std::string svg = as_svg(each->chart);
            rows << "<g transform=\"translate(" << x << ' ' << y << ")\">" << svg << "</g>\n";
            x += size_of(svg, "width");
            height = std::max(height, size_of(svg, "height"));
        }
        width = std::max(width, x);
        y += height;
    }
    std::ostringstream page;
    page << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << width << ' ' << y
         << "\" width=\"" << width << "\" height=\"" << y << "\">\n"
         << rows.str() << "</svg>\n";
    return page.str();
}

void write_transfer_figures(const std::filesystem::path& folder,
                            const std::filesystem::path& output) {
    const std::vector<BeforeAndAfter> pairs = pairs_of(folder);
    std::vector<Figure> figures;
    for (const BeforeAndAfter& pair : pairs) {
        figures.push_back(pair.before);
        figures.push_back(pair.after);
    }
    write_figures(output, figures);
    exchange::publish_text(output / "before_and_after.svg", side_by_side(pairs));
}

}  // namespace breach::report
