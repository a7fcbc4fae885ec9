#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// Flags are kept as rows by SQL triggers only, so that they cannot differ from the results that
// carry them. A result of an earlier version has no flags, but it says whether it came to rest.
// From here on the views belong to the program (views.cpp), which makes them anew.
const char* const version_6 = R"sql(
CREATE TABLE flags (
    task TEXT NOT NULL REFERENCES tasks(id),
    run TEXT NOT NULL REFERENCES runs(id),
    phase TEXT NOT NULL,
    code TEXT NOT NULL,
    severity TEXT NOT NULL,
    message TEXT NOT NULL,
    pointer TEXT NOT NULL
) STRICT;
CREATE INDEX flags_of_task ON flags(task, severity);
CREATE INDEX flags_of_run ON flags(run, severity, code, phase, task);

CREATE TRIGGER gather_flags AFTER UPDATE OF result ON tasks BEGIN
    DELETE FROM flags WHERE task = NEW.id;
    INSERT INTO flags SELECT NEW.id, NEW.run, NEW.phase, coalesce(json_extract(value, '$.code'), ''),
        coalesce(json_extract(value, '$.severity'), ''), coalesce(json_extract(value, '$.message'), ''),
        coalesce(json_extract(value, '$.pointer'), '')
        FROM json_each(NEW.result, '$.flags') WHERE type = 'object';
    INSERT INTO flags SELECT NEW.id, NEW.run, NEW.phase, 'still_moving', 'questionable',
        'the soil was still moving when the MPM ended, so that the runout is a lower bound; '
        || 'lengthen /mpm/duration', '/mpm/duration'
        WHERE NEW.phase = 'mpm_solver' AND json_type(NEW.result, '$.flags') IS NULL
            AND json_type(NEW.result, '$.at_rest') = 'false';
END;
UPDATE tasks SET result = result WHERE result IS NOT NULL;

-- The study's variants in its order.
CREATE TABLE variants (
    run TEXT NOT NULL REFERENCES runs(id),
    name TEXT NOT NULL,
    place INTEGER NOT NULL,
    PRIMARY KEY (run, name)
) STRICT;
INSERT OR IGNORE INTO variants SELECT runs.id, json_extract(value, '$.name'), key
    FROM runs, json_each(runs.study, '$.variants') WHERE json_extract(value, '$.name') IS NOT NULL;
CREATE TRIGGER order_variants AFTER INSERT ON runs BEGIN
    INSERT OR IGNORE INTO variants SELECT NEW.id, json_extract(value, '$.name'), key
        FROM json_each(NEW.study, '$.variants') WHERE json_extract(value, '$.name') IS NOT NULL;
END;

-- A page of a long table is chosen by the index alone.
DROP INDEX tasks_of_sweep;
CREATE INDEX tasks_of_sweep ON tasks(run, phase, variant, transfer_time, id);

DROP VIEW run_summaries;
DROP VIEW sweep_results;
)sql";

}  // namespace breach::orchestrator
