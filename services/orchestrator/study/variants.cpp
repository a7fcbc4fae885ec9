// Each variant is checked as a whole scene, because overrides that are fine alone may contradict
// each other. Faults that the scene itself has are reported once, not once per variant.
#include "services/orchestrator/study/variants.hpp"

#include <algorithm>
#include <future>
#include <map>
#include <set>
#include <thread>

#include "services/orchestrator/study/checked_scene.hpp"
#include "services/orchestrator/study/transfers.hpp"

namespace breach::orchestrator {

using fault::Fault;
using fault::Flag;
using nlohmann::json;

namespace {

/// Faults of a variant that the scene itself does not have.
/// Late times are judged per variant, as an override may shorten the FEM's stages.
std::vector<Fault> faults_of_variant(const check::Checked& changed, const Base& base,
                                     const std::vector<double>& times) {
    std::vector<Fault> own;
    for (const Fault& each : changed.faults) {
        const bool known = std::ranges::any_of(base.faults, [&](const Fault& other) {
            return other.pointer == each.pointer && other.cause == each.cause;
        });
        if (!known) own.push_back(each);
    }
    std::vector<Fault> late;
    if (changed.scene.fem) check_times(times, *changed.scene.fem, late);
    for (const Fault& each : late) own.push_back({"/fem/stages", each.cause, each.remedy});
    return own;
}

struct CheckedVariant {
    json scene;  ///< completed; null where it has faults
    std::vector<Fault> faults;
    std::vector<Flag> warnings;  ///< warnings that the scene itself does not have
};

bool is_same(const Flag& one, const Flag& other) {
    return one.code == other.code && one.pointer == other.pointer && one.message == other.message;
}

CheckedVariant checked_variant(const VariantEntry& entry, const Base& base,
                               const std::vector<double>& times) {
    std::vector<std::string> overrides = base.overrides;
    overrides.insert(overrides.end(), entry.overrides.begin(), entry.overrides.end());
    check::Checked changed = check_sent_scene(base.scene, overrides, base.files, *base.recordings);
    CheckedVariant variant{
        .scene = nullptr, .faults = faults_of_variant(changed, base, times), .warnings = {}};
    for (const Flag& each : changed.scene.warnings)
        if (std::ranges::none_of(base.warnings,
                                 [&](const Flag& known) { return is_same(known, each); }))
            variant.warnings.push_back(each);
    if (changed.faults.empty()) variant.scene = std::move(changed.completed);
    return variant;
}

/// Checks all variants, on several threads if there are many.
/// Scenes are independent; the motions they share are read once (Recordings). Below 50 variants per
/// thread, starting it is not worth it.
std::vector<CheckedVariant> each_checked(const std::vector<VariantEntry>& entries, const Base& base,
                                         const std::vector<double>& times) {
    constexpr std::size_t worth_a_thread = 50;
    const std::size_t threads = std::clamp<std::size_t>(
        std::min<std::size_t>(std::thread::hardware_concurrency(), entries.size() / worth_a_thread),
        1, 8);
    std::vector<CheckedVariant> checked(entries.size());
    const auto check_from = [&](std::size_t first) {
        // Every thread writes to places of its own.
        for (std::size_t i = first; i < entries.size(); i += threads)
            checked[i] = checked_variant(entries[i], base, times);
    };
    std::vector<std::future<void>> others;
    for (std::size_t first = 1; first < threads; ++first)
        others.push_back(std::async(std::launch::async, check_from, first));
    check_from(0);
    for (std::future<void>& each : others) each.get();
    return checked;
}

/// Adds the warnings of all variants, each once, with the first variant and the number of variants.
void add_warnings(const std::vector<VariantEntry>& entries,
                  const std::vector<CheckedVariant>& checked, std::vector<Flag>& warnings) {
    struct Found {
        Flag flag;
        std::string first;
        std::size_t variants;
    };
    std::vector<Found> found;
    for (std::size_t i = 0; i < entries.size(); ++i)
        for (const Flag& flag : checked[i].warnings) {
            // The message may have numbers of the variant, so code and pointer decide.
            const auto known = std::ranges::find_if(found, [&](const Found& each) {
                return each.flag.code == flag.code && each.flag.pointer == flag.pointer;
            });
            if (known == found.end())
                found.push_back({flag, entries[i].name, 1});
            else
                ++known->variants;
        }
    for (Found& each : found) {
        std::string of = "variant \"" + each.first + "\"";
        if (each.variants > 1) of += " and " + std::to_string(each.variants - 1) + " more";
        each.flag.message = of + ": " + each.flag.message;
        each.flag.pointer = "/scene" + each.flag.pointer;
        warnings.push_back(std::move(each.flag));
    }
}

}  // namespace

std::vector<VariantEntry> own_variants(const json& document) {
    const json& entries = document["variants"];
    std::vector<VariantEntry> own;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        // Of a stored study: generated variants are added to the author's.
        if (entries[i].contains("made_by")) continue;
        const std::string at = "/variants/" + std::to_string(i);
        own.push_back({.name = entries[i].at("name"),
                       .overrides = entries[i].at("overrides"),
                       .name_pointer = at + "/name",
                       .pointer = at + "/overrides",
                       .made_by = ""});
    }
    return own;
}

void warn_about_overrides(const json& document, std::vector<Flag>& warnings) {
    const auto warn_about_one = [&](const std::vector<std::string>& overrides,
                                    const std::string& pointer) {
        std::map<std::string, std::string> values;
        for (const std::string& each : overrides) {
            const std::string entry = each.substr(0, each.find('='));
            const std::string value = each.substr(std::min(entry.size() + 1, each.size()));
            const auto [known, is_new] = values.try_emplace(entry, value);
            // An append may come twice.
            if (is_new || known->second == value || entry.ends_with("/-")) continue;
            warnings.push_back({"overridden_twice", fault::Severity::warning,
                                "sets " + entry + " to " + known->second + " and to " + value +
                                    ": the last value holds. Keep one of them",
                                pointer});
            known->second = value;
        }
    };
    warn_about_one(document["overrides"], "/overrides");
    std::map<std::vector<std::string>, std::string> names;
    for (const VariantEntry& each : own_variants(document)) {
        warn_about_one(each.overrides, each.pointer);
        const auto [known, is_new] = names.try_emplace(each.overrides, each.name);
        if (!is_new)
            warnings.push_back({"equal_variants", fault::Severity::warning,
                                "variants \"" + known->second + "\" and \"" + each.name +
                                    "\" have the same overrides, hence the same results. Leave one "
                                    "of them out",
                                each.pointer});
    }
}

std::vector<VariantEntry> wanted_variants(const json& document, Reach reach, const json& scene,
                                          std::vector<Fault>& faults) {
    constexpr std::size_t longest_name = 32;  // limit in the schema
    const Draws draws = draws_of(document);
    std::vector<VariantEntry> own = own_variants(document);
    if (draws.count == 1 || !can_redraw(draws.of, reach)) return own;
    if (own.empty())
        own.push_back({.name = "",
                       .overrides = {},
                       .name_pointer = "/draws",
                       .pointer = "/draws",
                       .made_by = ""});
    std::vector<VariantEntry> entries = repeated(own, draws, reach, scene);
    for (const VariantEntry& each : entries)
        if (each.name.size() > longest_name)
            faults.push_back({each.name_pointer,
                              "the name of its repeat, \"" + each.name + "\", is too long",
                              "give the variant a shorter name"});
    return entries;
}

json as_json(const std::vector<VariantEntry>& entries) {
    json list = json::array();
    for (const VariantEntry& each : entries) {
        list.push_back({{"name", each.name}, {"overrides", each.overrides}});
        if (!each.made_by.empty()) list.back()["made_by"] = each.made_by;
        if (!each.sample.is_null()) list.back()["sample"] = each.sample;
    }
    return list;
}

void keep_variants(const std::vector<VariantEntry>& entries, json& document) {
    document["variants"] = as_json(entries);
}

std::vector<Variant> checked_variants(const std::vector<VariantEntry>& entries, const Base& base,
                                      const std::vector<double>& times, std::vector<Fault>& faults,
                                      std::vector<Flag>& warnings) {
    if (entries.empty()) return {{.name = "", .overrides = {}, .scene = base.scene}};
    std::vector<Variant> variants;
    std::set<std::string> names;
    std::vector<CheckedVariant> checked = each_checked(entries, base, times);
    add_warnings(entries, checked, warnings);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const VariantEntry& entry = entries[i];
        if (!names.insert(entry.name).second) {
            faults.push_back({entry.name_pointer, "the name \"" + entry.name + "\" is given twice",
                              "give each variant a name of its own"});
        }
        for (const Fault& each : checked[i].faults) {
            const bool of_lattice = !entry.draws_pointer.empty() && is_lattice(each.pointer);
            const Fault fault{of_lattice ? entry.draws_pointer : entry.pointer,
                              each.pointer + ": " + each.cause,
                              each.remedy + (of_lattice ? "; or leave \"draws\" out" : "")};
            const bool told = std::ranges::any_of(faults, [&](const Fault& other) {
                return of_lattice && other.pointer == fault.pointer && other.cause == fault.cause;
            });
            if (!told) faults.push_back(fault);
        }
        variants.push_back({.name = entry.name,
                            .overrides = entry.overrides,
                            .scene = std::move(checked[i].scene)});
    }
    return variants;
}

}  // namespace breach::orchestrator
