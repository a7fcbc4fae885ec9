// Questions of a reviewer of a deformation analysis (after Boulanger & Beaty 2016 and USSD 2022),
// answered from the run.
#include <set>

#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

constexpr const char* none = "not modelled";

json at(const json& document, const char* pointer) {
    return document.is_object() ? document.value(json::json_pointer(pointer), json()) : json();
}

std::string three_digits(const json& result, const char* pointer) {
    const json value = at(result, pointer);
    return value.is_number() ? rounded(value.get<double>(), 3) : "-";
}

std::string word(const json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Flags of the phases with one of these codes.
std::string flagged(const Run& run, const std::set<std::string>& codes) {
    std::string found;
    std::set<std::string> said;
    for (const PhaseFolder& each : run.phases)
        for (const json& flag :
             each.result.is_object() ? each.result.value("flags", json::array()) : json::array())
            if (codes.contains(flag.at("code")) && said.insert(flag.at("code")).second)
                found +=
                    (found.empty() ? "; flagged: " : ", ") + flag.at("code").get<std::string>();
    return found;
}

std::string laws_of(const json& scene) {
    std::map<std::string, std::string> by_law;
    const json materials = scene.value("materials", json::object());
    for (const auto& [name, material] : materials.items()) {
        std::string& names = by_law[word(at(material, "/law/type"))];
        names += (names.empty() ? "" : ", ") + name;
    }
    std::string text;
    for (const auto& [law, names] : by_law)
        text += (text.empty() ? "" : "; ") + law + " (" + names + ")";
    return text;
}

/// Questions and answers; a missing phase answers "not modelled".
class Checklist {
  public:
    explicit Checklist(const Material& from)
        : run_(from.run),
          has_element_tests_(!from.choice.element_tests.empty()),
          lem_(phase_named(run_, phases::lem.program)),
          fem_(phase_shown(run_, phases::fem.program)),
          mpm_(farthest_runout(run_)) {}

    Table table() {
        ask("Which laws do the soils have?", laws_of(run_.scene));
        ask("Does limit equilibrium agree that it can fail?", stability());
        ask("How fine is the mesh?", mesh());
        ask("What are the boundaries at the sides and below?", boundaries());
        ask("What damps, and how much does it carry?", damping());
        ask("What are the initial stresses?", initial_stress());
        ask("Does pore water flow?", water());
        ask("Was the soil calibrated on elements?",
            has_element_tests_
                ? "see the chapter on element tests"
                : "not shown here: --element-tests FOLDER adds the laboratory's curves");
        ask("Which motion, and how many?", motion());
        ask("What gives softening its length?", softening());
        ask("Why was it transferred when it was?", transfer());
        ask("How fine is the runout, and what does its scheme take?", runout());
        ask("How far may the runout be off?", error());
        ask("What is left out?",
            "a plane section: no third dimension, no channel; no mixing with water on the way; no "
            "consolidation while it flows; no water of the pond");
        return std::move(table_);
    }

  private:
    void ask(const char* question, const std::string& answer) {
        table_.rows.push_back({question, answer.empty() ? none : answer});
    }

    std::string stability() const {
        if (!lem_ || !lem_->result.is_object()) return "";
        return "factor of safety " + three_digits(lem_->result, "/factor_of_safety") +
               " before anything liquefies" +
               (at(lem_->result, "/critical_depth").is_number()
                    ? ", critical depth " + three_digits(lem_->result, "/critical_depth") + " m"
                    : "") +
               flagged(run_, {"bound_raises_factor"});
    }
    std::string mesh() const {
        if (!fem_ || !fem_->result.is_object()) return "";
        return fact(fem_->result, "/elements") + " elements " +
               word(at(fem_->scene, "/fem/element")) + ", edges of " +
               three_digits(fem_->result, "/mesh/shortest_edge") + " to " +
               three_digits(fem_->result, "/mesh/longest_edge") + " m, smallest angle " +
               three_digits(fem_->result, "/mesh/smallest_angle_deg") + " degrees";
    }
    std::string boundaries() const {
        if (!fem_) return "";
        const json base = at(fem_->scene, "/fem/base");
        return std::string(at(fem_->scene, "/fem/free_field").is_object() ? "free-field columns"
                                                                          : "held edges") +
               " at the sides; " +
               (base.is_object()
                    ? "below, rock of V_s " + word(base.at("V_s")) + " m/s with dashpots"
                    : "a held base") +
               flagged(run_, {"upstream_wall", "reached_wall", "free_upstream_end"});
    }
    std::string damping() const {
        if (!fem_) return "";
        const json wanted = at(fem_->scene, "/fem/damping");
        const std::string share = at(fem_->result, "/viscous_share").is_number()
                                      ? "; in the failing soil it carries " +
                                            three_digits(fem_->result, "/viscous_share") +
                                            " of what the soil does"
                                      : "";
        return (wanted.is_object() ? "Rayleigh, ratio " + word(wanted.value("ratio", json())) +
                                         " at " + word(wanted.value("frequency_Hz", json())) + " Hz"
                                   : "stiffness-proportional, beta " +
                                         word(at(fem_->scene, "/fem/rayleigh_stiffness")) + " s") +
               share + flagged(run_, {"viscous_band"});
    }
    std::string initial_stress() const {
        const json stages = fem_ ? at(fem_->result, "/geostatic") : json();
        if (!stages.is_object() || stages.empty()) return "";
        std::string text;
        for (const auto& [name, stage] : stages.items())
            text += (text.empty() ? "" : "; ") + name + ": K " + three_digits(stage, "/K_average") +
                    " on average, out of balance " + three_digits(stage, "/out_of_balance");
        return text;
    }
    std::string water() const {
        if (!fem_) return "";
        if (!at(fem_->scene, "/fem/water").is_object()) return "dry";
        return "pressure and displacement together, " + fact(fem_->result, "/pressure_unknowns") +
               " pressures" +
               (at(fem_->result, "/largest_liquefaction_depth").is_number()
                    ? "; liquefied to " +
                          three_digits(fem_->result, "/largest_liquefaction_depth") + " m"
                    : "");
    }
    std::string motion() const {
        if (!fem_ || !at(fem_->result, "/motion").is_object()) return is_static(run_) ? "" : "none";
        std::set<std::string> files;
        for (const PhaseFolder* each : phases_named(run_, phases::fem.program))
            if (at(each->scene, "/fem/motion/file").is_string())
                files.insert(at(each->scene, "/fem/motion/file"));
        return word(at(fem_->result, "/motion/file")) + ": PGA " +
               three_digits(fem_->result, "/motion/pga_g") + " g, PGV " +
               three_digits(fem_->result, "/motion/pgv") + " m/s; " + std::to_string(files.size()) +
               " record(s) in the run";
    }
    std::string softening() const {
        std::string lengths;
        const json materials = run_.scene.value("materials", json::object());
        for (const auto& [name, material] : materials.items())
            if (at(material, "/nonlocal_length").is_number())
                lengths += (lengths.empty() ? "" : ", ") + name + " " +
                           word(material.at("nonlocal_length")) + " m";
        return (lengths.empty() ? "nothing: bands are as wide as a cell" : lengths) +
               flagged(run_, {"local_softening", "wide_band"});
    }
    std::string transfer() const {
        if (is_static(run_)) return "";
        std::string text;
        const json study = run_.study.is_object() ? run_.study : json::object();
        for (const json& each : study.value("triggers", json::array()))
            text += (text.empty() ? "" : "; ") + each.value("name", each.value("kind", ""));
        const std::size_t times = study.value("transfer_times", json::array()).size();
        if (times > 0) text += (text.empty() ? "" : "; ") + std::to_string(times) + " given times";
        return (text.empty() ? "not known: the run has no study" : text);
    }
    std::string runout() const {
        if (!mpm_) return "";
        return "cells of " + word(at(mpm_->scene, "/mpm/cell_size")) + " m, " +
               fact(mpm_->result, "/particles") + " points; overlap " +
               three_digits(mpm_->result, "/overlap") + ", energy that the scheme took " +
               three_digits(mpm_->result, "/energy/numerical/share") + " of what was released" +
               flagged(run_, {"coarse_cells", "thin_deposit", "overlap", "overlap_work",
                              "numerical_share"});
    }
    std::string error() const {
        if (!mpm_) return "";
        if (!mpm_->runout_error)
            return "no estimate" +
                   (mpm_->runout_error_from.empty() ? "" : ": " + mpm_->runout_error_from);
        return rounded(*mpm_->runout_error, 3) + " m, from " + mpm_->runout_error_from;
    }

    const Run& run_;
    bool has_element_tests_;
    const PhaseFolder* lem_;
    const PhaseFolder* fem_;
    const PhaseFolder* mpm_;
    Table table_{"checklist",
                 "What a reviewer asks",
                 {"question", "answer of this run"},
                 {},
                 "After the subjects of Boulanger & Beaty (2016) and USSD (2022). Of several "
                 "analyses, the one that is shown; of runouts, the farthest."};
};

}  // namespace

void add_checklist(const Material& from, Document& document) {
    Chapter chapter{"What a reviewer asks"};
    chapter.tables.push_back(Checklist(from).table());
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
