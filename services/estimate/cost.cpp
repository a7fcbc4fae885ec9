// The cost that `breach submit --dry-run`, `breach draw` and the study's page show before a run.
// It counts instead of meshing, and multiplies by rates, so that the answer is there at once.
// Earlier runs of this server correct the rates.
#include "services/estimate/cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/phases/phases.hpp"
#include "services/estimate/counts.hpp"

namespace breach::estimate {

using nlohmann::json;

namespace {

// CPU seconds and bytes per unit of work, fitted to the runs of README.md in this folder. Another
// machine is within the factor of two of all ranges, or `learn` corrects it.
constexpr double start_up = 0.01;                  // of a program [s]
constexpr double per_slice = 1.05e-7;              // [s]
constexpr double per_polyline_and_slice = 6.5e-7;  // [s]
constexpr double per_element_step = 2.5e-6;        // iterations included [s]
constexpr double softening_elements = 1200;        // with more, shear bands need more iterations
constexpr double per_element_step_with_memory = 8e-6;  // PM4Sand with its pore water [s]
constexpr double per_transferred_point = 4e-6;         // [s]
constexpr double per_point_step = 5e-8;                // [s]
constexpr double bytes_per_element = 600;              // of a snapshot
constexpr double bytes_per_point = 210;                // of a whole state
constexpr double bytes_per_framed_point = 20;          // of a frame with the usual fields
constexpr double bytes_per_fem_line = 900, bytes_per_mpm_line = 250;  // of telemetry
constexpr double bytes_beside = 5e4;                                  // result, scene, history
/// Ranges are the middle divided and multiplied by fold.
constexpr double fold = 2.0, widening_of_means = 1.5;

Range around(double middle) { return {middle / fold, middle * fold}; }

/// Output of the stages and samples of /lem; sensitivities and polylines are negligible.
double lem_bytes(const scene::Lem& lem) {
    constexpr double per_stage = 8e3, per_number = 13.0;
    double numbers = 0.0;
    if (lem.probability)
        numbers = lem.probability->samples *
                  (1.0 + static_cast<double>(lem.probability->variables.size()));
    return bytes_beside + per_stage * (1.0 + static_cast<double>(lem.liquefaction.size())) +
           per_number * numbers;
}

PhaseCost lem_cost(const scene::Scene& scene) {
    const scene::Lem& lem = *scene.lem;
    const Searches searches = searches_of(scene);
    const double circles = searches.surfaces * searches.stages;
    return {phases::lem.program,
            {{"surfaces", circles + searches.polylines}},
            around(start_up + per_slice * searches.slices +
                   per_polyline_and_slice * searches.polylines * lem.slices),
            around(lem_bytes(lem)),
            ""};
}

/// Mean time per step and element [s]. Bands of softening soil cost iterations over the whole mesh,
/// each with a factorisation.
double rate_of(const scene::Scene& scene, const MeshCounts& mesh) {
    const std::vector<double> elements = elements_of(scene);
    double all = 0.0, with_memory = 0.0;
    bool softens = false;
    for (std::size_t r = 0; r < elements.size(); ++r) {
        const std::size_t material = scene.section.regions[r].material;
        if (material >= scene.materials.size()) continue;
        const materials::Law& law = scene.materials[material].law;
        all += elements[r];
        if (materials::remembers(law)) with_memory += elements[r];
        if (materials::softening(law) != nullptr) softens = true;
    }
    const double share = all > 0.0 ? with_memory / all : 0.0;
    const double bands = softens ? std::max(1.0, mesh.elements / softening_elements) : 1.0;
    return share * per_element_step_with_memory + (1.0 - share) * bands * per_element_step;
}

MeshCounts mesh_of(const scene::Scene& scene) {
    double elements = 0.0;
    for (const double each : elements_of(scene)) elements += each;
    return {elements, elements + 2.0 * std::sqrt(elements) + 1.0};  // nodes of a square mesh
}

PhaseCost fem_cost(const scene::Scene& scene, const MeshCounts& mesh, bool counted) {
    const scene::Fem& fem = *scene.fem;
    const FemSteps steps = steps_of(fem);
    const double lines =
        fem.telemetry_interval > 0.0 ? steps.duration / fem.telemetry_interval : steps.steps;
    const double unknowns = (fem.water ? 3.0 : 2.0) * mesh.nodes;
    return {phases::fem.program,
            {{counted ? "elements" : "elements, about", mesh.elements},
             {"unknowns, about", unknowns},
             {"steps", steps.steps}},
            around(start_up + rate_of(scene, mesh) * mesh.elements * steps.steps),
            around(bytes_beside + bytes_per_element * mesh.elements * (snapshots_of(fem) + 1.5) +
                   bytes_per_fem_line * lines),
            ""};
}

PhaseCost transfer_cost(double points) {
    return {phases::transfer.program,
            {{"points, about", points}},
            around(2.0 * start_up + per_transferred_point * points),
            around(0.5 * bytes_beside + bytes_per_point * points),
            ""};
}

PhaseCost mpm_cost(const scene::Scene& scene, double points) {
    const scene::Mpm& mpm = *scene.mpm;
    const double duration = runout_duration(scene);
    const double steps = duration / runout_step(scene);
    const double whole_states = 2.0;
    const double frames = mpm.snapshot_interval > 0.0 ? duration / mpm.snapshot_interval : 0.0;
    const double per_point = bytes_per_point * whole_states + bytes_per_framed_point * frames;
    const double lines = mpm.telemetry_interval > 0.0 ? duration / mpm.telemetry_interval : steps;
    return {phases::mpm.program,
            {{"points, about", points},
             {"steps, about", steps},
             {mpm.until_rest ? "seconds until rest, about" : "seconds of flow", duration}},
            around(start_up + per_point_step * points * steps),
            around(bytes_beside + per_point * points + bytes_per_mpm_line * lines),
            ""};
}

std::string counted(double value) {
    std::string digits = std::to_string(std::llround(value));
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

/// Two significant digits, with thousands separators: "5,500".
/// Two digits: more would promise what a factor of two in the range denies.
std::string number(double value) {
    const double size = std::abs(value);
    const double unit = size > 0.0 ? std::pow(10.0, std::floor(std::log10(size)) - 1.0) : 1.0;
    char text[40];
    if (size < 10.0) {
        std::snprintf(text, sizeof text, "%.2g", value);
        return text;
    }
    return counted(std::round(value / unit) * unit);
}

std::string range(const Range& value, double unit, const char* name) {
    return number(value.low / unit) + " to " + number(value.high / unit) + " " + name;
}

std::string time_of(const Range& seconds) {
    if (seconds.high < 120.0) return range(seconds, 1.0, "CPU s");
    if (seconds.high < 4.0 * 3600.0) return range(seconds, 60.0, "CPU min");
    return range(seconds, 3600.0, "CPU h");
}

std::string disk_of(const Range& bytes) {
    return bytes.high < 2e9 ? range(bytes, 1e6, "MB") : range(bytes, 1e9, "GB");
}

/// How often a study runs the phase: least and most, because shared tasks are computed once.
Range times_of(const std::string& phase, const Repeats& repeats) {
    // The server has planned the study: shared and cached tasks are known, nothing is to be
    // guessed.
    if (!repeats.tasks.empty()) {
        const auto planned = repeats.tasks.find(phase);
        const double count = planned == repeats.tasks.end() ? 0.0 : planned->second;
        return {count, count};
    }
    const bool per_runout = phase == phases::transfer.program || phase == phases::mpm.program;
    if (per_runout) return {repeats.runouts, repeats.runouts};
    return {1.0, phase == phases::fem.program ? repeats.variants : 1.0};
}

struct Sum {
    Range cpu_seconds{0.0, 0.0}, bytes{0.0, 0.0};
};
/// A phase that runs many times gets the range of the mean: single runs scatter, their sum less so.
/// Lows and highs are added: the error of a rate is the same in all runs and does not average out.
Sum sum_of(const std::vector<PhaseCost>& costs, const Repeats& repeats) {
    Sum sum;
    for (const PhaseCost& each : costs) {
        const Range times = times_of(each.phase, repeats);
        const bool many = times.low > 1.0;
        const Range& cpu_seconds = many ? each.mean_cpu_seconds : each.cpu_seconds;
        const Range& bytes = many ? each.mean_bytes : each.bytes;
        sum.cpu_seconds.low += times.low * cpu_seconds.low;
        sum.cpu_seconds.high += times.high * cpu_seconds.high;
        sum.bytes.low += times.low * bytes.low;
        sum.bytes.high += times.high * bytes.high;
    }
    return sum;
}

/// Of "transfer_times" as the author wrote them, checked or not: anything unreadable counts as one.
double length_of(const json& times) {
    if (times.is_array()) return static_cast<double>(times.size());
    if (!times.is_object()) return 1.0;
    for (const char* each : {"from", "to", "step"})
        if (!times.contains(each) || !times.at(each).is_number()) return 1.0;
    const double step = times.at("step");
    if (step <= 0.0) return 1.0;
    return std::floor((times.at("to").get<double>() - times.at("from").get<double>()) / step +
                      1e-9) +
           1.0;
}

}  // namespace

double Range::middle() const { return std::sqrt(low * high); }

/// The transfer exists only between a FEM and a runout; a scene without a FEM is filled with
/// points.
std::vector<PhaseCost> cost_of(const scene::Scene& scene, const std::optional<MeshCounts>& mesh) {
    const MeshCounts meshed = mesh ? *mesh : mesh_of(scene);
    const double points = points_of(scene, meshed.elements);
    std::vector<PhaseCost> costs;
    if (scene.lem) costs.push_back(lem_cost(scene));
    if (scene.fem) costs.push_back(fem_cost(scene, meshed, mesh.has_value()));
    if (scene.fem && scene.transfer && scene.mpm) costs.push_back(transfer_cost(points));
    if (scene.mpm) costs.push_back(mpm_cost(scene, points));
    for (PhaseCost& each : costs) {
        each.mean_cpu_seconds = each.cpu_seconds;
        each.mean_bytes = each.bytes;
        each.basis = "by the scene alone";
    }
    return costs;
}

/// Ratios, not times, so that a run of another size of the same scene teaches as well.
void learn(std::vector<PhaseCost>& costs, const std::string& scene,
           const std::vector<Earlier>& earlier) {
    for (PhaseCost& cost : costs) {
        std::vector<const Earlier*> all, same;
        for (const Earlier& each : earlier) {
            if (each.phase != cost.phase || each.cpu_ratio <= 0.0) continue;
            all.push_back(&each);
            if (each.scene == scene) same.push_back(&each);
        }
        const std::vector<const Earlier*>& used = same.empty() ? all : same;
        if (used.empty()) continue;
        const double widening = same.empty() ? fold : used.size() > 1 ? 1.25 : 1.5;
        const auto moved = [&](const Range& range, double Earlier::*ratio) {
            const auto [low, high] =
                std::ranges::minmax(used, {}, [&](const Earlier* each) { return each->*ratio; });
            return Range{range.middle() * (low->*ratio) / widening,
                         range.middle() * (high->*ratio) * widening};
        };
        const auto mean = [&](const Range& range, double Earlier::*ratio) {
            double sum = 0.0;
            for (const Earlier* each : used) sum += each->*ratio;
            const double middle = range.middle() * sum / static_cast<double>(used.size());
            const double factor = same.empty() ? fold : widening_of_means;
            return Range{middle / factor, middle * factor};
        };
        cost.mean_cpu_seconds = mean(cost.cpu_seconds, &Earlier::cpu_ratio);
        cost.cpu_seconds = moved(cost.cpu_seconds, &Earlier::cpu_ratio);
        // A run without stored files still teaches its time.
        const bool sized =
            std::ranges::all_of(used, [](const Earlier* each) { return each->bytes_ratio > 0.0; });
        if (sized) {
            cost.mean_bytes = mean(cost.bytes, &Earlier::bytes_ratio);
            cost.bytes = moved(cost.bytes, &Earlier::bytes_ratio);
        }
        cost.basis = "by " + std::to_string(used.size()) +
                     (used.size() == 1 ? " earlier run" : " earlier runs") +
                     (same.empty() ? " of other scenes" : " of this scene");
    }
}

/// Reads a document that may still have faults, as the page shows a cost while it is written.
Repeats repeats_of(const json& document) {
    Repeats repeats;
    if (!document.is_object() || !document.contains("scene")) return repeats;
    if (const auto list = document.find("variants"); list != document.end() && list->is_array())
        repeats.variants = std::max<double>(1.0, static_cast<double>(list->size()));
    if (const auto draws = document.find("draws"); draws != document.end() && draws->is_number())
        repeats.variants *= std::max(1.0, draws->get<double>());
    if (const auto entry = document.find("uncertainty");
        entry != document.end() && entry->is_object() && entry->contains("samples") &&
        entry->at("samples").is_number())
        repeats.variants = std::max(1.0, entry->at("samples").get<double>());
    repeats.runouts = repeats.variants;
    if (const auto times = document.find("transfer_times"); times != document.end())
        repeats.runouts *= std::max(1.0, length_of(*times));
    return repeats;
}

std::vector<std::string> lines_of(const std::vector<PhaseCost>& costs, const Repeats& repeats) {
    std::vector<std::string> lines;
    for (const PhaseCost& each : costs) {
        std::string line = each.phase + ": ";
        for (const auto& [what, count] : each.counts) {
            const auto about = what.find(", about");
            line += about == std::string::npos
                        ? counted(count) + " " + what + ", "
                        : "about " + number(count) + " " + what.substr(0, about) + ", ";
        }
        lines.push_back(line + time_of(each.cpu_seconds) + ", " + disk_of(each.bytes) + " (" +
                        each.basis + ")");
    }
    if (costs.empty()) return {"Cost: the scene asks for no phase"};
    const Sum sum = sum_of(costs, repeats);
    std::string all = "All";
    if (repeats.tasks.empty() && repeats.runouts > 1.0)
        all += ", with " + counted(repeats.runouts) + " runouts";
    for (const auto& [phase, count] : repeats.tasks) all += ", " + counted(count) + " " + phase;
    lines.push_back(all + ": " + time_of(sum.cpu_seconds) + ", " + disk_of(sum.bytes));
    return lines;
}

json as_json(const std::vector<PhaseCost>& costs, const Repeats& repeats) {
    const auto both = [](const Range& range) { return json::array({range.low, range.high}); };
    json phases = json::array();
    for (const PhaseCost& each : costs) {
        json counts = json::object();
        for (const auto& [what, count] : each.counts)
            counts[what.substr(0, what.find(", about"))] = std::round(count);
        phases.push_back({{"phase", each.phase},
                          {"counts", counts},
                          {"cpu_seconds", both(each.cpu_seconds)},
                          {"bytes", both(each.bytes)},
                          {"basis", each.basis}});
    }
    const Sum sum = sum_of(costs, repeats);
    json answer{{"phases", phases},
                {"runouts", repeats.runouts},
                {"cpu_seconds", both(sum.cpu_seconds)},
                {"bytes", both(sum.bytes)},
                {"lines", lines_of(costs, repeats)}};
    for (const auto& [phase, count] : repeats.tasks) answer["tasks"][phase] = std::llround(count);
    return answer;
}

}  // namespace breach::estimate
