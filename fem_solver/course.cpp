// Start, stages and restart of a Course. A resumed one takes its position first: supports, absent
// soil and water are those of its stage, and with them the sizes of the arrays that follow.
#include "fem_solver/course.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "core/phases/files.hpp"
#include "core/scene/resolution.hpp"
#include "fem_solver/model/stages.hpp"
#include "fem_solver/solve/trial.hpp"

namespace breach::fem {

namespace {

constexpr const char* geostatic =
    "geostatic";  // facts of stages that a resumed run does not repeat
constexpr const char* entanglement_name = "entanglement";

/// LDL^T for static stages without plasticity, dynamic stages (the mass keeps the symmetrised
/// tangent positive) and PM4Sand, whose tangent is symmetric. Mohr-Coulomb statics near collapse
/// needs the true, unsymmetric tangent. Slope scene, 150 steps: LDL^T 886 iterations, 0.77 s; LU
/// 822 iterations, 1.12 s.
Symmetry symmetry_for(const scene::Stage& stage, const std::vector<materials::Law>& laws) {
    const bool symmetric = std::ranges::all_of(
        laws, [](const auto& law) { return materials::traits(law).symmetric_tangent; });
    const bool general =
        stage.kind == scene::StageKind::static_equilibrium && stage.undrained.empty() && !symmetric;
    return general ? Symmetry::general : Symmetry::symmetric;
}

/// Reports the node used as crest; flags one that is far away.
void report_crest(Course& course) {
    const Mesh& body = course.watch.body();
    const Vec2& node = body.nodes[course.crest_node];
    // Triggers and milestones read this node; a crest drawn beside the mesh would go unnoticed.
    const double distance = (node - course.fem.crest).norm();
    const double size = element_size_at(body, course.crest_node);
    std::ostringstream text;
    text << "the crest's displacement is that of the node at (" << node.x() << ", " << node.y()
         << "), " << distance << " m from /fem/crest";
    course.session.result()["crest"] = {{"x", node.x()}, {"y", node.y()}, {"distance", distance}};
    constexpr double near = 2.0;  // element sizes
    if (distance <= near * size) {
        spdlog::info("{}", text.str());
        return;
    }
    text << ", which is " << std::round(distance / size)
         << " element sizes: another place than was asked for; give a point on the ground";
    course.session.flag({"far_crest", fault::Severity::warning, text.str(), "/fem/crest"});
}

/// The check of a scene does not read a mesh file.
void flag_short_lengths(const Model& model, process::Session& session) {
    const scene::Scene& scene = session.scene();
    if (!scene::fem_of(scene).mesh.msh_file) return;
    std::map<std::size_t, double> largest;  // by material [m2]
    for (const Zone& zone : model.zones) {
        if (zone.nonlocal_length <= 0.0) continue;
        const auto region = static_cast<std::size_t>(model.mesh.region_of_element[zone.first]);
        double& area = largest[scene.section.regions[region].material];
        for (std::size_t e = zone.first; e < zone.first + zone.count; ++e)
            area = std::max(area, model.volume[e] / scene.thickness);
    }
    for (const auto& [material, area] : largest)
        if (const auto flag = scene::short_length(scene.materials[material], std::sqrt(area)))
            session.flag(*flag);
}

}  // namespace

Course::Course(process::Session& its_session, Model its_model)
    : session(its_session),
      fem(scene::fem_of(session.scene())),
      decided(decide_run(session.scene())),
      model(std::move(its_model)),
      watch(fem, model),
      crest_node(nearest_node(watch.body(), fem.crest)) {
    trial = motion = at_rest(model);
    const auto& switches = session.settings().switches;
    if (switches.contains(profile_switch) || switches.contains(trial_switch))
        seconds.clock = process::Session::cpu_seconds;
    span = fem.duration();
    if (fem.changes_the_body()) check_changes();
    prediction = prediction_for(model);
    report_crest(*this);
    flag_short_lengths(model, session);
    const bool resumed = session.settings().start == process::Start::resume &&
                         std::filesystem::exists(session.output(phases::files::checkpoint));
    if (resumed) {
        resume();
    } else {
        session.truncate_telemetry(0);
    }
}

/// Applies every stage to a copy, to refuse impossible ones before computing.
void Course::check_changes() const {
    Model copy = model;
    const ModelDecisions of_model = decide_model(session.scene());
    for (std::size_t s = 0; s < fem.stages.size(); ++s)
        set_stage(session.scene(), of_model, s, copy);
}

const scene::Stage& Course::stage() const { return fem.stages[position.stage]; }

std::string Course::pointer_of_stage() const {
    return "/fem/stages/" + std::to_string(position.stage);
}

double Course::stage_begin() const {
    double begin = 0.0;
    for (std::int64_t s = 0; s < position.stage; ++s) begin += fem.stages[s].duration;
    return begin;
}

void Course::place_stage() {
    if (!fem.changes_the_body()) return;
    set_stage(session.scene(), decide_model(session.scene()),
              static_cast<std::size_t>(position.stage), model);
    watch.look_at(model);
    apply_to_model(beginning, model);
    prediction = prediction_for(model);
}

void Course::make_newton() {
    // A draining static stage knows its pressures (set_steady_pressure); an undrained one solves
    // for them.
    const Solved solved = stage().kind == scene::StageKind::dynamic ? Solved::motion_and_pressure
                          : stage().undrained.empty()               ? Solved::displacement
                                                      : Solved::displacement_and_pressure;
    place_stage();
    const Stopwatch stopwatch(seconds, &Seconds::factor);
    newton.emplace(
        model, solved,
        NewtonSettings{fem.force_tolerance, fem.largest_iterations, session.settings().threads},
        symmetry_for(stage(), laws_for(model, stage().laws)), seconds);
    newton->set_counts(counts);
}

void Course::write_checkpoint() {
    const Stopwatch stopwatch(seconds, &Seconds::output);
    counts = newton->counts();
    exchange::Archive archive = checkpoint_archive(*this, newton->memory(), session.scene());
    // What a resumed run does not find again: facts of static stages, the entanglement, flags.
    const nlohmann::json& facts = session.result();
    if (facts.contains(geostatic)) archive.texts[geostatic] = facts.at(geostatic).dump();
    if (entanglement) archive.texts[entanglement_name] = as_json(*entanglement).dump();
    put_flags(session.flags(), archive);
    exchange::write_archive(session.output(phases::files::checkpoint), archive,
                            session.provenance());
}

void Course::resume() {
    const auto file = session.output(phases::files::checkpoint);
    const exchange::Archive archive =
        exchange::read_archive(file, checkpoint_kind, checkpoint_version, exchange::Reals::finite);
    position = position_in(archive, session.scene(), file.string());
    place_stage();
    Checkpoint checkpoint = checkpoint_from(archive, session.scene(), model, file.string());
    // Facts of stages before the checkpoint are taken from it, as these stages do not run again.
    if (const auto kept = archive.texts.find(geostatic); kept != archive.texts.end())
        session.result()[geostatic] = nlohmann::json::parse(kept->second);
    if (const auto noted = archive.texts.find(entanglement_name); noted != archive.texts.end())
        entanglement =
            entanglement_from(nlohmann::json::parse(noted->second), session.scene().section);
    static_cast<Kept&>(*this) = std::move(checkpoint.kept);
    trial = motion;
    apply_to_model(beginning, model);
    raise_again(flags_in(archive, file.string()));
    session.truncate_telemetry(position.telemetry_lines);
    session.went_on_after(archive.spent);
    // --profile counts this process only, from here.
    before = {position.step, counts.iterations};
    make_newton();
    if (!newton->restore(checkpoint.newton))
        throw fault::BadInput(file.string(), {{"/breachline/reals/newton.values",
                                               "the matrix is not that of this mesh",
                                               "resume with the same scene, or start afresh"}});
    distortion = distortion_of(model, motion, fem.strain_threshold);
    spdlog::info("goes on at {} s (step {})", position.time, position.step);
}

/// Flags found before the checkpoint, which are not found again.
void Course::raise_again(const std::vector<fault::Flag>& flags) {
    for (const fault::Flag& each : flags) {
        const bool is_there = std::ranges::any_of(session.flags(), [&](const fault::Flag& present) {
            return present.code == each.code && present.pointer == each.pointer;
        });
        if (!is_there) session.flag(each);
    }
}

}  // namespace breach::fem
