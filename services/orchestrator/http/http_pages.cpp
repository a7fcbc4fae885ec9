// What needs no run: the dashboard's files, the description of the API, schemas, health, and the
// plan of a scene. openapi.json describes only what cannot be derived; rights, columns and path
// parameters are added from the code, so that they cannot differ from it.
#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "core/scene/file_paths.hpp"
#include "core/scene/schema_text.hpp"
#include "core/telemetry/columns.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/http/openapi_text.hpp"
#include "services/orchestrator/http/sent_documents.hpp"
#include "services/orchestrator/programs/plan_question.hpp"
#include "services/orchestrator/records/mean_columns.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

// Room for the database to commit and a run's documents.
constexpr std::uintmax_t least_free_bytes = 16 << 20;

/// The fields of telemetry, which conditions of triggers may use.
/// Made from the columns that the phases write, so that forms and errors know the same names.
json telemetry_table() {
    json fields = json::array();
    for (const auto& table : {telemetry::fem_columns(), telemetry::run_columns()})
        for (const telemetry::Column& each : table)
            fields.push_back({{"name", each.name}, {"unit", each.unit}, {"meaning", each.meaning}});
    return fields;
}

const std::map<std::string, std::string> content_types{
    {".html", "text/html; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".json", "application/json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".txt", "text/plain; charset=utf-8"},
};

/// Refuses hidden files, "..", and characters with a meaning to a file system.
bool is_plain(const std::string& path) {
    const bool known_letters = std::ranges::all_of(path, [](unsigned char each) {
        return std::isalnum(each) != 0 || each == '/' || each == '.' || each == '-' || each == '_';
    });
    return known_letters && path.size() < 200 && !path.starts_with('.') && !path.starts_with('/') &&
           path.find("/.") == std::string::npos;
}

/// no-cache: a browser asks again each time, so that a new version of the service shows its own
/// pages.
void send_file(const Service& service, Call& call, const std::string& name) {
    if (!is_plain(name)) throw not_found("such page");
    const auto wanted = service.web / name;
    std::error_code error;
    const auto root = std::filesystem::canonical(service.web, error);
    const auto file =
        std::filesystem::canonical(wanted, error);  // resolves links: they must stay inside
    const auto type = content_types.find(wanted.extension());
    const bool inside = !error && std::ranges::mismatch(root, file).in1 == root.end();
    if (!inside || type == content_types.end() || !std::filesystem::is_regular_file(file))
        throw not_found("such page");
    call.response.set_header("Cache-Control", "no-cache");
    call.response.set_header(
        "Content-Security-Policy",
        "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
        "object-src 'none'; base-uri 'none'; frame-ancestors 'none'");
    call.response.set_content(whole_text(file), type->second);
}

// openapi.json with its order of entries, which a reader of the page follows.
using Description = nlohmann::ordered_json;

/// "problems": statuses answered by a problem; other statuses are possible.
void add_problems(Description& operation) {
    const json problem{{"$ref", "#/components/responses/Problem"}};
    for (const auto& status : operation.value("problems", Description::array()))
        operation["responses"][std::to_string(status.get<int>())] = problem;
    operation["responses"]["default"] = problem;
    operation.erase("problems");
}

/// "json": the schema of a JSON body.
void name_media_type(Description& body) {
    if (!body.contains("json")) return;
    body["content"]["application/json"]["schema"] = body["json"];
    body.erase("json");
}

/// Adds "{run}" and the like of the path as required parameters, before the listed ones.
void add_path_parameters(const std::string& path, Description& operation) {
    Description parameters = Description::array();
    for (std::size_t at = path.find('{'); at != std::string::npos; at = path.find('{', at + 1))
        parameters.push_back({{"name", path.substr(at + 1, path.find('}', at) - at - 1)},
                              {"in", "path"},
                              {"required", true},
                              {"schema", {{"type", "string"}}}});
    for (auto& each : operation.value("parameters", Description::array()))
        parameters.push_back(each);
    if (!parameters.empty()) operation["parameters"] = std::move(parameters);
}

/// "extends": puts the properties of another schema before its own.
void extend(Description& schemas, Description& schema) {
    if (!schema.contains("extends")) return;
    Description& base = schemas[schema["extends"].get<std::string>()];
    extend(schemas, base);
    Description whole = base;
    whole["properties"].update(schema["properties"]);
    for (auto& each : schema["required"]) whole["required"].push_back(each);
    schema = std::move(whole);
}

/// Adds the examples of examples.json, real calls with their answers, to their operations.
void add_examples(Description& paths) {
    for (const auto& call : Description::parse(examples_text())) {
        const auto word = [&](const char* entry) { return call.at(entry).get<std::string>(); };
        const auto add = [&](Description& body, const Description& value) {
            body["examples"][call.value("name", "example")] = {{"summary", word("call")},
                                                               {"value", value}};
        };
        Description& operation = paths.at(word("path")).at(word("method"));
        Description& response = operation.at("responses").at(word("status"));
        add(response.at("content").at(word("media")), call.at("answer"));
        if (call.contains("body"))
            add(operation.at("requestBody").at("content").front(), call.at("body"));
    }
}

/// openapi.json, completed with the columns of results and the rights of the routes.
std::string api_description(const Router& router) {
    auto document = Description::parse(openapi_text());
    Description& schemas = document["components"]["schemas"];
    for (auto& each : schemas) extend(schemas, each);
    for (auto& [path, operations] : document["paths"].items()) {
        for (auto& [method, operation] : operations.items()) {
            for (auto& response : operation["responses"]) name_media_type(response);
            if (operation.contains("requestBody")) name_media_type(operation["requestBody"]);
            add_problems(operation);
            add_path_parameters(path, operation);
            std::string name = method;
            std::ranges::transform(name, name.begin(),
                                   [](unsigned char c) { return std::toupper(c); });
            const Right right = router.needed(name, path);
            operation["security"] = json::array();
            if (right == Right::none) continue;
            // The empty object: a service without tokens on loopback needs none.
            operation["security"] = json::array({json::object(), {{"bearer", {name_of(right)}}}});
        }
    }
    add_examples(document["paths"]);
    schemas["SweepRow"] = schema_of_rows(result_columns());
    schemas["SweepMean"] = schema_of_rows(mean_columns());
    return document.dump(1);
}

/// Ready: there is room on the disk and the database answers.
void ready(const Service& service, Call& call) {
    std::error_code error;
    const auto space = std::filesystem::space(service.data.scratch(), error);
    if (error || space.available < least_free_bytes) {
        throw disk_is_full("Not ready");
    }
    service.store.runs(1);
    reply(call.response, {{"status", "ready"}});
}

}  // namespace

void add_page_routes(Router& router, Service& service) {
    router.get("/", [&](Call& call) { send_file(service, call, "index.html"); });
    router.get("/static/{file...}", [&](Call& call) { send_file(service, call, call.parts[0]); });
    router.get("/healthz", [](Call& call) { reply(call.response, {{"status", "ok"}}); });
    router.get("/readyz", [&](Call& call) { ready(service, call); });
    router.get("/openapi.json", [&router](Call& call) {
        call.allow_parameters({});
        // At the first request, when all routes have been added.
        static const std::string text = api_description(router);
        call.response.set_content(text, "application/json");
    });
    router.get("/v1/schema/scene", [](Call& call) {
        call.response.set_content(scene::scene_schema_text(), "application/json");
    });
    router.get("/v1/schema/study", [](Call& call) {
        call.response.set_content(scene::study_schema_text(), "application/json");
    });
    router.get("/v1/telemetry/fields", [](Call& call) {
        call.allow_parameters({});
        reply(call.response, {{"fields", telemetry_table()}});
    });
    router.post("/v1/scenes/plan", [&](Call& call) {
        call.allow_parameters({});
        auto [scene, warnings] = sent_scene(call.json_body(), service);
        // The phases take paths, not references.
        scene::resolve_references(scene, service.data.root());
        reply(call.response, {{"plans", plans_of(scene, service.bin, service.data.scratch())},
                              {"warnings", fault::as_json(warnings)}});
    });
}

}  // namespace breach::orchestrator
