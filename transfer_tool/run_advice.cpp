// `transfer_tool advise` as a phase: one answer for each telemetry of the same scene. The snapshots
// are looked for beside each telemetry, where fem_solver writes them.
#include <spdlog/spdlog.h>

#include "core/fault/fault.hpp"
#include "core/telemetry/lines.hpp"
#include "transfer_tool/advice.hpp"
#include "transfer_tool/run.hpp"

namespace breach::transfer {
namespace {

constexpr int most_files = 1000;

nlohmann::json as_json(const Edge& edge) {
    nlohmann::json entry{{"time", edge.time}, {"condition", edge.condition}};
    for (const auto& [field, value] : edge.values) entry["values"][field] = value;
    return entry;
}

nlohmann::json as_json(const Advice& advice) {
    nlohmann::json entry{{"begin", advice.begin}, {"end", advice.end}, {"missing", advice.missing}};
    if (advice.lower) entry["lower"] = as_json(*advice.lower);
    if (advice.shut_since) entry["shut_since"] = *advice.shut_since;
    if (advice.half_way) {
        // A FEM that never distorted closes the window with its end.
        entry["upper"] = advice.upper ? as_json(*advice.upper)
                                      : nlohmann::json{{"time", advice.end},
                                                       {"condition", "the telemetry's end"}};
        entry["half_way"] = *advice.half_way;
        entry["snapshots"] = advice.snapshots;
    }
    if (advice.pick) entry["take"] = *advice.pick;
    entry["signs"] = nlohmann::json::array();
    for (const Sign& sign : advice.signs)
        entry["signs"].push_back({{"name", sign.name},
                                  {"condition", sign.condition},
                                  {"known", sign.known},
                                  {"onsets", sign.onsets}});
    return entry;
}

process::Outcome run_advice(process::Session& session) {
    nlohmann::json& all = session.result()["advice"] = nlohmann::json::array();
    for (const std::filesystem::path& file : session.settings().inputs) {
        const auto lines = telemetry::read(file);
        if (lines.empty())
            throw fault::BadInput(
                file.string(),
                {{"", "holds no line", "give the telemetry.jsonl of a phase that ran"}});
        const auto folder = std::filesystem::absolute(file).parent_path();
        const Advice advice = advise(session.scene(), lines, snapshot_times(folder));
        spdlog::info("{}\n{}", file.string(), as_text(advice));
        all.push_back(as_json(advice));
        all.back()["telemetry"] = file.string();
    }
    return process::Outcome::done;
}

process::Plan plan_advice(const scene::Scene& scene) {
    const criteria::Window window = window_of(scene);
    return {{"lower edge", process::Use::on, window.lower().expression().text,
             "/transfer/window/lower"},
            {"upper edge", process::Use::on, window.upper().text, "/transfer/window/upper"}};
}

}  // namespace

scene::Scene read(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    scene::Scene scene = scene::read_scene(file, overrides);
    if (scene.transfer && scene.transfer->window) window_of(scene);
    return scene;
}

process::Phase advise_phase() {
    return {.name = "transfer_tool advise",
            .purpose = "Which transfer times are sound, from the FEM's telemetry",
            .inputs = {1, most_files, "telemetry of a FEM (telemetry.jsonl)"},
            .plan = plan_advice,
            .run = run_advice,
            .read = read};
}

}  // namespace breach::transfer
