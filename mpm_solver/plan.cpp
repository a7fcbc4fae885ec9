// --plan: which features the scene uses and why, one line each. Lines of decisions that select
// loops come from choose.hpp, whose result the run uses; the others state entries of the scene.
#include <algorithm>

#include "core/scene/beds.hpp"
#include "core/scene/resolution.hpp"
#include "core/scene/stiffness.hpp"
#include "core/words/number.hpp"
#include "mpm_solver/body/choose.hpp"
#include "mpm_solver/body/points.hpp"
#include "mpm_solver/measure/overlap.hpp"
#include "mpm_solver/run.hpp"

namespace breach::mpm {

namespace {

using process::Plan;
using process::Use;
using words::text_of;

void plan_softening(const scene::Scene& scene, const scene::Material& material, Plan& plan) {
    const std::string& name = material.name;
    const bool of_points = materials::has_strength_of_points(material.law);
    const std::string pointer =
        "/materials/" + name + (of_points ? "/strength/softening" : "/law/softening");
    if (!materials::softening(material.law)) {
        plan.push_back({"softening of " + name, Use::left_out,
                        "the law has none: its strength is constant", pointer});
        return;
    }
    const auto& length = scene.mpm->softening_length;
    const double band = scene::band_width(material, *scene.mpm);
    const bool nonlocal = scene::nonlocal_length_in_runout(material, *scene.mpm).has_value();
    plan.push_back({"softening of " + name, Use::on, "strength falls with epsilon_q", pointer});
    plan.push_back({"nonlocal softening of " + name, nonlocal ? Use::on : Use::left_out,
                    nonlocal ? "bands " + text_of(band) + " m wide, independent of the cell size"
                             : "every point softens by its own strain: bands are a cell wide",
                    "/materials/" + name + "/nonlocal_length"});
    plan.push_back({"softening strains of " + name + " scaled to the band",
                    length ? Use::on : Use::left_out,
                    length ? "factor " + text_of(*length / band)
                           : "taken as they stand: bands narrow with the cells and dissipate less",
                    "/mpm/softening_length"});
}

void plan_laws(const scene::Scene& scene, Plan& plan) {
    for (const scene::Material& material : scene.materials) {
        const std::string pointer = "/materials/" + material.name + "/law";
        const SoilDecisions decided =
            decide(*scene.mpm, {material.name, material.law, material.viscosity});
        plan.push_back(decided.viscosity.line);
        const materials::Traits law = materials::traits(material.law);
        const std::string name = law.name;
        if (!materials::is_for_particles(material.law)) {
            plan.push_back({"law of " + material.name, Use::left_out,
                            name + " belongs to the FEM: no particle may have it", pointer});
            continue;
        }
        plan.push_back(decided.averages.line);
        plan.push_back({"law of " + material.name, Use::on,
                        law.opens ? name + " with tension cut-off" : name, pointer});
        if (materials::has_strength_of_points(material.law))
            plan.push_back({"strength of " + material.name + " by point", Use::on,
                            "each point has its own from the material's profile",
                            "/materials/" + material.name + "/strength"});
        if (law.yields) plan_softening(scene, material, plan);
    }
    plan.push_back({"dispatch of laws", scene.materials.size() > 1 ? Use::on : Use::left_out,
                    scene.materials.size() > 1
                        ? "once per zone, points of a material are neighbours"
                        : "one material, one loop",
                    "/materials"});
    plan.push_back({"pore pressure", Use::left_out,
                    scene.mpm->water ? "points carry sigma + p I" : "points carry total stress",
                    "/materials"});
    plan.push_back(
        {"standing water", scene.mpm->water ? Use::on : Use::left_out,
         scene.mpm->water
             ? "its still pressure acts at the points, which carry sigma + p I; drag and "
               "added mass are left out: the runout is an upper bound"
             : "no /mpm/water: the runout is in air",
         "/mpm/water"});
}

/// The ratio in force, which the cells and the wave speed limit.
process::PlanLine damping_line(const scene::Scene& scene) {
    const scene::Mpm& mpm = *scene.mpm;
    const auto line = [](Use use, std::string reason) {
        return process::PlanLine{"damping of what does not yield", use, std::move(reason),
                                 "/mpm/damping_ratio"};
    };
    if (mpm.damping_ratio == 0.0)
        return line(Use::left_out, "0: stress waves in soil that stands go on");
    double least = mpm.damping_ratio, largest = 0.0;
    for (const scene::Soil& each : scene::soils_of(scene)) {
        const scene::Material& soil = scene.materials[each.material];
        if (!materials::is_for_particles(soil.law)) continue;
        const double ratio = damping_of(scene, soil, scene::elasticity_in_runout(soil, mpm)).ratio;
        least = std::min(least, ratio);
        largest = std::max(largest, ratio);
    }
    const std::string where = " of critical at the mobile soil's height; what flows is not damped";
    if (least > 0.999 * mpm.damping_ratio) return line(Use::on, text_of(mpm.damping_ratio) + where);
    const std::string range =
        text_of(least, 2) + (largest > 1.01 * least ? " to " + text_of(largest, 2) : "");
    return line(Use::on, range + " instead of " + text_of(mpm.damping_ratio) + where +
                             "; cells of " + text_of(mpm.cell_size) + " m" +
                             (mpm.wave_speed_limit ? " and \"stiffness_scale\": \"auto\"" : "") +
                             " allow no more");
}

void plan_scheme(const scene::Scene& scene, Plan& plan) {
    const scene::Mpm& mpm = *scene.mpm;
    const SchemeDecisions decided = decide(mpm);
    plan.push_back({"drawing to affine PIC", mpm.blending_rate > 0.0 ? Use::on : Use::left_out,
                    "rate " + text_of(mpm.blending_rate) + " 1/s", "/mpm/blending_rate"});
    plan.push_back(damping_line(scene));
    plan.push_back(decided.overlap.line);
    plan.push_back(decided.shaking.line);
    plan.push_back({"adaptive time step", mpm.time_step ? Use::left_out : Use::on,
                    mpm.time_step ? "fixed at " + text_of(*mpm.time_step) + " s"
                                  : "Courant number " + text_of(mpm.cfl),
                    mpm.time_step ? "/mpm/time_step" : "/mpm/cfl"});
}

process::PlanLine stiffness_line(const scene::Scene& scene) {
    const scene::Mpm& mpm = *scene.mpm;
    const auto line = [](Use use, std::string reason) {
        return process::PlanLine{"stiffness scaling", use, std::move(reason),
                                 "/mpm/stiffness_scale"};
    };
    if (mpm.stiffness_scale != 1.0)
        return line(Use::on, "factor " + text_of(mpm.stiffness_scale) + " on every E");
    if (!mpm.wave_speed_limit) return line(Use::left_out, "soil has the scene's stiffness");
    const double fastest = scene::fastest_wave(scene, mpm);
    const std::string limit = text_of(*mpm.wave_speed_limit) + " m/s, " +
                              text_of(scene::waves_per_fall) + " times a free fall of " +
                              text_of(scene::fall_speed(scene, mpm)) + " m/s";
    if (fastest < 0.999 * *mpm.wave_speed_limit)
        return line(Use::left_out, "no wave is faster than " + limit);
    return line(Use::on, "lower bulk moduli hold compression waves to " + limit);
}

void plan_beds(const scene::Scene& scene, Plan& plan) {
    std::string tops;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const auto rows = scene::rows_below_bed(scene, m);
        if (!rows) continue;
        const scene::Mpm& mpm = *scene.mpm;
        tops += (tops.empty() ? "" : ", ") + scene.materials[m].name + " at " +
                text_of(mpm.floor.level + *rows * mpm.cell_size) + " m";
    }
    plan.push_back({"domains that end at the top of firm soil",
                    tops.empty() ? Use::left_out : Use::on,
                    tops.empty() ? "no firm soil lies under weaker soil with a level top on a line "
                                   "of the grid"
                                 : tops + ": it does not hold what slides on it",
                    "/section/regions"});
}

/// One line for all soils: of the first one that opens, if any.
void plan_gap_closure(const scene::Scene& scene, Plan& plan) {
    std::optional<process::PlanLine> line;
    for (const scene::Material& soil : scene.materials) {
        line = decide(*scene.mpm, {soil.name, soil.law, soil.viscosity}).volume_rule.line;
        if (materials::traits(soil.law).opens) break;
    }
    if (line) plan.push_back(*line);
    const bool closes = line && line->use == Use::on;
    const bool held = closes && scene.mpm->gap_room;
    plan.push_back({"gaps held to the room between neighbours", held ? Use::on : Use::left_out,
                    !closes ? "no gap is kept"
                    : held  ? "every " + std::to_string(steps_between_marks) + " steps"
                            : "no steep ground, or not wanted: debris that falls among other "
                              "soil stays open until compressed",
                    "/mpm/gap_room"});
}

std::string span(const std::array<double, 2>& range) {
    return text_of(range[0]) + " to " + text_of(range[1]) + " m";
}

void plan_boundaries(const scene::Mpm& mpm, Plan& plan) {
    plan.push_back({"grid", Use::on,
                    "x = " + span(mpm.domain_x) + ", y = " + span(mpm.domain_y) +
                        ": whole cells of " + text_of(mpm.cell_size) + " m",
                    "/mpm/domain_x"});
    const bool slips = !mpm.floor.friction.empty();
    if (!mpm.terrain.empty()) {
        plan.push_back({"terrain", Use::on,
                        std::to_string(mpm.terrain.size()) +
                            " vertices, felt by nodes within half "
                            "a cell; the floor lies below and is never touched",
                        "/mpm/terrain"});
    }
    plan.push_back(
        {"floor friction", slips ? Use::on : Use::left_out,
         slips ? std::to_string(mpm.floor.friction.size()) + " zones, evaluated at floor nodes only"
               : "no zones: the floor holds the soil",
         "/mpm/floor/friction"});
    const auto wall = [&](const char* side, scene::Wall kind) {
        plan.push_back({std::string(side) + " wall",
                        kind == scene::Wall::open ? Use::left_out : Use::on,
                        kind == scene::Wall::open     ? "open: a point that reaches it ends the run"
                        : kind == scene::Wall::roller ? "roller"
                                                      : "fixed",
                        std::string("/mpm/") + side});
    };
    wall("left", mpm.left);
    wall("right", mpm.right);
}

void plan_end(const scene::Mpm& mpm, Plan& plan) {
    const scene::Rest& rest = mpm.rest;
    plan.push_back(
        {"run until rest", mpm.until_rest ? Use::on : Use::left_out,
         (mpm.until_rest ? "asked for, at most " : "soil that still moves is cut off at ") +
             text_of(mpm.duration) + " s",
         "/mpm/duration"});
    plan.push_back({"end at rest", Use::on,
                    "front still within " + text_of(rest.change) + " m over " +
                        text_of(rest.window) + " s, not before " + text_of(rest.earliest) +
                        " s; kinetic energy below " + text_of(100.0 * rest.kinetic_share) +
                        " % of what is released and " + text_of(100.0 * rest.peak_share) +
                        " % of its peak; no body of " + text_of(100.0 * rest.body_share) +
                        " % of the soil faster than " + text_of(rest.speed) + " m/s",
                    "/mpm/rest_window"});
}

}  // namespace

Plan plan(const scene::Scene& scene) {
    const scene::Mpm& mpm = scene::mpm_of(scene);
    Plan plan;
    plan_laws(scene, plan);
    plan_scheme(scene, plan);
    plan.push_back(stiffness_line(scene));
    plan_beds(scene, plan);
    plan_gap_closure(scene, plan);
    plan_boundaries(mpm, plan);
    plan_end(mpm, plan);
    plan.push_back({"total epsilon_q", Use::on, "for pictures; softening has its own", "/mpm"});
    plan.push_back({"active nodes only", Use::on, "empty cells cost nothing", "/mpm/domain_x"});
    plan.push_back(
        {"sorting of points", Use::on,
         "whenever one has strayed half a cell: neighbours share cache and threads share "
         "no nodes",
         "/mpm/cell_size"});
    plan.push_back(
        {"threads", Use::on, "as --threads says; the results do not depend on it", "/mpm"});
    return plan;
}

}  // namespace breach::mpm
