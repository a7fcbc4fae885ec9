// The rules of docs/reference/methods/lem.md, *Which factor counts*: candidates_of collects all
// factors with the reasons against them, least_of decides.
#include "lem_tool/answer.hpp"

#include <algorithm>
#include <cmath>

#include "core/words/number.hpp"
#include "core/words/remedy.hpp"
#include "lem_tool/facts.hpp"
#include "lem_tool/non_circular.hpp"
#include "lem_tool/weak_layers.hpp"

namespace breach::lem {

using nlohmann::json;

namespace {

/// Usual relative difference of factors between surfaces.
constexpr double telling_difference = 0.03;

/// The schema's default, for the polyline that is searched without request.
constexpr int usual_vertices = 13;

std::string with_polyline() {
    return words::set("/lem/non_circular", "{\"vertices\":" + std::to_string(usual_vertices) + "}");
}

/// A factor of safety and whether it is valid.
struct Candidate {
    double factor;
    std::string method;
    std::string surface;  ///< its key in the result, "circle" for Bishop's
    std::string invalid;  ///< reason; empty: valid
    bool kinked_without_friction;
};

std::string name_of(const std::string& surface) { return surface == "circle" ? "bishop" : surface; }

std::string small_m_alpha(double least) {
    if (least >= least_m_alpha) return "";
    return words::formatted("m_alpha of a slice is %.3g, below %g", least, least_m_alpha);
}

void add_candidates(const std::string& surface, const json& facts, std::vector<Candidate>& all) {
    if (facts.is_null()) return;
    all.push_back({facts.at("factor_of_safety"), facts.at("method"), surface,
                   small_m_alpha(facts.at("least_m_alpha")), false});
    if (facts.contains("points")) {
        all.back().kinked_without_friction = kinks_without_friction(facts);
        if (all.back().kinked_without_friction)
            all.back().invalid = "its mass shears within itself in soil without friction";
        return;
    }
    const json& spencer = facts.at("spencer");
    if (spencer.is_null()) return;
    Candidate rigorous{spencer.at("factor_of_safety"), "spencer", surface,
                       small_m_alpha(spencer.at("least_m_alpha")), false};
    // Spencer's moments balance about any point; Bishop's do so on the arc only, where normal
    // forces have no moment.
    if (facts.value("follows_floor", false) && rigorous.invalid.empty())
        all.back().invalid =
            "off the arc Bishop's moments depend on the circle's centre, and Spencer's method has "
            "an answer there";
    all.push_back(std::move(rigorous));
}

std::vector<Candidate> candidates_of(const json& parts) {
    std::vector<Candidate> all;
    // In this order: of equal factors the circle's counts.
    for (const char* surface :
         {"circle", "composite", "given_circle", "non_circular", "given_polyline"})
        add_candidates(surface, parts.value(name_of(surface), json()), all);
    return all;
}

/// The least valid one; if none is valid, the least.
const Candidate& least_of(const std::vector<Candidate>& all) {
    return *std::ranges::min_element(all, [](const Candidate& a, const Candidate& b) {
        // Without a valid one a number is still given, and flags_of_answer says why it does not
        // count.
        if (a.invalid.empty() != b.invalid.empty()) return a.invalid.empty();
        return a.factor < b.factor;
    });
}

double lowest_of(const json& facts) {
    const double F = facts.at("factor_of_safety");
    const json& spencer = facts.at("spencer");
    return spencer.is_null() ? F : std::min(F, spencer.at("factor_of_safety").get<double>());
}

bool asks_for_polyline(const scene::Lem& lem) {
    return lem.non_circular && lem.non_circular->vertices > 0;
}

/// The least composite surface; null if there is none.
json least_composite(const std::vector<Searched>& composites) {
    json least;
    for (const Searched& each : composites) {
        json facts = facts_of(each);
        if (least.is_null() || lowest_of(facts) < lowest_of(least)) least = std::move(facts);
    }
    return least;
}

/// Facts of the critical surface, with those of an arc also for a polyline.
json front_of(const Candidate& least, const json& facts) {
    json front = facts;
    front["factor_of_safety"] = least.factor;
    front["method"] = least.method;
    front["surface"] = least.surface;
    if (!facts.contains("points")) return front;
    front.erase("start_factor_of_safety");
    front["spencer"] = {{"factor_of_safety", facts.at("factor_of_safety")},
                        {"interslice_inclination", facts.at("interslice_inclination")},
                        {"least_m_alpha", facts.at("least_m_alpha")}};
    front["spencer_reason"] = "";
    front["ordinary"] = nullptr;
    return front;
}

}  // namespace

std::string in_words(const std::string& surface) {
    if (surface == "circle") return "the critical circle";
    if (surface == "composite") return "the surface along the thin weak layer";
    if (surface == "given_circle") return "the given circle";
    if (surface == "given_polyline") return "the given surface of straight pieces";
    return "the optimised surface of straight pieces";
}

json facts_of(const Searched& searched) {
    Slices slices = make_slices(searched.model.strata, searched.model.slices);
    json facts = facts_of(searched.model, *searched.found.critical, slices);
    for (const scene::Vec2& p : searched.floor) facts["floor"].push_back({p.x(), p.y()});
    facts["follows_floor"] =
        std::find(slices.stands_on.begin(),
                  slices.stands_on.begin() + static_cast<std::ptrdiff_t>(slices.count),
                  Base::straight) !=
        slices.stands_on.begin() + static_cast<std::ptrdiff_t>(slices.count);
    if (std::isfinite(searched.found.error)) facts["search_error"] = searched.found.error;
    const Crack& crack = searched.model.strata.crack;
    if (crack.reach == Crack::Reach::none) return facts;
    const double whole = searched.factor_with_whole_crack;
    facts["tension_crack"] = {
        {"share", crack.share},
        {"tension_zone", tension_zone(searched.model, searched.found.critical->surface)},
        {"factor_of_safety_whole", std::isfinite(whole) ? json(whole) : json()}};
    return facts;
}

const Searched& Families::least() const {
    const Searched* best = &circles;
    for (const Searched& each : composites)
        if (each.factor() < best->factor()) best = &each;
    return *best;
}

Families search_families(const scene::Scene& scene, const Model& model,
                         const scene::SlipSearch& ranges, int threads) {
    const auto look = [&](const Model& each, Effort effort) {
        return search(each, ranges, threads, effort);
    };
    Families families{with_worst_crack(model, {}, look), {}};
    // The floor forces circles to follow the layer: alone, a circle hardly uses it.
    for (const Path& line : weak_lines(model, ranges)) {
        const Path floor = higher(line, scene.lem->floor);
        Searched along = with_worst_crack(over_floor(scene, model, floor), floor, look);
        if (along.found.critical) families.composites.push_back(std::move(along));
    }
    return families;
}

Families given_family(const scene::Scene& scene, const Model& model) {
    Slices slices = make_slices(model.strata, model.slices);
    std::optional<fault::BadInput> refused;
    const auto look = [&](const Model& each, Effort) {
        SearchResult result;
        try {
            result.critical = analyse_circle(scene, each, slices);
            result.tally.analysed = 1;
        } catch (const fault::BadInput& fault) {
            // The look is repeated with cracks of other depths: the first refusal is that of the
            // scene as given.
            if (!refused) refused = fault;
        }
        return result;
    };
    Families families{with_worst_crack(model, {}, look), {}};
    if (!families.circles.found.critical) throw fault::BadInput(*refused);
    return families;
}

/// Starts from wedges, the critical circle and every weak layer's surface; with the requested or
/// default number of vertices.
static json polyline_of(const scene::Scene& scene, const Families& families) {
    scene::Scene bent = scene;
    if (!asks_for_polyline(*scene.lem))
        bent.lem->non_circular = scene::NonCircular{{}, usual_vertices};
    // Under a weak layer's own floor a polyline could not leave the layer downwards.
    Model model = families.circles.model;
    model.strata.crack.share = families.least().model.strata.crack.share;
    std::vector<Start> starts{{model.strata, families.circles.found.critical->surface}};
    for (const Searched& each : families.composites)
        starts.push_back({each.model.strata, each.found.critical->surface});
    return optimised_polyline(bent, model, starts);
}

json answer(const scene::Scene& scene, const Families& families, const json& given) {
    const scene::Lem& lem = *scene.lem;
    json parts = given;
    parts["bishop"] = facts_of(families.circles);
    if (!families.composites.empty()) parts["composite"] = least_composite(families.composites);
    // An arc crosses a thin weak layer at one angle only, a polyline at those of least resistance.
    // Circles along thin seams had factors up to 9 % above those of wedges drawn by hand.
    if (asks_for_polyline(lem) || !families.composites.empty())
        parts["non_circular"] = polyline_of(scene, families);
    const auto all = candidates_of(parts);
    const Candidate& least = least_of(all);
    json result = front_of(least, parts.at(name_of(least.surface)));
    result.update(parts);
    return result;
}

std::vector<fault::Flag> flags_of_weak_layer(const scene::Scene& scene, const Families& families,
                                             const json& answer) {
    const Model& model = families.circles.model;
    if (asks_for_polyline(*scene.lem) || !families.composites.empty() ||
        !has_thick_weak_layer(model, *scene.lem->search))
        return {};
    const double reported = answer.at("factor_of_safety");
    const json parts{{"non_circular", polyline_of(scene, families)}};
    for (const Candidate& each : candidates_of(parts)) {
        if (!each.invalid.empty() || each.factor >= reported * (1.0 - telling_difference)) continue;
        const std::string words = words::formatted(
                                      "factor_of_safety is %.3f, and a surface of straight pieces "
                                      "through the weak layer has "
                                      "%.3f (Spencer). ",
                                      reported, each.factor) +
                                  with_polyline();
        return {{"surfaces_disagree", fault::Severity::questionable, words, "/lem/non_circular"}};
    }
    return {};
}

std::vector<fault::Flag> flags_of_answer(const json& answer, const scene::Lem& lem) {
    const double reported = answer.at("factor_of_safety");
    std::vector<fault::Flag> flags;
    for (const Candidate& each : candidates_of(answer)) {
        if (each.invalid.empty() || each.factor >= reported * (1.0 - telling_difference)) continue;
        const std::string words = words::formatted(
            "factor_of_safety is %.3f, and %s has %.3f (%s), which does not count: %s", reported,
            in_words(each.surface).c_str(), each.factor,
            each.method == "spencer" ? "Spencer" : "Bishop", each.invalid.c_str());
        if (each.kinked_without_friction)
            flags.push_back({"kinked_without_friction", fault::Severity::warning,
                             words + ", and Spencer's method does not see the strength that this "
                                     "takes; use the circle's factor",
                             "/lem/non_circular"});
        else
            flags.push_back(
                {"surfaces_disagree", fault::Severity::questionable,
                 words + ". Check that surface by another method" +
                     (lem.non_circular ? "" : ", or search a polyline: " + with_polyline()),
                 "/lem"});
    }
    return flags;
}

}  // namespace breach::lem
