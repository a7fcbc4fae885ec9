// A study's variants: what it names itself, its repeats, and each one's scene, checked.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/check/recordings.hpp"
#include "services/orchestrator/study/draws.hpp"
#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

/// The study's scene with its own overrides: completed when it is sound, as it was sent otherwise.
struct Base {
    SentFiles files;
    nlohmann::json scene;
    std::vector<std::string> overrides;
    std::vector<fault::Fault> faults;   ///< of the scene itself: a variant does not repeat them
    std::vector<fault::Flag> warnings;  ///< likewise
    check::Recordings* recordings;      ///< read for one scene, known to the others
};

inline constexpr const char* kept_variants =
    "own_variants";  ///< of a study that all runs are draws of

/// Those that the study names itself; what the service made of it is made anew.
std::vector<VariantEntry> own_variants(const nlohmann::json& document);

/// Warns of an entry that one list of overrides sets twice to different values, and of variants with equal overrides.
void warn_about_overrides(const nlohmann::json& document, std::vector<fault::Flag>& warnings);

/// On as many lattices as the study asks for.
std::vector<VariantEntry> wanted_variants(const nlohmann::json& document, Reach reach,
                                          const nlohmann::json& scene,
                                          std::vector<fault::Fault>& faults);

nlohmann::json as_json(const std::vector<VariantEntry>& entries);

/// What is run, and beside it the study's own variants where none of them is run as it stands: what was
/// read of the study is read of it again.
void keep_variants(const std::vector<VariantEntry>& entries, nlohmann::json& document);

/// Each variant's scene, checked and completed; faults are those of its overrides.
std::vector<Variant> checked_variants(const std::vector<VariantEntry>& entries, const Base& base,
                                      const std::vector<double>& times,
                                      std::vector<fault::Fault>& faults,
                                      std::vector<fault::Flag>& warnings);

}  // namespace breach::orchestrator
