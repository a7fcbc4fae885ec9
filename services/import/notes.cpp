#include "core/words/list.hpp"
#include "services/import/steps.hpp"

namespace breach::importing {

void Notes::ask_to_confirm(const std::string& pointer, const std::string& cause,
                           const std::string& remedy) {
    if (request.confirmed) return remark(cause + ": confirmed");
    result.to_confirm.push_back(
        {pointer, cause, remedy + "; or confirm it with --yes (\"confirmed\": true in a request)"});
}

void Notes::add(const std::vector<Fault>& faults) {
    result.faults.insert(result.faults.end(), faults.begin(), faults.end());
}

void Notes::add(const std::vector<Change>& changes) {
    for (const Change& each : changes)
        result.report["healed"].push_back({{"kind", each.kind},
                                           {"regions", each.regions},
                                           {"at", as_json(each.at)},
                                           {"size", each.size}});
}

void Notes::add(const Drawing& drawing) {
    add(drawing.faults);
    for (const std::string& each : drawing.remarks) remark(each);
}

std::string layers_named(const std::set<std::string>& names) {
    return names.empty() ? "none" : as_utf8(std::string_view(words::list_of(names)).substr(0, 400));
}

}  // namespace breach::importing
