// The command runs without the service, on the data folder alone: after a crash, a restored backup,
// or a disk that ran full, before the service is started again. The report of --repair is that of a
// second look: it lists what is left.
#include "services/orchestrator/audit/check_command.hpp"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "services/orchestrator/audit/audit.hpp"

namespace breach::orchestrator {

namespace {

void print(const Audit& audit, Look look) {
    for (const Inconsistency& each : audit.inconsistencies)
        std::cout << each.part << ": " << each.where << ": " << each.cause << "\n    "
                  << each.remedy << "\n";
    std::cout << "database of version " << audit.version << ", " << audit.runs << " runs, "
              << audit.tasks << " tasks, " << audit.events << " events; " << audit.outputs
              << " outputs and " << audit.files << " sent files "
              << (look == Look::at_contents ? "read whole" : "looked at by their sizes") << ": "
              << (audit.inconsistencies.empty()
                      ? "sound"
                      : std::to_string(audit.inconsistencies.size()) + " inconsistencies")
              << "\n";
    if (audit.in_service)
        std::cout
            << "a service works on this folder: what is younger than a minute was passed over\n";
}

/// For scripts: the same findings, with the word whether --repair would do.
void print_json(const Audit& audit) {
    nlohmann::json inconsistencies = nlohmann::json::array();
    for (const Inconsistency& each : audit.inconsistencies)
        inconsistencies.push_back({{"part", each.part},
                                   {"where", each.where},
                                   {"cause", each.cause},
                                   {"remedy", each.remedy},
                                   {"mendable", each.mendable}});
    std::cout
        << nlohmann::json{{"version", audit.version},       {"runs", audit.runs},
                          {"tasks", audit.tasks},           {"events", audit.events},
                          {"outputs", audit.outputs},       {"files", audit.files},
                          {"in_service", audit.in_service}, {"inconsistencies", inconsistencies}}
               .dump()
        << "\n";
}

}  // namespace

CLI::App* CheckOptions::add_to(CLI::App& program) {
    CLI::App* checking =
        program.add_subcommand("check", "whether database and files of a data folder say the same");
    checking->add_option("--data", data, "the service's data folder")->required();
    checking->add_flag(
        "--repair", repair,
        "move what no run knows to strays/ in the data folder, count tasks anew; the "
        "service must not run");
    checking->add_flag("--sizes", sizes, "look at the sizes of files only, not at their contents");
    checking->add_flag("--json", json, "one JSON object instead of lines");
    checking->footer(
        "\nExample:\n  breachline check --data var/breachline\n\nExit code 0: sound; 65: not.");
    return checking;
}

fault::ExitCode check(const CheckOptions& options) {
    // To compare contents, every stored result is read once; --sizes answers at once.
    const Look look = options.sizes ? Look::at_sizes : Look::at_contents;
    const DataPaths paths(options.data);
    Audit audit = audited(paths, look);
    if (options.repair && std::ranges::any_of(audit.inconsistencies, &Inconsistency::mendable)) {
        // Throws while a service has the folder. What was found before the lock may have changed
        // since, so the owner looks again; sizes suffice, because nothing inside a file is
        // repaired.
        const DataFolder owned(options.data);
        mend(owned, audited(owned, Look::at_sizes).inconsistencies);
        audit = audited(owned, look);
    }
    if (options.json) {
        print_json(audit);
    } else {
        print(audit, look);
    }
    return audit.inconsistencies.empty() ? fault::ExitCode::done : fault::ExitCode::bad_input;
}

}  // namespace breach::orchestrator
