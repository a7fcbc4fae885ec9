#include <algorithm>
#include <optional>

#include "core/check/findings.hpp"
#include "core/check/section.hpp"
#include "core/motion/read_motion.hpp"

namespace breach::check {

namespace {

using motion::Quantity;
using motion::Recording;

constexpr const char* file_pointer = "/fem/motion/file";

std::optional<Recording> recording_of(const scene::BaseMotion& wanted, Findings& findings) {
    const std::string file = wanted.file.string();
    if (!std::filesystem::exists(wanted.file)) {
        refuse(findings, file_pointer, "does not exist: " + file,
               "give a path relative to the scene file, or the absolute path on the machine that "
               "computes");
        return std::nullopt;
    }
    try {
        if (std::filesystem::is_directory(wanted.file)) throw fault::IoError(file + " is a folder");
        return motion::read_motion(wanted.file);
    } catch (const fault::BadInput& error) {
        for (const fault::Fault& each : error.faults())
            refuse(findings, file_pointer, file + ", " + each.pointer + ": " + each.cause,
                   each.remedy);
    } catch (const fault::IoError& error) {
        refuse(findings, file_pointer, error.what(), "give a motion that can be read");
    }
    return std::nullopt;
}

/// What cannot be done with this kind of recording.
void check_kind(const scene::BaseMotion& wanted, Quantity quantity, Findings& findings) {
    if (quantity == Quantity::displacement)
        refuse(findings, file_pointer, "is a displacement",
               "give the acceleration or the velocity of the same motion");
    if (quantity != Quantity::velocity) return;
    if (wanted.scale_to_pga_g)
        refuse(findings, "/fem/motion/scale_to_pga_g",
               "scales an acceleration; the file holds a velocity",
               "give the acceleration, or leave the scale out");
    if (wanted.baseline == scene::Baseline::corrected)
        refuse(findings, "/fem/motion/baseline",
               "is corrected in an acceleration only; the file holds a velocity",
               "give the acceleration, or take it as recorded");
}

/// A motion that is none, and times in another unit.
bool check_samples(const motion::Series& series, Findings& findings) {
    const auto [low, high] = std::ranges::minmax(series.values);
    if (low == high) {
        refuse(
            findings, file_pointer,
            "holds " + std::to_string(series.values.size()) + " times the same value, " + text(low),
            "give a motion that moves: is the second column the right one?");
        return false;
    }
    constexpr double coarsest = 0.25, coarse = 0.05;
    if (series.dt > coarsest) {
        refuse(findings, file_pointer,
               "has one sample per " + text(series.dt) + " s and lasts " + text(series.duration()) +
                   " s",
               "times are in seconds: as milliseconds these would be " + text(1e-3 * series.dt) +
                   " s and " + text(1e-3 * series.duration()) + " s");
        return false;
    }
    if (series.dt > coarse)
        warn(findings, "implausible", file_pointer,
             "the motion has one sample per " + text(series.dt) +
                 " s: records have 0.0025 to 0.02 s; what shakes faster is lost");
    return true;
}

struct Range {
    double least, largest, most;  ///< plausible from, plausible to, possible up to
    const char* unit;
    double SI;  ///< of one unit
    const char* slip;
};

/// Peak ground motions ever recorded stay below `most`.
Range range_of(Quantity quantity) {
    if (quantity == Quantity::velocity)
        return {0.001, 2.5, 10.0, "m/s", 1.0, "are the values cm/s under another header?"};
    return {0.01,
            1.2,
            5.0,
            "g",
            motion::standard_gravity,
            "are the values m/s2 under a header of g, or the reverse (factor 9.81)?"};
}

void check_peak(const scene::BaseMotion& wanted, const Recording& recording, Findings& findings) {
    if (wanted.scale_to_pga_g) return;  // its own plausibility is the schema's
    const Range range = range_of(recording.quantity);
    const double peak = motion::peak(recording.series) / range.SI;
    const std::string cause = "the motion's peak is " + text(peak) + " " + range.unit;
    if (peak > range.most)
        refuse(findings, file_pointer,
               "has a peak of " + text(peak) + " " + range.unit + "; none above " +
                   text(range.most) + " " + range.unit + " is known",
               range.slip);
    else if (peak > range.largest || peak < range.least)
        warn(findings, "implausible", file_pointer,
             cause + ", usual are " + text(range.least) + " to " + text(range.largest) + ": " +
                 range.slip);
}

double dynamic_duration(const scene::Fem& fem) {
    double sum = 0.0;
    for (const scene::Stage& stage : fem.stages) sum += stage.duration;
    return sum;
}

/// The stages against the motion's length and step.
void check_stages_against(const scene::Fem& fem, const motion::Series& acceleration,
                          Findings& findings) {
    const double end = dynamic_duration(fem);
    motion::Series felt = acceleration;
    felt.values.resize(std::min(felt.values.size(), static_cast<std::size_t>(end / felt.dt) + 1));
    const double whole = motion::arias_intensity(acceleration);
    const double share = felt.values.size() < 2 ? 0.0 : motion::arias_intensity(felt) / whole;
    if (share < 0.5)
        warn(findings, "motion_cut", "/fem/stages",
             "the dynamic stages end at " + text(end) + " s, when " + text(100.0 * share) +
                 " % of the motion's Arias intensity have arrived; its strong part lasts until " +
                 text(motion::strong_part(acceleration).end) + " s: lengthen the last stage");
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        const scene::Stage& stage = fem.stages[i];
        if (stage.kind != scene::StageKind::dynamic || stage.time_step <= 2.0 * acceleration.dt)
            continue;
        warn(findings, "coarse_step", "/fem/stages/" + std::to_string(i) + "/time_step",
             "steps of " + text(stage.time_step) + " s pass over samples of the motion, one per " +
                 text(acceleration.dt) + " s: give at most that");
    }
}

void check_drift(const motion::Series& acceleration, Findings& findings) {
    constexpr double much = 0.05;  // of the peak velocity
    const motion::Baseline left = motion::baseline(acceleration);
    if (left.velocity_share <= much) return;
    warn(findings, "drift", "/fem/motion/baseline",
         text(left.last_velocity) + " m/s are left at the motion's end (" +
             text(100.0 * left.velocity_share) +
             " % of its peak velocity); \"baseline\": \"corrected\" takes them off");
}

}  // namespace

void check_motion(const scene::Scene& scene, Findings& findings) {
    const scene::Fem& fem = *scene.fem;
    if (!fem.motion) return;
    if (dynamic_duration(fem) == 0.0)
        refuse(findings, "/fem/motion", "has no dynamic stage in which it could shake",
               "add a stage of type \"dynamic\", or leave the motion out");
    const auto recording = recording_of(*fem.motion, findings);
    if (!recording) return;
    check_kind(*fem.motion, recording->quantity, findings);
    if (!check_samples(recording->series, findings)) return;
    check_peak(*fem.motion, *recording, findings);
    if (recording->quantity != Quantity::acceleration) return;
    check_stages_against(fem, recording->series, findings);
    if (fem.motion->baseline == scene::Baseline::as_recorded)
        check_drift(recording->series, findings);
}

}  // namespace breach::check
