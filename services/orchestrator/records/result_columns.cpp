// One line per column, from which views, answers and descriptions are made. Without a pointer,
// store/views.cpp or the service works the value out.
#include "services/orchestrator/records/result_columns.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/words/words.hpp"
#include "services/orchestrator/records/lifecycle.hpp"

namespace breach::orchestrator {

using nlohmann::json;
using enum ColumnKind;

static constexpr auto words_of(ColumnKind) {
    return words::in_order<ColumnKind>(
        {{number, "number"}, {yes_no, "yes_no"}, {word, "word"}, {ColumnKind::flags, "flags"}});
}

namespace {

constexpr std::array columns{
    ResultColumn{"transfer_time", "", number, "s", "t_T",
                 "transfer time; null: the scene has no FEM"},
    ResultColumn{"state", "", word, "", "state",
                 "that of the row; questionable: there is a result, but not one to rely on"},
    ResultColumn{
        "runout", "/runout", number, "m", "runout",
        "99 % of the mobile soil lies within this distance of the toe; negative: upstream of it"},
    ResultColumn{"runout_beyond_toe", "/runout_beyond_toe", number, "m", "beyond toe",
                 "the same of the soil beyond the toe; 0: there is none"},
    ResultColumn{"runout_largest", "/runout_largest", number, "m", "largest",
                 "of the farthest point"},
    ResultColumn{"area_beyond_toe", "/area_beyond_toe", number, "m2", "",
                 "of the deposit beyond the toe: its volume per metre of width"},
    ResultColumn{"depth_beyond_toe", "/depth_beyond_toe", number, "m", "",
                 "largest depth of the deposit beyond the toe at the end"},
    ResultColumn{"volume_ratio", "/volume_ratio", number, "1", "volume ratio",
                 "indicator of error: volume at the end of that at the transfer"},
    ResultColumn{"numerical_share", "/energy/numerical/share", number, "1", "numerical share",
                 "indicator of error: energy made or lost by the numerics, of that released"},
    ResultColumn{"overlap", "/overlap", number, "1", "",
                 "indicator of error: area of soil that lies in other soil, of all"},
    ResultColumn{"cpu_seconds", "/cpu_seconds", number, "s", "CPU", "of the MPM"},
    ResultColumn{"reason", "", word, "", "", "why there is no result"},
    ResultColumn{"transfer_task", "", word, "", "",
                 "the task that made the points; null: they fill the section"},
    ResultColumn{"mpm_task", "", word, "", "",
                 "the task that made the result: mpm_solver, or lem_tool where it is alone"},
    ResultColumn{"variant", "", word, "", "variant", "of the study; empty: it has none"},
    ResultColumn{"reused", "", yes_no, "", "", "taken from an earlier, equal task"},
    ResultColumn{
        "trigger", "", word, "", "",
        "what made the transfer; at_time: the study's list; empty: nothing is transferred"},
    ResultColumn{"at_rest", "/at_rest", yes_no, "", "rest",
                 "the soil came to rest; if not, the runout is a lower bound"},
    ResultColumn{"lower_bound", "", yes_no, "", "",
                 "the soil still moved at the end: distances and areas are lower bounds"},
    ResultColumn{"ended", "/ended", word, "", "", "what ended the MPM: at_rest or duration"},
    ResultColumn{"kinetic_share", "/kinetic_share", number, "1", "kinetic share",
                 "kinetic energy at the end, of the energy released"},
    ResultColumn{"end_time", "/end_time", number, "s", "", "end of the MPM, by its own clock"},
    ResultColumn{"questionable", "", yes_no, "", "",
                 "the result is not one to rely on; null: there is none yet"},
    ResultColumn{"flags", "", ColumnKind::flags, "", "",
                 "what to know before believing it: of the MPM, the transfer and the FEM"},
    ResultColumn{
        "runout_error", "", number, "m", "+-",
        "how far one run's runout is off: by an accuracy study of an equal scene, else by "
        "noise (the sweep's own repeats, else its neighbours in transfer time, else what is "
        "usual) and the bias of the cells; null: there is no runout"},
    ResultColumn{"runout_error_from", "", word, "", "", "where the error comes from"},
    ResultColumn{
        "factor_of_safety", "", number, "1", "FS",
        "the least valid factor of all surfaces, of the variant's stability analysis or of "
        "the one that serves all, before any layer liquefies; null: there is none, not "
        "yet, or variants share it in parts"},
    ResultColumn{"factor_of_safety_liquefied", "", number, "1", "FS liq.",
                 "the same with every layer of /lem/liquefaction at its residual strength; null: "
                 "the scene has none"},
    ResultColumn{"factor_of_safety_post_seismic", "", number, "1", "FS post",
                 "with the strengths of the FEM's snapshot at the transfer, residual where the "
                 "soil has liquefied; null: the study has no post_seismic, or not yet"},
};

}  // namespace

std::span<const ResultColumn> result_columns() { return columns; }

const char* name_of(ColumnKind kind) { return words::name_of(kind).data(); }

json& value_of(ResultRow& row, std::string_view name, std::span<const ResultColumn> columns) {
    return const_cast<json&>(value_of(std::as_const(row), name, columns));
}

const json& value_of(const ResultRow& row, std::string_view name,
                     std::span<const ResultColumn> columns) {
    const auto found = std::ranges::find(columns, name, &ResultColumn::name);
    assert(found != columns.end() && row.size() == columns.size());
    return row[static_cast<std::size_t>(found - columns.begin())];
}

std::string codes_of(const json& flags) {
    std::string codes;
    std::set<std::string> said;
    for (const json& each : flags) {
        const std::string code = each.at("code");
        if (said.insert(code).second) codes += (codes.empty() ? "" : ";") + code;
    }
    return codes;
}

bool is_row_state(std::string_view word) {
    return word == "questionable" || word == "not_reached" ||
           std::ranges::any_of(all_task_states(),
                               [&](TaskState each) { return name_of(each) == word; });
}

}  // namespace breach::orchestrator
