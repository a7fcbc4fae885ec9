// Small scenes for FEM tests: a block of soil on rollers, and functions to run it.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/check/check.hpp"
#include "fem_solver/analysis.hpp"
#include "fem_solver/model/build_model.hpp"
#include "tests/folder.hpp"

namespace breach::fem::bench {

using nlohmann::json;

struct Block {
    double width = 1.0;   ///< [m]
    double height = 1.0;  ///< [m]
    int columns = 1;
    int rows = 1;
    json law = {{"type", "linear_elastic"}, {"E_MPa", 20}, {"nu", 0.3}};
    double density = 2000.0;  ///< [kg/m3]
    double gravity = 9.81;    ///< [m/s2]
    json stages = json::array({{{"type", "static"}, {"name", "gravity"}}});
};

inline json static_stage(const char* name, const json& more = json::object()) {
    json stage{{"type", "static"}, {"name", name}};
    stage.update(more);
    return stage;
}

/// A rectangle on a fixed base between smooth walls.
inline json scene_of(const Block& b) {
    const double W = b.width, H = b.height;
    return {{"format", "breachline-scene/1"},
            {"name", "block"},
            {"gravity", b.gravity},
            {"materials", {{"soil", {{"density", b.density}, {"law", b.law}}}}},
            {"section",
             {{"regions",
               {{{"name", "block"},
                 {"material", "soil"},
                 {"polygon", {{0, 0}, {W, 0}, {W, H}, {0, H}, {0, 0}}},
                 {"mesh", {{"type", "block"}, {"divisions", {b.columns, b.rows}}}}}}}}},
            {"fem",
             {{"supports",
               {{{"name", "left"}, {"from", {0, 0}}, {"to", {0, H}}, {"fixes", "x"}},
                {{"name", "right"}, {"from", {W, 0}}, {"to", {W, H}}, {"fixes", "x"}},
                {{"name", "base"}, {"from", {0, 0}}, {"to", {W, 0}}, {"fixes", "xy"}}}},
              {"stages", b.stages},
              {"crest", {W, H}}}}};
}

inline scene::Scene parse(const json& scene) { return scene::parse_scene(scene.dump(), "bench"); }

inline Model model_of(const scene::Scene& scene) {
    return build_model(scene, build_mesh(scene, std::filesystem::temp_directory_path()));
}

using test::Folder;

inline process::SessionSettings settings_for(const std::filesystem::path& output,
                                             process::Start start = process::Start::fresh) {
    process::SessionSettings settings;
    settings.phase = "fem_solver";
    settings.output = output;
    settings.start = start;
    return settings;
}

/// Runs all stages of a scene in a temporary folder and keeps its course.
class Run {
  public:
    explicit Run(const json& scene)
        : session_(settings_for(folder_.path()), parse(scene)),
          course_(session_, model_of(session_.scene())) {}
    const Course& go() {
        analyse(course_);
        return course_;
    }
    const Course& course() const { return course_; }
    const std::filesystem::path& folder() const { return folder_.path(); }
    process::Session& session() { return session_; }

  private:
    Folder folder_;
    process::Session session_;
    Course course_;
};

/// Displacement of the node nearest to x [m].
inline Vec2 u_at(const Course& done, const Vec2& x) {
    const std::size_t node = nearest_node(done.model.mesh, x);
    return done.motion.u.segment<2>(static_cast<Eigen::Index>(2 * node));
}

/// Pointer of the fault when the scene is read, checked or built; empty: accepted.
inline std::string place_refused(const json& scene) {
    try {
        const scene::Scene parsed = parse(scene);
        const auto faults = check::problems_of(parsed).faults;
        if (!faults.empty()) return faults.at(0).pointer;
        Run run(scene);
    } catch (const fault::BadInput& bad) {
        return bad.faults().at(0).pointer;
    }
    return "";
}

/// CJ1 of docs/reference/methods/norsand.md, section 14.
inline json cj1(double psi_0, double K_0 = 0.7) {
    return {{"type", "norsand"}, {"Gamma", 0.9}, {"lambda", 0.02},   {"M_tc", 1.2}, {"N", 0.3},
            {"chi_tc", 3.5},     {"H_0", 300},   {"G_ref_MPa", 30},  {"m", 1.0},    {"nu", 0.15},
            {"psi_0", psi_0},    {"K_0", K_0},   {"tolerance", 1e-6}};
}

/// Prints the error and its limit, then checks it.
inline void expect_error(const std::string& what, double reached, double allowed) {
    std::printf("    %-58s reached %.3e, allowed %.1e\n", what.c_str(), reached, allowed);
    EXPECT_LE(reached, allowed) << what;
}

}  // namespace breach::fem::bench
