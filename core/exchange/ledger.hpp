// What a transfer conserved and lost: one row per region and quantity. transfer_tool computes it
// from mesh and points and stores it in the particle file, beside the numbers that it is about.
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
