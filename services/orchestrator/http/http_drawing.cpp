#include "services/orchestrator/http/http_drawing.hpp"

#include "core/scene/schema.hpp"
#include "services/estimate/cost.hpp"
#include "services/orchestrator/accuracy/earlier_costs.hpp"
#include "services/orchestrator/http/sent_documents.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

fault::BadInput refusal_of(const report::Draft& draft) {
    std::vector<fault::Fault> faults = draft.faults;
    for (fault::Fault& each : faults) each.pointer = draft.base.pointer + each.pointer;
    return {draft.base.pointer.empty() ? "scene" : "study", std::move(faults)};
}

std::vector<estimate::PhaseCost> cost_here(const Service& service, const scene::Scene& scene) {
    std::vector<estimate::PhaseCost> costs = estimate::cost_of(scene);
    estimate::learn(costs, scene.name, earlier_costs(service.store));
    return costs;
}

void draw(const Service& service, Call& call) {
    call.allow_parameters({});
    const json document = scene::parse_json(call.json_body(), "document");
    const report::Draft draft = sent_draft(document);
    if (!report::can_be_drawn(draft)) throw refusal_of(draft);
    report::Additions additions;
    if (draft.faults.empty())
        additions.foot = estimate::lines_of(cost_here(service, draft.scene),
                                            estimate::repeats_of(document));
    call.response.set_content(report::as_svg(draft, additions), "image/svg+xml");
}

void tell_cost(const Service& service, Call& call) {
    call.allow_parameters({});
    const json document = scene::parse_json(call.json_body(), "document");
    const report::Draft draft = sent_draft(document);
    if (!draft.faults.empty()) throw refusal_of(draft);
    const auto costs = cost_here(service, draft.scene);
    const estimate::Repeats repeats = estimate::repeats_of(document);
    json answer = estimate::as_json(costs, repeats);
    answer["lines"] = estimate::lines_of(costs, repeats);
    reply(call.response, answer);
}

}  // namespace

void add_drawing_routes(Router& router, Service& service) {
    router.post("/v1/draw", [&](Call& call) { draw(service, call); });
    router.post("/v1/cost", [&](Call& call) { tell_cost(service, call); });
}

}  // namespace breach::orchestrator
