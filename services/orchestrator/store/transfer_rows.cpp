// Transfers of one run or all: why each was made, how long it waited, its runouts.
#include "services/orchestrator/store/store.hpp"

namespace breach::orchestrator {

// A time of the study has no firing. A transfer has one MPM task per variant that shares it.
// start_ms: from ready (the snapshot was seen) to the start of the last attempt; null for a result
// from the cache.
/// Several triggers may share a snapshot: the first that noticed it counts. 2440587.5 is the
/// Julian day of 1970-01-01, 86400000 the milliseconds of a day. Pages go by falling ids.
std::vector<TransferRow> Store::transfers_of(const TransferFilter& filter, std::size_t most) const {
    return reader()->select(
        R"(SELECT t.id AS id, t.run AS run, t.parent AS parent, t.transfer_time AS transfer_time,
    t.variant AS variant, t.state AS state, t.not_reached AS not_reached, t.input AS input,
    t.fault_summary AS fault_summary, g.name AS trigger, coalesce(g.kind, 'at_time') AS why,
    g.spec AS spec, f.wanted_time AS wanted_time, f.crossed AS crossed, f.fem_step AS fem_step,
    f.written_at - f.noticed_at AS snapshot_ms,
    (SELECT cast(round((julianday(max(a.created)) - 2440587.5) * 86400000.0) AS INTEGER)
     FROM attempts AS a WHERE a.task=t.id) - t.ready_at AS start_ms,
    (SELECT json_group_array(json_object('task', m.id, 'variant', m.variant, 'state', m.state,
         'runout', json_extract(m.result, '$.runout')))
     FROM tasks AS m WHERE m.parent=t.id ORDER BY m.id) AS runouts,
    t.started AS started, t.same_as AS same_as
FROM tasks AS t
LEFT JOIN triggers AS g ON g.id=(SELECT firings.trigger FROM firings JOIN triggers
    ON triggers.id=firings.trigger WHERE triggers.fem_task=t.parent AND firings.snapshot=t.input
    ORDER BY firings.noticed_at LIMIT 1)
LEFT JOIN firings AS f ON f.trigger=g.id AND f.snapshot=t.input
WHERE t.phase='transfer_tool' AND (?1 IS NULL OR t.run=?1)
    AND (?2 IS NULL OR coalesce(g.kind, 'at_time')=?2) AND (?3 IS NULL OR t.state=?3)
    AND (?4 IS NULL OR t.id<?4) ORDER BY t.id DESC LIMIT ?5)",
        {value_or_null(filter.run), value_or_null(filter.why), value_or_null(filter.state),
         value_or_null(filter.before), static_cast<std::int64_t>(most)},
        [](const Row& row) {
            return TransferRow{.task = row.text("id"),
                               .run = row.text("run"),
                               .fem_task = row.text("parent"),
                               .transfer_time = row.optional_real("transfer_time"),
                               .variant = row.text("variant"),
                               .state = row.text("state"),
                               .not_reached = row.yes("not_reached"),
                               .snapshot = row.text("input"),
                               .fault = row.optional_text("fault_summary"),
                               .trigger = row.optional_text("trigger"),
                               .why = row.text("why"),
                               .spec = row.optional_document("spec"),
                               .wanted_time = row.optional_real("wanted_time"),
                               .crossed = row.optional_document("crossed"),
                               .fem_step = row.optional_integer("fem_step"),
                               .snapshot_ms = row.optional_integer("snapshot_ms"),
                               .start_ms = row.optional_integer("start_ms"),
                               .runouts = row.document("runouts"),
                               .started = row.optional_text("started"),
                               .same_as = row.optional_text("same_as")};
        });
}

}  // namespace breach::orchestrator
