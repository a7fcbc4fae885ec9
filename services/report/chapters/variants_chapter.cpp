// The changes of each variant of a study, and their effect: one row per variant.
#include <algorithm>

#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/read/samples.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

const std::string materials = "/materials/";

/// One entry of the scene and its new values. The same entry of several materials counts as one
/// change.
struct Change {
    std::string entry;                ///< for a material: the part after its name
    std::vector<std::string> names;   ///< of the materials; empty: not a material's entry
    std::vector<std::string> values;  ///< one per material
};

std::vector<Change> changes_in(const json& overrides) {
    std::vector<Change> changes;
    for (const json& each : overrides) {
        const std::string text = each;
        const std::size_t equals = text.find('=');
        const std::string pointer = text.substr(0, equals), value = text.substr(equals + 1);
        const std::size_t end = pointer.starts_with(materials) ? pointer.find('/', materials.size())
                                                               : std::string::npos;
        if (end == std::string::npos) {
            changes.push_back({pointer, {}, {value}});
            continue;
        }
        const std::string name = pointer.substr(materials.size(), end - materials.size());
        const std::string entry = pointer.substr(end);
        const auto same = std::ranges::find_if(
            changes, [&](const Change& c) { return !c.names.empty() && c.entry == entry; });
        if (same == changes.end()) {
            changes.push_back({entry, {name}, {value}});
        } else {
            same->names.push_back(name);
            same->values.push_back(value);
        }
    }
    return changes;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& each : words) text += (text.empty() ? "" : ", ") + each;
    return text;
}

/// "/materials/{a, b}/viscosity=0", "/materials/{a, b}/law/c_kPa=1, 2"; one: its pointer.
std::string text_of(const Change& change) {
    const auto& [entry, names, values] = change;
    if (names.empty()) return entry + "=" + values.front();
    const std::string whose = names.size() == 1 ? names.front() : "{" + joined(names) + "}";
    const bool same =
        std::ranges::all_of(values, [&](const auto& each) { return each == values.front(); });
    return materials + whose + entry + "=" + (same ? values.front() : joined(values));
}

std::string changes_of(const Run& run, const std::string& variant) {
    std::string all;
    for (const json& each : run.study.at("variants")) {
        if (each.at("name") != variant) continue;
        for (const Change& change : changes_in(each.value("overrides", json::array()))) {
            if (!all.empty()) all.append("; ");
            all.append(text_of(change));
        }
    }
    return all.empty() ? "nothing" : all;
}

std::string or_dash(const std::optional<double>& value) {
    return value ? short_number(*value) : "-";
}

bool is_bound(const std::optional<Plateau>& plateau) {
    return plateau && any_moves(plateau->runouts);
}

/// Median of an entry over the plateau's runouts.
std::optional<double> median_of(const std::optional<Plateau>& plateau, const char* key) {
    std::vector<double> values;
    for (const PhaseFolder* each : plateau ? plateau->runouts : std::vector<const PhaseFolder*>{}) {
        if (each->result.value(key, json()).is_number()) values.push_back(each->result.at(key));
    }
    if (values.empty()) return {};
    return median(std::move(values));
}

struct Count {
    std::vector<const PhaseFolder*> runouts =
        {};  ///< runouts of the variant, running, failed or ended
    std::size_t ended = 0;
    double cpu_seconds = 0.0;
};

Count counts_of_variant(const Run& run, const std::string& variant) {
    Count count;
    for (const PhaseFolder* each : phases_named(run, phases::mpm.program)) {
        if (each->variant != variant) continue;
        count.runouts.push_back(each);
        if (!each->result.is_object()) continue;
        ++count.ended;
        count.cpu_seconds += each->result.value("cpu_seconds", 0.0);
    }
    return count;
}

/// Names in the study's order; includes variants without a transfer.
std::vector<std::string> listed_variants(const Run& run) {
    std::vector<std::string> names;
    if (!run.study.is_object()) return names;
    for (const json& each : run.study.value("variants", json::array())) {
        names.push_back(each.at("name"));
    }
    return names;
}

std::vector<std::string> row_of(const Run& run, const std::string& variant,
                                const std::optional<double>& reference) {
    const auto plateau = plateau_of(run, variant);
    const auto runout = median_of(plateau, "runout");
    const bool bound = is_bound(plateau);
    const auto distance = [&](const std::optional<double>& value) {
        return (bound && value ? at_least : "") + or_dash(value);
    };
    const Count count = counts_of_variant(run, variant);
    WindowEdges window;
    std::string fem_end = "-";
    if (const PhaseFolder* fem = phase_of_variant(run, phases::fem.program, variant);
        fem && has_telemetry(*fem)) {
        window = window_of(run, telemetry_of(run, *fem));
        fem_end = how_it_ended(*fem);
        if (fem_end == "well") fem_end = "at " + fact(fem->result, "/end_time") + " s";
    }
    const double now = runout.value_or(0.0), then = reference.value_or(0.0);
    const bool comparable = now > 0.0 && then > 0.0 && !bound;
    return {variant,
            changes_of(run, variant),
            std::to_string(count.ended) + " of " + std::to_string(count.runouts.size()),
            plateau ? short_number(plateau->first) + " to " + short_number(plateau->last) : "-",
            distance(runout),
            comparable ? rounded(100.0 * (now / then - 1.0), 3) : "-",
            distance(median_of(plateau, "runout_beyond_toe")),
            distance(median_of(plateau, "runout_beyond_toe_95")),
            or_dash(window.lower),
            or_dash(window.upper),
            fem_end,
            rounded(count.cpu_seconds, 3),
            how_they_ended(count.runouts)};
}

// ---------------------------------------------------------------- static scenes

const PhaseFolder* own_result(const Run& run, const std::string& phase,
                              const std::string& variant) {
    for (const PhaseFolder* each : phases_named(run, phase))
        if ((each->variant == variant || each->variant.empty()) && each->result.is_object())
            return each;
    return nullptr;
}

std::string fate_of(const Run& run, const std::string& variant) {
    std::string text;
    for (const PhaseFolder& each : run.phases)
        if (each.variant == variant || each.variant.empty())
            text += (text.empty() ? "" : "; ") + std::string(phases::named(each.phase)->part) +
                    ": " + how_it_ended(each);
    return text;
}

/// One row per variant, without transfer time, window and FEM.
Table static_table(const Run& run, const std::vector<std::string>& variants) {
    const bool flows = phase_named(run, phases::mpm.program);
    const bool judged = phase_named(run, phases::lem.program);
    Table table{"variants",
                "One thing changed at a time",
                {"variant", "changed"},
                {},
                flows ? "Runout: 99 % of the mobile soil, from the toe; negative: before it. "
                        "\u2265: the soil still moved, a lower bound and compared with nothing."
                      : ""};
    if (judged) table.columns.emplace_back("factor of safety");
    if (flows)
        table.columns.insert(table.columns.end(), {"runout [m]", "against the first [%]",
                                                   "area beyond toe [m2]", "at rest", "end [s]"});
    table.columns.emplace_back("how it ended");
    const PhaseFolder* first = own_result(run, phases::mpm.program, variants.front());
    for (const std::string& variant : variants) {
        std::vector<std::string> row{variant, changes_of(run, variant)};
        const auto of = [&](const PhaseFolder* phase, const char* pointer, int digits) {
            const json::json_pointer at(pointer);
            return phase && phase->result.value(at, json()).is_number()
                       ? rounded(phase->result.at(at).get<double>(), digits)
                       : std::string("-");
        };
        const PhaseFolder* lem = own_result(run, phases::lem.program, variant);
        const PhaseFolder* mpm = own_result(run, phases::mpm.program, variant);
        const auto distance = [&](const char* pointer) {
            const std::string value = of(mpm, pointer, 4);
            return mpm ? bounded(*mpm, value) : value;
        };
        if (judged) row.push_back(of(lem, "/factor_of_safety", 4));
        if (flows) {
            const bool comparable = first && mpm && first != mpm && runout_of(first) > 0.0 &&
                                    !still_moves(*first) && !still_moves(*mpm);
            row.insert(
                row.end(),
                {distance("/runout"),
                 comparable ? rounded(100.0 * (runout_of(mpm) / runout_of(first) - 1.0), 3) : "-",
                 distance("/area_beyond_toe"), mpm ? fact(mpm->result, "/at_rest") : "-",
                 of(mpm, "/end_time", 4)});
        }
        row.push_back(fate_of(run, variant));
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// The one entry that every variant sets to a different number.
struct Parameter {
    std::string entry;
    std::vector<double> values;  ///< of the variants, in their order
};

std::optional<Parameter> one_parameter(const Run& run) {
    Parameter found;
    for (const json& each : run.study.at("variants")) {
        const json overrides = each.value("overrides", json::array());
        if (overrides.size() != 1) return {};
        const std::string text = overrides.front();
        const std::size_t equals = text.find('=');
        const json value = json::parse(text.substr(equals + 1), nullptr, false);
        if (!value.is_number()) return {};
        if (!found.values.empty() && text.substr(0, equals) != found.entry) return {};
        found.entry = text.substr(0, equals);
        found.values.push_back(value);
    }
    return found;
}

/// A number of each variant's result against the changed parameter.
Figure against_parameter(const Run& run, const std::vector<std::string>& variants,
                         const Parameter& parameter, const phases::Phase& phase, const char* key,
                         const std::string& name, const std::string& title,
                         const std::string& label) {
    Figure figure{name,
                  {title, {parameter.entry.substr(parameter.entry.rfind('/') + 1)}, {label}, {}},
                  "Against " + parameter.entry + ", which alone the variants change."};
    Series series{title, {}, {}, Style::line_and_points};
    for (std::size_t i = 0; i < variants.size(); ++i) {
        const PhaseFolder* found = own_result(run, phase.program, variants[i]);
        if (!found || !found->result.value(key, json()).is_number()) continue;
        series.x.push_back(parameter.values[i]);
        series.y.push_back(found->result.at(key));
        series.certainty.push_back(certainty_of(*found));
    }
    if (std::ranges::all_of(series.certainty,
                            [](Certainty each) { return each == Certainty::certain; }))
        series.certainty.clear();
    if (!series.x.empty()) figure.chart.series.push_back(std::move(series));
    return figure;
}

Chapter static_chapter(const Run& run, const std::vector<std::string>& variants) {
    Chapter chapter{"Variants"};
    if (const auto parameter = one_parameter(run)) {
        std::vector figures{against_parameter(run, variants, *parameter, phases::mpm, "runout",
                                              "runout_against_parameter", "Runout", "runout [m]"),
                            against_parameter(run, variants, *parameter, phases::lem,
                                              "factor_of_safety", "safety_against_parameter",
                                              "Factor of safety", "factor of safety [-]")};
        std::erase_if(figures, [](const Figure& each) { return each.chart.series.empty(); });
        chapter.figures = std::move(figures);
    }
    chapter.tables.push_back(static_table(run, variants));
    return chapter;
}

}  // namespace

void add_variants(const Material& from, Document& document) {
    const std::vector<std::string> variants = listed_variants(from.run);
    if (variants.size() < 2 || has_samples(from.run)) return;  // samples have their own chapter
    if (is_static(from.run)) {
        document.chapters.push_back(static_chapter(from.run, variants));
        return;
    }
    Table table{
        "variants",
        "One thing changed at a time",
        {"variant", "changed", "runouts", "plateau t_T [s]", "runout [m]", "against the first [%]",
         "beyond toe, 99 % [m]", "beyond toe, 95 % [m]", "window opens [s]", "window closes [s]",
         "FEM ended", "CPU of runouts [s]", "how the runouts ended"},
        {},
        "Runout and distances beyond the toe: medians over the plateau, the transfer times "
        "around the largest runout that give at least 75 % of it; variants that share a "
        "FEM share its edges; one that closes before it opens is none. - where nothing ran past "
        "the toe. \u2265: soil of a runout behind it "
        "still moved, so it is a lower bound and compared with nothing."};
    const auto first = plateau_of(from.run, variants.front());
    std::optional<double> reference;
    if (!is_bound(first)) reference = median_of(first, "runout");
    for (const std::string& each : variants) {
        table.rows.push_back(row_of(from.run, each, reference));
    }
    Chapter chapter{"Variants"};
    chapter.tables.push_back(std::move(table));
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
