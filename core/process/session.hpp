// One execution of a phase: input, output folder, reporting, request to stop.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/exchange/provenance.hpp"
#include "core/fault/flag.hpp"
#include "core/process/series.hpp"
#include "core/scene/scene.hpp"

namespace breach::process {

enum class ProgressStyle { none, bar, json };
enum class Start { fresh, resume };

struct SessionSettings {
    std::string phase;
    std::filesystem::path output;
    std::vector<std::filesystem::path> inputs;
    std::vector<std::string> overrides;
    std::set<std::string> switches;  ///< given flags of the phase itself: "--profile"
    Start start = Start::fresh;
    int threads = 1;
    ProgressStyle progress = ProgressStyle::none;
};

class Session {
  public:
    Session(SessionSettings settings, scene::Scene scene);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const scene::Scene& scene() const { return scene_; }
    const SessionSettings& settings() const { return settings_; }
    const std::filesystem::path& input(std::size_t i = 0) const { return settings_.inputs.at(i); }
    std::filesystem::path output(const std::string& name) const { return settings_.output / name; }

    /// Provenance with the times spent so far.
    exchange::Provenance provenance() const;
    double wall_seconds() const;  ///< of this process
    static double cpu_seconds();  ///< of this process; 2 us per call
    /// Time of all processes of the run: this one and those that it continues.
    exchange::Spent spent() const;
    /// Call if the run continues from earlier results.
    void went_on_after(const exchange::Spent& earlier) { earlier_ = earlier; }
    /// Peak physical memory of the process [MB]; none if the system does not report it.
    std::optional<double> peak_memory() const;

    /// fraction in [0, 1]. Cheap: throttled to a few reports per second.
    void progress(double fraction, const std::string& message);

    /// Appends one JSON line to telemetry.jsonl and flushes. A resumed session first drops the
    /// lines after its checkpoint with truncate_telemetry.
    void telemetry(const nlohmann::json& line);
    /// Keeps the first `lines` complete lines; returns how many it kept.
    std::int64_t truncate_telemetry(std::int64_t lines);
    std::int64_t telemetry_lines() const { return telemetry_lines_; }

    /// Reports a new file (a snapshot) in the progress output: {"event":"artifact",...}.
    void announce(const std::filesystem::path& file, const nlohmann::json& what);
    /// Reports a new frame and adds it to the folder's series. name: as phases::files composes it;
    /// time [s], ascending.
    void announce_frame(const std::string& name, const std::string& prefix, double time);

    /// True after SIGINT or SIGTERM: save a checkpoint and return Outcome::stopped.
    bool stop_requested() const;

    /// Entries of result.json; run_phase writes it when the phase succeeds.
    nlohmann::json& result() { return result_; }

    /// Adds a flag to result.json and the log. The scene's warnings about this phase's parts are
    /// included from the start. A flag with the same code and pointer replaces the earlier one: a
    /// step that judges again must not list its flag twice.
    void flag(fault::Flag flag);
    const std::vector<fault::Flag>& flags() const { return flags_; }

  private:
    void emit(const nlohmann::json& line);

    SessionSettings settings_;
    scene::Scene scene_;
    std::vector<exchange::InputDigest> digests_;
    std::chrono::steady_clock::time_point began_;
    exchange::Spent earlier_;
    std::chrono::steady_clock::time_point shown_{};
    std::ofstream telemetry_;
    std::int64_t telemetry_lines_ = 0;
    nlohmann::json result_ = nlohmann::json::object();
    std::vector<fault::Flag> flags_;
    std::optional<Series> series_;
};

}  // namespace breach::process
