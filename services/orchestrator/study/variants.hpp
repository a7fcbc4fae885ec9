// A study's variants: its own, its repeats, and each one's checked scene.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/check/recordings.hpp"
#include "services/orchestrator/study/draws.hpp"
#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

/// The study's scene with its own overrides: completed when it is valid, otherwise unchanged.
struct Base {
    SentFiles files;
    nlohmann::json scene;
    std::vector<std::string> overrides;
    std::vector<fault::Fault> faults;   ///< of the scene itself; variants do not repeat them
    std::vector<fault::Flag> warnings;  ///< likewise
    check::Recordings* recordings;      ///< cache of motions, shared by the variants
};

/// The variants that the study itself defines; generated variants are derived again.
std::vector<VariantEntry> own_variants(const nlohmann::json& document);

/// Warns of an entry that one list of overrides sets to two different values, and of variants with
/// equal overrides.
void warn_about_overrides(const nlohmann::json& document, std::vector<fault::Flag>& warnings);

/// With as many lattices as the study requests.
std::vector<VariantEntry> wanted_variants(const nlohmann::json& document, Reach reach,
                                          const nlohmann::json& scene,
                                          std::vector<fault::Fault>& faults);

nlohmann::json as_json(const std::vector<VariantEntry>& entries);

/// Stores the variants that are run, generated ones with "made_by", so that reading the study again
/// gives the same variants.
void keep_variants(const std::vector<VariantEntry>& entries, nlohmann::json& document);

/// Each variant's scene, checked and completed; faults are those of its overrides.
std::vector<Variant> checked_variants(const std::vector<VariantEntry>& entries, const Base& base,
                                      const std::vector<double>& times,
                                      std::vector<fault::Fault>& faults,
                                      std::vector<fault::Flag>& warnings);

}  // namespace breach::orchestrator
