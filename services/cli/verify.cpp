// `breach verify`: computes the shipped verification cases here and compares them. It needs no
// server, as an installation is verified before one is set up.
#include "services/cli/verify.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "services/cli/table.hpp"
#include "services/verify/page.hpp"

namespace breach::cli {

namespace fs = std::filesystem;

namespace {

fs::path own_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

/// The installed catalogue, else that of the source tree.
fs::path shipped_catalogue() {
    const fs::path installed =
        own_folder().parent_path() / "share/breachline/verification/catalogue";
    return fs::exists(installed) ? installed
                                 : fs::path(BREACH_WORKFLOWS) / "verification/catalogue";
}

std::string machine() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2) + ", " +
                   std::to_string(std::thread::hardware_concurrency()) + " cores";
    return "unknown machine";
}

}  // namespace

fault::ExitCode verify(const VerifyOptions& options, const Console& console) {
    const auto catalogue =
        verify::catalogue_in(options.catalogue.empty() ? shipped_catalogue() : options.catalogue);
    const verify::Settings settings{.programs = own_folder(),
                                    .output = options.output,
                                    .quick = options.quick,
                                    .slots = std::max(1U, std::thread::hardware_concurrency())};
    fs::create_directories(options.output);
    const verify::About about{verify::versions_of(settings), machine(), options.quick};
    std::size_t done = 0;
    const auto outcomes =
        verify::compare(catalogue, settings, [&](const verify::Outcome& each, std::size_t of) {
            ++done;
            std::string said;
            for (const verify::Found& found : each.found)
                if (!found.passed())
                    said += "  " + found.quantity->what + ": " +
                            (found.value
                                 ? cell(*found.value) + ", right is " + cell(found.quantity->right)
                                 : found.problem) +
                            "\n";
            console.notes << "[" << done << "/" << of << "] " << each.of->id
                          << (said.empty() ? "" : "  failed") << "\n"
                          << said;
        });
    verify::write_pages(options.output, catalogue, outcomes, about);
    const verify::Sum sum = verify::sum_of(outcomes);
    console.out << verify::in_words(sum) << "\n" << (options.output / "index.md").string() << "\n";
    return sum.passed == sum.comparisons ? fault::ExitCode::done : fault::ExitCode::breakdown;
}

}  // namespace breach::cli
