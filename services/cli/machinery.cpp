#include "services/cli/machinery.hpp"

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "services/cli/table.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;

namespace {

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

std::string runouts_of(const json& transfer) {
    std::string text;
    for (const json& each : transfer.at("runouts"))
        text += (text.empty() ? "" : ", ") +
                (each.at("runout").is_number() ? cell(each, "runout") : cell(each, "state"));
    return text.empty() ? "-" : text;
}

}  // namespace

ExitCode workers(Server& server, const Console& console) {
    const json answer = server.get("/v1/workers");
    if (console.style == Style::json) {
        show_json(answer, console);
        return ExitCode::done;
    }
    std::vector<Cells> rows;
    for (const json& each : answer.at("workers")) {
        std::string note = cell(each, "message") == "-" ? "" : cell(each, "message");
        if (each.at("job_reason").is_string()) note = cell(each, "job_reason");
        rows.push_back({cell(each, "task"), cell(each, "label"), cell(each, "state"),
                        clock_of(each, "since"), cell(each, "host"),
                        cell(each, each.at("job").is_string() ? "job" : "pid"), cell(each, "cores"),
                        cell(each, "cpu_seconds"), cell(each, "memory_used_MB"), note});
    }
    if (!rows.empty())
        console.out << as_table({{"task", Align::left},
                                 {"label", Align::left},
                                 {"state", Align::left},
                                 {"since (UTC)", Align::left},
                                 {"host", Align::left},
                                 {"pid or job", Align::right},
                                 {"cores", Align::right},
                                 {"CPU [s]", Align::right},
                                 {"memory [MB]", Align::right},
                                 {"", Align::left}},
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
    if (console.style == Style::json) {
        show_json(list, console);
        return ExitCode::done;
    }
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
        console.out << as_table({{"transfer", Align::left},
                                 {"variant", Align::left},
                                 {"t_T [s]", Align::right},
                                 {"why", Align::left},
                                 {"condition", Align::left},
                                 {"values", Align::left},
                                 {"start [ms]", Align::right},
                                 {"state", Align::left},
                                 {"runout [m]", Align::left}},
                                rows);
    return ExitCode::done;
}

namespace {

/// A parsed PROV-JSON document: which activity made which file, from which files.
class Told {
  public:
    explicit Told(const json& document) : document_(document) {
        for (const auto& [id, each] : all("wasGeneratedBy"))
            maker_[each.at("prov:entity")] = each.at("prov:activity");
        for (const auto& [id, each] : all("used"))
            used_[each.at("prov:activity")].push_back(each.at("prov:entity"));
        for (const auto& [id, each] : all("wasAssociatedWith"))
            agent_[each.at("prov:activity")] = each.at("prov:agent");
        for (const auto& [id, each] : all("wasDerivedFrom"))
            if (!each.contains("prov:activity"))
                source_[each.at("prov:generatedEntity")].push_back(each.at("prov:usedEntity"));
    }

    std::string lines_from(const std::string& entity, std::size_t depth = 0) {
        const std::string indent(2 * depth, ' ');
        std::string text = indent + named(entity) + "\n";
        const auto maker = maker_.find(entity);
        if (maker == maker_.end()) {
            if (!seen_.insert(entity).second) return text;
            for (const std::string& each : source_[entity])
                text += indent + "  from " + named(each) + "\n";
            return text;
        }
        text += indent + "  made by " + activity(maker->second) + "\n";
        if (!seen_.insert(maker->second).second) return text + indent + "    (as above)\n";
        for (const std::string& each : used_[maker->second]) text += lines_from(each, depth + 2);
        return text;
    }

  private:
    std::map<std::string, json> all(const char* relation) const {
        return document_.value(relation, std::map<std::string, json>{});
    }

    std::string named(const std::string& entity) const {
        const json& about = document_.at("entity").at(entity);
        std::string text = cell(about, "prov:type") + " " + cell(about, "prov:label");
        if (about.contains("breach:sha256")) text += "  SHA-256 " + cell(about, "breach:sha256");
        return text;
    }

    std::string activity(const std::string& id) const {
        const json& about = document_.at("activity").at(id);
        std::string text = cell(about, "breach:task") + ", " + cell(about, "prov:label");
        if (const auto agent = agent_.find(id); agent != agent_.end()) {
            const json& program = document_.at("agent").at(agent->second);
            text += ", " + cell(program, "prov:label");
            if (program.contains("breach:version")) text += " " + cell(program, "breach:version");
        }
        if (about.contains("breach:host")) text += ", on " + cell(about, "breach:host");
        if (about.contains("prov:startTime"))
            text += ", " + cell(about, "prov:startTime") + " to " + cell(about, "prov:endTime");
        if (about.contains("breach:note")) text += ", " + cell(about, "breach:note");
        return text;
    }

    const json& document_;
    std::map<std::string, std::string> maker_;
    std::map<std::string, std::vector<std::string>> used_;
    std::map<std::string, std::vector<std::string>> source_;  ///< without an activity between
    std::map<std::string, std::string> agent_;
    std::set<std::string> seen_;  ///< each is printed once
};

}  // namespace

ExitCode provenance(Server& server, const std::string& sha256, const Console& console) {
    const json document = server.get(path_of({"artifacts", sha256, "provenance"}));
    if (console.style == Style::json)
        show_json(document, console);
    else
        console.out << Told(document).lines_from("breach:file/" + sha256);
    return ExitCode::done;
}

}  // namespace breach::cli
