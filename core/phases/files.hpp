// File names of the phases: each is defined only here.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace breach::phases::files {

/// In every phase's output folder.
inline constexpr const char* scene = "scene.completed.json";
inline constexpr const char* result = "result.json";
inline constexpr const char* fault = "fault.json";  ///< instead of a result
inline constexpr const char* telemetry = "telemetry.jsonl";
inline constexpr const char* checkpoint = "checkpoint.h5";

inline constexpr const char* history = "history.h5";
inline constexpr const char* motion = "motion.csv";            ///< fem: the applied motion
inline constexpr const char* base_motion = "base_motion.csv";  ///< fem: motion of the free field
inline constexpr const char* particles = "particles.vtkhdf";   ///< transfer: the new points
inline constexpr const char* final_state = "final.vtkhdf";     ///< mpm
inline constexpr const char* envelope = "envelope.csv";        ///< mpm: envelope along x
/// to the fem: write a snapshot; in its output folder
inline constexpr const char* request = "snapshot_request";
inline constexpr const char* element_tests = "element_tests.h5";

inline constexpr const char* snapshot_extension = ".vtkhdf";
inline constexpr const char* snapshot_prefix = "snapshot_";  ///< fem
inline constexpr const char* frame_prefix = "particles_";    ///< mpm

/// Snapshots of the fem or frames of the mpm, for ParaView.
inline constexpr const char* series = "frames.vtkhdf.series";

/// "0.500000": a time in the names of snapshots and tasks.
std::string spelt(double time);
/// "snapshot_0.500000.vtkhdf", of the fem
std::string snapshot_name(double time);
/// "particles_0.500000.vtkhdf", of the mpm
std::string frame_name(double time);
/// 0.5 from "particles_0.500000.vtkhdf" with the prefix "particles_"; none if the name differs.
std::optional<double> time_in(std::string_view name, std::string_view prefix);

}  // namespace breach::phases::files
