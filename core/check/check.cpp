#include "core/check/check.hpp"

#include <utility>

#include "core/check/recordings.hpp"
#include "core/check/subjects.hpp"
#include "core/scene/reading.hpp"
#include "core/scene/resolution.hpp"
#include "core/scene/schema.hpp"

namespace breach::check {

Problems problems_of(const scene::Scene& scene) {
    Recordings recordings;
    return problems_of(scene, recordings);
}

Problems problems_of(const scene::Scene& scene, Recordings& recordings) {
    Problems problems;
    if (!has_soil(scene)) return problems;  // the reader has already reported that
    check_geometry(scene, problems);
    if (scene.lem) check_stability(scene, problems);
    if (scene.fem) {
        check_stages(scene, problems);
        check_supports(scene, problems);
        check_water(scene, problems);
        check_motion(scene, recordings, problems);
    }
    check_soils(scene, problems);
    check_strengths(scene, problems);
    check_agreement(scene, problems);
    if (scene.transfer) check_transfer(scene, problems);
    if (scene.mpm) check_ground(scene, problems);
    return problems;
}

/// Drops unit warnings about small cells that suit the section: a model of 10 cm has cells of
/// millimetres.
static void drop_warnings_of_fitting_cells(scene::Scene& scene) {
    if (!scene.mpm || !has_soil(scene)) return;
    const double h = scene.mpm->cell_size, cells = scene::area_of_section(scene) / (h * h);
    constexpr double fewest = 50.0;
    if (cells < fewest || cells > scene::most_cells) return;
    std::erase_if(scene.warnings, [](const fault::Flag& each) {
        return each.code == "implausible" && each.pointer == "/mpm/cell_size";
    });
}

Checked checked_text(std::string_view text, const std::string& name,
                     const std::filesystem::path& folder,
                     const std::vector<std::string>& overrides) {
    return checked_document(scene::parse_json(text, name), name, folder, overrides);
}

Checked checked_document(nlohmann::json document, const std::string& name,
                         const std::filesystem::path& folder,
                         const std::vector<std::string>& overrides) {
    Recordings recordings;
    return checked_document(std::move(document), name, folder, overrides, recordings);
}

Checked checked_document(nlohmann::json document, const std::string& name,
                         const std::filesystem::path& folder,
                         const std::vector<std::string>& overrides, Recordings& recordings) {
    scene::Reading reading = scene::read_document(std::move(document), name, folder, overrides);
    drop_warnings_of_fitting_cells(reading.scene);
    Problems problems = problems_of(reading.scene, recordings);
    Checked checked{std::move(reading.scene), std::move(reading.faults),
                    std::move(reading.completed)};
    for (fault::Fault& each : problems.faults) checked.faults.push_back(std::move(each));
    for (fault::Flag& each : problems.warnings) checked.scene.warnings.push_back(std::move(each));
    return checked;
}

scene::Scene checked_scene(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides) {
    Checked checked =
        checked_text(scene::text_of(file), file.string(), file.parent_path(), overrides);
    if (!checked.faults.empty()) throw fault::BadInput(file.string(), std::move(checked.faults));
    return std::move(checked.scene);
}

}  // namespace breach::check
