// Commands about the server itself: what its disk holds, what its workers do. Called by
// command_line.cpp.
#include "services/cli/machinery.hpp"
#include "services/cli/program.hpp"
#include "services/cli/stored.hpp"

namespace breach::cli {

void add_words_of_server(Program& program) {
    const auto rm =
        program.add<Removal>("rm", "remove runs, or files that were sent, from the server's disk",
                             "latest --cancel", remove_all);
    rm.word.add_option("RUN|FILE", rm.options.names, "runs, or files as file:sha256/...")
        ->required();
    rm.word.add_flag("--cancel", rm.options.cancel_first,
                     "cancel runs that have not ended, then remove them");
    rm.word.add_flag("-y,--yes", rm.options.confirmed, "do not ask, for scripts");
    program.add("du", "disk space that the server uses, and what removing each run would free",
                "--json", disk_use);
    using Paths = std::vector<std::filesystem::path>;
    const auto files = program.add<Paths>(
        "files", "the motions and meshes that were sent; with FILE: send it", "motion.csv",
        [](Server& server, const Paths& sent, const Console& console) {
            return sent.empty() ? list_files(server, console) : send_files(server, sent, console);
        });
    files.word.add_option("FILE", files.options, "send these, print how a scene names them");
    const auto opened = program.add<std::string>("open", "print the dashboard's address of a run",
                                                 "latest", open_page);
    take_run(opened.word, opened.options);

    program.add("workers", "what runs where, and the queue", "--json", workers);
    const auto& [word, options] = program.add<TransfersOptions>(
        "transfers", "why each transfer was made, how long it waited, what came of it",
        "latest --why criterion", transfers);
    word.add_option("RUN", options.run, "only of this run");
    word.add_option("--why", options.why, "only at_time, manual, criterion, window, bisect")
        ->check(CLI::IsMember({"at_time", "manual", "criterion", "window", "bisect"}));
    word.add_option("-n,--most", options.most, "how many")
        ->check(CLI::Range(1, 500))
        ->capture_default_str();
}

}  // namespace breach::cli
