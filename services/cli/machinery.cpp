// `breach workers` and `breach transfers`: tables of what the server does at the moment and why it
// made each transfer. The server decides what is listed and in which order.
#include "services/cli/machinery.hpp"

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/words/list.hpp"
#include "services/cli/table.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;

namespace {

/// The clock of an ISO 8601 time; the title of the column says that it is UTC.
std::string clock_of(const json& object, const char* key) {
    const std::string time = cell(object, key);
    return time.size() < 19 ? time : time.substr(11, 8);
}

std::string counts_of(const json& counts) {
    std::string text;
    for (const auto& [what, count] : counts.items())
        text += (text.empty() ? "" : ", ") + cell(count) + " " + harmless(what);
    return text;
}

/// One transfer may feed several runouts. One without a result yet shows its state.
std::string runouts_of(const json& transfer) {
    const std::string text = words::list_of(transfer.at("runouts"), [](const json& each) {
        return cell(each, each.at("runout").is_number() ? "runout" : "state");
    });
    return text.empty() ? "-" : text;
}

}  // namespace

ExitCode workers(Server& server, const Console& console) {
    const json answer = server.get("/v1/workers");
    if (shown_as_json(answer, console)) return ExitCode::done;
    std::vector<Cells> rows;
    for (const json& each : answer.at("workers")) {
        std::string note = cell(each, "message") == "-" ? "" : cell(each, "message");
        // Slurm's reason wins: why a job waits is what its owner can change.
        if (each.at("job_reason").is_string()) note = cell(each, "job_reason");
        rows.push_back({cell(each, "task"), cell(each, "label"), cell(each, "state"),
                        clock_of(each, "since"), cell(each, "host"),
                        cell(each, each.at("job").is_string() ? "job" : "pid"), cell(each, "cores"),
                        cell(each, "cpu_seconds"), cell(each, "memory_used_MB"), note});
    }
    if (!rows.empty())
        console.out << as_table({{"task"},
                                 {"label"},
                                 {"state"},
                                 {"since (UTC)"},
                                 {"host"},
                                 {"pid or job", right},
                                 {"cores", right},
                                 {"CPU [s]", right},
                                 {"memory [MB]", right},
                                 {""}},
                                rows)
                    << "\n";
    const json& queue = answer.at("queue");
    console.out << cell(answer, "slots_used") << " of " << cell(answer, "slots") << " cores taken"
                << (answer.at("executor") == "slurm" ? " in Slurm" : "")
                << "; waiting: " << cell(queue, "ready") << " ready, " << cell(queue, "blocked")
                << " for an input, " << cell(queue, "retry_wait") << " for another try\n";
    if (const json& slurm = answer.at("slurm"); slurm.is_object())
        console.out << "Slurm: " << counts_of(slurm.at("states"))
                    << (slurm.at("reasons").empty() ? "" : "; they wait for ")
                    << counts_of(slurm.at("reasons")) << "\n";
    return ExitCode::done;
}

ExitCode transfers(Server& server, const TransfersOptions& options, const Console& console) {
    const std::string path = options.run.empty()
                                 ? std::string("/v1/transfers")
                                 : path_of({"runs", run_named(server, options.run), "transfers"});
    const json answer = server.get(
        path + query_of({{"why", options.why}, {"limit", std::to_string(options.most)}}));
    const json& list = answer.at("transfers");
    if (answer.at("next").is_string())
        console.notes << "only the newest " << list.size()
                      << " transfers, there are more: -n shows up to 500\n";
    if (shown_as_json(list, console)) return ExitCode::done;
    std::vector<Cells> rows;
    for (const json& each : list)
        rows.push_back({cell(each, "task"), cell(each, "variant"),
                        whole_cell(each, "transfer_time"), cell(each, "why"),
                        cell(each, "condition"),
                        each.at("crossed").is_null() ? "-" : harmless(each["crossed"].dump()),
                        cell(each, "start_ms"), cell(each, "state"), runouts_of(each)});
    if (rows.empty())
        console.notes << "no transfers\n";
    else
        console.out << as_table({{"transfer"},
                                 {"variant"},
                                 {"t_T [s]", right},
                                 {"why"},
                                 {"condition"},
                                 {"values"},
                                 {"start [ms]", right},
                                 {"state"},
                                 {"runout [m]"}},
                                rows);
    return ExitCode::done;
}

}  // namespace breach::cli
