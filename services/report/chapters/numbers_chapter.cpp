// All numbers of the run with their settings, errors and costs.
#include <algorithm>
#include <cmath>

#include "core/phases/phases.hpp"
#include "services/report/chapters/chapters.hpp"
#include "services/report/read/verdict.hpp"

namespace breach::report {

using nlohmann::json;

namespace {

/// A task's overrides according to the study, for its variant or the first variant it serves. Its
/// result may come from another run's task with that task's overrides. Null: unknown.
json asked_overrides(const Run& run, const PhaseFolder& phase) {
    if (phase.task.empty() || !run.study.is_object()) return {};
    const json variants = run.study.value("variants", json::array());
    if (variants.empty()) return phase.variant.empty() ? json::array() : json();
    if (phase.variant.empty()) return variants.front().value("overrides", json::array());
    for (const json& each : variants)
        if (each.at("name") == phase.variant) return each.value("overrides", json::array());
    return {};
}

/// The phase's overrides, without those that only set output times.
std::string settings_of(const Run& run, const PhaseFolder& phase) {
    if (!phase.result.is_object()) return "not known: no result.json";
    json overrides = asked_overrides(run, phase);
    if (overrides.is_null())
        overrides = phase.result.value(json::json_pointer("/provenance/overrides"), json());
    if (overrides.is_null()) return "";
    std::string text;
    for (const json& each : overrides) {
        const std::string override = each;
        if (override.starts_with("/fem/snapshot_")) continue;
        text += (text.empty() ? "" : "; ") + override;
    }
    constexpr std::size_t longest = 120;
    if (text.size() > longest) return text.substr(0, longest) + " ... (whole: Variants)";
    return text.empty() ? "as in the scene" : text;
}

/// A column of a table: its heading, the number's place in result.json, its unit in SI.
struct Column {
    std::string head;
    std::string pointer;
    double unit = 1.0;
    bool grows = false;  ///< while soil moves, so that it is a lower bound then
};

Table table_of(const Run& run, const std::string& phase, const std::string& title,
               const std::vector<Column>& columns, const std::string& caption) {
    Table table{"numbers_" + phase, title, {"run", "t_T [s]", "variant"}, {}, caption};
    for (const Column& each : columns) table.columns.push_back(each.head);
    table.columns.insert(table.columns.end(), {"settings", "CPU [s]", "how it ended"});
    for (const PhaseFolder* each : phases_named(run, phase)) {
        std::vector<std::string> row = {
            each->label, each->transfer_time ? short_number(*each->transfer_time) : "-",
            each->variant.empty() ? "all" : each->variant};
        for (const Column& column : columns) {
            const std::string value = fact(each->result, column.pointer, column.unit);
            row.push_back(column.grows ? bounded(*each, value) : value);
        }
        row.insert(row.end(), {settings_of(run, *each), fact(each->result, "/cpu_seconds"),
                               how_it_ended(*each)});
        table.rows.push_back(std::move(row));
    }
    return table;
}

/// Errors of the runouts as known from an accuracy study, the run's repeats, or neighbouring
/// transfer times.
Table errors_of(const Run& run) {
    Table table{"numbers_runout_error",
                "How far the runouts are off",
                {"run", "t_T [s]", "variant", "runout [m]", "error of one run [m]", "from"},
                {},
                "The error of a setting (bias and scatter against a reference) comes from an "
                "accuracy study of the same scene at the same setting; repeats, and neighbours in "
                "transfer time, tell the scatter alone."};
    for (const PhaseFolder* each : phases_named(run, phases::mpm.program)) {
        if (each->runout_error_from.empty()) continue;
        table.rows.push_back({each->label,
                              each->transfer_time ? short_number(*each->transfer_time) : "-",
                              each->variant.empty() ? "all" : each->variant,
                              bounded(*each, fact(each->result, "/runout")),
                              each->runout_error ? rounded(*each->runout_error, 3) : "no estimate",
                              each->runout_error_from});
    }
    return table;
}

/// "12.5 +- 0.3", marked where soil of a repeat still moved; "-": unknown.
std::string with_scatter(const Run& run, const json& mean, const std::string& measure) {
    const json value = mean.value(measure, json());
    if (!value.is_number()) return "-";
    const json deviation = mean.value(measure + "_deviation", json());
    return (any_moves(draws_of(run, mean)) ? at_least : "") + rounded(value.get<double>(), 4) +
           (deviation.is_number() ? " +- " + rounded(deviation.get<double>(), 2) : "");
}

/// Mean and scatter of every runout of a study with repeats.
Table means_of(const Run& run) {
    Table table{"numbers_means",
                "Means over the repeats",
                {"t_T [s]", "variant", "repeats", "runout [m]", "beyond the toe [m]",
                 "farthest [m]", "mean runout is off by [m]", "not as it should be"},
                {},
                "Mean +- standard deviation of one repeat. A repeat is the same setting on another "
                "lattice of points. Off by: nine of ten such means, by Student's distribution for "
                "so few repeats, with the bias where an accuracy study tells it. \u2265: a lower "
                "bound, soil of a repeat still moved."};
    for (const json& mean : run.means) {
        const json error = mean.value("runout_error", json());
        std::string caution;
        for (const auto& [key, words] : {std::pair{"missing_draws", "without a result: "},
                                         std::pair{"questionable_draws", "questionable: "}})
            if (const std::string draws = mean.at(key); !draws.empty())
                caution += (caution.empty() ? "" : "; ") + (words + draws);
        const std::string variant = mean.at("variant");
        const json& time = mean.at("transfer_time");
        table.rows.push_back({time.is_number() ? rounded(time.get<double>(), 6) : "-",
                              variant.empty() ? "all" : variant,
                              rounded(mean.at("draws_done").get<double>(), 4) + " of " +
                                  rounded(mean.at("draws").get<double>(), 4),
                              with_scatter(run, mean, "runout"),
                              with_scatter(run, mean, "runout_beyond_toe"),
                              with_scatter(run, mean, "runout_largest"),
                              error.is_number() ? rounded(error.get<double>(), 3) : "no estimate",
                              caution.empty() ? "-" : caution});
    }
    return table;
}

/// Relative differences in the transfers' ledgers over the whole section: one row per transfer, one
/// column per quantity.
Table ledger(const Run& run) {
    Table table{"numbers_transfer_ledger",
                "What the transfers lost or made",
                {"run", "t_T [s]"},
                {},
                "Relative differences, points minus mesh, over the whole section: the transfer's "
                "error. What is of the nodes was the FEM's lumped mass times its nodal velocity; "
                "its kinetic energy counts velocities that change within an element as they are "
                "at its corners."};
    for (const PhaseFolder* each : phases_named(run, phases::transfer.program)) {
        if (!each->result.is_object() || !each->result.contains("ledger")) continue;
        std::vector<std::string> row = {
            each->label, each->transfer_time ? short_number(*each->transfer_time) : "-"};
        const bool first = table.rows.empty();
        for (const json& kept : each->result.at("ledger")) {
            if (kept.value("region", "") != "total") continue;
            if (first) table.columns.push_back(kept.at("quantity"));
            row.push_back(rounded(kept.at("relative_difference"), 2));
        }
        row.resize(table.columns.size(), "-");
        table.rows.push_back(std::move(row));
    }
    return table;
}

}  // namespace

std::string fact(const json& result, const std::string& pointer, double unit) {
    const json::json_pointer at(pointer);
    if (!result.is_object() || !result.contains(at) || result.at(at).is_null()) return "-";
    const json& value = result.at(at);
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_string()) return value.get<std::string>();
    return value.is_number() ? rounded(value.get<double>() / unit, 6) : value.dump();
}

/// The paper's notes on this table that apply to the run.
std::string note_of(const Material& from, const std::string& table, const PhaseFolder& phase) {
    std::string text;
    for (const PaperNote& each : from.paper ? from.paper->notes : std::vector<PaperNote>{}) {
        const json::json_pointer at(each.entry);
        if (each.table != table || !phase.result.is_object() || !phase.result.contains(at))
            continue;
        if (phase.result.at(at) == json(each.value)) text += " " + each.text;
    }
    return text;
}

/// Whether a law of the scene loses strength with strain.
bool softens(const json& scene) {
    return std::ranges::any_of(scene.value("materials", json::object()), [](const json& each) {
        return each.contains(json::json_pointer("/law/softening"));
    });
}

void add_numbers(const Material& from, Document& document) {
    Chapter chapter{"Numbers"};
    if (from.paper) chapter.tables.push_back(comparison(*from.paper, from.measures));
    const auto add = [&](const std::string& phase, const std::string& title,
                         const std::vector<Column>& columns, const std::string& caption) {
        if (const PhaseFolder* first = phase_named(from.run, phase)) {
            chapter.tables.push_back(table_of(from.run, phase, title, columns,
                                              caption + note_of(from, "numbers_" + phase, *first)));
        }
    };
    add(phases::lem.program, "Limit equilibrium",
        {{"FS", "/factor_of_safety"},
         {"FS Bishop", "/bishop/factor_of_safety"},
         {"FS Spencer", "/bishop/spencer/factor_of_safety"},
         {"FS Ordinary", "/bishop/ordinary/factor_of_safety"},
         {"critical depth [m]", "/critical_depth"},
         {"depth at FS = 1 [m]", "/depth_at_fs_1"},
         {"slices", "/slices"}},
        "FS is the least valid factor of all surfaces analysed; Bishop, Spencer and Ordinary are "
        "on Bishop's critical circle. Error: that of the number of slices. The difference between "
        "Bishop and Spencer shows that of the method.");
    add(phases::fem.program, "Finite elements",
        {{"end [s]", "/end_time"},
         {"steps", "/steps"},
         {"cut steps", "/cut_steps"},
         {"elements", "/elements"},
         {"shortest edge [m]", "/mesh/shortest_edge"},
         {"largest displacement [m]", "/largest_displacement"},
         {"error: hourglass energy / internal work", "/hourglass/energy_over_internal_work"}},
        softens(from.run.scene)
            ? "Softening is local: a shear band is one element wide, so the time of failure "
              "depends on the mesh; only runs with other element sizes measure that error."
            : "");
    add(phases::transfer.program, "Transfers",
        {{"error: largest stress outside the yield surface [kPa]", "/largest_yield_excess", 1e3}},
        "");
    if (Table kept = ledger(from.run); !kept.rows.empty()) {
        chapter.tables.push_back(std::move(kept));
    }
    add(phases::mpm.program, "Runouts",
        {{"runout [m]", "/runout", 1.0, true},
         {"beyond toe [m]", "/runout_beyond_toe", 1.0, true},
         {"farthest point [m]", "/runout_largest", 1.0, true},
         {"front [m]", "/runout_front", 1.0, true},
         {"area beyond toe [m2]", "/area_beyond_toe", 1.0, true},
         {"at rest", "/at_rest"},
         {"in motion / released [%]", "/kinetic_share", 0.01},
         {"end [s]", "/end_time"},
         {"points", "/particles"},
         {"error: numerical energy / released", "/energy/numerical/share"},
         {"error: volume / initial", "/volume_ratio"},
         {"error: overlap", "/overlap"}},
        "Errors: share of the released energy that the scheme took (positive) or made; mean volume "
        "over initial volume; share of soil that lies in other soil. Front: the farthest place "
        "where "
        "the soil is /mpm/runout/front_depth deep (1 m unless the scene says so). \u2265: a lower "
        "bound, the soil still moved.");
    if (Table means = means_of(from.run); !means.rows.empty())
        chapter.tables.push_back(std::move(means));
    if (Table errors = errors_of(from.run); !errors.rows.empty())
        chapter.tables.push_back(std::move(errors));
    if (Table flags = flag_table(from.run); !flags.rows.empty()) {
        chapter.tables.push_back(std::move(flags));
    }
    document.chapters.push_back(std::move(chapter));
}

}  // namespace breach::report
