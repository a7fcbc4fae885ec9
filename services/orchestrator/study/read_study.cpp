// From the sent document to a Study, or all its faults at once. Called for submissions, previews
// and extensions, on the request's thread; extensions read the stored document again, so a stored
// study must stay readable.
#include "services/orchestrator/study/read_study.hpp"

#include <algorithm>

#include "core/check/check.hpp"
#include "core/scene/scene.hpp"
#include "core/scene/schema.hpp"
#include "services/orchestrator/records/identity.hpp"
#include "services/orchestrator/study/checked_scene.hpp"
#include "services/orchestrator/study/conflicts.hpp"
#include "services/orchestrator/study/recipe.hpp"
#include "services/orchestrator/study/sampled_variants.hpp"
#include "services/orchestrator/study/transfers.hpp"
#include "services/orchestrator/study/variants.hpp"

namespace breach::orchestrator {

using fault::BadInput;
using fault::Fault;
using fault::Flag;
using nlohmann::json;

namespace {

constexpr std::size_t most_transfers = 10000;

/// Parts with a default ("transfer") are completed instead.
void need_part(const json& scene, const std::string& part, std::vector<Fault>& faults) {
    if (scene.contains(part)) return;
    faults.push_back({"/scene/" + part, "a study needs this part of the scene, and it is missing",
                      "add \"" + part + "\" to the scene"});
}

/// Phases that a scene allows: without a FEM the points fill the section; without material points
/// too, only the stability analysis.
/// A scene without any of them is read as a chain, whose missing parts are then reported.
Reach reach_of(const json& scene) {
    if (scene.contains(phases::fem.part)) return Reach::chain;
    if (scene.contains(phases::mpm.part)) return Reach::filled_mpm;
    return scene.contains(phases::lem.part) ? Reach::lem : Reach::chain;
}

/// Adds the faults with `prefix` before their pointers.
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

void check_time(const Quantity& quantity, const scene::Scene& scene, std::vector<Fault>& faults) {
    if (!quantity.time || !scene.fem) return;
    if (is_late(*quantity.time, *scene.fem))
        faults.push_back(
            {"/accuracy/quantity",
             "the dynamic stages end at " + spelt(scene.fem->duration()) + " s, before this time",
             "ask for an earlier time or lengthen /scene/fem/stages"});
}

/// Faults of rungs that change nothing for the phases of the quantity.
/// By recipes, not by scenes: an entry that the phases do not read changes the scene alone.
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
                          "change an entry that affects the quantity"});
    }
}

/// Recipes of a sample's phases; empty: the probe's scene has faults, which are added to `found`.
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

/// A parameter without effect would show up as an importance of 0, and its author would take it for
/// a finding.
void check_parameters_are_read(const Study& study, const Base& base, std::vector<Fault>& faults) {
    std::vector<phases::Phase> phases = phases_of(study.reach);
    // A parameter may matter to the stability analysis only.
    if (study.stability && study.reach != Reach::lem) phases.push_back(phases::lem);
    if (study.post_seismic) phases.push_back(phases::post_seismic);
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
    for (Fault& each : faults_by_parameter(found, *study.uncertainty))
        faults.push_back(std::move(each));
}

/// Reads the plan, checks it, and makes the samples the study's variants.
/// Each step needs the one before it without faults: samples of a wrong distribution would give a
/// fault in every variant.
void take_samples(Study& study, json& document, const Base& base, std::vector<Fault>& faults) {
    const std::size_t before = faults.size();
    study.uncertainty = read_uncertainty(document["uncertainty"], base.scene, faults);
    const UncertaintyPlan& plan = *study.uncertainty;
    check_parameters(document, plan, study.reach, faults);
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
    for (Fault& each : faults_by_parameter(found, plan)) faults.push_back(std::move(each));
    document["variants"] = as_json(entries);
    if (study.target) {
        entry["target"]["quantity"] = study.target->question.quantity;
        entry["target"]["draws"] = study.target->lattices;
        entry["target"]["values"] = study.target->values;
    }
    // Written back, so that reading the stored study again gives the same samples (first_block:
    // they depend on the size of the first hypercube).
    entry["drawn"] = study.target ? entries.size() : plan.drawn;
    entry["first_block"] = plan.first;
}

/// One fault for a scene instead of one per missing entry of a study.
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

/// Reads a study in steps. Each step adds its faults, and skips entries that the schema or an
/// earlier step found faulty.
class StudyReader {
  public:
    StudyReader(json document, const SentFiles& files)
        : document_(std::move(document)), base_{files, {}, {}, {}, {}, &recordings_} {
        // Before the schema: a scene in place of a study would lack every entry of one.
        refuse_scene(document_);
        // Kept apart from faults_: sound() asks it for single entries while faults_ grows.
        of_schema_ = scene::complete_and_check(document_, scene::study_schema(), "study");
        faults_ = of_schema_;
        if (document_.is_object()) kind_ = kind_of(document_);
        repeats_are_sound_ = sound("variants") && sound("draws") && sound("draws_of");
        times_are_sound_ =
            document_.is_object() && is_sound(of_schema_, "/transfer_times") && sound("triggers");
    }

    /// The order is that of dependence: the scene decides the phases, these decide which entries
    /// may stand together, and all of it decides what variants are.
    Study read() {
        read_scene();
        read_transfers();
        refuse_what_conflicts();
        if (scene_ && sound("stability")) study_.stability = wants_stability();
        if (scene_ && sound("post_seismic")) study_.post_seismic = wants_post_seismic();
        switch (kind_) {
            case Kind::sweep:
                read_sweep();
                break;
            case Kind::accuracy:
                read_ladders();
                break;
            case Kind::uncertainty:
                read_samples();
                break;
        }
        if (!faults_.empty()) throw BadInput("study", std::move(faults_));
        return finished();
    }

  private:
    /// Entries that the schema refused are not read, since at() and get() would throw.
    bool sound(const char* entry) const {
        return document_.is_object() && document_.contains(entry) &&
               is_sound(of_schema_, std::string("/") + entry);
    }
    const scene::Fem* fem() const { return scene_ && scene_->fem ? &*scene_->fem : nullptr; }

    /// The phases of the study's tasks, by its kind.
    Reach reach() {
        const Reach of_scene = reach_of(base_.scene);
        if (kind_ == Kind::accuracy && sound("accuracy")) {
            accuracy_ = read_accuracy(document_["accuracy"], base_.scene, faults_);
            return accuracy_->quantity.reach;
        }
        if (kind_ == Kind::uncertainty && sound("uncertainty"))
            return reach_of_samples(document_["uncertainty"], base_.scene, of_scene, faults_);
        return of_scene;
    }

    void read_scene() {
        if (!document_.is_object() || !document_.contains("scene")) return;
        if (document_["scene"].is_string())
            faults_.push_back({"/scene", "a study sent to the service cannot name a scene file",
                               "put the scene itself here (jq can: .scene = $scene[0])"});
        if (!document_["scene"].is_object()) return;
        base_.scene = std::move(document_["scene"]);
        if (sound("overrides")) base_.overrides = document_["overrides"];
        study_.reach = reach();
        for (const phases::Phase& phase : phases_of(study_.reach))
            if (!phase.has_default_part) need_part(base_.scene, phase.part, faults_);
        check::Checked checked =
            check_scene_of_study("/scene", base_.scene, base_.overrides, base_.files, recordings_);
        add_below("/scene", checked.faults, faults_);
        base_.faults = std::move(checked.faults);
        base_.warnings = checked.scene.warnings;
        for (Flag each : base_.warnings) {
            each.pointer = "/scene" + each.pointer;
            study_.warnings.push_back(std::move(each));
        }
        // Variants then start from the completed scene: their overrides find every entry, defaults
        // included.
        if (base_.faults.empty()) {  // changes by variants
            base_.scene = std::move(checked.completed);
            base_.overrides.clear();
        }
        scene_ = std::move(checked.scene);
    }

    void read_transfers() {
        if (!times_are_sound_) return;
        if (kind_ == Kind::uncertainty && sound("uncertainty")) place_transfer(document_, faults_);
        orchestrator::read_transfers(document_, fem(), study_, faults_);
        if (fem() && sound("stability"))
            check_fields(document_["triggers"], *scene_, document_["stability"],
                         sound("post_seismic") && document_["post_seismic"].get<bool>(), faults_);
    }

    void refuse_what_conflicts() {
        if (!scene_ || !times_are_sound_ || !repeats_are_sound_ || !sound("stability")) return;
        const bool bisects = std::ranges::any_of(
            study_.triggers, [](const TriggerPlan& each) { return each.kind == "bisect"; });
        refuse_conflicts({document_, kind_, study_.reach, study_.transfer_times.size(),
                          study_.triggers.size(), bisects, draws_of(document_)},
                         faults_);
    }

    /// An accuracy study has one quantity and computes nothing beside it.
    bool wants_stability() const {
        if (study_.reach == Reach::lem) return true;
        return kind_ != Kind::accuracy && document_["stability"].get<bool>() &&
               scene_->lem.has_value();
    }

    bool wants_post_seismic() {
        if (!document_["post_seismic"].get<bool>()) return false;
        if (study_.reach == Reach::chain && scene_->lem) return true;
        faults_.push_back({"/post_seismic",
                           study_.reach == Reach::chain
                               ? "needs the slip surfaces of /scene/lem"
                               : "needs snapshots of a FEM that is transferred",
                           "give both in the scene, or leave \"post_seismic\" out"});
        return false;
    }

    void read_sweep() { take_variants(); }

    void read_ladders() {
        if (!accuracy_ || !scene_ || !repeats_are_sound_) return;
        const bool rungs_are_sound = std::ranges::none_of(
            faults_, [](const Fault& each) { return each.pointer.starts_with("/accuracy"); });
        if (times_are_sound_) check_time(accuracy_->quantity, *scene_, faults_);
        if (!rungs_are_sound) return;
        take_variants();
        check_rungs(*accuracy_, settings_of(*accuracy_, base_.scene), study_.variants, faults_);
    }

    void read_samples() {
        if (sound("uncertainty") && sound("overrides") && repeats_are_sound_ && faults_.empty())
            take_samples(study_, document_, base_, faults_);
    }

    void take_variants() {
        if (!scene_ || !repeats_are_sound_) return;
        const std::vector<VariantEntry> entries =
            accuracy_ ? variants_of(*accuracy_, base_.scene)
                      : wanted_variants(document_, study_.reach, base_.scene, faults_);
        if (sound("overrides")) warn_about_overrides(document_, study_.warnings);
        check_lines(*scene_, study_, faults_);
        const std::vector<double>& times = study_.transfer_times;
        // The study has that fault once already; each variant would repeat it.
        const bool late = fem() && !times.empty() && is_late(times.back(), *fem());
        study_.variants = checked_variants(entries, base_, late ? std::vector<double>{} : times,
                                           faults_, study_.warnings);
        if (study_.variants.size() * times.size() > most_transfers)
            faults_.push_back(
                {"/variants",
                 "variants times transfer times are more than " + std::to_string(most_transfers),
                 "split the study"});
        keep_variants(entries, document_);
    }

    Study finished() {
        study_.scene = std::move(base_.scene);
        study_.name = document_["name"];
        study_.title = document_["title"];
        study_.resources = wanted_resources(document_["resources"]);
        study_.priority = document_["priority"];
        study_.reuse = document_["reuse"];
        // The store keeps it in a column of its own, for it is large.
        document_.erase("scene");
        study_.document = std::move(document_);
        return std::move(study_);
    }

    json document_;
    check::Recordings recordings_;
    Base base_;
    std::vector<Fault> of_schema_;
    std::vector<Fault> faults_;
    Kind kind_ = Kind::sweep;
    bool repeats_are_sound_ = false;
    bool times_are_sound_ = false;
    Study study_;
    std::optional<scene::Scene> scene_;  ///< valid parts
    std::optional<AccuracyPlan> accuracy_;
};

}  // namespace

Study read_study(std::string_view text, const SentFiles& files) {
    return read_study_document(scene::parse_json(text, "study"), files);
}

Study read_study_document(json document, const SentFiles& files) {
    return StudyReader(std::move(document), files).read();
}

WholeScene read_whole_scene(const json& document, const SentFiles& files) {
    check::Checked checked = check_sent_scene(document, {}, files);
    if (!checked.faults.empty()) throw BadInput("scene", checked.faults);
    return {std::move(checked.completed), std::move(checked.scene.warnings)};
}

}  // namespace breach::orchestrator
