// Asked once when the service starts. A phase of another build would put wrong results into the
// cache, so a program that does not answer ends the start. 0 ("never reuse") is refused as well: it
// is for phases under development.
#include "services/orchestrator/programs/numerics.hpp"

#include <charconv>
#include <chrono>
#include <map>
#include <sstream>

#include "core/command/command.hpp"
#include "core/fault/fault.hpp"
#include "core/phases/phases.hpp"

namespace breach::orchestrator {

namespace {

constexpr std::string_view numerics_word = "numerics ";

std::int64_t numerics_of(const std::filesystem::path& program) {
    const std::string remedy = "; give the folder of the phases of this build with --bin";
    if (!std::filesystem::exists(program))
        throw fault::IoError(program.string() + ": there is no such program" + remedy);
    const command::Result result =
        command::run({program.string(), "--version"}, "", command::longest_answer);
    std::istringstream lines(result.out);
    for (std::string line; result.exit_code == 0 && std::getline(lines, line);) {
        if (!line.starts_with(numerics_word)) continue;
        std::int64_t number = 0;
        const auto parsed =
            std::from_chars(line.data() + numerics_word.size(), line.data() + line.size(), number);
        if (parsed.ec == std::errc{} && number > 0) return number;
    }
    throw fault::IoError(program.string() + " --version does not say the version of its numerics" +
                         remedy);
}

}  // namespace

Numerics numerics_of_phases(const std::filesystem::path& bin) {
    Numerics found;
    std::map<std::string, std::int64_t> of_executables;  // one may be two phases
    for (const phases::Phase& each : phases::all) {
        const auto [known, is_new] = of_executables.try_emplace(each.executable);
        if (is_new) known->second = numerics_of(bin / each.executable);
        found[each.program] = known->second;
    }
    return found;
}

}  // namespace breach::orchestrator
