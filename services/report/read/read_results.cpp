#include "services/report/read/read_results.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/fault/fault.hpp"

namespace breach::report {

nlohmann::json read_json(const std::filesystem::path& path) {
    std::ifstream stream(path);
    if (!stream) throw fault::IoError(path.string() + ": cannot be read; give a phase's output");
    try {
        return nlohmann::json::parse(stream);
    } catch (const nlohmann::json::exception& error) {
        throw fault::BadInput(path.string(), {{"", error.what(), "run the phase again"}});
    }
}

}  // namespace breach::report
