// A plan as text, for --plan and for the log of each run.
#include "core/process/plan.hpp"

#include <algorithm>

namespace breach::process {

PlanLine line_of(const std::string& feature, Use use, const Reasons& reasons,
                 const std::string& pointer) {
    return {feature, use, use == Use::on ? reasons.on : reasons.left_out, pointer};
}

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
