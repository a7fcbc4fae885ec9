#include "mpm_solver/measure/history.hpp"

#include <string>

namespace breach::mpm {

void store(const History& history, const std::string& prefix, exchange::Archive& archive) {
    // Columns exist without rows, too: a checkpoint may come before the first measurement.
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

}  // namespace breach::mpm
