#include "mpm_solver/begin.hpp"

#include <spdlog/spdlog.h>

#include "mpm_solver/body/fill.hpp"

namespace breach::mpm {

namespace {

void log_sampling(const std::vector<SampledRegion>& regions) {
    for (const SampledRegion& region : regions) {
        spdlog::log(
            is_faithful(region) ? spdlog::level::info : spdlog::level::warn,
            "region {}: {} points hold {:.6f} m2 of the polygon's {:.6f} m2, their centroid "
            "lies at {:.4f} m, the polygon's at {:.4f} m",
            region.name, region.points, region.sampled_area, region.polygon_area,
            region.sampled_level, region.polygon_level);
    }
}

Body fresh_body(const scene::Scene& scene, const exchange::ParticleState& state,
                const std::string& source, const Computing& computing) {
    Body body = make_body(scene, zoned_points(scene, state, source), source, computing);
    refuse_buried_points(body, source);
    return body;
}

}  // namespace

Computing computing_of(const process::Session& session) {
    return {.threads = session.settings().threads};
}

Begun begin(const process::Session& session) {
    const scene::Scene& scene = session.scene();
    if (session.settings().inputs.empty()) {
        const FilledSection filled = fill_section(scene);
        log_sampling(filled.regions);
        const std::string source = scene.name + " (section filled with points)";
        return {fresh_body(scene, filled.state, source, computing_of(session)), 0.0};
    }
    const exchange::ParticleState state = exchange::read_particle_state(session.input()).state;
    const std::string source = session.input().string();
    log_sampling(sampling_of(scene, state));
    return {fresh_body(scene, state, source, computing_of(session)), state.transfer_time};
}

}  // namespace breach::mpm
