#include "services/orchestrator/study/study.hpp"

#include <algorithm>
#include <cmath>
#include <future>
#include <iterator>
#include <set>
#include <thread>

#include "core/check/check.hpp"
#include "core/check/measured.hpp"
#include "core/criteria/expression.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/schema.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/study/checked_scene.hpp"
#include "services/orchestrator/study/recipe.hpp"
#include "services/orchestrator/study/sampled_variants.hpp"

namespace breach::orchestrator {

using fault::BadInput;
using fault::Fault;
using fault::Flag;
using nlohmann::json;

namespace {

constexpr std::size_t most_transfers = 10000;
constexpr double unknown_span = 1e9;  // of a FEM that could not be read [s]: nothing is too late
constexpr double microsecond = 1e-6;  // two times closer than this would share a snapshot's name

/// The double nearest to the spelt time: 0.1 + 0.2 becomes 0.3, so snapshot, override and row
/// agree.
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
    const double count = std::floor((to - from) / step + 1e-9) + 1;
    if (count > static_cast<double>(most_transfers)) {
        faults.push_back({"/transfer_times/step",
                          "the range holds more than " + std::to_string(most_transfers) + " times",
                          "give a larger step"});
        return {};
    }
    std::vector<double> times;
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
        faults.push_back({"/transfer_times", "the time " + spelt(*equal) + " s is given twice",
                          "give each transfer time once (they are told apart to 1e-6 s)"});
    }
    return times;
}

/// Length of the shaking and failure [s]: the clock of snapshots starts with the first dynamic
/// stage.
double dynamic_duration(const scene::Fem& fem) {
    double sum = 0.0;
    for (const scene::Stage& stage : fem.stages) sum += stage.duration;
    return sum;
}

void check_times(const std::vector<double>& times, const scene::Fem& fem,
                 std::vector<Fault>& faults) {
    if (times.empty()) return;
    const double end = dynamic_duration(fem);
    if (times.back() > end + microsecond) {
        faults.push_back({"/transfer_times",
                          "the transfer at " + spelt(times.back()) +
                              " s comes after the end of the dynamic stages at " + spelt(end) +
                              " s",
                          "transfer earlier or lengthen /scene/fem/stages"});
    }
}

void need_part(const json& scene, const std::string& part, std::vector<Fault>& faults) {
    if (scene.contains(part)) return;
    faults.push_back({"/scene/" + part, "a study needs this part of the scene, and it is missing",
                      "add \"" + part + "\" to the scene"});
}

/// What a scene lets be run: without a FEM the points fill the section; without points, too, there
/// is its stability.
Reach reach_of(const json& scene) {
    if (scene.contains(phases::fem.part)) return Reach::chain;
    if (scene.contains(phases::mpm.part)) return Reach::filled_mpm;
    return scene.contains(phases::lem.part) ? Reach::lem : Reach::chain;
}

/// The faults with their pointers moved below `prefix`.
void add_below(const std::string& prefix, const std::vector<Fault>& found,
               std::vector<Fault>& faults) {
    for (const Fault& each : found)
        faults.push_back({prefix + each.pointer, each.cause, each.remedy});
}

/// Whether the schema found nothing wrong at the entry or below it.
bool is_sound(const std::vector<Fault>& faults, const std::string& entry) {
    return std::ranges::none_of(faults, [&](const Fault& each) {
        return each.pointer == entry || each.pointer.starts_with(entry + "/");
    });
}

/// Fields that a condition asks for; none where it cannot be read, which is told elsewhere.
std::vector<std::string> fields_of(const std::string& condition) {
    try {
        return criteria::parse(condition, criteria::Kind::condition, "").fields;
    } catch (const BadInput&) {
        return {};
    }
}

/// Conditions on what this run's telemetry never holds.
void check_fields(const json& triggers, const scene::Scene& scene, bool stability,
                  std::vector<Fault>& faults) {
    const bool staged = stability && scene.lem && !scene.lem->liquefaction.empty();
    for (std::size_t i = 0; i < triggers.size(); ++i) {
        for (const char* key : {"when", "lower", "upper"}) {
            if (!triggers[i].contains(key)) continue;
            const std::string at = "/triggers/" + std::to_string(i) + "/" + key;
            const auto fields = fields_of(triggers[i][key].get<std::string>());
            std::ranges::move(check::unmeasured(fields, scene, at), std::back_inserter(faults));
            if (!staged && std::ranges::find(fields, "critical_depth") != fields.end())
                faults.push_back(
                    {at, "asks for critical_depth, which only a stability analysis in stages gives",
                     "give /scene/lem/liquefaction and leave \"stability\" on"});
        }
    }
}

/// What makes transfers happen: times, and triggers that watch the FEM for `span` [s].
void read_triggers(const json& document, double span, Study& study, std::vector<Fault>& faults) {
    const std::size_t before = faults.size();
    CheckedTriggers checked = check_triggers(document["triggers"], span, "/triggers", faults);
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
    if (study.reach != Reach::chain) return;
    if (faults.size() == before && study.transfer_times.empty() && document["triggers"].empty()) {
        faults.push_back({"/transfer_times", "nothing says when to transfer",
                          "give \"transfer_times\", \"triggers\" or both"});
    }
}

/// The study's scene with its own overrides: completed when it is sound, as it was sent otherwise.
struct Base {
    SentFiles files;
    json scene;
    std::vector<std::string> overrides;
    std::vector<Fault> faults;      ///< of the scene itself: a variant does not repeat them
    std::vector<Flag> warnings;     ///< likewise
    check::Recordings* recordings;  ///< read for one scene, known to the others
};

/// What a variant changes for the worse: faults that the scene itself does not have.
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

constexpr const char* kept_variants = "own_variants";  ///< of a study that all runs are draws of

/// Of this list, what the service has not made.
std::vector<VariantEntry> own_among(const json& entries, const std::string& pointer) {
    std::vector<VariantEntry> own;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (entries[i].contains("made_by")) continue;
        const std::string at = pointer + "/" + std::to_string(i);
        own.push_back({.name = entries[i].at("name"),
                       .overrides = entries[i].at("overrides"),
                       .name_pointer = at + "/name",
                       .pointer = at + "/overrides",
                       .made_by = ""});
    }
    return own;
}

/// Those that the study names itself; what the service made of it is made anew.
std::vector<VariantEntry> own_variants(const json& document) {
    std::vector<VariantEntry> own = own_among(document["variants"], "/variants");
    if (!own.empty() || document["variants"].empty() || !document.contains(kept_variants))
        return own;
    return own_among(document[kept_variants], std::string("/") + kept_variants);
}

/// On as many lattices as the study asks for.
std::vector<VariantEntry> wanted_variants(const json& document, Reach reach, const json& scene,
                                          std::vector<Fault>& faults) {
    constexpr std::size_t longest_name = 32;  // of the schema
    const Draws draws = draws_of(document);
    std::vector<VariantEntry> own = own_variants(document);
    if (draws.first == 0 && draws.count == 1) return own;
    if (!can_redraw(draws.of, reach)) {
        if (!document.contains("check")) check_draws(draws, reach, "", faults);
        return own;
    }
    const bool waits = std::ranges::any_of(
        document["triggers"], [](const json& each) { return each.value("kind", "") != "at_time"; });
    const std::string refusal(refusal_of_triggers(draws));
    if (!refusal.empty() && waits && !document.contains("check"))
        faults.push_back({"/draws_of", refusal,
                          "give \"transfer_times\", or leave \"draws_of\" out: draws of the "
                          "points share one FEM and its triggers"});
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

/// What is run, and beside it the study's own variants where none of them is run as it stands: what was
/// read of the study is read of it again.
void keep_variants(const std::vector<VariantEntry>& entries, json& document) {
    const std::vector<VariantEntry> own = own_variants(document);
    document["variants"] = as_json(entries);
    document.erase(kept_variants);
    if (!own.empty() && own_variants(document).empty()) document[kept_variants] = as_json(own);
}

/// One variant's scene as it was checked.
struct CheckedVariant {
    json scene;  ///< completed; null where it has faults
    std::vector<Fault> faults;
    std::vector<Flag> warnings;  ///< that the scene itself does not have
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

/// All of them, on several threads where they are many: no variant's check hangs on another's.
std::vector<CheckedVariant> each_checked(const std::vector<VariantEntry>& entries, const Base& base,
                                         const std::vector<double>& times) {
    constexpr std::size_t worth_a_thread = 50;
    const std::size_t threads = std::clamp<std::size_t>(
        std::min<std::size_t>(std::thread::hardware_concurrency(), entries.size() / worth_a_thread),
        1, 8);
    std::vector<CheckedVariant> checked(entries.size());
    const auto check_from = [&](std::size_t first) {
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

/// The warnings of all variants, each once, with the first variant that has it and how many do.
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

/// Each variant's scene, checked and completed; faults are those of its overrides.
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
                              each.remedy + (of_lattice ? "; or ask for no draws" : "")};
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

/// What a study of a scene without a FEM cannot ask for.
void check_without_fem(const json& document, Reach reach, std::vector<Fault>& faults) {
    const auto refuse = [&](const std::string& entry, const std::string& cause) {
        faults.push_back(
            {"/" + entry, cause, "leave \"" + entry + "\" out, or add \"fem\" to the scene"});
    };
    if (document.contains("transfer_times"))
        refuse("transfer_times", "the scene has no FEM, and nothing else is transferred");
    if (!document["triggers"].empty())
        refuse("triggers", "triggers watch a FEM, and the scene has none");
    if (reach == Reach::lem && !document["stability"].get<bool>())
        faults.push_back({"/stability", "the scene has nothing but a stability analysis to run",
                          "leave \"stability\" out, or add \"mpm\" to the scene"});
}

// ---------------------------------------------------------------- accuracy

/// What a study cannot be besides one that judges one setting's or one ladder's runout.
void check_one_state(const json& document, const std::string& judge, const Study& study,
                     std::vector<Fault>& faults) {
    if (!document["triggers"].empty())
        faults.push_back({"/triggers", judge + " judges one state, at one time",
                          "give one transfer time instead"});
    const std::size_t times = study.transfer_times.size();
    if (study.reach == Reach::chain && times > 1)
        faults.push_back({"/transfer_times",
                          judge + " judges one state, and there are " + std::to_string(times) +
                              " transfer times",
                          "give one time"});
    if (study.reach != Reach::chain && times > 0)
        faults.push_back({"/transfer_times", "nothing is transferred for this quantity",
                          "leave \"transfer_times\" out"});
}

/// What a blind check cannot have.
void check_blind(const json& document, const Study& study, std::vector<Fault>& faults) {
    if (!own_variants(document).empty())
        faults.push_back(
            {"/variants", "a blind check draws one setting", "put its changes into \"overrides\""});
    check_one_state(document, "a blind check", study, faults);
}

/// What a study cannot be besides an accuracy study.
void check_company(const json& document, const Study& study, std::vector<Fault>& faults) {
    if (!own_variants(document).empty())
        faults.push_back({"/variants", "an accuracy study makes its variants of its ladders",
                          "leave \"variants\" out: a ladder's rungs say what is changed"});
    for (const auto& [entry, none] : entries_of_no_draws().items())
        if (document[entry] != none)
            faults.push_back({std::string("/") + entry,
                              "an accuracy study has its own entry for repeats",
                              "give /accuracy/draws and /accuracy/draws_of"});
    if (document.contains("check"))
        faults.push_back({"/check", "a study measures or is checked, not both",
                          "leave \"check\" out, or give it in a study without \"accuracy\""});
    check_one_state(document, "an accuracy study", study, faults);
}

void check_time(const Quantity& quantity, const scene::Scene& scene, std::vector<Fault>& faults) {
    if (!quantity.time || !scene.fem) return;
    const double end = dynamic_duration(*scene.fem);
    if (*quantity.time > end + microsecond)
        faults.push_back({"/accuracy/quantity",
                          "the dynamic stages end at " + spelt(end) + " s, before this time",
                          "ask for an earlier time or lengthen /scene/fem/stages"});
}

/// A rung that changes nothing for the phases that give the quantity.
void check_rungs(const AccuracyPlan& plan, const std::vector<Setting>& settings,
                 const std::vector<Variant>& variants, std::vector<Fault>& faults) {
    const auto asked = [&](const Setting& setting) {
        const auto found = std::ranges::find(variants, setting.variants.front(), &Variant::name);
        std::vector<std::string> recipes;
        for (const phases::Phase& phase : phases_of(plan.quantity.reach))
            if (!found->scene.is_null())
                recipes.push_back(recipe_of(phase.program, found->scene, 0).hash);
        return recipes;
    };
    for (std::size_t i = 1; i < settings.size(); ++i) {
        const Setting& setting = settings[i];
        if (setting.step == 0) continue;
        const auto recipes = asked(setting);
        if (recipes.empty() || recipes != asked(settings[i - 1])) continue;
        std::string readers;
        for (const phases::Phase& each : phases_of(plan.quantity.reach))
            readers += (readers.empty() ? "" : ", ") + std::string(each.program);
        faults.push_back({"/accuracy/ladders/" + std::to_string(setting.ladder) + "/steps/" +
                              std::to_string(setting.step),
                          "the rung changes nothing that " + readers + " read" +
                              (readers.find(',') == std::string::npos ? "s" : "") +
                              ": it is the rung before it once more",
                          "change an entry that the quantity hangs on"});
    }
}

// ---------------------------------------------------------------- uncertainty

/// Of the phases that a sample runs; empty where a probe's scene has faults, which are told.
std::vector<std::string> recipes_of_probe(const Base& base, const std::vector<std::string>& probe,
                                          const std::vector<phases::Phase>& phases,
                                          std::vector<Fault>& found) {
    const check::Checked changed =
        check_sent_scene(base.scene, probe, base.files, *base.recordings);
    for (const Fault& each : changed.faults)
        found.push_back({"/uncertainty", each.pointer + ": " + each.cause, each.remedy});
    std::vector<std::string> recipes;
    if (!changed.faults.empty()) return recipes;
    for (const phases::Phase& each : phases)
        recipes.push_back(recipe_of(each.program, changed.completed, 0).hash);
    return recipes;
}

/// A parameter that changes nothing for any phase that runs would do nothing.
void check_parameters_are_read(const Study& study, const Base& base, std::vector<Fault>& faults) {
    std::vector<phases::Phase> phases = phases_of(study.reach);
    if (study.stability && study.reach != Reach::lem) phases.push_back(phases::lem);
    std::string readers;
    for (const phases::Phase& each : phases)
        readers += (readers.empty() ? "" : ", ") + std::string(each.program);
    std::vector<Fault> found;
    for (const ParameterProbe& probe : probes_of(*study.uncertainty, base.scene, study.reach)) {
        std::vector<std::vector<std::string>> recipes;
        for (const auto& each : probe.overrides) {
            recipes.push_back(recipes_of_probe(base, each, phases, found));
            if (recipes.back().empty()) break;
        }
        if (recipes.back().empty() ||
            std::ranges::adjacent_find(recipes, std::not_equal_to<>()) != recipes.end())
            continue;
        faults.push_back({"/uncertainty/parameters/" + std::to_string(probe.parameter),
                          "no phase that runs reads what \"" +
                              study.uncertainty->parameters[probe.parameter].name + "\" changes (" +
                              readers + " would run): it would do nothing",
                          "name an entry that one of them reads, or leave the parameter out"});
    }
    for (Fault& each : told_by_parameter(found, *study.uncertainty))
        faults.push_back(std::move(each));
}

/// Each sample is one state: more would be several results of one sample.
void check_state_of_samples(const Study& study, std::vector<Fault>& faults) {
    const std::size_t times = study.transfer_times.size();
    if (study.reach != Reach::chain) {
        if (times + study.triggers.size() > 0)
            faults.push_back({times > 0 ? "/transfer_times" : "/triggers",
                              "nothing is transferred for this quantity", "leave it out"});
        return;
    }
    const bool searches = std::ranges::any_of(
        study.triggers, [](const TriggerPlan& each) { return each.kind == "bisect"; });
    if (times + study.triggers.size() > 1 || searches)
        faults.push_back({times > 1 ? "/transfer_times" : "/triggers",
                          "each sample is transferred once, and this makes several transfers",
                          "give one time, or one trigger that fires once"});
}

/// Reads the plan, checks it, and makes the study's variants of its samples.
void take_samples(Study& study, json& document, const Base& base, std::vector<Fault>& faults) {
    const std::size_t before = faults.size();
    study.uncertainty = read_uncertainty(document["uncertainty"], base.scene, faults);
    const UncertaintyPlan& plan = *study.uncertainty;
    check_company_of_samples(document, plan, study.reach, faults);
    if (faults.size() > before) return;
    check_parameters_are_read(study, base, faults);
    if (faults.size() > before) return;
    json& entry = document["uncertainty"];
    if (entry.contains("target")) study.target = read_target(entry, plan, study.reach, faults);
    if (faults.size() > before) return;
    const std::vector<VariantEntry> entries =
        study.target ? variants_of(*study.target, plan, base.scene, study.reach)
                     : variants_of(plan, base.scene, study.reach);
    std::vector<Fault> found;
    study.variants = checked_variants(entries, base, study.transfer_times, found, study.warnings);
    for (Fault& each : told_by_parameter(found, plan)) faults.push_back(std::move(each));
    document["variants"] = as_json(entries);
    if (study.target) {
        entry["target"]["quantity"] = study.target->question.quantity;
        entry["target"]["draws"] = study.target->lattices;
        entry["target"]["values"] = study.target->values;
    }
    entry["drawn"] = study.target ? entries.size() : plan.drawn;
    entry["first_block"] = plan.first;
}

/// One fault instead of one per entry that a study lacks.
void refuse_scene(const json& document) {
    if (!document.is_object() || !document.contains("format") || !document["format"].is_string() ||
        !document["format"].get_ref<const std::string&>().starts_with("breachline-scene/"))
        return;
    throw BadInput("study", {{"/format", "is that of a scene; a study was expected",
                              "send {\"format\": \"breachline-study/1\", \"name\": ..., "
                              "\"transfer_times\": [...], \"scene\": this scene}"}});
}

std::map<std::string, Resources> wanted_resources(const json& entries) {
    std::map<std::string, Resources> wanted;
    for (const auto& [phase, ask] : entries.items())
        wanted[phase] = {.cores = ask.at("cores"), .memory_mb = ask.at("memory_MB")};
    return wanted;
}

}  // namespace

Study read_study(std::string_view text, const SentFiles& files) {
    return read_study_document(scene::parse_json(text, "study"), files);
}

Study read_study_document(json document, const SentFiles& files) {
    refuse_scene(document);
    const std::vector<Fault> of_study = scene::complete_and_check(document, scene::study_schema());
    std::vector<Fault> faults = of_study;
    const auto sound = [&](const char* entry) {
        return document.is_object() && document.contains(entry) &&
               is_sound(of_study, std::string("/") + entry);
    };
    if (document.is_object() && document.contains("scene") && document["scene"].is_string()) {
        faults.push_back(
            {"/scene", "a study sent to the service cannot name a scene file",
             "put the scene itself here (jq can: .scene = $scene[0]), or store it (POST "
             "/v1/scenes) and give scene:NAME"});
    }
    const bool repeats_are_sound = sound("variants") && sound("draws") && sound("first_draw") &&
                                   sound("draws_of") &&
                                   is_sound(of_study, std::string("/") + kept_variants);
    Study study;
    std::optional<AccuracyPlan> accuracy;
    std::optional<check::Checked> scene;
    check::Recordings recordings;
    Base base{files, {}, {}, {}, {}, &recordings};
    if (document.is_object() && document.contains("scene") && document["scene"].is_object()) {
        base.scene = std::move(document["scene"]);
        if (sound("overrides")) base.overrides = document["overrides"];
        if (sound("accuracy")) {
            accuracy = read_accuracy(document["accuracy"], base.scene, faults);
            study.reach = accuracy->quantity.reach;
        } else if (sound("uncertainty")) {
            study.reach =
                reach_of_samples(document["uncertainty"], base.scene, reach_of(base.scene), faults);
        } else if (sound("check") && repeats_are_sound) {
            study.reach =
                read_blind_check(document["check"], base.scene, draws_of(document), faults)
                    .quantity.reach;
        } else {
            study.reach = reach_of(base.scene);
        }
        for (const phases::Phase& phase : phases_of(study.reach))
            if (!phase.has_default_part) need_part(base.scene, phase.part, faults);
        scene = check_sent_scene(base.scene, base.overrides, files, recordings);
        base.faults = scene->faults;
        for (Flag each : scene->scene.warnings) {
            each.pointer = "/scene" + each.pointer;
            study.warnings.push_back(std::move(each));
        }
        add_below("/scene", scene->faults, faults);
        if (scene->faults.empty())
            base = {files, std::move(scene->completed), {},
                    {},    scene->scene.warnings,       &recordings};  // what variants change
    }
    const bool times_are_sound =
        document.is_object() && is_sound(of_study, "/transfer_times") && sound("triggers");
    const auto* fem = scene && scene->scene.fem ? &*scene->scene.fem : nullptr;
    if (times_are_sound && sound("uncertainty")) place_transfer(document, faults);
    if (times_are_sound) {
        read_triggers(document, fem ? dynamic_duration(*fem) : unknown_span, study, faults);
        if (fem) check_times(study.transfer_times, *fem, faults);
        if (fem && sound("stability"))
            check_fields(document["triggers"], scene->scene, document["stability"], faults);
        if (fem && fem->snapshot_interval > 0.0 && study.snapshot_interval > fem->snapshot_interval)
            study.snapshot_interval = 0.0;  // the scene's own are finer
    }
    const bool rungs_are_sound = std::ranges::none_of(
        faults, [](const Fault& each) { return each.pointer.starts_with("/accuracy"); });
    if (accuracy && scene && times_are_sound && repeats_are_sound) {
        check_company(document, study, faults);
        check_time(accuracy->quantity, scene->scene, faults);
    } else if (scene && times_are_sound && repeats_are_sound && sound("check")) {
        check_blind(document, study, faults);
    }
    const bool samples = document.contains("uncertainty");
    const bool judged = samples || document.contains("accuracy") || document.contains("check");
    if (!judged && times_are_sound && sound("stability") && study.reach != Reach::chain)
        check_without_fem(document, study.reach, faults);
    if (scene && sound("stability"))
        study.stability =
            study.reach == Reach::lem ||
            (!accuracy && document["stability"].get<bool>() && scene->scene.lem.has_value());
    if (samples && times_are_sound) check_state_of_samples(study, faults);
    if (samples && sound("uncertainty") && sound("overrides") && repeats_are_sound &&
        faults.empty())
        take_samples(study, document, base, faults);
    if (!samples && scene && repeats_are_sound && rungs_are_sound) {
        const std::vector<VariantEntry> entries =
            accuracy ? variants_of(*accuracy, base.scene)
                     : wanted_variants(document, study.reach, base.scene, faults);
        const bool late = fem && !study.transfer_times.empty() &&
                          study.transfer_times.back() > dynamic_duration(*fem) + microsecond;
        study.variants =
            checked_variants(entries, base, late ? std::vector<double>{} : study.transfer_times,
                             faults, study.warnings);
        if (study.variants.size() * study.transfer_times.size() > most_transfers) {
            faults.push_back(
                {"/variants",
                 "variants times transfer times are more than " + std::to_string(most_transfers),
                 "split the study"});
        }
        keep_variants(entries, document);
        if (accuracy)
            check_rungs(*accuracy, settings_of(*accuracy, base.scene), study.variants, faults);
    }
    if (!faults.empty()) throw BadInput("study", std::move(faults));

    study.scene = std::move(base.scene);
    study.name = document["name"];
    study.title = document["title"];
    study.resources = wanted_resources(document["resources"]);
    study.priority = document["priority"];
    study.reuse = document["reuse"];
    if (document.contains("budget")) study.budget = document["budget"]["cpu_seconds"];
    document.erase("scene");
    study.document = std::move(document);
    return study;
}

WholeScene read_whole_scene(std::string_view text, const SentFiles& files) {
    check::Checked checked = check_sent_scene(scene::parse_json(text, "scene"), {}, files);
    if (!checked.faults.empty()) throw BadInput("scene", checked.faults);
    return {std::move(checked.completed), std::move(checked.scene.warnings)};
}

}  // namespace breach::orchestrator
