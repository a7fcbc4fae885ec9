// A sweep's results as an HDF5 file: one array per column, for h5py and MATLAB.
#pragma once

#include "services/orchestrator/files/frames.hpp"
#include "services/orchestrator/records/records.hpp"

namespace breach::orchestrator {

/// The bytes of the file. Numbers that are not known are NaN; columns of text are one text with a
/// line per row. `scratch`: a folder for the time of the writing. Throws IoError.
std::string as_hdf5(const std::vector<SweepRow>& rows, const std::string& run,
                    const std::string& scene, FrameReader& hdf5,
                    const std::filesystem::path& scratch);

}  // namespace breach::orchestrator
