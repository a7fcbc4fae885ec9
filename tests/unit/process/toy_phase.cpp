// The smallest real phase, to test run_phase: counts to 20 with one telemetry line each, and fails
// as the scene's title requests.
#include <chrono>
#include <fstream>
#include <thread>

#include "core/process/phase.hpp"

using namespace breach;

namespace {

constexpr int last = 20;

process::Outcome count(process::Session& session) {
    const std::string title = session.scene().title;
    std::int64_t n = session.telemetry_lines();
    for (; n < last; ++n) {
        if (session.stop_requested()) return process::Outcome::stopped;
        if (title == "slow") std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (title == "breakdown" && n == 5)
            throw fault::Breakdown("element 7 is entangled at t = 5 s");
        if (title == "io") throw fault::IoError("/disk: full");
        if (title == "bug") throw std::logic_error("impossible");
        session.telemetry({{"n", n}});
        session.progress(static_cast<double>(n) / last, "counting");
    }
    session.progress(1.0, "counted");
    session.result()["count"] = n;
    return process::Outcome::done;
}

}  // namespace

int main(int argc, char** argv) {
    return process::run_phase(argc, argv,
                              {.name = "toy_phase",
                               .purpose = "Counts to twenty",
                               .inputs = {0, 1, "nothing"},
                               .plan =
                                   [](const scene::Scene& scene) {
                                       return process::Plan{
                                           {"counting", process::Use::on, "always", "/name"},
                                           {"pore pressure", process::Use::left_out,
                                            scene.name + " has no water", "/section/regions"}};
                                   },
                               .run = count});
}
