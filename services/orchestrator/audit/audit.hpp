// Checks that the database and the files agree, for `breachline check`. `audited` reads everything
// and changes nothing; `mend` repairs faults that can be repaired without loss.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/orchestrator/files/damage.hpp"
#include "services/orchestrator/files/data_folder.hpp"

namespace breach::orchestrator {

/// One inconsistency.
struct Inconsistency {
    std::string part;    ///< "database", "counts", "output", "file", "stray"
    std::string where;   ///< a path, or a name in the database
    std::string cause;   ///< "is missing"
    std::string remedy;  ///< what a person can do
    bool mendable = false;
};

struct Audit {
    std::int64_t version = 0;  ///< of the database
    std::int64_t runs = 0;
    std::int64_t tasks = 0;
    std::int64_t events = 0;
    std::int64_t outputs = 0;  ///< outputs of ended tasks
    std::int64_t files = 0;    ///< files that were sent
    bool in_service =
        false;  ///< a service uses the folder: stray files younger than a minute are skipped
    std::vector<Inconsistency> inconsistencies;
};

/// Reads one state of the database, also while a service works on it. Throws BadInput when there is
/// no database, StoreError when it cannot be read.
Audit audited(const DataPaths& data, Look look);
/// The lock of the folder proves that no service runs: nothing is skipped.
Audit audited(const DataFolder& data, Look look);

/// Moves files that belong to no run to <data>/strays/ and recounts the tasks of each run.
void mend(const DataFolder& data, const std::vector<Inconsistency>& inconsistencies);

}  // namespace breach::orchestrator
