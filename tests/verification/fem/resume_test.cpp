// A stopped and resumed run gives the same bits as an uninterrupted one.
#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>
#include <thread>

#include "core/exchange/excess_pressure.hpp"
#include "fem_solver/run.hpp"
#include "fem_solver/snapshot.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem::resume_test {
namespace {

using nlohmann::json;

json failing_column() {
    bench::Block block{.width = 10.0, .height = 20.0, .columns = 10, .rows = 20};
    block.law = {{"type", "mohr_coulomb"},
                 {"E_MPa", 20},
                 {"nu", 0.3},
                 {"c_kPa", 1},
                 {"phi_deg", 30},
                 {"softening",
                  {{"epsilon_q_start", 0.0},
                   {"epsilon_q_end", 0.1},
                   {"c_residual_kPa", 0},
                   {"phi_residual_deg", 20}}}};
    block.stages.push_back(
        {{"type", "dynamic"}, {"name", "failure"}, {"duration", 0.4}, {"time_step", 0.005}});
    json scene = bench::scene_of(block);
    scene["materials"]["soil"]["nonlocal_length"] = 2.0;
    scene["fem"]["supports"].erase(1);
    scene["fem"]["snapshot_times"] = {0.1, 0.2, 0.333};
    return scene;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

void expect_same_snapshot(const std::filesystem::path& a, const std::filesystem::path& b) {
    const auto one = exchange::read_mesh_snapshot(a).snapshot;
    const auto two = exchange::read_mesh_snapshot(b).snapshot;
    EXPECT_EQ(one.time, two.time);
    EXPECT_EQ(one.displacement, two.displacement);
    EXPECT_EQ(one.velocity, two.velocity);
    EXPECT_EQ(one.acceleration, two.acceleration);
    EXPECT_EQ(one.stress, two.stress);
    EXPECT_EQ(one.strain, two.strain);
    EXPECT_EQ(one.epsilon_q_plastic, two.epsilon_q_plastic);
}

/// fem_solver itself, stopped by SIGTERM after its first snapshot.
TEST(Resume, GivesTheSameBitsAsAnUninterruptedRun) {
    const bench::Folder folder;
    const auto scene_file = folder.path() / "scene.json";
    std::ofstream(scene_file) << failing_column().dump();
    const std::string command = std::string(BREACH_BIN) + "/fem_solver " + scene_file.string() +
                                " --progress none --output " + folder.path().string();
    ASSERT_EQ(std::system((command + "/whole 2>/dev/null").c_str()), 0);
    const std::string stopped = folder.path().string() + "/stopped";
    // The shell waits for the first snapshot and then sends TERM to the solver.
    const std::string interrupt =
        command + "/stopped 2>/dev/null & p=$!; while [ ! -e " + stopped +
        "/snapshot_0.100000.vtkhdf ]; do sleep 0.005; done; kill -TERM $p; "
        "wait $p";
    const int code = WEXITSTATUS(std::system(interrupt.c_str()));
    ASSERT_TRUE(code == 143 || code == 0) << code;
    if (code == 143) {
        EXPECT_FALSE(std::filesystem::exists(stopped + "/result.json"));
        EXPECT_TRUE(std::filesystem::exists(stopped + "/checkpoint.h5"));
    }
    ASSERT_EQ(std::system((command + "/stopped --resume 2>/dev/null").c_str()), 0);
    const std::filesystem::path one = folder.path() / "whole", two = stopped;
    EXPECT_EQ(text_of(one / "telemetry.jsonl"), text_of(two / "telemetry.jsonl"));
    const auto history_1 = exchange::read_archive(one / "history.h5", "fem_history", 1);
    const auto history_2 = exchange::read_archive(two / "history.h5", "fem_history", 1);
    EXPECT_EQ(history_1.reals, history_2.reals);
    for (const double time : {0.1, 0.2, 0.333, 0.4}) {
        expect_same_snapshot(one / snapshot_name(time), two / snapshot_name(time));
    }
}

/// Wet ground over rock with columns, shaken by a file.
json shaken_ground(const std::filesystem::path& folder) {
    std::ofstream motion(folder / "motion.csv");
    motion << "time_s,velocity_m_s\n";
    for (int i = 0; i <= 100; ++i) motion << 0.01 * i << ',' << 0.1 * std::sin(0.2 * i) << '\n';
    bench::Block block{.width = 8.0, .height = 10.0, .columns = 4, .rows = 10};
    block.law = {
        {"type", "mohr_coulomb"}, {"E_MPa", 50}, {"nu", 0.3}, {"c_kPa", 5}, {"phi_deg", 30}};
    block.stages.push_back(
        {{"type", "dynamic"}, {"name", "shaking"}, {"duration", 0.8}, {"time_step", 0.005}});
    json scene = bench::scene_of(block);
    json& fem = scene["fem"];
    fem["supports"] = json::array({scene["fem"]["supports"][2]});
    fem["element"] = "ssp";
    fem["water"] = {{"line", {{0, 9}}}};
    fem["base"] = {{"density", 2300}, {"V_s", 760}};
    fem["free_field"] = {{"width", 2}};
    fem["motion"] = {{"file", "motion.csv"}};
    fem["snapshot_times"] = {0.2};
    scene["materials"]["soil"]["void_ratio"] = 0.8;
    scene["materials"]["soil"]["permeability"] = {1e-5, 1e-5};
    scene["materials"]["soil"]["dynamic_strength"] = {{"ratio", 0.2}};
    return scene;
}

TEST(Stopped, AShakenWetSceneGoesOnBitForBit) {
    const bench::Folder folder;
    const auto scene_file = folder.path() / "scene.json";
    std::ofstream(scene_file) << shaken_ground(folder.path()).dump();
    const std::string command = std::string(BREACH_BIN) + "/fem_solver " + scene_file.string() +
                                " --progress none --output " + folder.path().string();
    ASSERT_EQ(std::system((command + "/whole 2>/dev/null").c_str()), 0);
    const std::string stopped = folder.path().string() + "/stopped";
    const std::string interrupt = command + "/stopped 2>/dev/null & p=$!; while [ ! -e " + stopped +
                                  "/snapshot_0.200000.vtkhdf ]; do sleep 0.005; done; "
                                  "kill -TERM $p; wait $p";
    const int code = WEXITSTATUS(std::system(interrupt.c_str()));
    ASSERT_TRUE(code == 143 || code == 0) << code;
    ASSERT_EQ(std::system((command + "/stopped --resume 2>/dev/null").c_str()), 0);
    const std::filesystem::path one = folder.path() / "whole", two = stopped;
    EXPECT_EQ(text_of(one / "telemetry.jsonl"), text_of(two / "telemetry.jsonl"));
    const auto end_1 = exchange::read_mesh_snapshot(one / snapshot_name(0.8)).snapshot;
    const auto end_2 = exchange::read_mesh_snapshot(two / snapshot_name(0.8)).snapshot;
    expect_same_snapshot(one / snapshot_name(0.8), two / snapshot_name(0.8));
    EXPECT_FALSE(end_1.pore_pressure.empty());
    EXPECT_EQ(end_1.pore_pressure, end_2.pore_pressure);
    EXPECT_EQ(end_1.sigma_v0, end_2.sigma_v0);
    EXPECT_EQ(end_1.excess_pressure_max, end_2.excess_pressure_max);
    EXPECT_EQ(end_1.r_u_max, end_2.r_u_max);
    EXPECT_EQ(end_1.shear_strain_max, end_2.shear_strain_max);
    EXPECT_GT(*std::ranges::max_element(end_1.shear_strain_max), 0.0);
    const std::vector<double> now = exchange::nodal_excess_pressure(end_1);
    double fell = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i)
        fell = std::max(fell, end_1.excess_pressure_max.at(i) - now[i]);
    EXPECT_GT(fell, 100.0) << "the largest lies before the end";
    EXPECT_TRUE(end_1.base_motion.any());
    EXPECT_EQ(end_1.base_motion.velocity, end_2.base_motion.velocity);
    EXPECT_EQ(end_1.quads.size(), 40U) << "columns stay behind";
}

/// An archive of the dynamic stage.
exchange::Archive archive_in_failure(bench::Run& run) {
    Kept kept = run.course();
    kept.position.stage = 1;
    return checkpoint_archive(kept, {}, run.session().scene());
}

TEST(Checkpoint, OfAnotherSceneIsRefused) {
    bench::Run run(failing_column());
    const Course& a = run.go();
    exchange::Archive archive = archive_in_failure(run);
    json other = failing_column();
    other["materials"]["soil"]["density"] = 1999;
    EXPECT_THROW(checkpoint_from(archive, bench::parse(other), a.model, "checkpoint.h5"),
                 fault::BadInput);
    EXPECT_NO_THROW(checkpoint_from(archive, run.session().scene(), a.model, "checkpoint.h5"));
}

TEST(Checkpoint, WithArraysThatAreNotTheMeshsIsRefused) {
    bench::Run run(failing_column());
    const Course& a = run.go();
    const exchange::Archive sound = archive_in_failure(run);
    const auto expect_refused = [&](const exchange::Archive& changed, const std::string& name) {
        EXPECT_THROW(checkpoint_from(changed, run.session().scene(), a.model, "checkpoint.h5"),
                     fault::BadInput)
            << name;
    };
    for (const auto& [name, values] : sound.reals) {
        if (values.empty() || name == "newton.values") continue;
        exchange::Archive changed = sound;
        changed.reals[name].pop_back();
        expect_refused(changed, name);
    }
    for (const auto& [name, values] : sound.integers) {
        exchange::Archive changed = sound;
        changed.integers.erase(name);
        expect_refused(changed, name);
    }
    exchange::Archive beyond = sound;
    beyond.integers.at("position").at(0) = 2;  // stages are 0 and 1
    expect_refused(beyond, "stage");
    for (std::size_t i = 1; i < 6; ++i) {  // counts; two marks follow
        exchange::Archive uncountable = sound;
        uncountable.integers.at("position").at(i) = std::numeric_limits<std::int64_t>::max();
        expect_refused(uncountable, "count " + std::to_string(i));
    }
}

TEST(Checkpoint, WithTheMatrixOfAnotherMeshIsRefused) {
    const json scene = failing_column();
    bench::Run run(scene);
    run.go();
    const auto file = run.folder() / "checkpoint.h5";
    exchange::Archive archive = archive_in_failure(run);
    archive.reals.at("newton.values").assign(3, 1.0);
    archive.integers.at("newton.state").at(0) = 1;
    exchange::write_archive(file, archive, run.session().provenance());
    process::Session session(bench::settings_for(run.folder(), process::Start::resume),
                             bench::parse(scene));
    EXPECT_THROW(Course(session, bench::model_of(session.scene())), fault::BadInput);
}

TEST(Checkpoint, KeepsTheFlagsOfTheWay) {
    const json scene = failing_column();
    bench::Run run(scene);
    run.go();
    const auto file = run.folder() / "checkpoint.h5";
    const exchange::Archive before = archive_in_failure(run);
    const fault::Flag raised{"limit_point", fault::Severity::questionable, "beyond 0.5",
                             "/fem/stages/0"};
    const auto resumed = [&](const exchange::Archive& archive) {
        exchange::write_archive(file, archive, run.session().provenance());
        process::Session session(bench::settings_for(run.folder(), process::Start::resume),
                                 bench::parse(scene));
        Course(session, bench::model_of(session.scene()));
        return session.flags();
    };
    const std::vector<fault::Flag> own = resumed(before);
    exchange::Archive with_flags = before;
    std::vector<fault::Flag> all = own;
    all.push_back(raised);
    put_flags(all, with_flags);
    const std::vector<fault::Flag> found = resumed(with_flags);
    ASSERT_EQ(found.size(), own.size() + 1) << "each once";
    EXPECT_EQ(found.back().code, raised.code);
    EXPECT_EQ(found.back().severity, raised.severity);
    EXPECT_EQ(found.back().message, raised.message);
    EXPECT_EQ(found.back().pointer, raised.pointer);
    for (const char* torn : {"[", "[{\"code\": 1}]", "[1]", "7"}) {
        exchange::Archive broken = with_flags;
        broken.texts.at("flags") = torn;
        EXPECT_THROW(resumed(broken), fault::BadInput) << torn;
    }
}

}  // namespace
}  // namespace breach::fem::resume_test
