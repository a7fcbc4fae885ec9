// POST of a drawing from the dashboard's form. It stores nothing: the answer has the scene, which
// the page then submits or downloads.
#include "services/orchestrator/http/imports.hpp"

#include <set>

#include "core/scene/schema.hpp"
#include "services/drawing/section_drawing.hpp"
#include "services/import/import.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;

namespace {

/// The entries of a request, with a fault for each that has the wrong type.
/// One pass over the body: each entry is asked for once, and finish() knows what was not.
class Entries {
  public:
    explicit Entries(const json& body) : body_(body) {}

    std::string text(const std::string& name) {
        return take<std::string>(name, &json::is_string, "a text").value_or("");
    }
    std::optional<double> number(const std::string& name) {
        return take<double>(name, &json::is_number, "a number");
    }
    bool flag(const std::string& name) {
        return take<bool>(name, &json::is_boolean, "true or false").value_or(false);
    }
    std::vector<std::string> texts(const std::string& name) {
        std::vector<std::string> list;
        const json entry = take<json>(name, &json::is_array, "a list of texts").value_or(json());
        for (const json& each : entry) {
            if (each.is_string()) {
                list.push_back(each);
            } else {
                refuse(name, "holds something that is no text", "give a list of texts");
            }
        }
        return list;
    }
    std::optional<importing::Sent> file(const std::string& name) {
        auto content = take<std::string>(name, &json::is_string, "the text of a CSV file");
        if (!content) return std::nullopt;
        return importing::Sent{name, std::move(*content)};
    }
    json object(const std::string& name) {
        return take<json>(name, &json::is_object, "an object").value_or(json());
    }
    /// Throws BadInput with all faults, including unknown entries.
    void finish() {
        for (const auto& [name, value] : body_.items())
            if (!known_.contains(name)) refuse(name, "is not known", "leave it out");
        if (!body_.contains("drawing"))
            refuse("drawing", "is missing", "give the text of a DXF or CSV file");
        if (!faults_.empty()) throw fault::BadInput("request", std::move(faults_));
    }

  private:
    template <class Value>
    std::optional<Value> take(const std::string& name, bool (json::*fits)() const noexcept,
                              const std::string& kind) {
        known_.insert(name);
        const auto found = body_.find(name);
        if (found == body_.end()) return std::nullopt;
        if (((*found).*fits)()) return found->template get<Value>();
        refuse(name, "is not " + kind, "give " + kind);
        return std::nullopt;
    }
    void refuse(const std::string& name, std::string cause, std::string remedy) {
        faults_.push_back({json::json_pointer().operator/=(name).to_string(), std::move(cause),
                           std::move(remedy)});
    }

    const json& body_;
    std::set<std::string> known_;
    std::vector<Fault> faults_;
};

/// Once for the scene and once for its picture: the same body gives both.
importing::Request request_from(const std::string& text) {
    const json body = scene::parse_json(text, "request");
    Entries entries(body);
    importing::Request request{.drawing = {entries.text("file"), entries.text("drawing")},
                               .materials = entries.object("materials"),
                               .map = entries.texts("map"),
                               .layers = entries.texts("layers"),
                               .phreatic = entries.file("phreatic"),
                               .terrain = entries.file("terrain"),
                               .ground = entries.file("ground"),
                               .unit = entries.text("unit"),
                               .tolerance = entries.number("tolerance").value_or(0.05),
                               .flatten = entries.number("flatten"),
                               .name = entries.text("name"),
                               .confirmed = entries.flag("confirmed"),
                               .liquefied = entries.texts("liquefied")};
    const auto pga = entries.number("pga"), shaking = entries.number("shaking");
    if (entries.flag("with_fem")) {
        // Its presence asks for a FEM; pga and shaking alone have no effect.
        auto& motion = request.motion.emplace();
        motion.pga = pga.value_or(motion.pga);
        motion.shaking = shaking.value_or(motion.shaking);
    }
    entries.finish();
    return request;
}

}  // namespace

json imported(const std::string& body, const KeepMotion& keep_motion) {
    const importing::Request request = request_from(body);
    importing::Imported made = importing::import_section(request);
    if (!made.faults.empty()) throw fault::BadInput("drawing", std::move(made.faults));
    json answer{{"report", std::move(made.report)}};
    if (!made.motion.empty()) {
        made.scene["fem"]["motion"]["file"] = keep_motion(made.motion);
    }
    if (!made.study.is_null()) answer["study"] = std::move(made.study);
    answer["scene"] = std::move(made.scene);
    return answer;
}

/// With faults there is no scene: what could be read of the drawing is shown with their places.
std::string picture_of_import(const std::string& body) {
    const importing::Request request = request_from(body);
    importing::Imported made = importing::import_section(request);
    const json shown =
        made.faults.empty() ? made.scene : json{{"title", "What is wrong with the drawing"}};
    // Made before it is known whether it is thrown: it keeps the faults, which the draft shows.
    const fault::BadInput first("drawing", std::move(made.faults));
    const drawing::Draft draft{{shown, {}, ""}, std::move(made.sketch), first.faults()};
    if (!drawing::can_be_drawn(draft)) throw first;
    return drawing::as_svg(draft, {});
}

}  // namespace breach::orchestrator
