// A sweep's results as an HDF5 file: one array per column, for h5py and MATLAB. The layout of
// core/exchange/archive.hpp.
#pragma once

#include "services/orchestrator/files/frames.hpp"
#include "services/orchestrator/records/result_columns.hpp"

namespace breach::orchestrator {

/// The bytes of the file. Unknown numbers are NaN; yes and no are 1 and 0, unknown is -1; a column
/// of text is one text with a line per row. `scratch`: folder for temporary files. Throws IoError.
std::string as_hdf5(const ResultTable& table, const std::string& run, const std::string& scene,
                    FrameReader& hdf5, const std::filesystem::path& scratch);

}  // namespace breach::orchestrator
