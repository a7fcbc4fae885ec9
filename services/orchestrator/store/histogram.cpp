// Text for Prometheus. Its buckets are cumulative, ours are not: hence the running sum.
#include "services/orchestrator/store/histogram.hpp"

#include <sstream>

namespace breach::orchestrator {

std::string Histogram::as_text(const std::string& name, const std::string& help) const {
    std::ostringstream text;
    text << "# HELP " << name << " " << help << "\n# TYPE " << name << " histogram\n";
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
        below += counts_[i];
        text << name << "_bucket{le=\"" << bounds_[i] << "\"} " << below << "\n";
    }
    below += counts_.back();
    text << name << "_bucket{le=\"+Inf\"} " << below << "\n"
         << name << "_sum " << sum_.load() << "\n"
         << name << "_count " << below << "\n";
    return text.str();
}

}  // namespace breach::orchestrator
