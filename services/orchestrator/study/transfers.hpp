// When a study transfers: its times, and the triggers that watch its FEM.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/scene/scene.hpp"
#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

/// Length of the shaking and failure [s]: the clock of snapshots starts with the first dynamic stage.
double dynamic_duration(const scene::Fem& fem);
/// A time after the FEM's end.
bool is_late(double time, const scene::Fem& fem);
void check_times(const std::vector<double>& times, const scene::Fem& fem,
                 std::vector<fault::Fault>& faults);

/// Lines of /transfer/liquefied that no transfer time uses; triggers choose their own times.
void check_lines(const scene::Scene& scene, const Study& study, std::vector<fault::Fault>& faults);

/// Times, triggers and the snapshots that they need. fem: null: it could not be read, and nothing is too late.
void read_transfers(const nlohmann::json& document, const scene::Fem* fem, Study& study,
                    std::vector<fault::Fault>& faults);

/// Conditions on what this run's telemetry never holds.
void check_fields(const nlohmann::json& triggers, const scene::Scene& scene, bool stability,
                  std::vector<fault::Fault>& faults);

}  // namespace breach::orchestrator
