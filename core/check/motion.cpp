#include <algorithm>
#include <cmath>
#include <optional>

#include "core/check/applied_motion.hpp"
#include "core/check/recordings.hpp"
#include "core/check/section.hpp"
#include "core/check/subjects.hpp"
#include "core/motion/plausibility.hpp"
#include "core/words/remedy.hpp"

namespace breach::check {

namespace {

using motion::Quantity;
using motion::Recording;

constexpr const char* file_pointer = "/fem/motion/file";

std::optional<Recording> recording_of(const scene::BaseMotion& wanted, Recordings& recordings,
                                      Problems& problems) {
    const std::string file = wanted.file.string();
    std::error_code ignored;  // an overlong path counts as missing
    if (!std::filesystem::exists(wanted.file, ignored)) {
        refuse(problems, file_pointer, "does not exist: " + file,
               "give a path relative to the scene file, or the absolute path on the machine that "
               "computes");
        return std::nullopt;
    }
    try {
        if (std::filesystem::is_directory(wanted.file, ignored))
            throw fault::IoError(file + " is a folder");
        return recordings.of(wanted.file);
    } catch (const fault::BadInput& error) {
        for (const fault::Fault& each : error.faults())
            refuse(problems, file_pointer, file + ", " + each.pointer + ": " + each.cause,
                   each.remedy);
    } catch (const fault::IoError& error) {
        refuse(problems, file_pointer, error.what(), "give a motion that can be read");
    }
    return std::nullopt;
}

/// Refuses operations that this kind of recording does not allow.
void check_kind(const scene::BaseMotion& wanted, Quantity quantity, Problems& problems) {
    if (quantity == Quantity::displacement)
        refuse(problems, file_pointer, "is a displacement",
               "give the acceleration or the velocity of the same motion");
    if (quantity != Quantity::velocity) return;
    if (wanted.scale_to_pga_g)
        refuse(problems, "/fem/motion/scale_to_pga_g",
               "scales an acceleration; the file holds a velocity",
               "give the acceleration, or leave the scale out");
    if (wanted.baseline == scene::Baseline::corrected)
        refuse(problems, "/fem/motion/baseline",
               "is corrected in an acceleration only; the file holds a velocity",
               "give the acceleration, or take it as recorded");
}

/// Warns of time steps that skip samples of the motion.
void check_steps(const scene::Fem& fem, const motion::Series& series, Problems& problems) {
    for (std::size_t i = 0; i < fem.stages.size(); ++i) {
        if (fem.stages[i].kind != scene::StageKind::dynamic) continue;
        auto warning = motion::warning_about_step(
            series, fem.stages[i].time_step, "/fem/stages/" + std::to_string(i) + "/time_step");
        if (warning) problems.warnings.push_back(std::move(*warning));
    }
}

/// Warns of stages that end before most of the shaking.
void check_length(const scene::Fem& fem, const motion::Series& acceleration, Problems& problems) {
    const double end = fem.duration();
    motion::Series felt = acceleration;
    felt.values.resize(std::min(felt.values.size(), static_cast<std::size_t>(end / felt.dt) + 1));
    const double whole = motion::arias_intensity(acceleration);
    const double share = felt.values.size() < 2 ? 0.0 : motion::arias_intensity(felt) / whole;
    if (share >= 0.5) return;
    const double enough = motion::strong_part(acceleration).end;
    std::size_t last = fem.stages.size() - 1;
    while (last > 0 && fem.stages[last].kind != scene::StageKind::dynamic) --last;
    warn(problems, "motion_cut", "/fem/stages",
         "the dynamic stages end at " + text(end) + " s, when " + text(100.0 * share) +
             " % of the motion's Arias intensity have arrived; its strong part lasts until " +
             text(enough) + " s: " +
             words::set("/fem/stages/" + std::to_string(last) + "/duration",
                        std::ceil(fem.stages[last].duration + enough - end)));
}

/// Warns of stages that go on long after the motion has ended.
void check_rest(const scene::Fem& fem, const motion::Series& series, Problems& problems) {
    constexpr double most = 2.0;  // motions: some soil fails after the shaking
    const double end = fem.duration(), length = series.duration();
    if (end <= most * length) return;
    std::size_t last = fem.stages.size();
    while (fem.stages[last - 1].kind != scene::StageKind::dynamic) --last;
    const double before = end - fem.stages[last - 1].duration;
    warn(problems, "beyond_motion", "/fem/stages/" + std::to_string(last - 1) + "/duration",
         "the dynamic stages end at " + text(end) + " s, and the motion at " + text(length) +
             " s: the rest is computed without shaking, which costs time and strains the mesh; " +
             (before < length ? words::set("/fem/stages/" + std::to_string(last - 1) + "/duration",
                                           length - before) +
                                    ", or up to " + text(most * length - before) +
                                    " if the soil fails after the shaking"
                              : std::string("delete this stage")) +
             ", or give the whole record");
}

/// Warns of damping given at a frequency outside the motion's band: other frequencies have other
/// ratios.
void check_damping(const scene::Fem& fem, const motion::Series& acceleration, Problems& problems) {
    if (!fem.damping_frequency) return;
    const motion::Band band = motion::band(acceleration);
    const double low = 0.5 * band.low, high = 2.0 * band.high;
    if (!(high > 0.0)) return;  // no motion at all: core/motion warns of it
    if (*fem.damping_frequency >= low && *fem.damping_frequency <= high) return;
    refuse(problems, "/fem/damping/frequency_Hz",
           "is " + text(*fem.damping_frequency) + " Hz, and the motion has its power from " +
               text(band.low) + " to " + text(band.high) + " Hz",
           "give a frequency within the motion's, as a rule that of the dam's first mode");
}

motion::Series acceleration_of(const Recording& shaking) {
    motion::Series series = shaking.series;
    if (shaking.quantity == Quantity::acceleration) return series;
    for (std::size_t i = series.values.size(); i-- > 1;)
        series.values[i] = (series.values[i] - series.values[i - 1]) / series.dt;
    series.values.front() = 0.0;
    return series;
}

}  // namespace

void check_motion(const scene::Scene& scene, Recordings& recordings, Problems& problems) {
    const scene::Fem& fem = *scene.fem;
    if (!fem.motion) return;
    if (fem.duration() == 0.0)
        refuse(problems, "/fem/motion", "has no dynamic stage in which it could shake",
               "add a stage of type \"dynamic\", or leave the motion out");
    const auto recording = recording_of(*fem.motion, recordings, problems);
    if (!recording) return;
    check_kind(*fem.motion, recording->quantity, problems);
    if (recording->quantity == Quantity::displacement) return;
    if (auto constant = motion::fault_of_constant(*recording, file_pointer)) {
        problems.faults.push_back(std::move(*constant));
        return;
    }
    const Recording shaking = applied(*fem.motion, *recording);
    motion::Remarks remarks = motion::remarks_about(shaking, file_pointer);
    for (fault::Fault& each : remarks.faults) problems.faults.push_back(std::move(each));
    for (fault::Flag& each : remarks.flags) problems.warnings.push_back(std::move(each));
    if (!remarks.faults.empty()) return;
    check_steps(fem, shaking.series, problems);
    const motion::Series acceleration = acceleration_of(shaking);
    check_length(fem, acceleration, problems);
    check_rest(fem, acceleration, problems);
    check_damping(fem, acceleration, problems);
}

motion::Recording applied(const scene::BaseMotion& wanted, motion::Recording recording) {
    if (wanted.reversed)
        for (double& value : recording.series.values) value = 0.0 - value;
    if (recording.quantity != Quantity::acceleration) return recording;
    motion::Series& series = recording.series;
    if (wanted.baseline == scene::Baseline::corrected)
        series = motion::base_corrected(std::move(series));
    if (wanted.scale_to_pga_g)
        series = motion::scaled_to_peak(std::move(series),
                                        *wanted.scale_to_pga_g * motion::standard_gravity);
    return recording;
}

motion::Recording applied_motion(const scene::BaseMotion& wanted) {
    return applied(wanted, motion::read_motion(wanted.file));
}

}  // namespace breach::check
