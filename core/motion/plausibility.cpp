#include "core/motion/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/words/number.hpp"
#include "core/words/remedy.hpp"

namespace breach::motion {

namespace {

/// Limits in ascending order: possible, plausible, plausible, possible.
struct Range {
    double least, low, high, most;
};
// The strongest horizontal records reach 2 g (4 g over three directions) and 3 m/s.
constexpr Range acceleration{0.0, 0.005, 1.0, 3.0};  // [g]
constexpr Range velocity{0.0, 0.002, 3.0, 10.0};     // [m/s]
constexpr Range sampling{1e-5, 2e-4, 0.05, 0.5};     // [s]
constexpr Range length{0.0, 1.0, 600.0, 1e5};        // [s]
constexpr double rounding = 1e-6;                    // of values in a file
constexpr double much_left = 0.05;                   // final velocity over the peak velocity

std::string text(double value, const char* unit = "") { return words::text_of(value, 4) + unit; }

/// Largest derivative, at the middles of steps.
double steepest(const Series& series) {
    double largest = 0.0;
    for (std::size_t i = 1; i < series.values.size(); ++i) {
        largest = std::max(largest, std::abs(series.values[i] - series.values[i - 1]) / series.dt);
    }
    return largest;
}

class Finder {
  public:
    explicit Finder(std::string pointer) : pointer_(std::move(pointer)) {}

    /// what: "a PGA of 1.96 g". slip(value): likely unit slip and remedy, or "".
    template <class Slip>
    void judge(double value, const Range& range, const std::string& what, Slip slip) {
        const bool possible = value >= range.least && value <= range.most * (1.0 + rounding);
        const bool plausible = value >= range.low && value <= range.high * (1.0 + rounding);
        if (plausible) return;
        const std::string meant = slip(value);
        if (!possible) {
            remarks.faults.push_back(
                {pointer_, "has " + what + ", which no earthquake has",
                 meant.empty() ? "check the file's units and columns" : meant});
            return;
        }
        flag("implausible", "the motion has " + what + ", hardly plausible: " +
                                (meant.empty() ? "check the file's units and columns" : meant));
    }

    /// One flag per code: a second finding is appended as a sentence.
    void flag(const char* code, const std::string& message) {
        const auto said = std::ranges::find(remarks.flags, code, &fault::Flag::code);
        if (said != remarks.flags.end()) {
            said->message += "; " + message;
        } else {
            remarks.flags.push_back({code, fault::Severity::warning, message, pointer_});
        }
    }

    Remarks remarks;

  private:
    std::string pointer_;
};

std::string slip_of_acceleration(double g) {
    if (g < acceleration.low) {
        return "it looks like g given as m/s2: name the column acceleration_g, or scale the motion";
    }
    if (g / standard_gravity <= acceleration.high) {
        return text(g) + " looks like m/s2 given as g: divide by 9.81 (" +
               text(g / standard_gravity, " g") + "), or name the column acceleration_m_s2";
    }
    if (g / (100.0 * standard_gravity) <= acceleration.high) {
        return text(g) + " looks like cm/s2 (gal) given as g: divide by 981 (" +
               text(g / (100.0 * standard_gravity), " g") + ")";
    }
    return "";
}

std::string slip_of_velocity(double v) {
    if (v > velocity.high && 0.01 * v <= velocity.high) {
        return text(v) +
               " looks like cm/s given as m/s: divide by 100, or name the column "
               "velocity_cm_s";
    }
    if (v < velocity.low) {
        return "it looks like m/s given as cm/s: name the column velocity_m_s";
    }
    return "";
}

std::string slip_of_time(double seconds, const Range& range) {
    const double meant = 1e-3 * seconds;
    if (seconds < range.high || meant < range.low || meant > range.high) return "";
    return text(seconds) + " looks like milliseconds: divide the times by 1000 (" +
           text(meant, " s") + ")";
}

}  // namespace

Peaks peaks_of(const Recording& motion) {
    if (motion.quantity == Quantity::velocity) {
        return {steepest(motion.series), peak(motion.series)};
    }
    return {peak(motion.series), peak(integral(motion.series))};
}

std::string summary_of(const Recording& motion) {
    const Peaks peaks = peaks_of(motion);
    return "PGA " + text(peaks.acceleration / standard_gravity, " g") + ", PGV " +
           text(peaks.velocity, " m/s") + ", " + text(motion.series.duration(), " s") +
           " in steps of " + text(motion.series.dt, " s");
}

Remarks remarks_about(const Recording& motion, const std::string& pointer) {
    Finder find(pointer);
    const Series& series = motion.series;
    const Peaks peaks = peaks_of(motion);
    find.judge(series.dt, sampling, "a time step of " + text(series.dt, " s"),
               [](double dt) { return slip_of_time(dt, sampling); });
    find.judge(series.duration(), length, "a length of " + text(series.duration(), " s"),
               [](double all) { return slip_of_time(all, length); });
    if (peak(series) == 0.0) {
        find.flag("implausible", "the motion is zero throughout: nothing is shaken");
        return std::move(find.remarks);
    }
    if (motion.quantity == Quantity::velocity) {
        find.judge(peaks.velocity, velocity, "a peak velocity of " + text(peaks.velocity, " m/s"),
                   slip_of_velocity);
        for (const auto& [end, left] : {std::pair{"beginning", series.values.front()},
                                        std::pair{"end", series.values.back()}}) {
            const double share = std::abs(left) / peaks.velocity;
            if (share <= much_left) continue;
            find.flag("drifting_motion", "the velocity at its " + std::string(end) + " is " +
                                             text(left, " m/s") + ", " + text(100.0 * share, " %") +
                                             " of its peak, and 0 beyond: a jolt that the record "
                                             "does not have; make it begin and end at rest");
        }
        return std::move(find.remarks);
    }
    const double g = peaks.acceleration / standard_gravity;
    find.judge(g, acceleration, "a PGA of " + text(g, " g"), slip_of_acceleration);
    const Baseline left = baseline(series);
    if (left.velocity_share > much_left) {
        find.flag("drifting_motion", "the motion leaves " + text(left.last_velocity, " m/s") +
                                         " at its end, " + text(100.0 * left.velocity_share, " %") +
                                         " of its peak velocity, and moves everything by " +
                                         text(left.last_displacement, " m") + ": " +
                                         words::set("/fem/motion/baseline", "corrected") +
                                         " takes both off");
    }
    return std::move(find.remarks);
}

std::optional<fault::Fault> fault_of_constant(const Recording& motion, const std::string& pointer) {
    const auto [low, high] = std::ranges::minmax(motion.series.values);
    if (low != high || low == 0.0) return std::nullopt;
    return fault::Fault{pointer,
                        "holds one constant value, " + text(low) + ", in " +
                            std::to_string(motion.series.values.size()) + " samples",
                        "give a motion that moves: is the second column the right one?"};
}

std::vector<fault::Flag> warnings_about(const Recording& motion, const std::string& pointer) {
    if (motion.quantity == Quantity::displacement) return {};
    Remarks remarks;
    if (auto constant = fault_of_constant(motion, pointer))
        remarks.faults.push_back(std::move(*constant));
    else
        remarks = remarks_about(motion, pointer);
    std::vector<fault::Flag> all;
    for (const fault::Fault& each : remarks.faults)
        all.push_back({"impossible", fault::Severity::questionable,
                       "the motion " + each.cause + ": " + each.remedy, each.pointer});
    std::ranges::move(remarks.flags, std::back_inserter(all));
    return all;
}

std::optional<fault::Flag> warning_about_step(const Series& motion, double time_step,
                                              const std::string& pointer) {
    constexpr double fine = 0.01;  // [s] resolves 10 Hz, above which a dam hardly responds
    const double samples = time_step / motion.dt;
    if (time_step <= fine || samples <= 2.0) return std::nullopt;
    return fault::Flag{"coarse_step", fault::Severity::warning,
                       "steps of " + text(time_step, " s") + " pass over " + text(samples) +
                           " samples of the motion (" + text(motion.dt, " s") +
                           " apart): its peaks are missed; " +
                           words::set(pointer, std::max(fine, 2.0 * motion.dt)),
                       pointer};
}

}  // namespace breach::motion
