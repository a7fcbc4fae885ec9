// Drawing, faults and cost of a study before it is submitted. It runs the checks of a submission,
// so that what passes here is accepted there, and it still draws a scene with faults, with their
// places.
#include "services/orchestrator/http/preview.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>

#include "core/phases/phases.hpp"
#include "core/scene/reading.hpp"
#include "core/scene/schema.hpp"
#include "core/words/number.hpp"
#include "services/drawing/mesh_question.hpp"
#include "services/estimate/cost.hpp"
#include "services/orchestrator/http/answers.hpp"
#include "services/orchestrator/http/sent_documents.hpp"
#include "services/orchestrator/study/checked_scene.hpp"
#include "services/orchestrator/study/graph.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

struct Sent {
    json document;
    drawing::Draft draft;
};

/// A study without its scene inside is refused as a submission would refuse it; a study whose scene
/// has faults is drawn.
Sent sent(const Service& service, const std::string& body) {
    json document = scene::parse_json(body, "document");
    if (is_study_document(document) && !document.value("scene", json()).is_object())
        sent_study(document, service);  // throws its faults
    drawing::BaseScene base = drawing::base_scene_of(document);
    check::Recordings recordings;
    check::Checked checked = check_scene_of_study(base.pointer, base.scene, base.overrides,
                                                  files_of(service), recordings);
    checked.faults = seen_from_here(std::move(checked.faults));
    return {std::move(document), drawing::draft_of(std::move(base), std::move(checked))};
}

bool is_study(const drawing::Draft& draft) { return !draft.base.pointer.empty(); }

/// Pointers into the document that was sent, whether it is a scene or a study.
fault::BadInput refusal_of(const drawing::Draft& draft, const std::vector<fault::Fault>& of_study) {
    std::vector<fault::Fault> faults = draft.faults;
    for (fault::Fault& each : faults) each.pointer = draft.base.pointer + each.pointer;
    faults.insert(faults.end(), of_study.begin(), of_study.end());
    return {is_study(draft) ? "study" : "scene", std::move(faults)};
}

/// Faults and warnings of a submission beyond those of the scene.
struct Judged {
    std::vector<fault::Fault> faults;
    std::vector<fault::Flag> warnings;
    std::optional<Study> study = {};  ///< none: the document is a scene, or has faults
};

Judged judged(const Service& service, const json& document, const drawing::Draft& draft) {
    if (!is_study(draft)) return {{}, draft.scene.warnings};
    try {
        Study study = sent_study(document, service);
        std::vector<fault::Flag> warnings = study.warnings;
        return {{}, std::move(warnings), std::move(study)};
    } catch (const fault::BadInput& refused) {
        Judged found{refused.faults(), draft.scene.warnings};
        // The study repeats the faults of its scene; they are already on the drawing.
        std::erase_if(found.faults, [&](const fault::Fault& each) {
            return std::ranges::any_of(draft.faults, [&](const fault::Fault& known) {
                return each.pointer == draft.base.pointer + known.pointer;
            });
        });
        for (fault::Flag& each : found.warnings) each.pointer = draft.base.pointer + each.pointer;
        return found;
    }
}

/// Of scenes, with what this server's earlier runs of the same scene say.
class CostsHere {
  public:
    explicit CostsHere(const Service& service)
        : earlier_(service.earlier_costs.of(service.store)) {}

    std::vector<estimate::PhaseCost> of(
        const scene::Scene& scene, const std::optional<estimate::MeshCounts>& mesh = {}) const {
        std::vector<estimate::PhaseCost> costs = estimate::cost_of(scene, mesh);
        estimate::learn(costs, scene.name, earlier_);
        return costs;
    }

  private:
    std::vector<estimate::Earlier> earlier_;
};

/// Costs of a study's scene with a task's overrides, each read once.
class CostsOfTasks {
  public:
    CostsOfTasks(const CostsHere& here, const Study& study)
        : here_(here), scene_(study.scene.dump()) {}

    /// Of its phase; the stability analysis after the shaking counts as the one before it.
    const estimate::PhaseCost* of(const TaskPlan& task) {
        const std::vector<estimate::PhaseCost>& costs = read(task.overrides);
        const std::string& program =
            task.phase == phases::post_seismic.program ? phases::lem.program : task.phase;
        const auto found = std::ranges::find(costs, program, &estimate::PhaseCost::phase);
        return found == costs.end() ? nullptr : &*found;
    }

  private:
    const std::vector<estimate::PhaseCost>& read(const std::vector<std::string>& overrides) {
        // Beyond these, samples cost on the mean what the first ones do.
        constexpr std::size_t most_scenes = 40;
        const auto known = known_.find(overrides);
        if (known != known_.end()) return known->second;
        if (known_.size() >= most_scenes)
            return std::next(known_.begin(), static_cast<std::ptrdiff_t>(turn_++ % known_.size()))
                ->second;
        const scene::Reading reading = scene::read_text(scene_, "scene", "/", overrides);
        return known_.emplace(overrides, here_.of(reading.scene)).first->second;
    }

    const CostsHere& here_;
    std::string scene_;
    std::map<std::vector<std::string>, std::vector<estimate::PhaseCost>> known_;
    std::size_t turn_ = 0;
};

/// An uncertainty study with all requested samples, of which a submission draws the first.
Study with_all_samples(const Service& service, json document, Study study) {
    if (!document.contains("uncertainty")) return study;
    json& entry = document["uncertainty"];
    if (entry.is_object() && entry.contains("samples")) entry["drawn"] = entry["samples"];
    return sent_study(std::move(document), service);
}

/// All tasks that a study asks for. Tasks that variants or samples share count once.
estimate::StudyCost study_cost_here(const Service& service, const Study& study,
                                    const CostsHere& here) {
    const TaskGraph graph = plan_tasks(study, service.numerics);
    CostsOfTasks costs(here, study);
    estimate::StudyCost all{.workers = static_cast<unsigned>(service.dispatcher.settings().slots)};
    // known: of tasks that are counted already.
    const auto add = [&](const std::vector<TaskPlan>& tasks, std::string_view known) {
        std::vector<double> ends;  // CPU seconds until each is over; parents come first
        for (const TaskPlan& each : tasks) {
            const double before = each.parent ? ends.at(*each.parent) : 0.0;
            const estimate::PhaseCost* cost = costs.of(each);
            const bool counts = cost && each.phase != known;
            ends.push_back(counts ? all.add(*cost, before)
                                  : before + (cost ? cost->cpu_seconds : 0.0));
        }
    };
    add(graph.tasks, "");
    // Triggers add their transfers later: one per variant is the best guess.
    if (!all.tasks.contains(phases::mpm.program)) add(graph.one_more_transfer, phases::fem.program);
    return all;
}

struct Forecast {
    std::vector<estimate::PhaseCost> phases;
    estimate::StudyCost all;

    std::vector<std::string> lines() const { return estimate::lines_of(phases, all); }
    json as_json() const { return estimate::as_json(phases, all); }
};

/// study: that of the document, if it is one.
Forecast forecast(const Service& service, const json& document, const drawing::Draft& draft,
                  std::optional<Study> study,
                  const std::optional<estimate::MeshCounts>& mesh = {}) {
    const CostsHere here(service);
    std::vector<estimate::PhaseCost> phases = here.of(draft.scene, mesh);
    if (!study) {
        estimate::StudyCost all = estimate::study_cost_of(phases, document);
        return {std::move(phases), std::move(all)};
    }
    const Study whole = with_all_samples(service, document, std::move(*study));
    return {std::move(phases), study_cost_here(service, whole, here)};
}

drawing::DrawnMesh mesh_here(const Service& service, const drawing::Draft& draft) {
    constexpr double most_elements = 2e5;  // larger meshes take gmsh too long for a request
    for (const estimate::PhaseCost& each : estimate::cost_of(draft.scene))
        if (each.phase == phases::fem.program && each.counts.at(0).second > most_elements)
            throw fault::BadInput("scene",
                                  {{draft.base.pointer + "/section",
                                    "asks for more elements than are meshed for a picture",
                                    "draw it without its mesh, or use breach draw --mesh"}});
    return drawing::mesh_of(draft,
                            {service.bin / phases::fem.program, service.data.scratch() / "meshes"});
}

}  // namespace

std::string picture_of(const Service& service, const std::string& body, MeshDrawn mesh) {
    const auto [document, draft] = sent(service, body);
    auto [faults, warnings, study] = judged(service, document, draft);
    if (!drawing::can_be_drawn(draft)) throw refusal_of(draft, faults);
    drawing::Additions additions{.faults = std::move(faults), .warnings = std::move(warnings)};
    if (!draft.faults.empty()) return drawing::as_svg(draft, additions);  // it cannot be meshed
    std::optional<estimate::MeshCounts> counts;
    if (mesh == MeshDrawn::yes && draft.scene.fem) {
        additions.mesh = mesh_here(service, draft);
        counts = {static_cast<double>(additions.mesh->quads.size()),
                  static_cast<double>(additions.mesh->nodes.size())};
    }
    if (additions.faults.empty())
        additions.foot = forecast(service, document, draft, std::move(study), counts).lines();
    return drawing::as_svg(draft, additions);
}

/// In the order of a submission: what it would refuse has no cost.
json cost_of(const Service& service, const std::string& body) {
    const auto [document, draft] = sent(service, body);
    std::optional<Study> study;
    if (is_study(draft)) study = sent_study(document, service);  // or throws its faults
    if (!draft.faults.empty()) throw refusal_of(draft, {});
    const json warnings = fault::as_json(study ? study->warnings : draft.scene.warnings);
    json cost = forecast(service, document, draft, std::move(study)).as_json();
    cost["warnings"] = warnings;
    return cost;
}

}  // namespace breach::orchestrator
