// A FEM with open triggers and its data so far: telemetry, snapshots, and the stability analyses
// that they use.
#pragma once

#include <chrono>
#include <map>

#include "core/telemetry/lines.hpp"
#include "services/orchestrator/files/data_folder.hpp"
#include "services/orchestrator/files/folder_watch.hpp"
#include "services/orchestrator/files/frames.hpp"
#include "services/orchestrator/store/store.hpp"
#include "services/orchestrator/study/transfers.hpp"

namespace breach::orchestrator {

inline constexpr double snapshot_slack = 1e-6;  ///< names of snapshots carry six decimals [s]

struct WatchedFem;

/// A trigger being evaluated.
struct ArmedTrigger {
    explicit ArmedTrigger(const Trigger& stored);
    /// The number of a stability analysis that it needs and that is not known (yet); null: none.
    const StabilityField* lacks(const WatchedFem& fem) const;
    /// Evaluates the lines since the last call.
    void feed(const WatchedFem& fem);

    Trigger trigger;
    Work work;
    std::int64_t noticed_at = 0;  ///< when the service read the line that met it [ms since 1970]
    nlohmann::json crossed = nullptr;
    std::int64_t crossed_step = 0;
    std::size_t lines_taken = 0;  ///< of the FEM's telemetry

  private:
    void take(const WatchedFem& fem, const telemetry::Line& line);
    void note(const criteria::Expression& condition, const criteria::Line& crossing);
};

struct WatchedFem {
    WatchedFem(Task of, const Store& store, const DataFolder& data);
    /// Reads everything written since the last call.
    void read_on(const Store& store, FolderWatch& watches);
    /// Whether it was interrupted (full disk, killed, cancelled): it neither reached its end nor
    /// broke down, which is a result. A retry continues its output.
    bool was_cut_short() const;
    criteria::Line line_for(const criteria::Expression& condition,
                            const telemetry::Line& line) const;
    /// The first snapshot not before that time; null: none so far.
    const Frame* first_from(double wanted) const;
    void ask_for_snapshot();

    Task task;
    std::filesystem::path output;
    telemetry::Tail tail;
    int watch = -1;
    std::vector<telemetry::Line> lines = {};  ///< all so far, for triggers that come later
    std::vector<ArmedTrigger> armed = {};
    bool ended = false;
    bool regular;  ///< writes snapshots at an interval
    bool planned;  ///< the run stores the tasks of a firing of it
    std::vector<Frame> snapshots = {};
    std::chrono::steady_clock::time_point asked{};
    /// A stability analysis that a trigger needs.
    struct Stability {
        std::optional<nlohmann::json> result{};  ///< once it has ended; null: there is none
        std::string why_none = {};               ///< how it failed; empty: it has not
    };
    std::map<std::string_view, Stability> stability = {};  ///< by field
    std::string trouble = {};                              ///< why the last look was incomplete

  private:
    void look_for_stability(const Store& store, const StabilityField& field);
};

std::string how_it_ended(const Task& task);
/// The values on the line on which the condition became true, by name.
nlohmann::json crossing_of(const criteria::Expression& condition, const criteria::Line& line);
nlohmann::json crossing_of(const criteria::Criterion& criterion);

}  // namespace breach::orchestrator
