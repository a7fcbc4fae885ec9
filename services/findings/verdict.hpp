// Judges whether the results of a run can be used, with reasons in sentences, the worst first. The
// store collects the facts (store/run_facts.cpp), also for folders of phases that were run by hand.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/fault/flag.hpp"

namespace breach::findings {

/// One flag of one phase, with the number of results that have it.
struct Raised {
    fault::Flag flag;  ///< of the first such result
    std::string phase;
    std::int64_t results = 1;
    std::int64_t of_results = 1;  ///< results of the phase in all
    std::string first = {};       ///< label of the first such result
};

/// Stability analyses with a factor of safety below 1 before any layer liquefies.
struct Unstable {
    std::int64_t analyses;
    std::int64_t of_analyses;
    double least;
    std::string variant;  ///< with the least factor; empty: the scene itself
};

/// A variant with a FEM that ended before all its transfer times, or without a trigger that fired.
struct NoTransfer {
    std::string variant;
    bool stood;  ///< the FEM ended without a failure
    std::string reason;
    std::string pointer = "/triggers";  ///< entry that requested a transfer
};

/// Transfers before the liquefied zone had most of its final depth (milestone "liquefied").
struct Early {
    std::int64_t transfers;
    std::int64_t of_transfers;
    double first;         ///< transfer time of the first of them [s]
    double liquefied_at;  ///< time of the milestone [s]
};

/// Tasks without a result.
struct Broken {
    std::string phase;
    std::int64_t results;
    std::int64_t of_results;
    std::string why;  ///< of the first
};

struct Facts {
    std::string state;                        ///< of the run
    std::vector<fault::Flag> submitted = {};  ///< warnings of the submission
    std::vector<Raised> raised = {};
    std::optional<Unstable> unstable =
        {};  ///< nothing: for samples, or a section that is known to have failed
    std::vector<NoTransfer> without_transfer = {};
    bool has_runout = false;
    std::optional<Early> early = {};
    std::vector<Broken> broken = {};
    std::vector<std::vector<std::string>> same_results = {};  ///< groups of variants
};

/// From the best to the worst; a verdict is the worst that any of its reasons allows. not_finished
/// and in_part may still improve: the run goes on, or a retry repeats its failed tasks.
enum class Usable { yes, with_remarks, not_finished, in_part, questionable, no };
/// "yes", "with_remarks", ...
const char* name_of(Usable usable);
/// For people: "usable", "not usable", ...
const char* phrase_of(Usable usable);

struct Reason {
    Usable usable;      ///< the best verdict that it allows
    std::string code;   ///< a flag's code, or does_not_stand, early_transfer, no_transfer, ...
    std::string brief;  ///< "7 of 8 runouts still moving: lower bounds"
    std::string text;   ///< one or two sentences
    std::string pointer = {};
    std::int64_t count = 1;  ///< number of results, analyses or variants
};

struct Verdict {
    Usable usable = Usable::yes;
    std::vector<Reason> reasons = {};  ///< worst first
};

Verdict verdict_of(const Facts& facts);

/// Why a run is less than usable, in one line; empty: usable.
std::string line_of(const Verdict& verdict);

/// {"usable", "words", "reasons": [{"usable", "code", "brief", "text", "pointer", "count"}]}
nlohmann::json as_json(const Verdict& verdict);

}  // namespace breach::findings
