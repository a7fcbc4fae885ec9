// What each of a study's variants changes, and what that does: one row per variant.
#include <algorithm>

#include "services/report/chapters/chapters.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

/// The same change to several materials reads better once: "/materials/*/viscosity=0".
std::string without_its_material(const std::string& change) {
    const std::string materials = "/materials/";
    if (!change.starts_with(materials)) return change;
    std::string text = materials;
    text.append("*").append(change, change.find('/', materials.size()));
    return text;
}

/// One entry of the scene and the values that it gets.
struct Change {
    std::string entry;
    std::vector<std::string> values;  ///< one per material
};

std::vector<Change> changes_in(const json& overrides) {
    std::vector<Change> changes;
    for (const json& each : overrides) {
        const std::string text = without_its_material(each);
        const std::size_t equals = text.find('=');
        const std::string entry = text.substr(0, equals), value = text.substr(equals + 1);
        const auto same = std::ranges::find(changes, entry, &Change::entry);
        if (same == changes.end()) {
            changes.push_back({entry, {value}});
        } else {
            same->values.push_back(value);
        }
    }
    return changes;
}

/// "a=1 (7 materials)", "a=1, 2, 3".
std::string text_of(const Change& change) {
    const auto& values = change.values;
    std::string text = change.entry + "=" + values.front();
    if (values.size() == 1) return text;
    if (std::ranges::all_of(values, [&](const auto& each) { return each == values.front(); })) {
        return text.append(" (" + std::to_string(values.size()) + " materials)");
    }
    for (std::size_t k = 1; k < values.size(); ++k) text.append(", ").append(values[k]);
    return text;
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

/// Median of a fact over the plateau's runouts.
std::optional<double> median_of(const std::optional<Plateau>& plateau, const char* key) {
    std::vector<double> values;
    for (const PhaseFolder* each : plateau ? plateau->runouts : std::vector<const PhaseFolder*>{}) {
        if (each->result.value(key, json()).is_number()) values.push_back(each->result.at(key));
    }
    if (values.empty()) return {};
    return median(std::move(values));
}

struct Count {
    std::size_t ended = 0, all = 0;
    double cpu_seconds = 0.0;
    std::string fault;  ///< of the first that did not end well
};

Count count_of(const Run& run, const std::string& variant) {
    Count count;
    for (const PhaseFolder* each : phases_named(run, "mpm_solver")) {
        if (each->variant != variant) continue;
        ++count.all;
        if (each->result.is_object()) {
            ++count.ended;
            count.cpu_seconds += each->result.value("cpu_seconds", 0.0);
        } else if (count.fault.empty()) {
            count.fault = each->fault;
        }
    }
    return count;
}

/// Names as the study lists them; a variant whose transfer never came has no runout but a row.
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
    const Count count = count_of(run, variant);
    WindowEdges window;
    std::string fem_end = "-";
    if (const PhaseFolder* fem = phase_of_variant(run, "fem_solver", variant);
        fem && has_telemetry(*fem)) {
        window = window_of(run, telemetry_of(run, *fem));
        fem_end = fem->fault.empty() ? "at " + fact(fem->result, "/end_time") + " s" : fem->fault;
    }
    const bool comparable = runout && reference && *runout > 0.0 && *reference > 0.0;
    return {variant,
            changes_of(run, variant),
            std::to_string(count.ended) + " of " + std::to_string(count.all),
            plateau ? short_number(plateau->first) + " to " + short_number(plateau->last) : "-",
            or_dash(runout),
            comparable ? rounded(100.0 * (*runout / *reference - 1.0), 3) : "-",
            or_dash(median_of(plateau, "runout_beyond_toe")),
            or_dash(median_of(plateau, "runout_beyond_toe_95")),
            or_dash(window.lower),
            or_dash(window.upper),
            fem_end,
            rounded(count.cpu_seconds, 3),
            count.fault.empty() ? "well" : count.fault};
}

}  // namespace

void add_variants(const Material& from, Document& document) {
    const std::vector<std::string> variants = listed_variants(from.run);
    if (variants.size() < 2) return;
    Table table{
        "variants",
        "One thing changed at a time",
        {"variant", "changed", "runouts", "plateau t_T [s]", "runout [m]", "against the first [%]",
         "beyond toe, 99 % [m]", "beyond toe, 95 % [m]", "window opens [s]", "window closes [s]",
         "FEM ended", "CPU of runouts [s]", "how the runouts ended"},
        {},
        "Runout and distances beyond the toe: medians over the plateau, the transfer times "
        "around the largest runout that give at least 75 % of it; variants that share a "
        "FEM share its edges. - where nothing ran past the toe."};
    const auto reference = median_of(plateau_of(from.run, variants.front()), "runout");
    for (const std::string& each : variants) {
        table.rows.push_back(row_of(from.run, each, reference));
    }
    Chapter chapter{"Variants"};
    chapter.tables.push_back(std::move(table));
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
