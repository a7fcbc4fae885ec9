// Called while a study is read, before any task is planned. Times are fixed to microseconds here,
// as they become names of snapshots, which the transfer must find again.
#include "services/orchestrator/study/transfers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/check/measured.hpp"
#include "core/criteria/expression.hpp"
#include "core/criteria/ranges.hpp"
#include "core/words/milliseconds.hpp"
#include "core/words/number.hpp"
#include "services/orchestrator/records/identity.hpp"

namespace breach::orchestrator {

using fault::BadInput;
using fault::Fault;
using nlohmann::json;

namespace {

/// A slip in "step" must not make millions of tasks.
constexpr std::size_t most_times = 10000;
constexpr double unknown_span = 1e9;  // of an unreadable FEM [s]: no time is too late
constexpr double microsecond = 1e-6;  // closer times would share a snapshot's name

/// The double nearest to the time as text: 0.1 + 0.2 becomes 0.3, so that snapshot, override and
/// row agree.
double in_microseconds(double time) { return std::stod(spelt(time)); }

std::vector<double> even_range(const json& range, std::vector<Fault>& faults) {
    const double from = range.at("from");
    const double to = range.at("to");
    const double step = range.at("step");
    if (to < from) {
        faults.push_back({"/transfer_times/to", "the range ends before it begins",
                          "give to >= from, or a list of times"});
        return {};
    }
    if (step < microsecond) {
        faults.push_back({"/transfer_times/step", "the step is below one microsecond",
                          "give a step of at least 1e-6 s"});
        return {};
    }
    // 1e-9 of a step: 0.3 / 0.1 is 2.9999999999999996 and must give three steps.
    const double count = std::floor((to - from) / step + 1e-9) + 1;
    if (count > static_cast<double>(most_times)) {
        faults.push_back({"/transfer_times/step",
                          "the range holds more than " + std::to_string(most_times) + " times",
                          "give a larger step"});
        return {};
    }
    std::vector<double> times;
    // Not a running sum: its rounding would grow with the number of steps.
    for (double i = 0; i < count; ++i) times.push_back(from + i * step);
    return times;
}

std::vector<double> wanted_times(const json& entry, std::vector<Fault>& faults) {
    std::vector<double> times =
        entry.is_array() ? entry.get<std::vector<double>>() : even_range(entry, faults);
    for (double& time : times) time = in_microseconds(time);
    std::ranges::sort(times);
    const auto equal = std::ranges::adjacent_find(times);
    if (equal != times.end()) {
        faults.push_back({"/transfer_times",
                          "the time " + words::text_of(*equal, 9) + " s is given twice",
                          "give each transfer time once (two times differ by 1e-6 s or more)"});
    }
    return times;
}

/// Warns of criteria that wait for a time after the FEM's end.
void warn_about_late_criteria(const json& triggers, double span,
                              std::vector<fault::Flag>& warnings) {
    const auto range = [&](const std::string& field) {
        // All other fields may take any value.
        return field == "time" ? criteria::Range{0.0, span} : criteria::Range{};
    };
    for (std::size_t i = 0; i < triggers.size(); ++i) {
        if (!triggers[i].contains("when")) continue;
        const std::string at = "/triggers/" + std::to_string(i) + "/when";
        const std::string when = triggers[i]["when"];
        try {
            if (criteria::can_be_true(criteria::parse(when, criteria::Kind::condition, at), range))
                continue;
        } catch (const BadInput&) {
            continue;  // reported by check_triggers
        }
        warnings.push_back({"late_criterion", fault::Severity::warning,
                            "\"" + when + "\" is never true: the FEM ends at " +
                                words::text_of(span, 9) +
                                " s, so this trigger makes no transfer. Write an earlier time, or "
                                "lengthen /scene/fem/stages",
                            at});
    }
}

/// Fields in a condition; none for a faulty one, which check_triggers reports.
std::vector<std::string> fields_of(const std::string& condition) {
    try {
        return criteria::parse(condition, criteria::Kind::condition, "").fields;
    } catch (const BadInput&) {
        return {};
    }
}

}  // namespace

/// A microsecond of slack for sums of stages.
bool is_late(double time, const scene::Fem& fem) { return time > fem.duration() + microsecond; }

void check_times(const std::vector<double>& times, const scene::Fem& fem,
                 std::vector<Fault>& faults) {
    if (times.empty()) return;
    if (is_late(times.back(), fem)) {
        const std::string in_ms = words::seconds_remedy(times.back(), fem.duration());
        faults.push_back(
            {"/transfer_times",
             "the transfer at " + words::text_of(times.back(), 9) +
                 " s comes after the end of the dynamic stages at " +
                 words::text_of(fem.duration(), 9) + " s",
             in_ms.empty() ? "transfer earlier or lengthen /scene/fem/stages" : in_ms});
    }
}

void check_fields(const json& triggers, const scene::Scene& scene, bool stability,
                  bool post_seismic, std::vector<Fault>& faults) {
    const bool staged = stability && scene.lem && !scene.lem->liquefaction.empty();
    for (std::size_t i = 0; i < triggers.size(); ++i) {
        for (const char* key : {"when", "lower", "upper"}) {
            if (!triggers[i].contains(key)) continue;
            const std::string at = "/triggers/" + std::to_string(i) + "/" + key;
            const auto fields = fields_of(triggers[i][key].get<std::string>());
            std::ranges::move(check::unmeasured(fields, scene, at), std::back_inserter(faults));
            const auto asks = [&](std::string_view name) {
                return std::ranges::find(fields, name) != fields.end();
            };
            const bool regular = triggers[i].value("snapshot_interval_s", 0.0) > 0.0 ||
                                 scene.fem->snapshot_interval > 0.0 ||
                                 triggers[i].at("kind") == "window";
            if (asks(post_seismic_field) && !(post_seismic && regular))
                faults.push_back(
                    {at, "asks for post_seismic_factor, which is computed from regular snapshots",
                     "give \"post_seismic\": true in the study and \"snapshot_interval_s\" here"});
            if (!staged && asks(critical_depth_field))
                faults.push_back(
                    {at, "asks for critical_depth, which only a stability analysis in stages gives",
                     "give /scene/lem/liquefaction and leave \"stability\" on"});
        }
    }
}

void check_lines(const scene::Scene& scene, const Study& study, std::vector<Fault>& faults) {
    if (!scene.transfer || !scene.transfer->liquefied || !study.triggers.empty()) return;
    const auto& lines = scene.transfer->liquefied->lines;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const double time = lines[i].transfer_time;
        const auto is_its = [&](double each) { return std::abs(each - time) < microsecond; };
        if (std::ranges::any_of(study.transfer_times, is_its)) continue;
        faults.push_back({"/scene/transfer/liquefied/line/" + std::to_string(i) + "/transfer_time",
                          "is " + words::text_of(time) + " s, which is no transfer time",
                          "add it to \"transfer_times\", or leave the line out"});
    }
}

/// Triggers "at_time" fire at times that are known: they become transfer times here, and only live
/// ones are watched.
void read_transfers(const json& document, const scene::Fem* fem, Study& study,
                    std::vector<Fault>& faults) {
    const std::size_t before = faults.size();
    const double span = fem ? fem->duration() : unknown_span;
    CheckedTriggers checked = check_triggers(document["triggers"], span, "/triggers", faults);
    if (fem) warn_about_late_criteria(document["triggers"], span, study.warnings);
    std::vector<double> times;
    const auto take = [&](const json& entry) {
        const std::vector<double> more = wanted_times(entry, faults);
        times.insert(times.end(), more.begin(), more.end());
    };
    if (document.contains("transfer_times")) take(document["transfer_times"]);
    for (const json& each : checked.at_time) take(each);
    std::ranges::sort(times);
    const auto repeated = std::ranges::unique(times);
    times.erase(repeated.begin(), repeated.end());
    study.transfer_times = std::move(times);
    study.triggers = std::move(checked.live);
    study.snapshot_interval = checked.snapshot_interval;
    if (fem) check_times(study.transfer_times, *fem, faults);
    if (fem && fem->snapshot_interval > 0.0 && study.snapshot_interval > fem->snapshot_interval)
        study.snapshot_interval = 0.0;  // the scene's own interval is finer
    if (study.reach != Reach::chain) return;
    if (faults.size() == before && study.transfer_times.empty() && document["triggers"].empty()) {
        faults.push_back({"/transfer_times", "nothing says when to transfer",
                          "give \"transfer_times\", \"triggers\" or both"});
    }
}

}  // namespace breach::orchestrator
