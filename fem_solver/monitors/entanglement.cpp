#include "fem_solver/monitors/entanglement.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace breach::fem {
namespace {

/// Present elements of the body that share a node with `element`, ascending, without itself.
std::vector<std::size_t> neighbours_of(const Model& model, std::size_t element) {
    const Mesh& mesh = model.mesh;
    const Quad& own = mesh.quads[element];
    std::vector<std::size_t> found;
    for (std::size_t e = 0; e < model.body.elements; ++e) {
        if (model.is_absent(e)) continue;
        const bool touches = std::ranges::any_of(mesh.quads[e], [&](std::int32_t node) {
            return std::ranges::find(own, node) != own.end();
        });
        if (touches && e != element) found.push_back(e);
    }
    return found;
}

std::string surfaces_of(const Entanglement& what) {
    if (what.failure_surfaces == 0) return "no failure surface";
    const bool one = what.failure_surfaces == 1;
    return std::to_string(what.failure_surfaces) + (one ? " failure surface" : " failure surfaces");
}

}  // namespace

Entanglement entanglement_of(const scene::Section& section, const Model& model, const Watch& watch,
                             const Motion& last_good, const Distortion& folded, double time) {
    const std::size_t e = folded.worst_element;
    const std::vector<double> epsilon_q = epsilon_q_of_elements(model, last_good);
    const FailureSurfaces surfaces = watch.failure_surfaces(epsilon_q);
    double sum = 0.0, volume = 0.0;
    bool on_surface = surfaces.holds[e];
    for (const std::size_t n : neighbours_of(model, e)) {
        sum += model.volume[n] * epsilon_q[n];
        volume += model.volume[n];
        on_surface = on_surface || surfaces.holds[n];
    }
    const double mean = volume > 0.0 ? sum / volume : epsilon_q[e];
    // The distinction decides how a reader takes the end: a band says that the dam has failed, a
    // corner only that the mesh is bad.
    const bool failed = mean > watch.failure_strain() || on_surface;
    const auto region = static_cast<std::size_t>(model.mesh.region_of_element[e]);
    return {.time = time,
            .element = e,
            .region = region,
            .region_name = section.regions[region].name,
            .where = corners_of(model.mesh, e).rowwise().mean(),
            .least_ratio = folded.least,
            .mean_epsilon_q = mean,
            .failure_surfaces = surfaces.count,
            .kind = failed ? Entanglement::Kind::band : Entanglement::Kind::corner};
}

nlohmann::json as_json(const Entanglement& what) {
    return {{"time", what.time},
            {"element", what.element},
            {"region", what.region_name},
            {"x", what.where.x()},
            {"y", what.where.y()},
            {"least_jacobian_ratio", what.least_ratio},
            {"mean_epsilon_q", what.mean_epsilon_q},
            {"failure_surfaces", what.failure_surfaces},
            {"kind", what.kind == Entanglement::Kind::band ? "band" : "corner"}};
}

Entanglement entanglement_from(const nlohmann::json& facts, const scene::Section& section) {
    const std::string name = facts.at("region");
    const auto region = std::ranges::find(section.regions, name, &scene::Region::name);
    const bool band = facts.at("kind") == "band";
    return {.time = facts.at("time"),
            .element = facts.at("element"),
            .region = static_cast<std::size_t>(region - section.regions.begin()),
            .region_name = name,
            .where = Vec2(facts.at("x").get<double>(), facts.at("y").get<double>()),
            .least_ratio = facts.at("least_jacobian_ratio"),
            .mean_epsilon_q = facts.at("mean_epsilon_q"),
            .failure_surfaces = facts.at("failure_surfaces"),
            .kind = band ? Entanglement::Kind::band : Entanglement::Kind::corner};
}

std::string in_words(const Entanglement& what) {
    const bool corner = what.kind == Entanglement::Kind::corner;
    const bool none = what.failure_surfaces == 0;
    std::ostringstream text;
    text << std::setprecision(4) << (corner ? "one corner at (" : "the mesh folded at (")
         << what.where.x() << ", " << what.where.y() << (corner ? ") folded at " : ") at ")
         << what.time << " s" << (corner ? "" : ", in soil that has failed") << " (element "
         << what.element << " of '" << what.region_name << "'); mean strain there "
         << std::round(1000.0 * what.mean_epsilon_q) / 10.0 << " %, " << surfaces_of(what);
    if (corner) {
        text << (none ? ": not a failure of the dam" : ", but elsewhere")
             << "; refine the mesh there";
    } else if (none) {
        text << " from ground to ground yet";
    }
    return text.str();
}

fault::Flag flag_of(const Entanglement& what) {
    const std::string words = in_words(what);
    if (what.kind == Entanglement::Kind::corner) {
        return {"entangled_corner", fault::Severity::questionable, words,
                "/section/regions/" + std::to_string(what.region)};
    }
    return {"entangled", fault::Severity::warning,
            words + "; what comes after that is unknown to the FEM", "/fem/least_jacobian_ratio"};
}

}  // namespace breach::fem
