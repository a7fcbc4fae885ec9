#include "services/orchestrator/store/versions.hpp"

namespace breach::orchestrator {

// Which variant a draw repeats: "soft" for "soft" and "soft_d2", "" for "d1"; NULL: the study has no
// draws.
const char* const version_9 = R"sql(
ALTER TABLE variants ADD COLUMN draw_of TEXT;

DROP TRIGGER order_variants;
CREATE TRIGGER order_variants AFTER INSERT ON runs BEGIN
    INSERT OR IGNORE INTO variants SELECT NEW.id, json_extract(value, '$.name'), key,
        CASE WHEN NOT repeated THEN NULL
             WHEN coalesce(json_extract(value, '$.made_by'), '') <> 'draws' THEN json_extract(value, '$.name')
             ELSE substr(json_extract(value, '$.name'), 1,
                 max(0, length(rtrim(json_extract(value, '$.name'), '0123456789')) - 2)) END
        FROM (SELECT coalesce(json_extract(NEW.study, '$.draws'), 1) > 1
                OR coalesce(json_extract(NEW.study, '$.first_draw'), 0) > 0 AS repeated),
            json_each(NEW.study, '$.variants') WHERE json_extract(value, '$.name') IS NOT NULL;
END;

INSERT OR REPLACE INTO variants SELECT runs.id, json_extract(value, '$.name'), key,
    CASE WHEN coalesce(json_extract(value, '$.made_by'), '') <> 'draws' THEN json_extract(value, '$.name')
         ELSE substr(json_extract(value, '$.name'), 1,
             max(0, length(rtrim(json_extract(value, '$.name'), '0123456789')) - 2)) END
    FROM runs, json_each(runs.study, '$.variants')
    WHERE json_extract(runs.study, '$.draws') > 1 AND json_extract(value, '$.name') IS NOT NULL;
)sql";

}  // namespace breach::orchestrator
