#include "transfer_tool/advice.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <span>

#include "core/fault/fault.hpp"
#include "core/phases/files.hpp"
#include "core/words/number.hpp"

namespace breach::transfer {
namespace {

/// Signs listed in docs/reference/methods/mochikoshi_case.md, in the order of a failure.
struct KnownSign {
    const char* name;
    const char* condition;
};
constexpr std::array known_signs{
    KnownSign{"liquefaction reaches 10 m", "liquefaction_depth > 10"},
    KnownSign{"first failure surface", "failure_surfaces >= 1"},
    KnownSign{"second failure surface", "failure_surfaces >= 2"},
    KnownSign{"energy grows e-fold in a second", "growth(kinetic_energy, 1) > 1"},
    KnownSign{"strained elements: mean epsilon_q above 20 %", "epsilon_q_avg > 0.2"},
    KnownSign{"strained elements: mean least |J_t|/|J_0| below 0.97", "jacobian_least_avg < 0.97"},
    KnownSign{"strained elements: mean area |J_t|/|J_0| below 0.97", "jacobian_centre_avg < 0.97"},
};

/// A condition on a field that no line has is never true. Without this list a misspelt field would
/// read as a failure that never developed.
std::vector<std::string> missing_fields(const criteria::Expression& expression,
                                        std::span<const telemetry::Line> telemetry) {
    std::vector<std::string> missing;
    for (const std::string& field : expression.fields)
        if (std::ranges::none_of(telemetry,
                                 [&](const auto& line) { return line.values.contains(field); }))
            missing.push_back(field);
    return missing;
}

Sign sign_of(const std::string& name, const std::string& condition,
             std::span<const telemetry::Line> telemetry) {
    const auto expression = criteria::parse(condition, criteria::Kind::condition, "");
    Sign sign{name, condition, missing_fields(expression, telemetry).empty(), {}};
    criteria::Evaluation evaluation(expression);
    bool before = false;
    for (const telemetry::Line& line : telemetry) {
        const bool now = evaluation(line.time, line_for(expression, line).values) == 1.0;
        if (now && !before) sign.onsets.push_back(line.time);
        before = now;
    }
    return sign;
}

Edge edge_of(const criteria::Expression& condition, const criteria::Line& line) {
    Edge edge{condition.text, line.time, {}};
    for (std::size_t i = 0; i < condition.fields.size(); ++i)
        edge.values[condition.fields[i]] = line.values[i];
    return edge;
}

using words::formatted;

std::string edge_text(const char* name, const Edge& edge) {
    std::string text = std::string(name) + formatted(" %.6g s: ", edge.time) + edge.condition;
    for (const auto& [field, value] : edge.values)
        text += ", " + field + formatted(" = %.4g", value);
    return text + "\n";
}

std::string sign_text(const Sign& sign) {
    std::string text = "  " + sign.name + " (" + sign.condition + "): ";
    if (!sign.known) return text + "the telemetry has no such field\n";
    if (sign.onsets.empty()) return text + "never\n";
    for (std::size_t i = 0; i < sign.onsets.size(); ++i)
        text += (i == 0 ? "from " : ", again from ") + formatted("%.6g s", sign.onsets[i]);
    return text + "\n";
}

}  // namespace

criteria::Window window_of(const scene::Scene& scene) {
    const auto& window = scene::transfer_of(scene).window;
    if (!window)
        throw fault::BadInput(scene.name, {{"/transfer/window", "is missing, and advice needs it",
                                            "say in \"lower\" when the failure has developed"}});
    std::vector<fault::Fault> faults;
    const auto parsed = [&](const std::string& text, const char* pointer) {
        try {
            return criteria::parse(text, criteria::Kind::condition, pointer);
        } catch (const fault::BadInput& refusal) {
            faults.insert(faults.end(), refusal.faults().begin(), refusal.faults().end());
            return criteria::Expression{};
        }
    };
    criteria::Expression lower = parsed(window->lower, "/transfer/window/lower");
    criteria::Expression upper = parsed(window->upper, "/transfer/window/upper");
    if (!faults.empty()) throw fault::BadInput(scene.name, faults);
    return {std::move(lower), std::move(upper), window->hold};
}

Advice advise(const scene::Scene& scene, const std::vector<telemetry::Line>& telemetry,
              const std::vector<double>& snapshots) {
    criteria::Window window = window_of(scene);
    Advice advice;
    advice.begin = telemetry.front().time;
    advice.end = telemetry.back().time;
    // The whole telemetry before any answer: only later lines tell whether a condition holds for
    // its hold.
    for (const telemetry::Line& line : telemetry) window.take(line);
    const criteria::Expression& lower = window.lower().expression();
    for (const criteria::Expression* each : {&lower, &window.upper()})
        for (const std::string& field : missing_fields(*each, telemetry))
            advice.missing.push_back(field);
    for (const KnownSign& each : known_signs)
        advice.signs.push_back(sign_of(each.name, each.condition, telemetry));
    if (window.lower().state() != criteria::Criterion::State::met) return advice;
    advice.lower = edge_of(lower, *window.lower().crossing());
    // Not an open window that ends early: the mesh was too distorted before the failure had
    // developed.
    if (window.shut_since()) {
        advice.shut_since = window.shut_since()->time;
        return advice;
    }
    if (const auto upper = window.upper_edge()) advice.upper = edge_of(window.upper(), *upper);
    const double from = advice.lower->time;
    const double to = advice.until();
    advice.half_way = 0.5 * (from + to);
    for (const double t : snapshots)
        if (t >= from && t <= to) advice.snapshots.push_back(t);
    advice.pick = criteria::picked(*criteria::pick_named(scene.transfer->window->pick), from, to,
                                   advice.snapshots);
    return advice;
}

std::vector<double> snapshot_times(const std::filesystem::path& folder) {
    constexpr std::string_view head = phases::files::snapshot_prefix;
    constexpr std::string_view tail = phases::files::snapshot_extension;
    std::vector<double> times;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(head) || !name.ends_with(tail)) continue;
        const char* begin = name.data() + head.size();
        const char* end = name.data() + name.size() - tail.size();
        double time = 0.0;
        // Another program's file with a similar name is no fault.
        if (std::from_chars(begin, end, time).ptr == end && begin != end) times.push_back(time);
    }
    std::ranges::sort(times);
    return times;
}

std::string as_text(const Advice& advice) {
    std::string text =
        formatted("telemetry from %.6g s", advice.begin) + formatted(" to %.6g s\n", advice.end);
    for (const std::string& field : advice.missing)
        text += "the telemetry has no \"" + field + "\": a condition on it is never true\n";
    if (!advice.lower) {
        text += "no window: the failure has not developed\n";
    } else if (advice.shut_since) {
        text += edge_text("no window: the failure has developed at", *advice.lower);
        text += formatted("the mesh is too distorted since %.6g s\n", *advice.shut_since);
    } else {
        text += edge_text("lower edge", *advice.lower);
        text += advice.upper ? edge_text("upper edge", *advice.upper)
                             : formatted("upper edge %.6g s: the telemetry's end\n", advice.end);
        text += formatted("half-way %.6g s\n", *advice.half_way);
        text += std::to_string(advice.snapshots.size()) + " snapshots in the window" +
                (advice.pick ? formatted("; take the one at %.6g s\n", *advice.pick)
                             : std::string("; run the FEM with one there\n"));
    }
    text += "signs\n";
    for (const Sign& sign : advice.signs) text += sign_text(sign);
    return text;
}

}  // namespace breach::transfer
