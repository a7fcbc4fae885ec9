// Transfers over one run or all: why each was made, how long it waited, what came of it.
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

using nlohmann::json;

namespace {

std::optional<json> optional_json(const Row& row, int column) {
    const auto text = row.optional_text(column);
    return text ? std::optional(json::parse(*text)) : std::nullopt;
}

// A time of the study has no firing. The MPM tasks of a transfer are as many as variants share it. From
// ready (its snapshot was seen) to the start of its last attempt; of one from the cache there is none.
constexpr const char* transfers =
    "SELECT t.id, t.run, t.parent, t.transfer_time, t.variant, t.state, t.not_reached, t.input, "
    "t.fault_summary, g.name, g.kind, g.spec, f.wanted_time, f.crossed, f.fem_step, f.written_at - "
    "f.noticed_at, (SELECT cast(round((julianday(max(a.created)) - 2440587.5) * 86400000.0) AS "
    "INTEGER) FROM attempts AS a WHERE a.task=t.id) - t.ready_at, (SELECT "
    "json_group_array(json_object('task', m.id, 'variant', m.variant, 'state', m.state, 'runout', "
    "json_extract(m.result, '$.runout'))) FROM tasks AS m WHERE m.parent=t.id ORDER BY m.id), "
    "t.started, t.same_as FROM tasks AS t LEFT JOIN triggers AS g ON g.id=(SELECT firings.trigger "
    "FROM firings JOIN triggers ON triggers.id=firings.trigger WHERE triggers.fem_task=t.parent "
    "AND "
    "firings.snapshot=t.input ORDER BY firings.noticed_at LIMIT 1) LEFT JOIN firings AS f ON "
    "f.trigger=g.id AND f.snapshot=t.input WHERE t.phase='transfer_tool' AND (?1 IS NULL OR "
    "t.run=?1) AND (?2 IS NULL OR coalesce(g.kind, 'at_time')=?2) AND (?3 IS NULL OR t.state=?3) "
    "AND (?4 IS NULL OR t.id<?4) ORDER BY t.id DESC LIMIT ?5";

}  // namespace

std::vector<TransferRow> Store::transfers_of(const TransferFilter& filter, std::size_t most) const {
    std::vector<TransferRow> found;
    read([&](Connection& database) {
        database.query(
            transfers,
            {value_or_null(filter.run), value_or_null(filter.why), value_or_null(filter.state),
             value_or_null(filter.before), static_cast<std::int64_t>(most)},
            [&](const Row& row) {
                found.push_back({.task = row.text(0),
                                 .run = row.text(1),
                                 .fem_task = row.text(2),
                                 .transfer_time = row.optional_real(3),
                                 .variant = row.text(4),
                                 .state = row.text(5),
                                 .not_reached = row.integer(6) != 0,
                                 .snapshot = row.text(7),
                                 .fault = row.optional_text(8),
                                 .trigger = row.optional_text(9),
                                 .why = row.optional_text(10).value_or("at_time"),
                                 .spec = optional_json(row, 11),
                                 .wanted_time = row.optional_real(12),
                                 .crossed = optional_json(row, 13),
                                 .fem_step = row.optional_integer(14),
                                 .snapshot_ms = row.optional_integer(15),
                                 .start_ms = row.optional_integer(16),
                                 .runouts = json::parse(row.text(17)),
                                 .started = row.optional_text(18),
                                 .same_as = row.optional_text(19)});
            });
    });
    return found;
}

}  // namespace breach::orchestrator
