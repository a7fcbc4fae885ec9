// Flags as result.json and the FEM's checkpoints hold them. The FEM reads them back when it
// resumes, so that a flag raised before a kill is not lost. The service has a reader of its own
// (findings/flags.hpp), which also takes flags without a pointer.
#include "core/process/flags.hpp"

#include <nlohmann/json.hpp>

namespace breach::process {

using nlohmann::json;

json as_json(const std::vector<fault::Flag>& flags) {
    json list = json::array();
    for (const fault::Flag& each : flags) {
        list.push_back({{"code", each.code},
                        {"severity", fault::name_of(each.severity)},
                        {"message", each.message},
                        {"pointer", each.pointer}});
    }
    return list;
}

std::vector<fault::Flag> flags_from(const json& list) {
    using fault::Severity;
    std::vector<fault::Flag> flags;
    for (const json& each : list) {
        const bool questionable = each.at("severity") == name_of(Severity::questionable);
        flags.push_back({each.at("code"), questionable ? Severity::questionable : Severity::warning,
                         each.at("message"), each.at("pointer")});
    }
    return flags;
}

}  // namespace breach::process
