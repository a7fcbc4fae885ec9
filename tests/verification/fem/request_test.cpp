// Snapshots on request or at an interval do not change the computation.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "core/phases/files.hpp"
#include "fem_solver/run.hpp"
#include "fem_solver/snapshot.hpp"
#include "fem_solver/snapshot_request.hpp"
#include "tests/verification/fem/bench.hpp"

namespace breach::fem::request_test {
namespace {

using nlohmann::json;

constexpr double time_step = 0.005;

json falling_column() {
    bench::Block block{.width = 4.0, .height = 8.0, .columns = 4, .rows = 8};
    block.law = {
        {"type", "mohr_coulomb"}, {"E_MPa", 20}, {"nu", 0.3}, {"c_kPa", 1}, {"phi_deg", 30}};
    block.stages.push_back(
        {{"type", "dynamic"}, {"name", "failure"}, {"duration", 0.1}, {"time_step", time_step}});
    json scene = bench::scene_of(block);
    scene["fem"]["supports"].erase(1);
    scene["fem"]["telemetry_interval"] = 0.0;
    return scene;
}

/// Runs the scene below `folder`/`name` and returns its telemetry.
std::string telemetry_of(const json& scene, const std::filesystem::path& output) {
    std::filesystem::create_directories(output);
    process::Session session(bench::settings_for(output), bench::parse(scene));
    EXPECT_EQ(run(session), process::Outcome::done);
    std::ifstream in(output / "telemetry.jsonl");
    return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> snapshots_in(const std::filesystem::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".vtkhdf") names.insert(entry.path().filename());
    }
    return names;
}

TEST(SnapshotRequest, IsAnsweredAtTheEndOfTheNextStepAndChangesNoStep) {
    const bench::Folder folder;
    const auto plain = folder.path() / "plain", asked = folder.path() / "asked";
    const std::string undisturbed = telemetry_of(falling_column(), plain);
    std::filesystem::create_directories(asked);
    std::ofstream(asked / phases::files::request) << "anything";
    EXPECT_EQ(telemetry_of(falling_column(), asked), undisturbed);
    EXPECT_EQ(snapshots_in(plain), (std::set<std::string>{snapshot_name(0.1)}));
    EXPECT_EQ(snapshots_in(asked),
              (std::set<std::string>{snapshot_name(time_step), snapshot_name(0.1)}));
    EXPECT_FALSE(std::filesystem::exists(asked / phases::files::request));
    EXPECT_FALSE(std::filesystem::exists(asked / "snapshot_request.taken"));
    const auto snapshot = exchange::read_mesh_snapshot(asked / snapshot_name(time_step)).snapshot;
    EXPECT_DOUBLE_EQ(snapshot.time, time_step);
}

TEST(SnapshotInterval, GivesOneSnapshotPerMultipleWithoutCuttingAStep) {
    const bench::Folder folder;
    const std::string undisturbed = telemetry_of(falling_column(), folder.path() / "plain");
    json scene = falling_column();
    scene["fem"]["snapshot_interval"] = 0.022;  // not a multiple of the step
    EXPECT_EQ(telemetry_of(scene, folder.path() / "regular"), undisturbed);
    std::set<std::string> expected{snapshot_name(0.1)};
    for (int k = 1; k * 0.022 <= 0.1; ++k)
        expected.insert(snapshot_name(time_step * std::ceil(k * 0.022 / time_step - 1e-9)));
    EXPECT_EQ(snapshots_in(folder.path() / "regular"), expected);
}

TEST(SnapshotTimes, AtMultiplesOfTheStepChangeNothingThoughStepsWereCut) {
    const bench::Folder folder;
    json scene = falling_column();
    scene["fem"]["largest_step_error"] = 3e-7;
    scene["fem"]["stages"].back()["time_step"] = 0.002;  // 9 of them are not 0.018 to the last bit
    const std::string undisturbed = telemetry_of(scene, folder.path() / "plain");
    scene["fem"]["snapshot_times"] = {0.018, 0.04, 0.072, 0.086};
    EXPECT_EQ(telemetry_of(scene, folder.path() / "wanted"), undisturbed);
    EXPECT_EQ(snapshots_in(folder.path() / "wanted").size(), 5U);
    const auto lines = std::ranges::count(undisturbed, '\n');
    std::printf("    %td steps, 50 without a cut\n", lines - 1);
    EXPECT_GT(lines, 60) << "steps were cut";
    EXPECT_LT(lines, 300);
}

TEST(SnapshotInterval, EqualToTheStepGivesEveryStepOnce) {
    const bench::Folder folder;
    json scene = falling_column();
    scene["fem"]["snapshot_interval"] = time_step;
    telemetry_of(scene, folder.path());
    EXPECT_EQ(snapshots_in(folder.path()).size(), 20u);
}

}  // namespace
}  // namespace breach::fem::request_test
