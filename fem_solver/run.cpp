#include "fem_solver/run.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <numbers>
#include <sstream>

#include "core/check/applied_motion.hpp"
#include "core/exchange/provenance.hpp"
#include "core/exchange/publish.hpp"
#include "core/motion/plausibility.hpp"
#include "core/phases/files.hpp"
#include "core/words/number.hpp"
#include "fem_solver/analysis.hpp"
#include "fem_solver/model/build_model.hpp"
#include "fem_solver/solve/plastic_gravity.hpp"

namespace breach::fem {

namespace {

/// The motion as it is applied, after scaling: whoever reads the run needs no other file. What it
/// is goes to the log and, with the hash of the file it came from, to the result.
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
}

}  // namespace

process::Outcome run(process::Session& session) {
    const scene::Scene& scene = session.scene();
    Mesh mesh;
    try {
        mesh =
            build_mesh(scene, session.settings().output, [&] { return session.stop_requested(); });
    } catch (const MeshingStopped&) {
        return process::Outcome::stopped;
    }
    const Quality quality = quality_of(mesh);
    spdlog::info(
        "mesh: {} quads, {} nodes, edges {:.3g} to {:.3g} m, least angle {:.0f} deg, "
        "largest aspect {:.1f}, least Jacobian {:.2f}",
        mesh.quads.size(), mesh.nodes.size(), quality.shortest_edge, quality.longest_edge,
        quality.smallest_angle * 180.0 / std::numbers::pi, quality.largest_aspect,
        quality.least_jacobian);
    if (const auto& motion = scene::fem_of(scene).motion) keep_motion(session, *motion);
    Analysis analysis(session, build_model(scene, std::move(mesh)));
    return analysis.run();
}

namespace {

using process::PlanLine;
using process::Use;

template <typename Predicate>
std::string regions_where(const scene::Scene& scene, Predicate predicate) {
    std::string names;
    for (const scene::Region& region : scene.section.regions) {
        if (!predicate(region)) continue;
        names += (names.empty() ? "" : ", ") + region.name;
    }
    return names;
}

PlanLine on_if(bool on, const std::string& feature, const std::string& why_on,
               const std::string& why_not, const std::string& pointer) {
    return {feature, on ? Use::on : Use::left_out, on ? why_on : why_not, pointer};
}

/// "Mohr-Coulomb in a, b; ...": every law that yields with its regions; PM4Sand has a line of its
/// own.
std::string plastic_regions(const scene::Scene& scene) {
    std::vector<std::string> names;
    for (const scene::Material& material : scene.materials) {
        const std::string name = materials::traits(material.law).name;
        const bool stands_here =
            materials::traits(material.law).yields && !materials::sand_in(material.law);
        if (stands_here && std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    std::string text;
    for (const std::string& name : names) {
        const std::string regions = regions_where(scene, [&](const scene::Region& region) {
            return name == materials::traits(scene.materials[region.material].law).name;
        });
        if (regions.empty()) continue;
        text += (text.empty() ? "" : "; ") + name + " in " + regions;
    }
    return text;
}

/// "1000 Pa s beside the law's stress in a; ...": every material with a viscosity and its regions.
std::string viscous_regions(const scene::Scene& scene) {
    std::string text;
    for (const scene::Material& material : scene.materials) {
        if (material.viscosity == 0.0) continue;
        const std::string regions = regions_where(scene, [&](const scene::Region& region) {
            return &scene.materials[region.material] == &material;
        });
        if (regions.empty()) continue;
        text += (text.empty() ? "" : "; ") + words::text_of(material.viscosity) +
                " Pa s beside the law's stress in " + regions;
    }
    return text;
}

}  // namespace

process::Plan plan(const scene::Scene& scene) {
    const scene::Fem& fem = scene::fem_of(scene);
    const auto law_of = [&](const scene::Region& region) -> const materials::Law& {
        return scene.materials[region.material].law;
    };
    const std::string plastic = plastic_regions(scene);
    const std::string sand = regions_where(
        scene, [&](const auto& region) { return materials::sand_in(law_of(region)); });
    const std::string softening = regions_where(
        scene, [&](const auto& region) { return materials::softening(law_of(region)); });
    const std::string unstructured = regions_where(
        scene, [](const auto& region) { return region.mesh == scene::RegionMesh::unstructured; });
    const bool moves = std::ranges::any_of(
        fem.stages, [](const auto& s) { return s.kind == scene::StageKind::dynamic; });
    const auto begins = std::ranges::find(fem.stages, scene::StageLaws::scene, &scene::Stage::laws);
    const bool rests = !sand.empty() && begins != fem.stages.end() &&
                       rests_first(*begins, begins - fem.stages.begin());
    const bool large = fem.kinematics == scene::Kinematics::updated_lagrangian;
    const bool damped = fem.rayleigh_mass > 0.0 || fem.rayleigh_stiffness > 0.0;
    const std::string viscous = viscous_regions(scene);
    const bool meshes = !fem.mesh.msh_file && !unstructured.empty();
    return {
        on_if(scene.gravity > 0.0, "gravity", "the load of every stage", "gravity is zero",
              "/gravity"),
        on_if(!sand.empty(), "PM4Sand",
              "in " + sand + "; elastic until the first stage with its laws", "no material has it",
              "/materials"),
        on_if(rests, "friction before PM4Sand",
              "a static stage begins it: gravity's stresses are brought inside its surfaces first",
              sand.empty()
                  ? "no material has PM4Sand"
                  : "no static stage of the scene's laws follows elastic gravity; what lies "
                    "outside the surfaces stays as a constant stress",
              "/fem/stages"),
        on_if(!plastic.empty(), "plasticity", plastic, "no material flows plastically",
              "/materials"),
        on_if(!softening.empty(), "softening",
              "in " + softening + "; explicit per step, so shear bands are one element wide",
              "no law softens", "/materials"),
        on_if(moves, "inertia (Newmark)", "a stage is dynamic", "every stage is static",
              "/fem/stages"),
        on_if(large, "moving mesh (updated Lagrangian)", "asked for", "small strains",
              "/fem/kinematics"),
        on_if(fem.element == scene::ElementKind::ssp, "single-point quads, stabilised",
              fem.hourglass == scene::HourglassKind::elastic
                  ? "asked for; the stabilisation stays elastic"
                  : "asked for; the stabilisation follows the soil's shear modulus",
              "2 x 2 Gauss points, mean dilatation", "/fem/element"),
        on_if(damped, "Rayleigh damping", "asked for", "both coefficients are zero",
              "/fem/rayleigh_mass"),
        on_if(!viscous.empty() && moves, "viscosity", viscous,
              viscous.empty() ? "no region's material has one" : "no stage moves", "/materials"),
        on_if(meshes, "gmsh", "meshes " + unstructured, "regions are mapped blocks or a .msh file",
              "/section/regions"),
        on_if(!fem.snapshot_times.empty(), "snapshots on the way",
              std::to_string(fem.snapshot_times.size()) + " times",
              "only the end is kept, and what is asked for on the way", "/fem/snapshot_times"),
        on_if(fem.snapshot_interval > 0.0, "regular snapshots",
              "one per " + words::text_of(fem.snapshot_interval) + " s", "no interval is given",
              "/fem/snapshot_interval"),
        on_if(fem.water.has_value(), "pore pressure",
              "an unknown of every node below the phreatic line", "the scene has no water",
              "/fem/water"),
        on_if(fem.base.has_value(), "absorbing base (dashpots)",
              "the base is released when motion begins", "the base is held for ever", "/fem/base"),
        on_if(fem.motion.has_value(), "base motion", "comes through the absorbing base",
              fem.base ? "none is given: the base is at rest" : "there is no base to carry it",
              "/fem/motion"),
        on_if(fem.free_field.has_value(), "free-field columns",
              "thick columns move the sides as the free field does", "the scene asks for none",
              "/fem/free_field"),
        on_if(fem.liquefaction.has_value(), "liquefied layers",
              "depth and r_u below the watched ground", "nothing is watched", "/fem/liquefaction"),
        on_if(!fem.surcharge.empty(), "surcharge", "on the ground", "nothing lies on the ground",
              "/fem/surcharge"),
        on_if(fem.largest_step_error > 0.0, "step size from its error",
              "steps are cut and grown to keep it", "steps follow the iterations alone",
              "/fem/largest_step_error"),
    };
}

}  // namespace breach::fem
