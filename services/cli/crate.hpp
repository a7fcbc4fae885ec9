// RO-Crate 1.1 metadata of an exported run (profile "Process Run Crate" 0.5): which program made
// which file, when, from which inputs. Builds a JSON document; touches no file.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace breach::cli {

struct CrateFile {
    std::string path;  ///< below the crate's folder, '/' between parts
    std::string description;
    std::int64_t bytes;
    std::string sha256;
};

class Crate {
  public:
    void add_file(const CrateFile& file);
    /// Adds a task as the action that made `outputs` (paths of files added before). `provenance`:
    /// from its result.json, or null; its inputs are found among the files by their hash. A task
    /// that was never started is left out.
    void add_action(const nlohmann::json& task, const nlohmann::json& provenance,
                    const std::vector<std::string>& outputs);

    /// The document ro-crate-metadata.json.
    nlohmann::json metadata(const nlohmann::json& run) const;

  private:
    nlohmann::json inputs_of(const nlohmann::json& provenance) const;
    std::string program_of(const std::string& phase, const std::string& version);

    std::map<std::string, std::string> first_with_hash_;
    nlohmann::json files_ = nlohmann::json::array();
    nlohmann::json actions_ = nlohmann::json::array();
    nlohmann::json programs_ = nlohmann::json::array();
};

}  // namespace breach::cli
