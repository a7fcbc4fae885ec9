// Provenance of a file up to its scene, as PROV-JSON (W3C Member Submission, 24 April 2013) with
// the names of PROV-DM. A file that the cache placed names the task that computed it.
#include <fstream>
#include <set>

#include "core/exchange/provenance.hpp"
#include "core/phases/files.hpp"
#include "core/phases/phases.hpp"
#include "core/scene/file_paths.hpp"
#include "services/orchestrator/executors/order.hpp"
#include "services/orchestrator/http/http_routes.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

constexpr const char* name_space = "urn:breachline:";

class Chain {
  public:
    explicit Chain(const Service& service) : service_(service) {
        document_["prefix"] = {{"breach", name_space}};
    }

    /// Adds the file, the task that made it, and everything before.
    void add_artifact(const Artifact& artifact) {
        const Task maker = wanted_task(service_, artifact.task);
        const std::string file = add_file(artifact.sha256, artifact.name, artifact.bytes);
        const std::string activity = add_task(maker);
        relate("wasGeneratedBy", {{"prov:entity", file}, {"prov:activity", activity}});
        for (const std::string& source : sources_[activity])
            relate("wasDerivedFrom", {{"prov:generatedEntity", file},
                                      {"prov:usedEntity", source},
                                      {"prov:activity", activity}});
    }

    json document() && { return std::move(document_); }

  private:
    static std::string name_of(const std::string& kind, const std::string& id) {
        return "breach:" + kind + "/" + id;
    }

    void relate(const std::string& relation, json what) {
        document_[relation]["_:" + relation + std::to_string(++relations_)] = std::move(what);
    }

    std::string add_file(const std::string& sha256, const std::string& name, std::int64_t bytes) {
        const std::string id = name_of("file", sha256);
        document_["entity"][id] = {{"prov:label", name},
                                   {"prov:type", "artifact"},
                                   {"breach:sha256", sha256},
                                   {"breach:bytes", bytes}};
        return id;
    }

    /// Adds the task's attempts as activities; returns the id of the last, which made the outputs.
    std::string add_task(const Task& task) {
        const auto attempts = service_.store.attempts_of(task.id);
        // The run that computed a reused result may be removed, with its attempts.
        const std::string last = name_of(
            "activity",
            attempts.empty() ? task.id : task.id + "/" + std::to_string(attempts.back().number));
        if (!sources_.emplace(last, std::vector<std::string>{}).second) return last;
        const json result = result_of(task);
        const std::string agent = add_program(task, result);
        if (attempts.empty()) {
            document_["activity"][last] = {
                {"prov:label", task.label},
                {"breach:task", task.id},
                {"breach:run", task.run},
                {"breach:note", "taken from the cache; the run that computed it was removed"}};
            relate("wasAssociatedWith", {{"prov:activity", last}, {"prov:agent", agent}});
        }
        std::string before;
        for (const Attempt& each : attempts) {
            const std::string id = add_attempt(task, each, result);
            relate("wasAssociatedWith", {{"prov:activity", id}, {"prov:agent", agent}});
            if (!before.empty())
                relate("wasInformedBy", {{"prov:informed", id}, {"prov:informant", before}});
            before = id;
        }
        use_inputs(task, last);
        return last;
    }

    std::string add_attempt(const Task& task, const Attempt& attempt, const json& result) {
        const std::string id = name_of("activity", task.id + "/" + std::to_string(attempt.number));
        json activity{{"prov:label", task.label + ", attempt " + std::to_string(attempt.number)},
                      {"breach:task", task.id},
                      {"breach:run", task.run},
                      {"breach:phase", task.phase},
                      {"breach:state", std::string(orchestrator::name_of(attempt.state))},
                      {"breach:cores", task.resources.cores}};
        if (attempt.started) activity["prov:startTime"] = *attempt.started;
        if (attempt.finished) activity["prov:endTime"] = *attempt.finished;
        if (attempt.exit_code) activity["breach:exitCode"] = *attempt.exit_code;
        if (attempt.cpu_seconds) activity["breach:cpuSeconds"] = *attempt.cpu_seconds;
        if (attempt.wall_seconds) activity["breach:wallSeconds"] = *attempt.wall_seconds;
        const auto beat = read_heartbeat(service_.data.attempt(task, attempt.number));
        if (beat && !beat->host.empty()) activity["breach:host"] = beat->host;
        if (!task.overrides.empty()) activity["breach:overrides"] = json(task.overrides).dump();
        if (result.contains("threads")) activity["breach:threads"] = result["threads"];
        document_["activity"][id] = std::move(activity);
        return id;
    }

    std::string add_program(const Task& task, const json& result) {
        const std::string version = result.value("version", "");
        const std::string id =
            name_of("program", version.empty() ? task.phase : task.phase + "/" + version);
        document_["agent"][id] = {{"prov:type", "prov:SoftwareAgent"}, {"prov:label", task.phase}};
        if (!version.empty()) document_["agent"][id]["breach:version"] = version;
        return id;
    }

    void use(const std::string& activity, const std::string& entity, const char* role) {
        relate("used", {{"prov:activity", activity}, {"prov:entity", entity}, {"prov:role", role}});
        sources_[activity].push_back(entity);
    }

    void use_inputs(const Task& task, const std::string& activity) {
        use(activity, add_scene(task.run), "scene");
        if (task.phase == phases::fem.program)
            for (const StoredFile& each : files_read_by(task)) {
                const std::string id = add_file(each.sha256, each.name, each.bytes);
                document_["entity"][id]["prov:type"] = each.kind;
                document_["entity"][id]["breach:about"] = each.about;
                use(activity, id, "file");
            }
        if (!task.parent || task.input.empty()) return;
        const Task parent = wanted_task(service_, *task.parent);
        for (const Artifact& each : service_.store.artifacts_of(parent.id)) {
            if (each.name != task.input) continue;
            use(activity, name_of("file", each.sha256), "input");
            add_artifact(service_.store.maker_of(each.sha256).value_or(each));
            return;
        }
        if (!task.input_sha256 || task.input_sha256->empty()) return;  // the parent still runs
        use(activity, add_file(*task.input_sha256, task.input, 0), "input");
        document_["entity"][name_of("file", *task.input_sha256)].erase("breach:bytes");
        relate("wasGeneratedBy", {{"prov:entity", name_of("file", *task.input_sha256)},
                                  {"prov:activity", add_task(parent)}});
    }

    std::vector<StoredFile> files_read_by(const Task& task) const {
        const json scene = json::parse(service_.store.scene_of(task.run).value_or("{}"));
        std::vector<StoredFile> found;
        for (const auto& each : scene::references_in({scene, json(task.overrides)}))
            if (auto file = service_.store.file(each.sha256)) found.push_back(std::move(*file));
        return found;
    }

    /// Adds the run's scene, its study and, if there is one, the stored scene.
    std::string add_scene(const std::string& run) {
        const std::string text = service_.store.scene_of(run).value_or("{}");
        const std::string sha256 = exchange::sha256_of_text(text);
        const std::string id = name_of("scene", sha256);
        if (!runs_.insert(run).second) return id;
        document_["entity"][id] = {{"prov:type", "scene"},
                                   {"prov:label", json::parse(text).value("name", "scene")},
                                   {"breach:sha256", sha256}};
        const Run about = wanted_run(service_, run);
        const std::string study = name_of("study", run);
        document_["entity"][study] = {{"prov:type", "study"},
                                      {"prov:label", about.name},
                                      {"breach:run", run},
                                      {"breach:submitted", about.created}};
        relate("wasDerivedFrom", {{"prov:generatedEntity", id}, {"prov:usedEntity", study}});
        const auto source = service_.store.scene_source_of(run);
        if (!source) return id;
        const std::string stored = name_of("scene", source->sha256);
        if (stored == id) return id;  // the study has no overrides
        document_["entity"][stored] = {{"prov:type", "scene"}, {"breach:sha256", source->sha256}};
        if (source->name)
            document_["entity"][stored]["prov:label"] =
                *source->name + "@" + std::to_string(source->version.value_or(0));
        relate("wasDerivedFrom", {{"prov:generatedEntity", id}, {"prov:usedEntity", stored}});
        return id;
    }

    /// The provenance in the phase's result.json; an empty object without a result.
    json result_of(const Task& task) const {
        std::ifstream stream(service_.data.output(task) / phases::files::result);
        const json result = json::parse(stream, nullptr, false);
        return result.is_object() ? result.value("provenance", json::object()) : json::object();
    }

    const Service& service_;
    json document_;
    std::map<std::string, std::vector<std::string>> sources_;  ///< of each activity in the document
    std::set<std::string> runs_;                               ///< runs whose scenes are listed
    std::size_t relations_ = 0;
};

void provenance(const Service& service, Call& call) {
    call.allow_parameters({});
    const auto artifact = service.store.maker_of(call.parts[0]);
    if (!artifact) throw not_found("artifact " + call.parts[0]);
    Chain chain(service);
    chain.add_artifact(*artifact);
    reply(call.response, std::move(chain).document());
}

}  // namespace

void add_provenance_routes(Router& router, Service& service) {
    router.get("/v1/artifacts/{sha256}/provenance", [&](Call& call) { provenance(service, call); });
}

}  // namespace breach::orchestrator
