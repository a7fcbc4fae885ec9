#include "tests/unit/report/wet_run.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/exchange/archive.hpp"
#include "core/exchange/mesh_snapshot.hpp"
#include "core/exchange/particle_state.hpp"

namespace breach::report {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

json scene_named(const std::string& name) {
    return {{"name", name},
            {"title", "Two wet elements"},
            {"section",
             {{"regions",
               {{{"name", "sand"}, {"polygon", {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0, 0}}}}}}}},
            {"fem",
             {{"motion", {{"file", "shake.csv"}, {"scale_to_pga_g", 0.3}}},
              {"liquefaction", {{"level", 1}}}}},
            {"transfer",
             {{"liquefied",
               {{"r_u", 0.7},
                {"regions", {"sand"}},
                {"layers", {{{"sigma_v0_kPa", {0, 50}}, {"material", "liquefied_1"}}}}}}}},
            {"mpm",
             {{"cell_size", 1.0},
              {"domain_x", {-1, 300}},
              {"floor", {{"level", -30}}},
              {"runout", {{"toe", {2, 0}}}},
              {"gauges", {{{"name", "toe"}, {"x", 2.0}}}}}}};
}

exchange::MeshSnapshot two_elements() {
    exchange::MeshSnapshot mesh;
    mesh.time = 14;
    mesh.regions = {"sand"};
    mesh.materials_of_regions = {"sand"};
    mesh.position_0 = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
    mesh.displacement.assign(6, {0.25, 0.0});
    mesh.velocity.assign(6, {0, 0});
    mesh.acceleration.assign(6, {0, 0});
    mesh.nodal_mass.assign(6, 1.0);
    mesh.pore_pressure_0.assign(6, 1e3);
    mesh.pore_pressure = {5e3, 5e3, 9e3, 5e3, 5e3, 9e3};
    mesh.sigma_v0.assign(6, 8e3);
    mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}};
    mesh.region_of_element = {0, 0};
    mesh.density = {1800, 1800};
    mesh.gauss_per_element = 1;
    mesh.gauss_positions = {{0, 0}};
    mesh.stress.assign(2, mechanics::Voigt(-4e3, -8e3, -4e3, 0));
    mesh.strain.assign(2, mechanics::Voigt::Zero());
    mesh.epsilon_q = {0.01, 0.5};
    mesh.epsilon_q_plastic = {0.0, 0.4};
    return mesh;
}

exchange::ParticleState four_points(double moved) {
    exchange::ParticleState points;
    points.transfer_time = 14;
    points.regions = {"sand", "sand"};
    points.materials_of_regions = {"sand", "liquefied_1"};
    points.resize(4);
    points.position = {{0.5, 0.25}, {0.5, 0.75}, {1.5 + moved, 0.25}, {1.5 + moved, 0.75}};
    points.mass.assign(4, 900);
    points.volume_0.assign(4, 0.5);
    points.volume.assign(4, 0.5);
    points.stress.assign(4, mechanics::Voigt(-4e3, -8e3, -4e3, 0));
    points.epsilon_q = {0.01, 0.01, 0.5, 0.75};
    points.region = {0, 0, 1, 1};
    points.pore_pressure.assign(4, 5e3);
    points.r_u = {0.5, 0.5, 0.75, 0.75};
    return points;
}

/// Liquefaction reaches 12 m at 11 s and 20 m at 15 s; the mesh is too distorted at 20 s.
std::string shaking() {
    std::string lines;
    for (int t = 0; t <= 21; ++t) {
        lines += json{{"time", t},
                      {"crest_displacement", 0.1 * t},
                      {"crest_dx", 0.1 * t},
                      {"crest_dy", 0.0},
                      {"kinetic_energy", 1e3 * t},
                      {"liquefaction_depth", t < 11 ? json(0.0) : json(t < 15 ? 12.5 : 20.0)},
                      {"failure_surfaces", t < 13   ? 0
                                           : t < 15 ? 1
                                                    : 2},
                      {"r_u_max", t < 11 ? 0.1 : 0.95},
                      {"jacobian_centre_avg", 1.0},
                      {"jacobian_least_avg", t < 20 ? 0.99 : 0.96},
                      {"jacobian_least_min", 1.0 - 0.04 * t},
                      {"epsilon_q_avg", 0.0125 * t}}
                     .dump() +
                 "\n";
    }
    return lines;
}

void write_runout(const fs::path& tasks, const json& scene, double t_T, const std::string& variant,
                  double runout) {
    const std::string time = std::to_string(t_T);
    const fs::path folder = tasks / ("mpm_" + time + "_" + variant);
    write(folder / "scene.completed.json", scene.dump());
    write(folder / "task.json",
          json{{"phase", "mpm_solver"}, {"transfer_time", t_T}, {"variant", variant}}.dump());
    write(folder / "result.json",
          json{{"phase", "mpm_solver"},
               {"runout", runout},
               {"runout_largest", runout},
               {"cpu_seconds", 2.5},
               {"energy", {{"numerical", {{"share", 0.02}}}}},
               {"gauges", {{"toe", {{"x", 2.0}, {"arrival_time", 0.5}, {"largest_depth", 0.75}}}}},
               {"provenance", {{"overrides", {"/mpm/cell_size=1"}}}}}
              .dump());
    write(folder / "telemetry.jsonl",
          "{\"time\":0,\"gauge.toe.depth\":0.1,\"gauge.toe.velocity\":0}\n"
          "{\"time\":1,\"gauge.toe.depth\":0.75,\"gauge.toe.velocity\":3.5}\n");
    exchange::write_particle_state(folder / "final.vtkhdf", four_points(runout), {});
    exchange::Archive history{.kind = "mpm_history",
                              .version = 1,
                              .reals = {{"profile.x", {0, 1, 2}},
                                        {"profile.times", {0, 0.5}},
                                        {"profile.depths", {1, 1, 0, 1, 0.9, 0.1}},
                                        {"envelope.x", {0, 1, 2}},
                                        {"envelope.final_depth", {1, 0.5, 0.5}}},
                              .integers = {},
                              .texts = {},
                              .units = {}};
    exchange::write_archive(folder / "history.h5", history, {});
}

}  // namespace

void write_wet_run(const fs::path& folder, const std::string& scene_name) {
    const json scene = scene_named(scene_name);
    const fs::path tasks = folder / "tasks";
    write(folder / "run.json", json{{"id", "01"}, {"name", "wet"}, {"title", "A wet run"}}.dump());
    write(folder / "study.json",
          json{{"variants",
                {{{"name", "softened"}, {"overrides", json::array()}},
                 {{"name", "not_softened"},
                  {"overrides",
                   {"/materials/a/viscosity=0", "/materials/b/viscosity=0",
                    "/mpm/terrain=[[0,0],[2,0],[102,-20]]"}}}}},
               {"triggers",
                {{{"kind", "window"},
                  {"lower", "liquefaction_depth >= 18.5 and failure_surfaces >= 2"},
                  {"upper", "jacobian_least_avg < 0.97"}}}}}
              .dump());
    write(tasks / "fem/scene.completed.json", scene.dump());
    write(tasks / "fem/telemetry.jsonl", shaking());
    write(tasks / "fem/fault.json", "{\"summary\":\"the mesh is entangled at 21 s\"}");
    write(tasks / "fem/shake.csv", "time_s,acceleration_g\n0,0\n0.5,0.1\n1,-0.2\n1.5,0.1\n2,0\n");
    exchange::write_mesh_snapshot(tasks / "fem/snapshot_14.000000.vtkhdf", two_elements(), {});
    write(tasks / "transfer_14.000000/scene.completed.json", scene.dump());
    write(tasks / "transfer_14.000000/result.json", "{\"phase\":\"transfer_tool\"}");
    exchange::write_particle_state(tasks / "transfer_14.000000/particles.vtkhdf", four_points(0),
                                   {});
    write_runout(tasks, scene, 13, "softened", 90);
    write_runout(tasks, scene, 16, "softened", 210);
    json sloping = scene;
    sloping["mpm"]["terrain"] = {{0, 0}, {2, 0}, {102, -20}};
    write_runout(tasks, sloping, 16, "not_softened", 30);
}

}  // namespace breach::report
