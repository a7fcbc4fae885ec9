// Requests that compute but store no run: the page sends them while a study is being written, again
// after each change. An import with an earthquake stores its motion, because the scene names it by
// its hash.
#include "services/orchestrator/http/http_routes.hpp"
#include "services/orchestrator/http/imports.hpp"
#include "services/orchestrator/http/preview.hpp"

namespace breach::orchestrator {

void add_drawing_routes(Router& router, Service& service) {
    router.post("/v1/draw", [&](Call& call) {
        call.allow_parameters({"mesh"});
        const auto mesh = call.whole_number("mesh", 0, 0, 1) == 1 ? MeshDrawn::yes : MeshDrawn::no;
        call.response.set_content(picture_of(service, call.json_body(), mesh), "image/svg+xml");
    });
    router.post("/v1/import", [&](Call& call) {
        call.allow_parameters({"picture"});
        if (call.whole_number("picture", 0, 0, 1) == 1) {
            // Faults are in the picture, so a drawing with faults is no error here.
            call.response.set_content(picture_of_import(call.json_body()), "image/svg+xml");
        } else {
            reply(call.response, imported(call.json_body(), [&](const std::string& text) {
                      return keep_motion(service, "motion.csv", text);
                  }));
        }
    });
    router.post("/v1/cost", [&](Call& call) {
        call.allow_parameters({});
        // Refuses what a submission would refuse, unlike the drawing.
        reply(call.response, cost_of(service, call.json_body()));
    });
}

}  // namespace breach::orchestrator
