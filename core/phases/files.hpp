// The file names of the phases, by which they find each other's files: each name is defined here
// and nowhere else.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace breach::phases::files {

/// Files that every phase leaves in its output folder.
inline constexpr const char* scene = "scene.completed.json";
inline constexpr const char* result = "result.json";
inline constexpr const char* fault = "fault.json";  ///< instead of a result
inline constexpr const char* telemetry = "telemetry.jsonl";
inline constexpr const char* checkpoint = "checkpoint.h5";

inline constexpr const char* history = "history.h5";
inline constexpr const char* motion = "motion.csv";            ///< fem: as it is applied
inline constexpr const char* base_motion = "base_motion.csv";  ///< fem: of the free ground
inline constexpr const char* particles = "particles.vtkhdf";   ///< transfer: the new points
inline constexpr const char* final_state = "final.vtkhdf";     ///< mpm
inline constexpr const char* envelope = "envelope.csv";        ///< mpm: over x
inline constexpr const char* request = "snapshot_request";     ///< to the fem, in its output
inline constexpr const char* element_tests = "element_tests.h5";

inline constexpr const char* snapshot_extension = ".vtkhdf";
inline constexpr const char* snapshot_prefix = "snapshot_";  ///< of the fem
inline constexpr const char* frame_prefix = "particles_";    ///< of the mpm

/// The fem's snapshots or the mpm's frames, for ParaView.
inline constexpr const char* series = "frames.vtkhdf.series";

/// "0.500000": a time as the names of snapshots and tasks contain it.
std::string spelt(double time);
/// "snapshot_0.500000.vtkhdf", of the fem
std::string snapshot_name(double time);
/// "particles_0.500000.vtkhdf", of the mpm
std::string frame_name(double time);
/// 0.5 in "particles_0.500000.vtkhdf" with the prefix "particles_"; nothing: no such name.
std::optional<double> time_in(std::string_view name, std::string_view prefix);

}  // namespace breach::phases::files
