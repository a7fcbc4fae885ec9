// The plan: for each feature whether it is on, why, and the scene entry that decides it. A phase
// makes it before its first step from the reduced scene; --plan prints it, the log and result.json
// keep it.
#pragma once

#include <string>
#include <vector>

namespace breach::process {

enum class Use { on, left_out };

struct PlanLine {
    std::string feature;  ///< "pore pressure"
    Use use;
    std::string reason;   ///< "no region lies below water"
    std::string pointer;  ///< JSON pointer of the scene entry that decides
};

using Plan = std::vector<PlanLine>;

/// A plan line with the reason for the decision.
struct Reasons {
    std::string on, left_out;
};
PlanLine line_of(const std::string& feature, Use use, const Reasons& reasons,
                 const std::string& pointer);
inline Use use_if(bool on) { return on ? Use::on : Use::left_out; }

/// A decision and its line in the plan: the phase uses the value, the plan prints the line.
template <class Value>
struct Decided {
    Value value;
    PlanLine line;
};

/// Aligned text.
std::string as_text(const Plan& plan);

}  // namespace breach::process
