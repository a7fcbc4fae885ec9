#include "mpm_solver/measure/history.hpp"

#include <cmath>
#include <string>

namespace breach::mpm {

void store(const History& history, const std::string& prefix, exchange::Archive& archive) {
    const Row blank;
    for_each_column(blank, [&](const char* name, const char* unit, double) {
        archive.reals[prefix + name].reserve(history.size());
        archive.units[prefix + name] = unit;
    });
    for (const Row& row : history) {
        for_each_column(row, [&](const char* name, const char*, double value) {
            archive.reals[prefix + name].push_back(value);
        });
    }
}

History load(const exchange::Archive& archive, const std::string& prefix) {
    History history(archive.reals.at(prefix + "time").size());
    for (std::size_t k = 0; k < history.size(); ++k) {
        for_each_column(history[k], [&](const char* name, const char*, double& value) {
            value = archive.reals.at(prefix + name).at(k);
        });
    }
    return history;
}

bool at_rest(const History& history, const scene::Mpm& mpm) {
    if (history.empty()) return false;
    const Row& now = history.back();
    const double from = now.time - mpm.rest_window;
    if (now.time < mpm.rest_earliest || from < history.front().time) return false;
    for (auto row = history.rbegin(); row != history.rend(); ++row) {
        if (std::abs(row->runout - now.runout) > mpm.rest_change ||
            std::abs(row->runout_beyond_toe - now.runout_beyond_toe) > mpm.rest_change) {
            return false;
        }
        if (row->time <= from) break;
    }
    return true;
}

}  // namespace breach::mpm
