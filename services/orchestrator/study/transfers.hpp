// The transfers of a study: its times, and the triggers that watch its FEM.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

#include "core/phases/phases.hpp"
#include "core/scene/scene.hpp"
#include "services/orchestrator/study/study.hpp"

namespace breach::orchestrator {

inline constexpr std::string_view critical_depth_field = "critical_depth";
inline constexpr std::string_view post_seismic_field = "post_seismic_factor";
/// A number in conditions that a stability analysis gives, and its phase.
struct StabilityField {
    std::string_view name;
    const char* phase;
};
inline constexpr std::array stability_fields{
    StabilityField{critical_depth_field, phases::lem.program},
    StabilityField{post_seismic_field, phases::post_seismic.program}};

/// Whether the time is after the FEM's end; times count from the start of the first dynamic stage.
bool is_late(double time, const scene::Fem& fem);
void check_times(const std::vector<double>& times, const scene::Fem& fem,
                 std::vector<fault::Fault>& faults);

/// Faults of lines of /transfer/liquefied that no transfer time uses; triggers choose their own
/// times.
void check_lines(const scene::Scene& scene, const Study& study, std::vector<fault::Fault>& faults);

/// Reads times, triggers and their snapshots. fem: null: unreadable; then no time is too late.
void read_transfers(const nlohmann::json& document, const scene::Fem* fem, Study& study,
                    std::vector<fault::Fault>& faults);

/// Faults of conditions on fields that this run's telemetry does not have.
void check_fields(const nlohmann::json& triggers, const scene::Scene& scene, bool stability,
                  bool post_seismic, std::vector<fault::Fault>& faults);

}  // namespace breach::orchestrator
