#include "services/orchestrator/study/budget.hpp"

#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"
#include "core/scene/schema.hpp"

namespace breach::orchestrator {

using nlohmann::json;

double checked_budget(const json& entry) {
    json document{{"budget", entry}};
    const json schema{
        {"type", "object"},
        {"properties", {{"budget", scene::study_schema().at("properties").at("budget")}}}};
    std::vector<fault::Fault> faults = scene::complete_and_check(document, schema, "study");
    if (!faults.empty()) throw fault::BadInput("study", std::move(faults));
    return entry.at("cpu_seconds").get<double>();
}

}  // namespace breach::orchestrator
