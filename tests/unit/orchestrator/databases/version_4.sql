-- A database as the service of version 4 left it; rows of every version up to it.
PRAGMA foreign_keys=OFF;
BEGIN TRANSACTION;
CREATE TABLE artifacts (
    task TEXT NOT NULL REFERENCES tasks(id),
    name TEXT NOT NULL,
    sha256 TEXT NOT NULL CHECK (length(sha256) = 64),
    bytes INTEGER NOT NULL,
    PRIMARY KEY (task, name)
) STRICT;
INSERT INTO "artifacts" VALUES('r1-00000','result.json','0000000000000000000000000000000000000000000000000000000000000001',100);
INSERT INTO "artifacts" VALUES('r1-00001','result.json','0000000000000000000000000000000000000000000000000000000000000002',101);
INSERT INTO "artifacts" VALUES('r1-00002','result.json','0000000000000000000000000000000000000000000000000000000000000003',102);
INSERT INTO "artifacts" VALUES('r1-00003','result.json','0000000000000000000000000000000000000000000000000000000000000004',103);
INSERT INTO "artifacts" VALUES('r1-00004','result.json','0000000000000000000000000000000000000000000000000000000000000005',104);
INSERT INTO "artifacts" VALUES('r2again-00000','result.json','0000000000000000000000000000000000000000000000000000000000000001',100);
CREATE TABLE attempts (
    task TEXT NOT NULL REFERENCES tasks(id),
    number INTEGER NOT NULL,
    state TEXT NOT NULL CHECK (state IN ('submitting', 'submitted', 'running', 'exited', 'lost', 'fenced')),
    created TEXT NOT NULL,
    started TEXT,
    finished TEXT,
    exit_code INTEGER,
    signal INTEGER,
    wall_seconds REAL,
    cpu_seconds REAL,
    PRIMARY KEY (task, number)
) STRICT;
INSERT INTO "attempts" VALUES('r1-00000',1,'exited','2026-02-01T00:00:13.000Z','2026-02-01T00:00:14.000Z','2026-02-01T00:00:15.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r1-00001',1,'exited','2026-02-01T00:00:27.000Z','2026-02-01T00:00:28.000Z','2026-02-01T00:00:29.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r1-00002',1,'exited','2026-02-01T00:00:41.000Z','2026-02-01T00:00:42.000Z','2026-02-01T00:00:43.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r1-00003',1,'exited','2026-02-01T00:00:55.000Z','2026-02-01T00:00:56.000Z','2026-02-01T00:00:57.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r1-00004',1,'exited','2026-02-01T00:00:09.000Z','2026-02-01T00:00:10.000Z','2026-02-01T00:00:11.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r1bad-00000',1,'exited','2026-02-01T00:00:23.000Z','2026-02-01T00:00:24.000Z','2026-02-01T00:00:25.000Z',65,NULL,1.5,1.25);
CREATE TABLE events (
    seq INTEGER PRIMARY KEY AUTOINCREMENT,
    time TEXT NOT NULL,
    run TEXT NOT NULL REFERENCES runs(id),
    task TEXT REFERENCES tasks(id),
    kind TEXT NOT NULL CHECK (kind IN ('run', 'task', 'attempt')),
    detail TEXT NOT NULL CHECK (json_valid(detail))
) STRICT;
INSERT INTO "events" VALUES(1,'2026-02-01T00:00:02.000Z','r1',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(2,'2026-02-01T00:00:03.000Z','r1','r1-00000','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(3,'2026-02-01T00:00:04.000Z','r1','r1-00000','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(4,'2026-02-01T00:00:05.000Z','r1','r1-00000','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(5,'2026-02-01T00:00:06.000Z','r1','r1-00000','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(6,'2026-02-01T00:00:07.000Z','r1','r1-00000','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(7,'2026-02-01T00:00:08.000Z','r1','r1-00000','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(8,'2026-02-01T00:00:09.000Z','r1','r1-00000','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(9,'2026-02-01T00:00:10.000Z','r1','r1-00000','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(10,'2026-02-01T00:00:16.000Z','r1','r1-00001','task','{"event": "release", "from": "blocked", "to": "ready"}');
INSERT INTO "events" VALUES(11,'2026-02-01T00:00:17.000Z','r1','r1-00001','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(12,'2026-02-01T00:00:18.000Z','r1','r1-00001','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(13,'2026-02-01T00:00:19.000Z','r1','r1-00001','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(14,'2026-02-01T00:00:20.000Z','r1','r1-00001','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(15,'2026-02-01T00:00:21.000Z','r1','r1-00001','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(16,'2026-02-01T00:00:22.000Z','r1','r1-00001','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(17,'2026-02-01T00:00:23.000Z','r1','r1-00001','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(18,'2026-02-01T00:00:24.000Z','r1','r1-00001','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(19,'2026-02-01T00:00:30.000Z','r1','r1-00002','task','{"event": "release", "from": "blocked", "to": "ready"}');
INSERT INTO "events" VALUES(20,'2026-02-01T00:00:31.000Z','r1','r1-00002','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(21,'2026-02-01T00:00:32.000Z','r1','r1-00002','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(22,'2026-02-01T00:00:33.000Z','r1','r1-00002','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(23,'2026-02-01T00:00:34.000Z','r1','r1-00002','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(24,'2026-02-01T00:00:35.000Z','r1','r1-00002','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(25,'2026-02-01T00:00:36.000Z','r1','r1-00002','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(26,'2026-02-01T00:00:37.000Z','r1','r1-00002','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(27,'2026-02-01T00:00:38.000Z','r1','r1-00002','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(28,'2026-02-01T00:00:44.000Z','r1','r1-00003','task','{"event": "release", "from": "blocked", "to": "ready"}');
INSERT INTO "events" VALUES(29,'2026-02-01T00:00:45.000Z','r1','r1-00003','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(30,'2026-02-01T00:00:46.000Z','r1','r1-00003','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(31,'2026-02-01T00:00:47.000Z','r1','r1-00003','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(32,'2026-02-01T00:00:48.000Z','r1','r1-00003','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(33,'2026-02-01T00:00:49.000Z','r1','r1-00003','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(34,'2026-02-01T00:00:50.000Z','r1','r1-00003','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(35,'2026-02-01T00:00:51.000Z','r1','r1-00003','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(36,'2026-02-01T00:00:52.000Z','r1','r1-00003','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(37,'2026-02-01T00:00:58.000Z','r1','r1-00004','task','{"event": "release", "from": "blocked", "to": "ready"}');
INSERT INTO "events" VALUES(38,'2026-02-01T00:00:59.000Z','r1','r1-00004','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(39,'2026-02-01T00:00:00.000Z','r1','r1-00004','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(40,'2026-02-01T00:00:01.000Z','r1','r1-00004','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(41,'2026-02-01T00:00:02.000Z','r1','r1-00004','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(42,'2026-02-01T00:00:03.000Z','r1','r1-00004','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(43,'2026-02-01T00:00:04.000Z','r1','r1-00004','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(44,'2026-02-01T00:00:05.000Z','r1','r1-00004','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(45,'2026-02-01T00:00:06.000Z','r1','r1-00004','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(46,'2026-02-01T00:00:13.000Z','r1bad',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(47,'2026-02-01T00:00:14.000Z','r1bad','r1bad-00000','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(48,'2026-02-01T00:00:15.000Z','r1bad','r1bad-00000','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(49,'2026-02-01T00:00:16.000Z','r1bad','r1bad-00000','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(50,'2026-02-01T00:00:17.000Z','r1bad','r1bad-00000','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(51,'2026-02-01T00:00:18.000Z','r1bad','r1bad-00000','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(52,'2026-02-01T00:00:19.000Z','r1bad','r1bad-00000','task','{"event": "exit_badly", "from": "running", "to": "failed"}');
INSERT INTO "events" VALUES(53,'2026-02-01T00:00:20.000Z','r1bad','r1bad-00000','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(54,'2026-02-01T00:00:26.000Z','r1bad','r1bad-00001','task','{"event": "skip", "from": "blocked", "to": "skipped"}');
INSERT INTO "events" VALUES(55,'2026-02-01T00:00:28.000Z','r1bad','r1bad-00002','task','{"event": "skip", "from": "blocked", "to": "skipped"}');
INSERT INTO "events" VALUES(56,'2026-02-01T00:00:31.000Z','r1open',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(57,'2026-03-01T00:00:33.000Z','r2again',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(58,'2026-03-01T00:00:34.000Z','r2again','r2again-00000','task','{"event": "reuse", "from": "ready", "to": "cached"}');
INSERT INTO "events" VALUES(59,'2026-03-01T00:00:38.000Z','r2off',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(60,'2026-03-01T00:00:39.000Z','r2off','r2off-00000','task','{"event": "cancel", "from": "ready", "to": "cancelled"}');
CREATE TABLE firing_plans (
    run TEXT PRIMARY KEY REFERENCES runs(id),
    tasks TEXT NOT NULL CHECK (json_valid(tasks))
) STRICT;
INSERT INTO "firing_plans" VALUES('r1','[]');
CREATE TABLE firings (
    trigger TEXT NOT NULL REFERENCES triggers(id),
    transfer_time REAL NOT NULL,
    wanted_time REAL NOT NULL,
    snapshot TEXT NOT NULL,
    sha256 TEXT NOT NULL CHECK (length(sha256) = 64),
    crossed TEXT NOT NULL CHECK (json_valid(crossed)),
    fem_step INTEGER NOT NULL,
    noticed_at INTEGER NOT NULL,
    written_at INTEGER NOT NULL,
    fired_at INTEGER NOT NULL,
    PRIMARY KEY (trigger, transfer_time)
) STRICT;
INSERT INTO "firings" VALUES('g3',1.0,0.98,'snapshot_1.vtkhdf','0000000000000000000000000000000000000000000000000000000000000001','[]',98,1000,1010,1020);
CREATE TABLE idempotency_keys (
    key TEXT PRIMARY KEY,
    body_sha256 TEXT NOT NULL CHECK (length(body_sha256) = 64),
    run TEXT NOT NULL REFERENCES runs(id),
    created TEXT NOT NULL
) STRICT;
INSERT INTO "idempotency_keys" VALUES('key-2','0000000000000000000000000000000000000000000000000000000000000005','r2again','2026-03-01T00:00:36.000Z');
CREATE TABLE recipes (
    hash TEXT PRIMARY KEY CHECK (length(hash) = 64),
    phase TEXT NOT NULL,
    cache_version INTEGER NOT NULL,
    part TEXT NOT NULL CHECK (json_valid(part))
) STRICT;
INSERT INTO "recipes" VALUES('000000000000000000000000000000000000000000000000000000000000004d','fem_solver',3,'{"fem":{}}');
CREATE TABLE run_counts (
    run TEXT PRIMARY KEY REFERENCES runs(id),
    started TEXT,
    last_finished TEXT,
    total INTEGER NOT NULL,
    ended INTEGER NOT NULL,
    reached INTEGER NOT NULL,
    failed INTEGER NOT NULL,
    cancelled INTEGER NOT NULL,
    runouts INTEGER NOT NULL
) STRICT;
INSERT INTO "run_counts" VALUES('r1','2026-02-01T00:00:08.000Z','2026-02-01T00:00:53.000Z',5,5,5,0,0,2);
INSERT INTO "run_counts" VALUES('r1bad','2026-02-01T00:00:22.000Z','2026-02-01T00:00:29.000Z',3,3,0,3,0,0);
INSERT INTO "run_counts" VALUES('r1open',NULL,NULL,1,0,0,0,0,0);
INSERT INTO "run_counts" VALUES('r2again',NULL,'2026-03-01T00:00:35.000Z',1,1,1,0,0,0);
INSERT INTO "run_counts" VALUES('r2off',NULL,'2026-03-01T00:00:40.000Z',1,1,0,0,1,0);
CREATE TABLE runs (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    title TEXT NOT NULL,
    created TEXT NOT NULL,
    study TEXT NOT NULL CHECK (json_valid(study)),
    scene TEXT NOT NULL CHECK (json_valid(scene))
, paused INTEGER NOT NULL DEFAULT 0 CHECK (paused IN (0, 1)), sweep INTEGER NOT NULL DEFAULT 0 CHECK (sweep IN (0, 1)), last_task INTEGER NOT NULL DEFAULT 0) STRICT;
INSERT INTO "runs" VALUES('r1','slope','kept of version 1','2026-02-01T00:00:01.000Z','{"transfer_times": [1, 2]}','{"name":"slope"}',0,0,5);
INSERT INTO "runs" VALUES('r1bad','slope','kept of version 1','2026-02-01T00:00:12.000Z','{"transfer_times": [1]}','{"name":"slope"}',0,0,3);
INSERT INTO "runs" VALUES('r1open','slope','kept of version 1','2026-02-01T00:00:30.000Z','{}','{"name":"slope"}',0,0,1);
INSERT INTO "runs" VALUES('r2again','slope','kept of version 2','2026-03-01T00:00:32.000Z','{"transfer_times": []}','{"name":"slope"}',0,0,0);
INSERT INTO "runs" VALUES('r2off','slope','kept of version 2','2026-03-01T00:00:37.000Z','{"transfer_times": []}','{"name":"slope"}',0,0,0);
CREATE TABLE tasks (
    id TEXT PRIMARY KEY,
    run TEXT NOT NULL REFERENCES runs(id),
    phase TEXT NOT NULL,
    label TEXT NOT NULL,
    transfer_time REAL,
    parent TEXT REFERENCES tasks(id),
    release TEXT NOT NULL CHECK (release IN ('at_once', 'file_exists', 'parent_succeeded')),
    input TEXT NOT NULL,
    overrides TEXT NOT NULL CHECK (json_valid(overrides)),
    state TEXT NOT NULL CHECK (state IN ('blocked', 'ready', 'cached', 'starting', 'running', 'finalizing',
        'succeeded', 'failed', 'lost', 'retry_wait', 'cancelling', 'cancelled', 'skipped')),
    tries INTEGER NOT NULL DEFAULT 0,
    retry_at INTEGER,
    started TEXT,
    finished TEXT,
    result TEXT CHECK (result IS NULL OR json_valid(result)),
    fault_exit INTEGER,
    fault_summary TEXT, variant TEXT NOT NULL DEFAULT '', priority INTEGER NOT NULL DEFAULT 0, cores INTEGER NOT NULL DEFAULT 1 CHECK (cores >= 1), memory_mb INTEGER NOT NULL DEFAULT 0 CHECK (memory_mb >= 0), recipe TEXT REFERENCES recipes(hash), input_sha256 TEXT, same_as TEXT REFERENCES tasks(id), cache_refusal TEXT, ready_at INTEGER,
    UNIQUE (run, label),
    CHECK ((state = 'retry_wait') = (retry_at IS NOT NULL)),
    CHECK ((state IN ('cached', 'succeeded', 'failed', 'cancelled', 'skipped')) = (finished IS NOT NULL)),
    CHECK (state <> 'succeeded' OR result IS NOT NULL)
) STRICT;
INSERT INTO "tasks" VALUES('r1-00000','r1','fem_solver','fem',NULL,NULL,'at_once','','[]','succeeded',1,NULL,'2026-02-01T00:00:12.000Z','2026-02-01T00:00:11.000Z','{"cpu_seconds": 12}',NULL,NULL,'',0,1,0,'000000000000000000000000000000000000000000000000000000000000004d','',NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r1-00001','r1','transfer_tool','transfer_1',1.0,'r1-00000','file_exists','snapshot_1.vtkhdf','[]','succeeded',1,NULL,'2026-02-01T00:00:26.000Z','2026-02-01T00:00:25.000Z','{}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r1-00002','r1','mpm_solver','mpm_1',1.0,'r1-00001','parent_succeeded','particles.vtkhdf','[]','succeeded',1,NULL,'2026-02-01T00:00:40.000Z','2026-02-01T00:00:39.000Z','{"runout": 10.5, "at_rest": true, "volume_ratio": 1.01, "cpu_seconds": 3}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r1-00003','r1','transfer_tool','transfer_2',2.0,'r1-00000','file_exists','snapshot_2.vtkhdf','[]','succeeded',1,NULL,'2026-02-01T00:00:54.000Z','2026-02-01T00:00:53.000Z','{}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r1-00004','r1','mpm_solver','mpm_2',2.0,'r1-00003','parent_succeeded','particles.vtkhdf','[]','succeeded',1,NULL,'2026-02-01T00:00:08.000Z','2026-02-01T00:00:07.000Z','{"runout": 12.25, "at_rest": false, "volume_ratio": 1.02, "cpu_seconds": 4}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r1bad-00000','r1bad','fem_solver','fem',NULL,NULL,'at_once','','[]','failed',1,NULL,'2026-02-01T00:00:22.000Z','2026-02-01T00:00:21.000Z',NULL,65,'/fem: no support','',0,1,0,NULL,NULL,NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r1bad-00001','r1bad','transfer_tool','transfer_1',1.0,'r1bad-00000','file_exists','s.vtkhdf','[]','skipped',0,NULL,NULL,'2026-02-01T00:00:27.000Z',NULL,NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r1bad-00002','r1bad','mpm_solver','mpm_1',1.0,'r1bad-00001','parent_succeeded','p.vtkhdf','[]','skipped',0,NULL,NULL,'2026-02-01T00:00:29.000Z',NULL,NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r1open-00000','r1open','lem_tool','lem',NULL,NULL,'at_once','','[]','ready',0,NULL,NULL,NULL,NULL,NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL);
INSERT INTO "tasks" VALUES('r2again-00000','r2again','fem_solver','fem',NULL,NULL,'at_once','','[]','cached',0,NULL,NULL,'2026-03-01T00:00:35.000Z','{"cpu_seconds": 12}',NULL,NULL,'',0,1,0,'000000000000000000000000000000000000000000000000000000000000004d','','r1-00000',NULL,NULL);
INSERT INTO "tasks" VALUES('r2off-00000','r2off','fem_solver','fem',NULL,NULL,'at_once','','[]','cancelled',0,NULL,NULL,'2026-03-01T00:00:40.000Z',NULL,NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL);
CREATE TABLE triggers (
    id TEXT PRIMARY KEY,
    run TEXT NOT NULL REFERENCES runs(id),
    fem_task TEXT NOT NULL REFERENCES tasks(id),
    name TEXT NOT NULL,
    kind TEXT NOT NULL CHECK (kind IN ('manual', 'criterion', 'window', 'bisect')),
    spec TEXT NOT NULL CHECK (json_valid(spec)),
    state TEXT NOT NULL CHECK (state IN ('armed', 'holding', 'fired', 'expired', 'disarmed')),
    reason TEXT NOT NULL DEFAULT '',
    result TEXT CHECK (result IS NULL OR json_valid(result)),
    created TEXT NOT NULL,
    changed TEXT NOT NULL,
    UNIQUE (fem_task, name)
) STRICT;
INSERT INTO "triggers" VALUES('g3','r1','r1-00000','deep','criterion','{"when":"crest_displacement > 1"}','fired','',NULL,'2026-04-01T00:00:41.000Z','2026-04-01T00:00:42.000Z');
CREATE INDEX tasks_by_state ON tasks(state, id);
CREATE INDEX tasks_by_run ON tasks(run, state, started, finished);
CREATE UNIQUE INDEX one_live_attempt ON attempts(task) WHERE state IN ('submitting', 'submitted', 'running');
CREATE INDEX artifacts_by_hash ON artifacts(sha256);
CREATE INDEX tasks_by_recipe ON tasks(recipe, input_sha256, id) WHERE state = 'succeeded';
CREATE INDEX tasks_by_phase ON tasks(phase, id) WHERE recipe IS NOT NULL;
CREATE INDEX tasks_to_start ON tasks(priority DESC, id) WHERE state = 'ready';
CREATE INDEX tasks_with_faults ON tasks(run, id) WHERE fault_summary IS NOT NULL;
CREATE INDEX tasks_unfinished ON tasks(run) WHERE finished IS NULL;
CREATE INDEX runs_paused ON runs(id) WHERE paused = 1;
CREATE INDEX runs_by_time ON runs(created, id);
CREATE INDEX runs_by_name ON runs(name, created, id);
CREATE TRIGGER count_new_task AFTER INSERT ON tasks BEGIN
    INSERT INTO run_counts VALUES (NEW.run, NEW.started, NEW.finished, 1, NEW.finished IS NOT NULL,
        NEW.state IN ('succeeded', 'cached'), NEW.state IN ('failed', 'skipped'), NEW.state = 'cancelled',
        NEW.phase = 'mpm_solver' AND NEW.state IN ('succeeded', 'cached'))
    ON CONFLICT (run) DO UPDATE SET total = total + 1, ended = ended + excluded.ended,
        reached = reached + excluded.reached, failed = failed + excluded.failed,
        cancelled = cancelled + excluded.cancelled, runouts = runouts + excluded.runouts;
END;
CREATE TRIGGER count_moved_task AFTER UPDATE OF state ON tasks WHEN OLD.state <> NEW.state BEGIN
    UPDATE run_counts SET
        started = coalesce(started, NEW.started),
        last_finished = max(coalesce(last_finished, ''), coalesce(NEW.finished, last_finished, '')),
        ended = ended + (NEW.finished IS NOT NULL) - (OLD.finished IS NOT NULL),
        reached = reached + (NEW.state IN ('succeeded', 'cached')) - (OLD.state IN ('succeeded', 'cached')),
        failed = failed + (NEW.state IN ('failed', 'skipped')) - (OLD.state IN ('failed', 'skipped')),
        cancelled = cancelled + (NEW.state = 'cancelled') - (OLD.state = 'cancelled'),
        runouts = runouts + (NEW.phase = 'mpm_solver') *
            ((NEW.state IN ('succeeded', 'cached')) - (OLD.state IN ('succeeded', 'cached')))
    WHERE run = NEW.run;
END;
CREATE INDEX triggers_of_run ON triggers(run, id);
CREATE INDEX triggers_open ON triggers(run, fem_task) WHERE state IN ('armed', 'holding');
CREATE VIEW trigger_firings AS
SELECT triggers.run AS run, triggers.id AS trigger, triggers.name AS name, triggers.kind AS kind,
    firings.transfer_time AS transfer_time, firings.wanted_time AS wanted_time,
    firings.transfer_time - firings.wanted_time AS lag_s,
    firings.snapshot AS snapshot, firings.sha256 AS sha256, firings.crossed AS crossed,
    firings.fem_step AS fem_step, firings.noticed_at AS noticed_at,
    firings.written_at - firings.noticed_at AS snapshot_ms,
    firings.fired_at - firings.noticed_at AS fired_ms,
    (SELECT cast(round((julianday(min(attempts.started)) - 2440587.5) * 86400000.0) AS INTEGER)
        - firings.noticed_at
     FROM tasks JOIN attempts ON attempts.task = tasks.id
     WHERE tasks.parent = triggers.fem_task AND tasks.input = firings.snapshot) AS start_ms
FROM firings JOIN triggers ON triggers.id = firings.trigger;
CREATE VIEW run_summaries AS
SELECT id, name, title, created, started, paused, sweep, total AS tasks_total, reached AS tasks_done,
    ended AS tasks_ended, failed AS tasks_failed,
    CASE WHEN is_open THEN CASE WHEN started IS NULL THEN 'queued' ELSE 'running' END
         WHEN cancelled > 0 THEN 'cancelled'
         WHEN failed = 0 THEN 'succeeded'
         WHEN runouts > 0 THEN 'partial'
         ELSE 'failed' END AS state,
    CASE WHEN NOT is_open THEN last_finished END AS finished
FROM (SELECT *, ended < total OR EXISTS (SELECT 1 FROM triggers
        WHERE triggers.run = runs.id AND triggers.state IN ('armed', 'holding')) AS is_open
      FROM runs JOIN run_counts ON run_counts.run = runs.id);
CREATE VIEW sweep_results AS
SELECT mpm.run AS run,
    mpm.variant AS variant,
    mpm.transfer_time AS transfer_time,
    CASE WHEN transfer.state IN ('failed', 'skipped') THEN transfer.state
         WHEN mpm.state = 'cached' THEN 'succeeded' ELSE mpm.state END AS state,
    mpm.state = 'cached' AS reused,
    json_extract(mpm.result, '$.runout') AS runout,
    json_extract(mpm.result, '$.runout_beyond_toe') AS runout_beyond_toe,
    json_extract(mpm.result, '$.runout_largest') AS runout_largest,
    json_extract(mpm.result, '$.volume_ratio') AS volume_ratio,
    json_extract(mpm.result, '$.energy.numerical.share') AS numerical_share,
    json_extract(mpm.result, '$.overlap') AS overlap,
    json_extract(mpm.result, '$.cpu_seconds') AS cpu_seconds,
    coalesce(transfer.fault_summary, mpm.fault_summary, '') AS reason,
    transfer.id AS transfer_task,
    mpm.id AS mpm_task,
    coalesce((SELECT group_concat(triggers.name, ' ') FROM triggers
        JOIN firings ON firings.trigger = triggers.id
        WHERE triggers.fem_task = transfer.parent AND firings.snapshot = transfer.input),
        'at_time') AS trigger
FROM tasks AS mpm JOIN tasks AS transfer ON transfer.id = mpm.parent
WHERE mpm.phase = 'mpm_solver' AND transfer.phase = 'transfer_tool';
CREATE INDEX tasks_by_parent ON tasks(parent, state, id);
CREATE INDEX tasks_of_sweep ON tasks(run, phase, variant, transfer_time);
CREATE INDEX events_of_run ON events(run, seq);
DELETE FROM "sqlite_sequence";
INSERT INTO "sqlite_sequence" VALUES('events',60);
COMMIT;
PRAGMA user_version=4;
PRAGMA foreign_keys=ON;
