#include "core/process/plan.hpp"

#include <algorithm>

namespace breach::process {

std::string as_text(const Plan& plan) {
    std::size_t width = 0;
    for (const PlanLine& line : plan) width = std::max(width, line.feature.size());
    std::string text;
    for (const PlanLine& line : plan) {
        text += line.use == Use::on ? "on        " : "left out  ";
        text += line.feature + std::string(width - line.feature.size() + 2, ' ') + line.reason;
        text += "  (" + (line.pointer.empty() ? "/" : line.pointer) + ")\n";
    }
    return text;
}

}  // namespace breach::process
