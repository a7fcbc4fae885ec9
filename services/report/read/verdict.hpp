// Arranges the verdict of services/findings for the report, and puts the end of each phase in
// words.
#pragma once

#include <string>
#include <vector>

#include "services/report/chart/chart.hpp"
#include "services/report/chart/document.hpp"
#include "services/report/read/run_folder.hpp"

namespace breach::report {

/// Whether the soil of a runout still moved at its end, so that its distances are lower bounds.
bool still_moves(const PhaseFolder& mpm);
/// Whether any still moved, so that their largest distance is a lower bound.
bool any_moves(const std::vector<const PhaseFolder*>& runouts);

/// Certainty of a runout's distances.
Certainty certainty_of(const PhaseFolder& mpm);

inline constexpr const char* at_least = "\u2265 ";
/// A distance of this runout as text, marked when it is a lower bound; "-" stays "-".
std::string bounded(const PhaseFolder& mpm, const std::string& distance);

/// "well", "well, with warnings: implausible", "questionable: still moving", "entangled at 6.7 s in
/// element 212 ...", or why there is no result.
std::string how_it_ended(const PhaseFolder& phase);
/// The same for several runouts: "well", "3 of 8 questionable: still moving"; "none" without any.
std::string how_they_ended(const std::vector<const PhaseFolder*>& runouts);

/// The entanglement of a FEM's mesh, in a sentence; empty when it did not entangle.
std::string entanglement_of(const PhaseFolder& fem);
/// The same for one; for several their number and times: "3 of 12 meshes entangled, from 4.1 to 9.8
/// s."
std::string entanglements_of(const std::vector<const PhaseFolder*>& fems);

/// For the head of the report: cautions first, in sentences.
Verdict verdict_of(const Run& run);

/// Every flag of every phase, one per row; no rows when there are none.
Table flag_table(const Run& run);

}  // namespace breach::report
