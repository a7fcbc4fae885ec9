// The frame of every phase: one main function for all executables. Owns arguments, log, progress, signals
// and exit codes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/check/check.hpp"
#include "core/process/cost.hpp"
#include "core/process/plan.hpp"
#include "core/process/session.hpp"
#include "core/scene/scene.hpp"

namespace breach::process {

/// How many --input files a phase takes.
struct InputRule {
    int least;
    int most;
    std::string what;  ///< "a FEM snapshot (.vtkhdf)"
};

/// A flag that only this phase knows; SessionSettings::switches has it when it was given.
struct Switch {
    std::string name;       ///< "--profile"
    std::string purpose;    ///< one line for --help
    std::string sets = {};  ///< "/json/pointer=value" that it stands for, after every --set
};

/// How a phase ended without a fault.
enum class Outcome {
    done,
    stopped,  ///< the session asked to stop; a checkpoint was saved
};

struct Phase {
    std::string name;     ///< "fem_solver"
    std::string purpose;  ///< one line for --help
    InputRule inputs;
    std::function<Plan(const scene::Scene&)> plan;
    std::function<Outcome(Session&)> run;
    /// Reads the document that the phase works from; not every phase works from a scene.
    std::function<scene::Scene(const std::filesystem::path&, const std::vector<std::string>&)>
        read = check::checked_scene;
    std::vector<Switch> switches = {};
    /// Raise it when the phase's results change for the same input: cached results with another
    /// number are not reused. --version prints it. 0: its results are never reused.
    int numerics = 0;
    /// Takes a few steps in the session's folder, which is removed after it. Empty: the phase has
    /// no steps, and no --measure.
    std::function<Cost(Session&)> measure = {};
};

/// Parses the arguments, reads the scene, runs the phase, maps exceptions to exit codes
/// (docs/reference/architecture.md, "What a phase promises"). Returns the exit code. Never throws.
int run_phase(int argc, char** argv, const Phase& phase);

}  // namespace breach::process
