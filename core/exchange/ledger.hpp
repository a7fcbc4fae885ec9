// What a transfer conserved and lost: one row per region and quantity, stored in the particle file.
#pragma once

#include <string>
#include <vector>

namespace breach::exchange {

struct LedgerRow {
    std::string region;    ///< region name, or "total"
    std::string quantity;  ///< "mass", "momentum x", ...
    std::string unit;      ///< of before and after
    double before;         ///< on the mesh
    double after;          ///< on the points
    double difference;     ///< (after - before) relative to the quantity's own scale [-]
};

using Ledger = std::vector<LedgerRow>;

}  // namespace breach::exchange
