// What one variant of an accuracy study gives: the value asked for and what it cost. A variant is
// the chain of tasks that ends with the phase of the quantity; its cost is that of the whole chain,
// also where tasks are shared with other variants.
#include "services/orchestrator/accuracy/measured.hpp"

#include <algorithm>

#include "core/phases/files.hpp"
#include "services/orchestrator/files/telemetry.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

using TasksById = std::map<std::string, const Task*>;

/// The task and those that its input comes from, last phase first.
std::vector<const Task*> chain_of(const Task& last, const TasksById& tasks) {
    std::vector<const Task*> chain{&last};
    while (chain.back()->parent) chain.push_back(tasks.at(*chain.back()->parent));
    return chain;
}

std::optional<double> number_in(const json& result, const std::string& pointer) {
    const json::json_pointer at(pointer);
    if (!result.contains(at) || !result.at(at).is_number()) return std::nullopt;
    return result.at(at).get<double>();
}

void add(Cost& cost, const Task& task) {
    const double cpu = number_in(*task.result, "/cpu_seconds").value_or(0.0);
    cost.cpu_seconds += cpu;
    cost.cpu_seconds_by_phase[task.phase] += cpu;
    cost.wall_seconds += number_in(*task.result, "/wall_seconds").value_or(0.0);
    if (const auto peak = number_in(*task.result, "/peak_memory_MB"))
        cost.peak_memory_MB = std::max(cost.peak_memory_MB.value_or(0.0), *peak);
}

/// Why the last task of the chain has no value.
/// The fault may be of an earlier phase: then the last one was skipped.
std::string reason_of(const std::vector<const Task*>& chain) {
    for (const Task* each : chain)
        if (each->fault) return each->phase + ": " + each->fault->summary;
    return std::string(name_of(chain.front()->state));
}

std::optional<double> value_measured(const Task& task, const Quantity& quantity,
                                     const DataFolder& data) {
    if (!quantity.time) return number_in(*task.result, quantity.pointer);
    // A long telemetry comes in several parts.
    TelemetryRequest request{.fields = {"time", quantity.name}};
    for (;;) {
        const json part = read_telemetry(data.output(task) / phases::files::telemetry, request);
        if (const auto value = value_at(part.at("lines"), quantity.name, *quantity.time))
            return value;
        if (part.at("next") <= request.from + 1 || part.at("lines").empty()) return std::nullopt;
        request.from = part.at("next").get<std::int64_t>() - 1;  // repeat the line before the gap
    }
}

Measured measured(const Task& last, const TasksById& tasks, const Quantity& quantity,
                  const DataFolder& data) {
    const auto chain = chain_of(last, tasks);
    const bool there = std::ranges::all_of(chain, [](const Task* each) {
        return each->result && each->result->is_object() && has_output(each->state);
    });
    if (!there) return {.value = std::nullopt, .reason = reason_of(chain)};
    Measured found{.value = value_measured(last, quantity, data)};
    for (const Task* each : chain) {
        add(found.cost, *each);
        const json& caution = each->result->value("questionable", json());
        found.questionable |= caution.is_boolean() && caution.get<bool>();
        if (const json& soft = each->result->value("softening", json()); soft.is_object()) {
            found.softens = true;
            // The phase says both itself ("softening" in result.json), so no law is read here.
            found.has_length |= soft.at("has_length").get<bool>();
        }
    }
    if (!found.value)
        found.reason =
            quantity.time ? "the FEM ended before this time" : "its result has no " + quantity.name;
    return found;
}

}  // namespace

std::optional<double> value_at(const json& lines, const std::string& field, double time) {
    constexpr double same_time = 1e-9;  // round-off of the FEM's sums of steps [s]
    const json* before = nullptr;
    for (const json& line : lines) {
        if (!line.contains("time") || !line.contains(field) || !line[field].is_number()) continue;
        const double here = line["time"];
        const double value = line[field];
        // The first line at or after the time: between it and the one before lies the value.
        if (here >= time - same_time) {
            if (before == nullptr || here <= time + same_time)
                return here <= time + same_time ? std::optional(value) : std::nullopt;
            const double there = (*before)["time"];
            const double share = (time - there) / (here - there);
            return (1.0 - share) * (*before)[field].get<double>() + share * value;
        }
        before = &line;
    }
    return std::nullopt;
}

std::map<std::string, Measured> measured_variants(const std::vector<Task>& tasks,
                                                  const Quantity& quantity,
                                                  const DataFolder& data) {
    const std::string last = phases_of(quantity.reach).back().program;
    TasksById by_id;
    for (const Task& each : tasks) by_id[each.id] = &each;
    std::map<std::string, Measured> found;
    for (const Task& each : tasks)
        if (each.phase == last) found[each.variant] = measured(each, by_id, quantity, data);
    return found;
}

}  // namespace breach::orchestrator
