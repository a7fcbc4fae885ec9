// What the steps of an import say. Faults come from all readers and checks in one form; only what
// looks like a mistake, but may be meant, passes through ask_to_confirm().
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

/// In the order of the changes: lines_of() shows the first ones only.
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

/// A CAD file may have hundreds of layers; the message is cut, as_utf8() keeps it valid.
std::string layers_named(const std::set<std::string>& names) {
    return names.empty() ? "none" : as_utf8(std::string_view(words::list_of(names)).substr(0, 400));
}

}  // namespace breach::importing
