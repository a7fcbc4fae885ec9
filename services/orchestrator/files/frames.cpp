// Snapshots for the dashboard's canvas: single precision and flat, so that a browser uses the bytes
// as they come. The list needs names only and no HDF5; TriggerWatch takes it, too.
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

/// The number at the end of "snapshot_0.500000.vtkhdf". Files without one
/// (phases::files::final_state) repeat a numbered frame.
std::optional<double> time_in(const std::string& name) {
    static const std::regex number(R"(_([0-9]+(\.[0-9]+)?)\.vtkhdf$)");
    std::smatch found;
    if (!std::regex_search(name, found, number)) return std::nullopt;
    return std::stod(found[1]);
}

/// The transfer's only frame: the material points at time zero.
bool is_transferred(const std::string& name) { return name == phases::files::particles; }

struct Cloud {
    double time = 0.0;
    std::vector<std::string> regions, materials;
    std::vector<float> x, y, region;
    /// Empty: not in the file.
    std::vector<float> speed, epsilon_q, epsilon_q_plastic, r_u, pore_pressure;
    std::vector<float> u_x, u_y, displacement, sigma_v;  ///< of a mesh only
    std::vector<std::uint32_t> quads;

    void add(const mechanics::Vec2& position, std::int32_t region_index) {
        x.push_back(static_cast<float>(position[0]));
        y.push_back(static_cast<float>(position[1]));
        region.push_back(static_cast<float>(region_index));
    }
};

float length_of(const mechanics::Vec2& vector) {
    return static_cast<float>(std::hypot(vector[0], vector[1]));
}

template <class Number>
void append(std::string& bytes, const std::vector<Number>& numbers) {
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

using Fields = std::vector<std::pair<std::string, const std::vector<float>*>>;

/// Fields of the file, without those that are not wanted.
Fields fields_of(const Cloud& cloud, const std::vector<std::string>& wanted) {
    Fields fields{{"x", &cloud.x},
                  {"y", &cloud.y},
                  {"speed", &cloud.speed},
                  {"epsilon_q", &cloud.epsilon_q},
                  {"region", &cloud.region},
                  {"r_u", &cloud.r_u},
                  {"pore_pressure", &cloud.pore_pressure},
                  {"epsilon_q_plastic", &cloud.epsilon_q_plastic},
                  {"u_x", &cloud.u_x},
                  {"u_y", &cloud.u_y},
                  {"displacement", &cloud.displacement},
                  {"sigma_v", &cloud.sigma_v}};
    std::erase_if(fields, [](const auto& field) { return field.second->empty(); });
    if (wanted.empty()) return fields;
    for (const std::string& name : wanted) {
        if (std::ranges::find(fields, name, &Fields::value_type::first) != fields.end()) continue;
        std::string known;
        for (const auto& field : fields) known += (known.empty() ? "" : ", ") + field.first;
        throw NoSuchField("the snapshot has no field \"" + name + "\"; it has " + known);
    }
    std::erase_if(fields, [&](const auto& field) {
        return field.first != "x" && field.first != "y" &&
               std::ranges::find(wanted, field.first) == wanted.end();
    });
    return fields;
}

std::string packed(const Cloud& cloud, const std::vector<std::string>& wanted) {
    const Fields fields = fields_of(cloud, wanted);
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
        if (!state.velocity.empty()) cloud.speed.push_back(length_of(state.velocity[p]));
        for (const auto& [from, to] :
             {std::pair{&state.epsilon_q, &cloud.epsilon_q}, std::pair{&state.r_u, &cloud.r_u},
              std::pair{&state.pore_pressure, &cloud.pore_pressure},
              std::pair{&state.epsilon_q_plastic, &cloud.epsilon_q_plastic}})
            if (!from->empty()) to->push_back(static_cast<float>((*from)[p]));
    }
    return cloud;
}

constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

/// u and r_u = (u - u_0) / sigma'_v0 of the nodes, if the snapshot has them. Dry soil and soil
/// without effective stress before the shaking have no r_u: NaN, not zero.
void add_water(Cloud& cloud, const exchange::MeshSnapshot& mesh) {
    for (const double u : mesh.pore_pressure) cloud.pore_pressure.push_back(static_cast<float>(u));
    const std::vector<double> excess = exchange::nodal_excess_pressure(mesh);
    if (excess.empty()) return;
    cloud.r_u.assign(excess.size(), no_value);
    for (const auto& quad : mesh.quads) {
        // Like nodal_excess_pressure: an element without u_0 at its corners is dry.
        const bool wet = std::ranges::any_of(
            quad, [&](std::int32_t i) { return mesh.pore_pressure_0[i] != 0.0; });
        for (const std::int32_t i : quad)
            if (wet && mesh.sigma_v0[i] > 0.0)
                cloud.r_u[i] = static_cast<float>(excess[i] / mesh.sigma_v0[i]);
    }
}

/// Mean of each element's Gauss points, averaged over the elements around each node.
template <class Value>
std::vector<float> nodal_means(const exchange::MeshSnapshot& mesh, const Value& value_at) {
    const auto per_element = static_cast<std::size_t>(mesh.gauss_per_element);
    std::vector<double> sum(mesh.position_0.size(), 0.0), touched(mesh.position_0.size(), 0.0);
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        double mean = 0.0;
        for (std::size_t g = 0; g < per_element; ++g)
            mean += value_at(e * per_element + g) / static_cast<double>(per_element);
        for (const std::int32_t i : mesh.quads[e]) {
            sum[i] += mean;
            touched[i] += 1.0;
        }
    }
    std::vector<float> means(sum.size());
    for (std::size_t i = 0; i < sum.size(); ++i)
        means[i] = static_cast<float>(sum[i] / std::max(1.0, touched[i]));
    return means;
}

/// Nodes in their displaced positions; a node has the region of the last element around it.
Cloud nodes_of(const std::filesystem::path& file) {
    const auto mesh = exchange::read_mesh_snapshot(file).snapshot;
    const std::size_t n_nodes = mesh.position_0.size();
    std::vector<std::int32_t> region(n_nodes, 0);
    Cloud cloud;
    for (std::size_t e = 0; e < mesh.quads.size(); ++e) {
        for (const std::int32_t i : mesh.quads[e]) {
            region[i] = mesh.region_of_element[e];
            cloud.quads.push_back(static_cast<std::uint32_t>(i));
        }
    }
    cloud.time = mesh.time;
    cloud.regions = mesh.regions;
    cloud.materials = mesh.materials_of_regions;
    for (std::size_t i = 0; i < n_nodes; ++i) {
        const mechanics::Vec2& u = mesh.displacement[i];
        cloud.add(mesh.position_0[i] + u, region[i]);
        cloud.speed.push_back(length_of(mesh.velocity[i]));
        cloud.u_x.push_back(static_cast<float>(u[0]));
        cloud.u_y.push_back(static_cast<float>(u[1]));
        cloud.displacement.push_back(length_of(u));
    }
    cloud.epsilon_q = nodal_means(mesh, [&](std::size_t g) { return mesh.epsilon_q[g]; });
    // Compression positive, as sigma_v0.
    cloud.sigma_v = nodal_means(mesh, [&](std::size_t g) { return -mesh.stress[g][1]; });
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
                                std::size_t stride, const std::vector<std::string>& wanted) {
    const std::lock_guard lock(mutex_);
    return packed(
        kind_of(phase) == phases::fem.frames ? nodes_of(file) : particles_of(file, stride), wanted);
}

}  // namespace breach::orchestrator
