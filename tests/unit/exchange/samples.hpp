// Small states in which all numbers differ.
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"
#include "tests/folder.hpp"

namespace breach::exchange::samples {

using test::Folder;

inline std::string content(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline void overwrite(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// n x 1 unit squares in a row; the right half belongs to the second region.
inline MeshSnapshot mesh(std::int32_t n) {
    MeshSnapshot s;
    s.time = 1.25;
    s.step = 250;
    s.thickness = 2.0;
    s.regions = {"starter dam", "tailings"};
    s.materials_of_regions = {"rockfill", "silt"};
    for (std::int32_t i = 0; i < 2 * (n + 1); ++i) {
        const double k = i;
        s.position_0.emplace_back(i % (n + 1), i / (n + 1));
        s.displacement.emplace_back(0.01 * k, -0.02 * k);
        s.velocity.emplace_back(1.0 + k, 2.0 - k);
        s.acceleration.emplace_back(0.1 * k, 9.81);
        s.nodal_mass.push_back(500.0 + k);
        s.pore_pressure.push_back(1e3 * k);
    }
    const double a = 1.0 / std::sqrt(3.0);
    s.gauss_positions = {{-a, -a}, {a, -a}, {a, a}, {-a, a}};
    for (std::int32_t e = 0; e < n; ++e) {
        s.quads.push_back({e, e + 1, e + n + 2, e + n + 1});
        s.region_of_element.push_back(e < (n + 1) / 2 ? 0 : 1);
        s.density.push_back(1800.0 + e);
        for (int g = 0; g < 4; ++g) {
            const double k = 4.0 * e + g;
            s.stress.emplace_back(-1e3 * k, -2e3 * k - 1.0 / 3.0, -3e3 * k, 10.0 * k);
            s.strain.emplace_back(1e-3 * k, -1e-3 * k, 0.0, 2e-3 * k);
            s.epsilon_q.push_back(1e-2 * k);
            s.epsilon_q_plastic.push_back(5e-3 * k);
        }
    }
    return s;
}

inline ParticleState particles(std::int32_t n) {
    ParticleState s;
    s.time = 0.5;
    s.transfer_time = 14.75;
    s.step = 42;
    s.thickness = 1.5;
    s.regions = {"starter dam", "tailings"};
    s.materials_of_regions = {"rockfill", "silt"};
    for (std::int32_t i = 0; i < n; ++i) {
        const double k = i;
        s.position.emplace_back(0.25 * k, 10.0 - 0.125 * k);
        s.velocity.emplace_back(1.0 + k, 2.0 - k);
        mechanics::Matrix2 l;
        l << 0.1 * k, 0.2 * k, 0.3 * k, 0.4 * k;
        s.velocity_gradient.push_back(l);
        s.mass.push_back(450.0 + k);
        s.volume_0.push_back(0.25 + 0.01 * k);
        s.volume.push_back(0.24 + 0.01 * k);
        s.stress.emplace_back(-1e3 * k, -2e3 * k - 1.0 / 3.0, -3e3 * k, 10.0 * k);
        s.epsilon_q.push_back(1e-2 * k);
        s.epsilon_q_plastic.push_back(5e-3 * k);
        s.gap.push_back(1e-4 * k);
        s.region.push_back(i % 2);
    }
    return s;
}

inline Provenance provenance() {
    return {.phase = "fem_solver",
            .version = "0.1.0",
            .scene = R"({"name":"Böschung"})",
            .overrides = {"/gravity=9.8", "/name=x"},
            .inputs = {{"scene.json", std::string(64, 'a')}},
            .threads = 2,
            .spent = {.wall = 3.5, .cpu = 6.25}};
}

}  // namespace breach::exchange::samples
