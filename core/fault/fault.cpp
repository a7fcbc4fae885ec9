#include "core/fault/fault.hpp"

namespace breach::fault {

namespace {

std::string list_all(const std::string& file, const std::vector<Fault>& faults) {
    std::string text =
        file + ": " + std::to_string(faults.size()) + (faults.size() == 1 ? " fault" : " faults");
    for (const Fault& each : faults) {
        text += "\n  " + (each.pointer.empty() ? "/" : each.pointer) + ": " + each.cause;
        if (!each.remedy.empty()) text += "\n      remedy: " + each.remedy;
    }
    return text;
}

}  // namespace

BadInput::BadInput(std::string file, std::vector<Fault> faults)
    : std::runtime_error(list_all(file, faults)),
      file_(std::move(file)),
      faults_(std::move(faults)) {}

}  // namespace breach::fault
