// The cost that `breach submit --dry-run`, `breach draw` and the study's page show before a run.
// It counts instead of meshing, and multiplies by rates, so that the answer is there at once.
// Earlier runs of the scene correct the rates.
#include "services/estimate/cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/phases/phases.hpp"
#include "services/estimate/counts.hpp"
#include "services/estimate/machine.hpp"

namespace breach::estimate {

using nlohmann::json;

namespace {

// CPU seconds and bytes per unit of work, fitted to runs on the reference machine: of the LEM 60
// scenes, of the FEM 12, of the MPM 40.
constexpr double start_up = 0.01;                  // of a program [s]
constexpr double per_slice = 1.2e-7;               // [s]
constexpr double per_polyline_and_slice = 6.5e-7;  // [s]
constexpr double per_element_step = 2.5e-6;        // iterations included [s]
constexpr double softening_elements = 1200;        // with more, shear bands need more iterations
constexpr double per_element_step_with_memory = 8e-6;     // PM4Sand with its pore water [s]
constexpr double per_element_step_with_state = 2e-5;      // NorSand [s]
constexpr double per_transferred_point = 4e-6;            // [s]
constexpr double per_point_step = 7e-8, per_step = 4e-5;  // the second of grid and telemetry [s]
constexpr double bytes_per_element = 600;                 // of a snapshot
constexpr double bytes_per_point = 210;                   // of a whole state
constexpr double bytes_per_framed_point = 20;             // of a frame with the usual fields
constexpr double bytes_per_fem_line = 900, bytes_per_mpm_line = 250;  // of telemetry
constexpr double bytes_beside = 5e4;                                  // result, scene, history

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
            start_up + per_slice * searches.slices +
                per_polyline_and_slice * searches.polylines * lem.slices,
            lem_bytes(lem),
            ""};
}

/// Mean time per step and element [s]. Bands of softening soil cost iterations over the whole mesh,
/// each with a factorisation.
double rate_of(const scene::Scene& scene, const MeshCounts& mesh) {
    const std::vector<double> elements = elements_of(scene);
    double all = 0.0, with_memory = 0.0, with_state = 0.0;
    bool softens = false;
    for (std::size_t r = 0; r < elements.size(); ++r) {
        const std::size_t material = scene.section.regions[r].material;
        if (material >= scene.materials.size()) continue;
        const materials::Law& law = scene.materials[material].law;
        all += elements[r];
        if (materials::has_state_parameter(law))
            with_state += elements[r];
        else if (materials::remembers(law))
            with_memory += elements[r];
        if (materials::softening(law) != nullptr) softens = true;
    }
    if (all == 0.0) return per_element_step;
    const double bands = softens ? std::max(1.0, mesh.elements / softening_elements) : 1.0;
    return (with_state * per_element_step_with_state + with_memory * per_element_step_with_memory +
            (all - with_state - with_memory) * bands * per_element_step) /
           all;
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
            start_up + rate_of(scene, mesh) * mesh.elements * steps.steps,
            bytes_beside + bytes_per_element * mesh.elements * (snapshots_of(fem) + 1.5) +
                bytes_per_fem_line * lines,
            ""};
}

PhaseCost transfer_cost(double points) {
    return {phases::transfer.program,
            {{"points, about", points}},
            2.0 * start_up + per_transferred_point * points,
            0.5 * bytes_beside + bytes_per_point * points,
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
            start_up + (per_step + per_point_step * points) * steps,
            bytes_beside + per_point * points + bytes_per_mpm_line * lines,
            ""};
}

std::string counted(double value) {
    std::string digits = std::to_string(std::llround(value));
    for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3)
        digits.insert(static_cast<std::size_t>(at), ",");
    return digits;
}

/// Two significant digits, with thousands separators: "5,500". More would promise what the range
/// denies.
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

/// "4 CPU min (2.4 to 6.8)"
std::string range(double likely, double unit, const std::string& name) {
    const Range all = range_around(likely / unit);
    return number(likely / unit) + " " + name + " (" + number(all.low) + " to " + number(all.high) +
           ")";
}

/// kind: "CPU ", or "" for time by the clock.
std::string time_of(double seconds, const std::string& kind) {
    if (seconds < 90.0) return range(seconds, 1.0, kind + "s");
    if (seconds < 3.0 * 3600.0) return range(seconds, 60.0, kind + "min");
    return range(seconds, 3600.0, kind + "h");
}

std::string disk_of(double bytes) {
    return bytes < 1e9 ? number(bytes / 1e6) + " MB" : number(bytes / 1e9) + " GB";
}

/// With what a task takes beside its CPU time: it is started, and its files are stored.
double wall_seconds(const StudyCost& all) {
    constexpr double per_run = 1.0, per_task = 0.2;
    double tasks = 0.0;
    for (const auto& [phase, count] : all.tasks) tasks += count;
    const double beside = per_run + per_task * tasks / all.workers;
    return std::max(all.cpu_seconds / all.workers, all.longest) + beside;
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

Range range_around(double likely) {
    constexpr double fold = 1.7;
    return {likely / fold, likely * fold};
}

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
        each.cpu_seconds *= slowness();
        each.basis = "by the scene alone";
    }
    return costs;
}

/// Ratios, not times, so that a run of another size of the same scene teaches as well. The median:
/// soil that stands costs a tenth of soil that flows.
void learn(std::vector<PhaseCost>& costs, const std::string& scene,
           const std::vector<Earlier>& earlier) {
    const auto median = [](std::vector<double> ratios) {
        const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
        std::ranges::nth_element(ratios, middle);
        return *middle;
    };
    for (PhaseCost& cost : costs) {
        std::vector<double> cpu, bytes;
        for (const Earlier& each : earlier) {
            if (each.phase != cost.phase || each.scene != scene || each.cpu_ratio <= 0.0) continue;
            cpu.push_back(each.cpu_ratio);
            // A run without stored files still teaches its time.
            if (each.bytes_ratio > 0.0) bytes.push_back(each.bytes_ratio);
        }
        if (cpu.empty()) continue;
        cost.basis = "by " + std::to_string(cpu.size()) +
                     (cpu.size() == 1 ? " earlier run" : " earlier runs") + " of this scene";
        cost.cpu_seconds *= median(std::move(cpu));
        if (!bytes.empty()) cost.bytes *= median(std::move(bytes));
    }
}

double StudyCost::add(const PhaseCost& task, double before) {
    ++tasks[task.phase];
    cpu_seconds += task.cpu_seconds;
    bytes += task.bytes;
    longest = std::max(longest, before + task.cpu_seconds);
    return before + task.cpu_seconds;
}

/// Reads a document that may still have faults, as the page shows a cost while it is written.
StudyCost study_cost_of(const std::vector<PhaseCost>& costs, const json& document) {
    double variants = 1.0, times = 1.0;
    if (document.is_object() && document.contains("scene")) {
        const auto number_in = [](const json& within, const char* name) {
            const auto found = within.find(name);
            const bool counts = found != within.end() && found->is_number();
            return counts ? std::max(1.0, found->get<double>()) : 1.0;
        };
        if (const auto list = document.find("variants"); list != document.end() && list->is_array())
            variants = std::max(1.0, static_cast<double>(list->size()));
        variants *= number_in(document, "draws");
        if (const auto entry = document.find("uncertainty");
            entry != document.end() && entry->is_object() && entry->contains("samples"))
            variants = number_in(*entry, "samples");
        if (const auto found = document.find("transfer_times"); found != document.end())
            times = std::max(1.0, length_of(*found));
    }
    StudyCost all;
    for (const PhaseCost& each : costs) {
        const bool per_runout =
            each.phase == phases::transfer.program || each.phase == phases::mpm.program;
        const double count = variants * (per_runout ? times : 1.0);
        all.tasks[each.phase] = count;
        all.cpu_seconds += count * each.cpu_seconds;
        all.bytes += count * each.bytes;
        if (each.phase != phases::lem.program) all.longest += each.cpu_seconds;
    }
    return all;
}

std::vector<std::string> lines_of(const std::vector<PhaseCost>& costs, const StudyCost& all) {
    std::vector<std::string> lines;
    for (const PhaseCost& each : costs) {
        std::string line = each.phase + ": ";
        for (const auto& [what, count] : each.counts) {
            const auto about = what.find(", about");
            line += about == std::string::npos
                        ? counted(count) + " " + what + ", "
                        : "about " + number(count) + " " + what.substr(0, about) + ", ";
        }
        lines.push_back(line + time_of(each.cpu_seconds, "CPU ") + ", " + disk_of(each.bytes) +
                        " (" + each.basis + ")");
    }
    if (costs.empty()) return {"Cost: the scene asks for no phase"};
    std::string sum = "All";
    if (std::ranges::any_of(all.tasks, [](const auto& each) { return each.second > 1.0; }))
        for (const auto& [phase, count] : all.tasks) sum += ", " + counted(count) + " " + phase;
    sum += ": " + time_of(all.cpu_seconds, "CPU ");
    if (all.workers > 1)
        sum += ", " + time_of(wall_seconds(all), "") + " on " + std::to_string(all.workers) +
               " workers";
    lines.push_back(sum + ", " + disk_of(all.bytes));
    return lines;
}

json as_json(const std::vector<PhaseCost>& costs, const StudyCost& all) {
    const auto both = [](double likely) {
        const Range range = range_around(likely);
        return json::array({range.low, range.high});
    };
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
    json answer{{"phases", phases},
                {"tasks", json::object()},
                {"cpu_seconds", both(all.cpu_seconds)},
                {"wall_seconds", both(wall_seconds(all))},
                {"bytes", both(all.bytes)},
                {"lines", lines_of(costs, all)}};
    for (const auto& [phase, count] : all.tasks) answer["tasks"][phase] = std::llround(count);
    return answer;
}

}  // namespace breach::estimate
