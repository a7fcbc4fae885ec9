// Plans of tasks as JSON, for the firing plan that the store keeps with a run until a trigger
// fires.
#include "core/phases/phases.hpp"
#include "core/words/words.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/records/or_null.hpp"
#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

using nlohmann::json;

static constexpr auto words_of(Release) {
    using enum Release;
    return words::in_order<Release>({{at_once, "at_once"},
                                     {file_exists, "file_exists"},
                                     {parent_succeeded, "parent_succeeded"}});
}

namespace {

template <class T>
std::optional<T> unless_null(const json& value) {
    if (value.is_null()) return std::nullopt;
    return value.get<T>();
}

}  // namespace

std::string_view name_of(Release release) { return words::name_of(release); }

Release release_named(std::string_view name) { return words::named<Release>(name); }

/// Also the name of the task's folder, and read back by phase_folders.cpp.
std::string label_of(const TaskPlan& task) {
    const phases::Phase* known = phases::named(task.phase);
    std::string label = known ? known->part : task.phase;
    if (task.transfer_time) label += "_" + spelt(*task.transfer_time);
    if (!task.variant.empty()) label += "_" + task.variant;
    return label;
}

void to_json(json& document, const TaskPlan& task) {
    document = {{"phase", task.phase},
                {"label", task.label},
                {"transfer_time", or_null(task.transfer_time)},
                {"parent", or_null(task.parent)},
                {"release", name_of(task.release)},
                {"input", task.input},
                {"overrides", task.overrides},
                {"variant", task.variant},
                {"cores", task.resources.cores},
                {"memory_MB", task.resources.memory_mb},
                {"recipe", task.recipe}};
}

void from_json(const json& document, TaskPlan& task) {
    task = {.phase = document.at("phase"),
            .label = document.at("label"),
            .transfer_time = unless_null<double>(document.at("transfer_time")),
            .parent = unless_null<std::size_t>(document.at("parent")),
            .release = release_named(document.at("release").get<std::string>()),
            .input = document.at("input"),
            .overrides = document.at("overrides"),
            .variant = document.at("variant"),
            .resources = {.cores = document.at("cores"), .memory_mb = document.at("memory_MB")},
            .recipe = document.at("recipe")};
}

}  // namespace breach::orchestrator
