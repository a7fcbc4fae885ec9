// Text below the plan of --plan --measure, for people who weigh a feature or a resolution. The
// service does not read it: its estimates come from rates (services/estimate).
#include "core/process/cost.hpp"

#include <algorithm>
#include <cstdio>

namespace breach::process {

namespace {

std::string line(const std::string& what, const char* format, double value) {
    char text[120];
    std::snprintf(text, sizeof text, format, what.c_str(), value);
    return text;
}

}  // namespace

std::string as_text(const Cost& cost) {
    std::string text;
    for (const auto& [what, count] : cost.counts)
        text += line(what, "cost      %-34s%14.0f\n", static_cast<double>(count));
    for (const auto& [what, bytes] : cost.memory)
        text += line("memory: " + what, "cost      %-34s%14.0f bytes\n", bytes);
    double all = 0.0;
    for (const auto& [kind, spent] : cost.seconds) all += spent;
    // A FEM without a dynamic stage has counts and memory, but no step to divide by.
    if (cost.steps == 0 || all <= 0.0) return text + "cost      no step was taken\n";
    const auto steps = static_cast<double>(cost.steps);
    text += line("one step, of " + std::to_string(cost.steps) + " tried",
                 "cost      %-34s%14.3g s\n", all / steps);
    for (const auto& [kind, spent] : cost.seconds)
        text += line("  " + kind, "cost      %-34s%14.1f %%\n", 100.0 * spent / all);
    return text;
}

}  // namespace breach::process
