#include "services/cli/draw.hpp"

#include "core/exchange/publish.hpp"
#include "services/cli/study_file.hpp"
#include "services/estimate/cost.hpp"
#include "services/report/section/section_drawing.hpp"

namespace breach::cli {

using fault::ExitCode;
using nlohmann::json;

namespace {

/// A scene is put into a study, so that overrides are read alike.
json study_of(const DrawWish& wish, bool is_study) {
    return is_study ? read_study(wish.document, wish.overrides)
                    : study_around(wish.document, wish.overrides);
}

}  // namespace

ExitCode draw(Server&, const DrawWish& wish, const Console& console) {
    const bool is_study = names_a_scene(wish.document);
    const json study = study_of(wish, is_study);
    report::BaseScene base = report::base_scene_of(study);
    if (!is_study) base.pointer = "";
    check::Checked checked = check::checked_text(base.scene.dump(), wish.document.string(),
                                                 wish.document.parent_path(), base.overrides);
    const report::Draft draft = report::draft_of(std::move(base), std::move(checked));
    std::vector<fault::Fault> faults = draft.faults;
    for (fault::Fault& each : faults) each.pointer = draft.base.pointer + each.pointer;
    if (!report::can_be_drawn(draft)) throw fault::BadInput(wish.document.string(), faults);
    report::Additions additions;
    if (faults.empty()) {
        const auto costs = estimate::cost_of(draft.scene);
        const estimate::Repeats repeats =
            is_study ? estimate::repeats_of(study) : estimate::Repeats{};
        additions.foot = estimate::lines_of(costs, repeats);
        if (console.style == Style::json) {
            console.out << estimate::as_json(costs, repeats).dump(2) << "\n";
        } else {
            for (const std::string& each : additions.foot) console.out << each << "\n";
        }
    }
    if (!wish.picture.empty())
        exchange::publish_text(wish.picture, report::as_svg(draft, additions));
    if (faults.empty()) return ExitCode::done;
    console.notes << "breach: "
                  << fault::BadInput(wish.document.string(), std::move(faults)).what() << "\n";
    return ExitCode::bad_input;
}

}  // namespace breach::cli
