#include "services/orchestrator/files/frames.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <regex>

#include "core/exchange/excess_pressure.hpp"
#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

static_assert(std::endian::native == std::endian::little,
              "the arrays are sent as they lie in memory");

std::string kind_of(const std::string& phase) {
    const phases::Phase* known = phases::named(phase);
    return known ? known->frames : phases::mpm.frames;
}

/// The number at the end of "snapshot_0.500000.vtkhdf". Files without one (phases::files::final_state) repeat a
/// numbered frame.
std::optional<double> time_in(const std::string& name) {
    static const std::regex number(R"(_([0-9]+(\.[0-9]+)?)\.vtkhdf$)");
    std::smatch found;
    if (!std::regex_search(name, found, number)) return std::nullopt;
    return std::stod(found[1]);
}

/// The transfer's only frame: the material points at the beginning of their own clock.
bool is_transferred(const std::string& name) { return name == phases::files::particles; }

struct Cloud {
    double time = 0.0;
    std::vector<std::string> regions, materials;
    std::vector<float> x, y, region;
    std::vector<float> speed, epsilon_q, r_u, pore_pressure;  ///< empty when the file has none
    std::vector<std::uint32_t> quads;

    void add(const mechanics::Vec2& position, std::int32_t region_index) {
        x.push_back(static_cast<float>(position[0]));
        y.push_back(static_cast<float>(position[1]));
        region.push_back(static_cast<float>(region_index));
    }
};

float speed_of(const mechanics::Vec2& velocity) {
    return static_cast<float>(std::hypot(velocity[0], velocity[1]));
}

template <class Number>
void append(std::string& bytes, const std::vector<Number>& numbers) {
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

std::string packed(const Cloud& cloud) {
    std::vector<std::pair<std::string, const std::vector<float>*>> fields{
        {"x", &cloud.x},
        {"y", &cloud.y},
        {"speed", &cloud.speed},
        {"epsilon_q", &cloud.epsilon_q},
        {"region", &cloud.region},
        {"r_u", &cloud.r_u},
        {"pore_pressure", &cloud.pore_pressure}};
    std::erase_if(fields, [](const auto& field) { return field.second->empty(); });
    json head{{"time", cloud.time},
              {"count", cloud.x.size()},
              {"fields", json::array()},
              {"regions", cloud.regions},
              {"materials", cloud.materials}};
    for (const auto& [name, values] : fields) head["fields"].push_back(name);
    if (!cloud.quads.empty()) head["quads"] = cloud.quads.size() / 4;
    std::string bytes = head.dump();
    while ((bytes.size() + 1) % 4 != 0) bytes += ' ';
    bytes += '\n';
    for (const auto& [name, values] : fields) append(bytes, *values);
    append(bytes, cloud.quads);
    return bytes;
}

Cloud particles_of(const std::filesystem::path& file, std::size_t stride) {
    const auto state = exchange::read_particle_frame(file);
    Cloud cloud;
    cloud.time = state.time;
    cloud.regions = state.regions;
    cloud.materials = state.materials_of_regions;
    for (std::size_t p = 0; p < state.size(); p += stride) {
        cloud.add(state.position[p], state.region[p]);
        if (!state.velocity.empty()) cloud.speed.push_back(speed_of(state.velocity[p]));
        for (const auto& [from, to] :
             {std::pair{&state.epsilon_q, &cloud.epsilon_q}, std::pair{&state.r_u, &cloud.r_u},
              std::pair{&state.pore_pressure, &cloud.pore_pressure}})
            if (!from->empty()) to->push_back(static_cast<float>((*from)[p]));
    }
    return cloud;
}

/// u and r_u = (u - u_0) / sigma'_v0 of the nodes, where the snapshot has them. Ground without
/// effective stress before the shaking has no r_u: not a number, which the page draws grey.
void add_water(Cloud& cloud, const exchange::MeshSnapshot& mesh) {
    for (const double u : mesh.pore_pressure) cloud.pore_pressure.push_back(static_cast<float>(u));
    const std::vector<double> excess = exchange::nodal_excess_pressure(mesh);
    for (std::size_t node = 0; node < excess.size(); ++node) {
        const double ratio = mesh.sigma_v0[node] > 0.0 ? excess[node] / mesh.sigma_v0[node]
                                                       : std::numeric_limits<double>::quiet_NaN();
        cloud.r_u.push_back(static_cast<float>(ratio));
    }
}

/// Nodes at their displaced places; a node's strain is the mean of its elements' Gauss values, its
/// region the last one that touches it.
Cloud nodes_of(const std::filesystem::path& file) {
    const auto mesh = exchange::read_mesh_snapshot(file).snapshot;
    const std::size_t n_nodes = mesh.position_0.size();
    const auto per_element = static_cast<std::size_t>(mesh.gauss_per_element);
    std::vector<double> strain(n_nodes, 0.0);
    std::vector<double> touched(n_nodes, 0.0);
    std::vector<std::int32_t> region(n_nodes, 0);
    Cloud cloud;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        double sum = 0.0;
        for (std::size_t g = 0; g < per_element; ++g) sum += mesh.epsilon_q[e * per_element + g];
        for (const std::int32_t node : mesh.quads[e]) {
            const auto i = static_cast<std::size_t>(node);
            strain[i] += sum / static_cast<double>(per_element);
            touched[i] += 1.0;
            region[i] = mesh.region_of_element[e];
            cloud.quads.push_back(static_cast<std::uint32_t>(node));
        }
    }
    cloud.time = mesh.time;
    cloud.regions = mesh.regions;
    cloud.materials = mesh.materials_of_regions;
    for (std::size_t i = 0; i < n_nodes; ++i) {
        const mechanics::Vec2 position = mesh.position_0[i] + mesh.displacement[i];
        cloud.add(position, region[i]);
        cloud.speed.push_back(speed_of(mesh.velocity[i]));
        cloud.epsilon_q.push_back(static_cast<float>(strain[i] / std::max(1.0, touched[i])));
    }
    add_water(cloud, mesh);
    return cloud;
}

}  // namespace

bool is_frame_name(const std::string& name) {
    static const std::regex plain(R"([A-Za-z0-9_-][A-Za-z0-9_.-]{0,120}\.vtkhdf)");
    return std::regex_match(name, plain);
}

std::vector<Frame> frames_in(const std::filesystem::path& output, const std::string& phase) {
    std::vector<Frame> frames;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(output, error)) {
        const std::string name = entry.path().filename();
        if (entry.path().extension() != phases::files::snapshot_extension || !is_frame_name(name))
            continue;
        const auto time = is_transferred(name) ? 0.0 : time_in(name);
        if (time) frames.push_back({*time, name, kind_of(phase)});
    }
    std::ranges::sort(frames, {},
                      [](const Frame& frame) { return std::pair(frame.time, frame.name); });
    return frames;
}

std::string FrameReader::points(const std::filesystem::path& file, const std::string& phase,
                                std::size_t stride) {
    const std::lock_guard lock(mutex_);
    return packed(kind_of(phase) == phases::fem.frames ? nodes_of(file)
                                                       : particles_of(file, stride));
}

}  // namespace breach::orchestrator
