// Hands over to the program breach-verify (services/verify), so that all commands have one name and
// one help.
#include "services/cli/verify.hpp"

#include <unistd.h>

#include <cstring>

namespace breach::cli {

fault::ExitCode verify(const VerifyOptions& options, const Console& console) {
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path() /
        "lib/breachline/breach-verify";
    std::vector<std::string> words{program.string(), "--output", options.output.string()};
    if (options.quick) words.emplace_back("--quick");
    if (!options.catalogue.empty())
        words.insert(words.end(), {"--catalogue", options.catalogue.string()});
    std::vector<char*> arguments;
    for (std::string& each : words) arguments.push_back(each.data());
    arguments.push_back(nullptr);
    // execv() replaces this process and drops what is buffered. In exchange the exit code and
    // Ctrl-C are those of the program itself.
    console.out << std::flush;
    execv(program.c_str(), arguments.data());
    throw fault::IoError(program.string() + ": cannot be started: " + std::strerror(errno));
}

}  // namespace breach::cli
