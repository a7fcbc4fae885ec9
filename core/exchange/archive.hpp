// Named arrays in one HDF5 file: checkpoints and histories. Not for ParaView; the layout belongs to
// the phase.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/exchange/provenance.hpp"

namespace breach::exchange {

struct Archive {
    std::string kind;  ///< "fem_checkpoint", "mpm_history", ...; checked on reading
    int version = 1;
    std::map<std::string, std::vector<double>> reals;
    std::map<std::string, std::vector<std::int64_t>> integers;
    std::map<std::string, std::string> texts;
    std::map<std::string, std::string> units;  ///< of an array, by its name; optional
    Spent spent = {};                          ///< computing time that went into the file, as read
};

void write_archive(const std::filesystem::path& path, const Archive& archive,
                   const Provenance& provenance);

/// Which reals an archive may contain.
enum class Reals {
    any,     ///< NaN marks a table entry without a value
    finite,  ///< refuse non-finite numbers: a state to resume from
};

/// Throws BadInput if the kind or version differs, an array is damaged or a real is not allowed;
/// IoError if the file cannot be opened.
Archive read_archive(const std::filesystem::path& path, const std::string& kind, int version,
                     Reals may_be = Reals::any);

}  // namespace breach::exchange
