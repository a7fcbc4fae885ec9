// `breach draw`: the section, its faults and its cost before anything is submitted. It works
// without a server. Then the cost follows from the scene alone, and no earlier run corrects it.
#include "services/cli/draw.hpp"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/exchange/publish.hpp"
#include "core/phases/phases.hpp"
#include "services/cli/sending.hpp"
#include "services/cli/study_file.hpp"
#include "services/cli/table.hpp"
#include "services/drawing/mesh_question.hpp"
#include "services/estimate/cost.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;

namespace {

/// Puts a scene into a study, so that overrides are treated the same.
json study_of(const DrawOptions& options, bool is_study) {
    return is_study ? read_study(options.document, options.overrides)
                    : study_around(options.document, options.overrides);
}

/// The fem_solver beside this program; meshes go to the user's cache folder.
/// Meshes of a large section take a while, and are the same until the scene changes: hence the
/// cache.
/// Beside this program, not by PATH: a build and an installed package must not mix their solvers.
drawing::Mesher mesher_here() {
    const auto value = [](const char* name) {
        const char* found = std::getenv(name);
        return std::filesystem::path(found ? found : "");
    };
    std::filesystem::path caches = value("XDG_CACHE_HOME");
    if (caches.empty()) caches = value("HOME").empty() ? "" : value("HOME") / ".cache";
    if (caches.empty()) caches = std::filesystem::temp_directory_path();
    return {std::filesystem::read_symlink("/proc/self/exe").parent_path() / phases::fem.program,
            caches / "breachline" / "meshes"};
}

/// A mesh file is always drawn: it may not fit the section.
std::optional<drawing::DrawnMesh> wanted_mesh(const drawing::Draft& draft,
                                              const DrawOptions& options) {
    const auto& fem = draft.scene.fem;
    if (!draft.faults.empty() || !fem || (!options.mesh && !fem->mesh.msh_file))
        return std::nullopt;
    return drawing::mesh_of(draft, mesher_here());
}

std::optional<estimate::MeshCounts> counts_of(const std::optional<drawing::DrawnMesh>& mesh) {
    if (!mesh) return std::nullopt;
    return estimate::MeshCounts{static_cast<double>(mesh->quads.size()),
                                static_cast<double>(mesh->nodes.size())};
}

/// In the form of the server's answer, so that both are shown by the same code.
json warnings_of(const drawing::Draft& draft) {
    json list = json::array();
    for (const fault::Flag& each : draft.scene.warnings)
        list.push_back({{"code", each.code},
                        {"message", each.message},
                        {"pointer", draft.base.pointer + each.pointer}});
    return list;
}

/// What is known before a run of a document with a valid scene.
struct Preview {
    json cost;                         ///< the answer of POST /v1/cost
    std::vector<fault::Fault> faults;  ///< that would make the server refuse the study
};

/// Asks the server for the cost of earlier runs; without an answer uses the scene alone.
/// A refusal about a file only means that the server has not got it yet: submit would send it. A
/// refusal without faults, such as a missing token, counts as no answer, as drawing needs no right.
Preview preview_of(Server& server, const json& document, const drawing::Draft& draft,
                   const std::optional<estimate::MeshCounts>& mesh) {
    std::vector<fault::Fault> faults;
    try {
        return {server.post("/v1/cost", document), {}};
    } catch (const Unreachable&) {
    } catch (const Refused& refused) {
        if (std::ranges::none_of(refused.faults(), is_about_a_file)) faults = refused.faults();
    }
    const std::vector<estimate::PhaseCost> costs = estimate::cost_of(draft.scene, mesh);
    json cost = estimate::as_json(costs, estimate::study_cost_of(costs, document));
    cost["warnings"] = warnings_of(draft);
    return {std::move(cost), std::move(faults)};
}

}  // namespace

/// A scene alone is checked as if in a study, but its faults keep the scene's own pointers.
ExitCode draw(Server& server, const DrawOptions& options, const Console& console) {
    const bool is_study = names_a_scene(options.document);
    const json study = study_of(options, is_study);
    drawing::BaseScene base = drawing::base_scene_of(study);
    if (!is_study) base.pointer = "";
    check::Checked checked = check::checked_document(
        base.scene, options.document.string(), options.document.parent_path(), base.overrides);
    const drawing::Draft draft = drawing::draft_of(std::move(base), std::move(checked));
    std::vector<fault::Fault> faults = draft.faults;
    for (fault::Fault& each : faults) each.pointer = draft.base.pointer + each.pointer;
    if (!drawing::can_be_drawn(draft)) throw fault::BadInput(options.document.string(), faults);
    drawing::Additions additions{.mesh = wanted_mesh(draft, options)};
    json cost{{"warnings", warnings_of(draft)}};
    if (faults.empty()) {
        Preview preview = preview_of(server, is_study ? study : draft.base.scene, draft,
                                     counts_of(additions.mesh));
        cost = std::move(preview.cost);
        faults = additions.faults = std::move(preview.faults);
        additions.foot = cost.at("lines");
        if (!shown_as_json(cost, console))
            for (const std::string& each : additions.foot) console.out << each << "\n";
    }
    show_warnings(cost, console);
    for (const json& each : cost.at("warnings"))
        additions.warnings.push_back(
            {each.at("code"), fault::Severity::warning, each.at("message"), each.at("pointer")});
    if (!options.picture.empty())
        exchange::publish_text(options.picture, drawing::as_svg(draft, additions));
    // Not thrown earlier: the picture that marks the faults is what the user asked for.
    if (faults.empty()) return ExitCode::done;
    console.notes << "breach: "
                  << fault::BadInput(options.document.string(), std::move(faults)).what() << "\n";
    return ExitCode::bad_input;
}

}  // namespace breach::cli
