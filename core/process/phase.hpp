// Common main function of all phases: arguments, log, progress, signals and exit codes.
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

/// Number of --input files of a phase.
struct InputRule {
    int least;
    int most;
    std::string what;  ///< "a FEM snapshot (.vtkhdf)"
};

/// A flag of this phase alone; if given, it is in SessionSettings::switches.
struct Switch {
    std::string name;       ///< "--profile"
    std::string purpose;    ///< one line for --help
    std::string sets = {};  ///< equivalent "/json/pointer=value", applied after every --set
};

/// End of a phase without fault.
enum class Outcome {
    done,
    stopped,  ///< stop requested; a checkpoint is saved
};

struct Phase {
    std::string name;     ///< "fem_solver"
    std::string purpose;  ///< one line for --help
    InputRule inputs;
    std::function<Plan(const scene::Scene&)> plan;
    std::function<Outcome(Session&)> run;
    /// Reads the input document, for most phases a scene.
    std::function<scene::Scene(const std::filesystem::path&, const std::vector<std::string>&)>
        read = check::checked_scene;
    std::vector<Switch> switches = {};
    /// Raise it when results change for the same input: results cached with another number are not
    /// reused. --version prints it. 0: never reuse.
    int numerics = 0;
    /// Takes a few steps in the session's folder, which is removed afterwards. Empty: no --measure.
    std::function<Cost(Session&)> measure = {};
    /// Its name in phases::all when it has an --input, if that makes it another phase.
    const char* with_input = nullptr;
};

/// Parses the arguments, reads the scene, runs the phase, maps exceptions to exit codes
/// (docs/reference/architecture.md, "What a phase promises"). Returns the exit code. Never throws.
int run_phase(int argc, char** argv, const Phase& phase);

}  // namespace breach::process
