// Whether the database, its history and the files still say the same. Looks at everything and changes
// nothing; what can be mended without loss, `mend` mends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "services/orchestrator/files/damage.hpp"
#include "services/orchestrator/files/data_folder.hpp"

namespace breach::orchestrator {

/// Something that is not as it must be.
struct Finding {
    std::string part;    ///< "database", "history", "counts", "output", "file", "stray"
    std::string where;   ///< a path, or what the database calls it
    std::string cause;   ///< "is missing"
    std::string remedy;  ///< what a person can do
    bool mendable = false;
};

struct Audit {
    std::int64_t version = 0;  ///< of the database
    std::int64_t runs = 0;
    std::int64_t tasks = 0;
    std::int64_t events = 0;
    std::int64_t outputs = 0;  ///< files that ended tasks have given
    std::int64_t files = 0;    ///< that were sent
    bool in_service =
        false;  ///< a service has the folder: what is younger than a minute is passed over
    std::vector<Finding> findings;
};

/// Reads one state of the database, also while a service works on it. Throws BadInput when there is
/// none, StoreError when it cannot be read at all.
Audit audited(const DataPaths& data, Look look);
/// The lock of the folder is proof that no service runs: nothing is passed over.
Audit audited(const DataFolder& data, Look look);

/// Moves what no run knows to <data>/strays/ and counts the tasks of each run anew.
void mend(const DataFolder& data, const std::vector<Finding>& findings);

}  // namespace breach::orchestrator
