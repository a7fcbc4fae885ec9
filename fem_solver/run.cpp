// From a scene to a Course: mesh, model, then analysis.cpp. Meshing is not in a checkpoint: a
// resumed run meshes again and gets the same mesh.
#include "fem_solver/run.hpp"

#include <spdlog/spdlog.h>

#include <numbers>
#include <sstream>

#include "core/check/applied_motion.hpp"
#include "core/exchange/provenance.hpp"
#include "core/exchange/publish.hpp"
#include "core/motion/measures.hpp"
#include "core/motion/plausibility.hpp"
#include "core/phases/files.hpp"
#include "fem_solver/analysis.hpp"
#include "fem_solver/choose.hpp"
#include "fem_solver/model/build_model.hpp"

namespace breach::fem {

namespace {

/// Stores the applied motion, so that readers need no other file, and reports it in the log and,
/// with the source file's hash, in the result.
void keep_motion(process::Session& session, const scene::BaseMotion& wanted) {
    const motion::Recording applied = check::applied_motion(wanted);
    const std::string name = wanted.file.filename().string();
    std::ostringstream csv;
    motion::write_csv(csv, applied, "as applied, from " + name);
    exchange::publish_text(session.output(phases::files::motion), csv.str());
    const motion::Peaks peaks = motion::peaks_of(applied);
    spdlog::info("motion {} as applied: {}", name, motion::summary_of(applied));
    session.result()["motion"] = {{"file", name},
                                  {"sha256", exchange::sha256_of_file(wanted.file)},
                                  {"pga_g", peaks.acceleration / motion::standard_gravity},
                                  {"pgv", peaks.velocity},
                                  {"duration", applied.series.duration()},
                                  {"time_step", applied.series.dt}};
    if (applied.quantity == motion::Quantity::acceleration)
        session.result()["motions"]["input"] = as_json(motion::measures_of(applied.series));
}

}  // namespace

process::Outcome run(process::Session& session) {
    const scene::Scene& scene = session.scene();
    Mesh mesh;
    try {
        mesh =
            build_mesh(scene, session.settings().output, [&] { return session.stop_requested(); });
    } catch (const MeshingStopped&) {
        // No checkpoint exists yet: the run starts again from its scene.
        return process::Outcome::stopped;
    }
    const Quality quality = quality_of(mesh);
    spdlog::info(
        "mesh: {} quads, {} nodes, edges {:.3g} to {:.3g} m, least angle {:.0f} deg, "
        "largest aspect {:.1f}, least Jacobian {:.2f}",
        mesh.quads.size(), mesh.nodes.size(), quality.shortest_edge, quality.longest_edge,
        quality.smallest_angle * 180.0 / std::numbers::pi, quality.largest_aspect,
        quality.least_jacobian);
    const ModelDecisions decided = decide_model(scene);
    // Before the analysis: readers find the motion even if the analysis breaks down.
    if (const auto& motion = decided.motion.value) keep_motion(session, *motion);
    Course course(session, build_model(scene, decided, std::move(mesh)));
    return analyse(course);
}

process::Plan plan(const scene::Scene& scene) { return plan_of(decide(scene), scene); }

}  // namespace breach::fem
