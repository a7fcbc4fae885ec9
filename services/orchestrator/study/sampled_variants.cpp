// Samples are ordinary variants from here on: tasks, cache and results know nothing of
// uncertainty.
#include "services/orchestrator/study/sampled_variants.hpp"

#include <algorithm>
#include <set>

#include "services/orchestrator/study/samples.hpp"

namespace breach::orchestrator {

using fault::Fault;
using nlohmann::json;

namespace {

Lattice lattice_for(Reach reach) {
    return [reach](std::size_t number) { return lattice_of_draw(number, reach); };
}

/// The parameter that sets this entry, a part of it, or an object around it.
std::optional<std::size_t> parameter_of(const std::string& pointer, const UncertaintyPlan& plan) {
    for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
        const Parameter& each = plan.parameters[k];
        if (each.kind == ParameterKind::numerical ? is_lattice(pointer) : gives(each, pointer))
            return k;
    }
    return std::nullopt;
}

std::string pointer_to(std::size_t parameter) {
    return "/uncertainty/parameters/" + std::to_string(parameter);
}

/// Faults of overrides of entries that a parameter sets; a factor may multiply them.
void check_overrides(const json& overrides, const std::string& at, const UncertaintyPlan& plan,
                     std::vector<Fault>& faults) {
    for (std::size_t i = 0; i < overrides.size(); ++i) {
        const auto& text = overrides[i].get_ref<const std::string&>();
        const auto parameter = parameter_of(text.substr(0, text.find('=')), plan);
        if (!parameter || plan.parameters[*parameter].kind == ParameterKind::factor) continue;
        faults.push_back({at + "/" + std::to_string(i),
                          "the parameter \"" + plan.parameters[*parameter].name + "\" (" +
                              pointer_to(*parameter) + ") gives this entry, too",
                          "leave one of them out: a setting is known or drawn"});
    }
}

}  // namespace

/// Called before the parameters are read: it depends on the quantity only.
Reach reach_of_samples(const json& entry, const json& scene, Reach of_scene,
                       std::vector<Fault>& faults) {
    const std::string first = entry.at("quantity");
    const auto check = [&](const std::string& name, const char* at) {
        const auto quantity = quantity_named(name, scene);
        if (quantity && !quantity->time) return;
        faults.push_back({std::string("/uncertainty") + at,
                          "\"" + name + "\" is nothing that a table of results has",
                          "give one of " + names_of_results() + ", or factor_of_safety"});
    };
    check(first, "/quantity");
    if (entry.contains("until"))
        check(entry.at("until").value("quantity", first), "/until/quantity");
    if (first == "factor_of_safety") return Reach::lem;
    if (of_scene == Reach::lem)
        faults.push_back({"/uncertainty/quantity",
                          "the scene has nothing but a stability analysis, which has no " + first,
                          "give \"factor_of_safety\""});
    return of_scene;
}

void check_parameters(const json& document, const UncertaintyPlan& plan, Reach reach,
                      std::vector<Fault>& faults) {
    check_overrides(document["overrides"], "/overrides", plan, faults);
    for (std::size_t k = 0; k < plan.parameters.size(); ++k)
        if (plan.parameters[k].kind == ParameterKind::numerical && !has_lattice(reach))
            faults.push_back({pointer_to(k) + "/numerical",
                              "this moves the lattice of material points, and there are none",
                              "leave the parameter out"});
}

/// "transfer" of an uncertainty study is another way to write "transfer_times"; what follows knows
/// only the latter.
void place_transfer(json& document, std::vector<Fault>& faults) {
    const json& entry = document.at("uncertainty");
    if (!entry.contains("transfer")) return;
    const json& transfer = entry.at("transfer");
    if (transfer.size() != 1) {
        faults.push_back({"/uncertainty/transfer", "gives a time and a trigger",
                          "give one of \"times\" and \"trigger\""});
        return;
    }
    const json own = document.value("transfer_times", json());
    if (transfer.contains("times")) {
        if (!own.is_null() && own != transfer.at("times")) {
            faults.push_back({"/transfer_times", "/uncertainty/transfer gives a time as well",
                              "leave one of them out"});
            return;
        }
        document["transfer_times"] = transfer.at("times");
        return;
    }
    const std::string name = transfer.at("trigger");
    std::size_t found = 0;
    for (const json& each : document["triggers"])
        // By name or, where a study has one trigger of a kind, by its kind.
        if (each.value("name", "") == name || each.at("kind") == name) ++found;
    if (found != 1)
        faults.push_back({"/uncertainty/transfer/trigger",
                          found == 0 ? "the study has no trigger \"" + name + "\""
                                     : "the study has several triggers \"" + name + "\"",
                          "describe one under /triggers and give its name here"});
    if (!own.is_null())
        faults.push_back({"/transfer_times", "the samples are transferred where a trigger fires",
                          "leave \"transfer_times\" out"});
}

void give_sample(const UncertaintyPlan& plan, const DrawnSample& sample, const json& scene,
                 const Lattice& lattice, VariantEntry& entry) {
    entry.sample = {{"number", sample.number}, {"values", values_of(plan, sample)}};
    for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
        if (!lattice && plan.parameters[k].kind == ParameterKind::numerical) continue;
        for (std::string& each : overrides_of(plan.parameters[k], sample.draws[k], scene, lattice))
            entry.overrides.push_back(std::move(each));
    }
}

std::vector<VariantEntry> variants_of(const UncertaintyPlan& plan, const json& scene, Reach reach) {
    std::vector<VariantEntry> entries;
    for (const DrawnSample& sample : samples_of(plan, plan.drawn)) {
        VariantEntry entry{.name = name_of_sample(sample.number),
                           .overrides = {},
                           .name_pointer = "/uncertainty",
                           .pointer = "/uncertainty",
                           .made_by = "uncertainty"};
        give_sample(plan, sample, scene, lattice_for(reach), entry);
        entries.push_back(std::move(entry));
    }
    return entries;
}

/// At 10 and 90 %: far enough apart to change every text, near enough to be valid.
std::vector<ParameterProbe> probes_of(const UncertaintyPlan& plan, const json& scene, Reach reach) {
    std::vector<ParameterProbe> probes;
    for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
        const Parameter& parameter = plan.parameters[k];
        std::vector<double> draws{draw_at(parameter, 0.1), draw_at(parameter, 0.9)};
        if (parameter.kind == ParameterKind::choice) {
            draws.clear();
            for (std::size_t i = 0; i < parameter.choices.size(); ++i)
                draws.push_back(static_cast<double>(i));
        }
        ParameterProbe probe{.parameter = k, .overrides = {}};
        for (const double draw : draws)
            probe.overrides.push_back(overrides_of(parameter, draw, scene, lattice_for(reach)));
        probes.push_back(std::move(probe));
    }
    return probes;
}

/// A thousand samples may break the same rule; a person needs it once, where the numbers come from.
std::vector<Fault> faults_by_parameter(const std::vector<Fault>& found,
                                       const UncertaintyPlan& plan) {
    std::vector<Fault> told;
    std::set<std::string> entries;
    for (const Fault& each : found) {
        const std::string entry = each.cause.substr(0, each.cause.find(": "));
        if (!entries.insert(entry).second) continue;
        const auto parameter = parameter_of(entry, plan);
        told.push_back({parameter ? pointer_to(*parameter) : "/uncertainty", each.cause,
                        each.remedy + "; or narrow the distribution with \"between\""});
    }
    return told;
}

}  // namespace breach::orchestrator
