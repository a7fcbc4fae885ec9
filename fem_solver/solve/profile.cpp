#include "fem_solver/solve/profile.hpp"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <sstream>
#include <utility>

namespace breach::fem {

double wall_clock() {
    const auto t = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(t).count();
}

std::string profile_text(const Seconds& seconds, double whole, const Work& work) {
    const std::pair<const char*, double> lines[] = {{"assembly", seconds.assembly},
                                                    {"law", seconds.law},
                                                    {"factor", seconds.factor},
                                                    {"solve", seconds.solve},
                                                    {"output", seconds.output},
                                                    {"other", whole - seconds.sum()},
                                                    {"whole", whole}};
    std::ostringstream text;
    text << std::fixed << "profile    CPU seconds  share\n";
    for (const auto& [kind, spent] : lines) {
        text << std::left << std::setw(10) << kind << std::right << std::setprecision(3)
             << std::setw(12) << spent << std::setprecision(1) << std::setw(5 + 1)
             << 100.0 * spent / whole << " %\n";
    }
    const auto steps = static_cast<double>(std::max<std::int64_t>(work.steps, 1));
    text << work.steps << " steps, " << work.iterations << " iterations, " << std::setprecision(6)
         << whole / steps << " s per step\n";
    return text.str();
}

}  // namespace breach::fem
