// For the page of a scene that is not submitted yet (http_pages.cpp), on the request's thread. The
// phases decide what they use and say so themselves: a copy of their rules here would drift.
#include "services/orchestrator/programs/plan_question.hpp"

#include <chrono>
#include <nlohmann/json.hpp>

#include "core/command/command.hpp"
#include "core/exchange/publish.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

namespace {

/// The output of PROGRAM SCENE --plan.
std::string answer_of(const std::filesystem::path& program, const std::filesystem::path& scene) {
    const command::Result result =
        command::run({program.string(), scene.string(), "--plan"}, "", command::longest_answer);
    if (result.exit_code != 0)
        throw fault::IoError(program.filename().string() + " --plan did not answer");
    return result.out;
}

struct ScratchFile {
    std::filesystem::path path;
    ~ScratchFile() {
        std::error_code error;
        std::filesystem::remove(path, error);
    }
};

}  // namespace

nlohmann::json plans_of(const nlohmann::json& scene, const std::filesystem::path& bin,
                        const std::filesystem::path& scratch) {
    const ScratchFile file{scratch / (new_run_id() + ".json")};
    exchange::publish_text(file.path, scene.dump());
    nlohmann::json plans = nlohmann::json::object();
    for (const phases::Phase& each : phases::all)
        if (scene.contains(each.part))
            plans[each.program] = answer_of(bin / each.program, file.path);
    return plans;
}

}  // namespace breach::orchestrator
