// Templates for the page's form (services/templates). Nothing is stored but the motion of a shaken
// scene: the study is the page's to change and submit.
#include "core/scene/schema.hpp"
#include "services/orchestrator/http/http_routes.hpp"
#include "services/templates/templates.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

const templates::Template& wanted_template(const std::string& name) {
    for (const templates::Template& each : templates::catalogue())
        if (each.name == name) return each;
    throw not_found("template " + name);
}

/// The study as POST /v1/runs accepts it, with its scene; the service stores the motion. Entries
/// have the order of the files of `breach new`.
void make(Service& service, Call& call) {
    call.allow_parameters({});
    const std::string& name = wanted_template(call.parts[0]).name;
    const templates::Made made =
        templates::make(name, scene::parse_json(call.json_body(), "options"));
    nlohmann::ordered_json answer{
        {"template", name}, {"options", made.options}, {"study", made.study}};
    nlohmann::ordered_json& scene = answer["study"]["scene"] = made.scene;
    if (!made.motion.empty())
        scene["fem"]["motion"]["file"] = keep_motion(service, "motion.csv", made.motion);
    call.response.set_header("Cache-Control", "no-store");
    call.response.set_content(answer.dump(), "application/json");
}

}  // namespace

void add_template_routes(Router& router, Service& service) {
    router.get("/v1/templates", [](Call& call) {
        call.allow_parameters({});
        reply(call.response, templates::as_json(templates::catalogue()));
    });
    router.post("/v1/templates/{name}", [&](Call& call) { make(service, call); });
}

}  // namespace breach::orchestrator
