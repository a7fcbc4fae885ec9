-- A database as the service of version 10 left it; rows of every version up to it.
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
INSERT INTO "artifacts" VALUES('r6-00000','result.json','0000000000000000000000000000000000000000000000000000000000000001',100);
INSERT INTO "artifacts" VALUES('r6-00001','result.json','0000000000000000000000000000000000000000000000000000000000000002',101);
INSERT INTO "artifacts" VALUES('r6-00002','result.json','0000000000000000000000000000000000000000000000000000000000000003',102);
INSERT INTO "artifacts" VALUES('r6-00003','result.json','0000000000000000000000000000000000000000000000000000000000000004',103);
INSERT INTO "artifacts" VALUES('r7-00000','result.json','0000000000000000000000000000000000000000000000000000000000000001',100);
INSERT INTO "artifacts" VALUES('r8-00000','result.json','0000000000000000000000000000000000000000000000000000000000000001',100);
INSERT INTO "artifacts" VALUES('r9-00000','result.json','0000000000000000000000000000000000000000000000000000000000000001',100);
INSERT INTO "artifacts" VALUES('r9-00001','result.json','0000000000000000000000000000000000000000000000000000000000000002',101);
INSERT INTO "artifacts" VALUES('r9-00002','result.json','0000000000000000000000000000000000000000000000000000000000000003',102);
INSERT INTO "artifacts" VALUES('r9-00003','result.json','0000000000000000000000000000000000000000000000000000000000000004',103);
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
INSERT INTO "attempts" VALUES('r5-00000',1,'exited','2026-06-01T00:00:54.000Z','2026-06-01T00:00:55.000Z','2026-06-01T00:00:56.000Z',70,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r6-00000',1,'exited','2026-07-01T00:00:09.000Z','2026-07-01T00:00:10.000Z','2026-07-01T00:00:11.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r6-00001',1,'exited','2026-07-01T00:00:23.000Z','2026-07-01T00:00:24.000Z','2026-07-01T00:00:25.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r6-00002',1,'exited','2026-07-01T00:00:36.000Z','2026-07-01T00:00:37.000Z','2026-07-01T00:00:38.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r6-00003',1,'exited','2026-07-01T00:00:50.000Z','2026-07-01T00:00:51.000Z','2026-07-01T00:00:52.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r7-00000',1,'exited','2026-08-01T00:00:05.000Z','2026-08-01T00:00:06.000Z','2026-08-01T00:00:07.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r8-00000',1,'exited','2026-09-01T00:00:22.000Z','2026-09-01T00:00:23.000Z','2026-09-01T00:00:24.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r9-00000',1,'exited','2026-01-01T00:00:37.000Z','2026-01-01T00:00:38.000Z','2026-01-01T00:00:39.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r9-00001',1,'exited','2026-01-01T00:00:51.000Z','2026-01-01T00:00:52.000Z','2026-01-01T00:00:53.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r9-00002',1,'exited','2026-01-01T00:00:04.000Z','2026-01-01T00:00:05.000Z','2026-01-01T00:00:06.000Z',0,NULL,1.5,1.25);
INSERT INTO "attempts" VALUES('r9-00003',1,'exited','2026-01-01T00:00:18.000Z','2026-01-01T00:00:19.000Z','2026-01-01T00:00:20.000Z',0,NULL,1.5,1.25);
CREATE TABLE "events" (
    seq INTEGER PRIMARY KEY AUTOINCREMENT,
    time TEXT NOT NULL,
    run TEXT NOT NULL,
    task TEXT,
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
INSERT INTO "events" VALUES(61,'2026-06-01T00:00:44.000Z','r5',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(62,'2026-06-01T00:00:45.000Z','r5','r5-00000','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(63,'2026-06-01T00:00:46.000Z','r5','r5-00000','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(64,'2026-06-01T00:00:47.000Z','r5','r5-00000','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(65,'2026-06-01T00:00:48.000Z','r5','r5-00000','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(66,'2026-06-01T00:00:49.000Z','r5','r5-00000','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(67,'2026-06-01T00:00:50.000Z','r5','r5-00000','task','{"event": "exit_badly", "from": "running", "to": "failed"}');
INSERT INTO "events" VALUES(68,'2026-06-01T00:00:51.000Z','r5','r5-00000','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(69,'2026-07-01T00:00:58.000Z','r6',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(70,'2026-07-01T00:00:59.000Z','r6','r6-00000','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(71,'2026-07-01T00:00:00.000Z','r6','r6-00000','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(72,'2026-07-01T00:00:01.000Z','r6','r6-00000','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(73,'2026-07-01T00:00:02.000Z','r6','r6-00000','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(74,'2026-07-01T00:00:03.000Z','r6','r6-00000','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(75,'2026-07-01T00:00:04.000Z','r6','r6-00000','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(76,'2026-07-01T00:00:05.000Z','r6','r6-00000','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(77,'2026-07-01T00:00:06.000Z','r6','r6-00000','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(78,'2026-07-01T00:00:12.000Z','r6','r6-00001','task','{"event": "release", "from": "blocked", "to": "ready"}');
INSERT INTO "events" VALUES(79,'2026-07-01T00:00:13.000Z','r6','r6-00001','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(80,'2026-07-01T00:00:14.000Z','r6','r6-00001','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(81,'2026-07-01T00:00:15.000Z','r6','r6-00001','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(82,'2026-07-01T00:00:16.000Z','r6','r6-00001','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(83,'2026-07-01T00:00:17.000Z','r6','r6-00001','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(84,'2026-07-01T00:00:18.000Z','r6','r6-00001','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(85,'2026-07-01T00:00:19.000Z','r6','r6-00001','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(86,'2026-07-01T00:00:20.000Z','r6','r6-00001','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(87,'2026-07-01T00:00:26.000Z','r6','r6-00002','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(88,'2026-07-01T00:00:27.000Z','r6','r6-00002','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(89,'2026-07-01T00:00:28.000Z','r6','r6-00002','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(90,'2026-07-01T00:00:29.000Z','r6','r6-00002','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(91,'2026-07-01T00:00:30.000Z','r6','r6-00002','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(92,'2026-07-01T00:00:31.000Z','r6','r6-00002','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(93,'2026-07-01T00:00:32.000Z','r6','r6-00002','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(94,'2026-07-01T00:00:33.000Z','r6','r6-00002','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(95,'2026-07-01T00:00:39.000Z','r6','r6-00003','task','{"event": "release", "from": "blocked", "to": "ready"}');
INSERT INTO "events" VALUES(96,'2026-07-01T00:00:40.000Z','r6','r6-00003','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(97,'2026-07-01T00:00:41.000Z','r6','r6-00003','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(98,'2026-07-01T00:00:42.000Z','r6','r6-00003','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(99,'2026-07-01T00:00:43.000Z','r6','r6-00003','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(100,'2026-07-01T00:00:44.000Z','r6','r6-00003','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(101,'2026-07-01T00:00:45.000Z','r6','r6-00003','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(102,'2026-07-01T00:00:46.000Z','r6','r6-00003','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(103,'2026-07-01T00:00:47.000Z','r6','r6-00003','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(104,'2026-08-01T00:00:54.000Z','r7',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(105,'2026-08-01T00:00:55.000Z','r7','r7-00000','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(106,'2026-08-01T00:00:56.000Z','r7','r7-00000','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(107,'2026-08-01T00:00:57.000Z','r7','r7-00000','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(108,'2026-08-01T00:00:58.000Z','r7','r7-00000','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(109,'2026-08-01T00:00:59.000Z','r7','r7-00000','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(110,'2026-08-01T00:00:00.000Z','r7','r7-00000','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(111,'2026-08-01T00:00:01.000Z','r7','r7-00000','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(112,'2026-08-01T00:00:02.000Z','r7','r7-00000','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(113,'2026-08-01T00:00:08.000Z','r7','r7-00001','task','{"event": "skip", "from": "blocked", "to": "skipped"}');
INSERT INTO "events" VALUES(114,'2026-09-01T00:00:11.000Z','r8',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(115,'2026-09-01T00:00:12.000Z','r8','r8-00000','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(116,'2026-09-01T00:00:13.000Z','r8','r8-00000','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(117,'2026-09-01T00:00:14.000Z','r8','r8-00000','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(118,'2026-09-01T00:00:15.000Z','r8','r8-00000','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(119,'2026-09-01T00:00:16.000Z','r8','r8-00000','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(120,'2026-09-01T00:00:17.000Z','r8','r8-00000','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(121,'2026-09-01T00:00:18.000Z','r8','r8-00000','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(122,'2026-09-01T00:00:19.000Z','r8','r8-00000','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(123,'2026-01-01T00:00:26.000Z','r9',NULL,'run','{"event": "submit"}');
INSERT INTO "events" VALUES(124,'2026-01-01T00:00:27.000Z','r9','r9-00000','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(125,'2026-01-01T00:00:28.000Z','r9','r9-00000','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(126,'2026-01-01T00:00:29.000Z','r9','r9-00000','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(127,'2026-01-01T00:00:30.000Z','r9','r9-00000','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(128,'2026-01-01T00:00:31.000Z','r9','r9-00000','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(129,'2026-01-01T00:00:32.000Z','r9','r9-00000','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(130,'2026-01-01T00:00:33.000Z','r9','r9-00000','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(131,'2026-01-01T00:00:34.000Z','r9','r9-00000','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(132,'2026-01-01T00:00:40.000Z','r9','r9-00001','task','{"event": "release", "from": "blocked", "to": "ready"}');
INSERT INTO "events" VALUES(133,'2026-01-01T00:00:41.000Z','r9','r9-00001','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(134,'2026-01-01T00:00:42.000Z','r9','r9-00001','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(135,'2026-01-01T00:00:43.000Z','r9','r9-00001','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(136,'2026-01-01T00:00:44.000Z','r9','r9-00001','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(137,'2026-01-01T00:00:45.000Z','r9','r9-00001','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(138,'2026-01-01T00:00:46.000Z','r9','r9-00001','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(139,'2026-01-01T00:00:47.000Z','r9','r9-00001','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(140,'2026-01-01T00:00:48.000Z','r9','r9-00001','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(141,'2026-01-01T00:00:54.000Z','r9','r9-00002','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(142,'2026-01-01T00:00:55.000Z','r9','r9-00002','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(143,'2026-01-01T00:00:56.000Z','r9','r9-00002','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(144,'2026-01-01T00:00:57.000Z','r9','r9-00002','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(145,'2026-01-01T00:00:58.000Z','r9','r9-00002','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(146,'2026-01-01T00:00:59.000Z','r9','r9-00002','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(147,'2026-01-01T00:00:00.000Z','r9','r9-00002','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(148,'2026-01-01T00:00:01.000Z','r9','r9-00002','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
INSERT INTO "events" VALUES(149,'2026-01-01T00:00:07.000Z','r9','r9-00003','task','{"event": "release", "from": "blocked", "to": "ready"}');
INSERT INTO "events" VALUES(150,'2026-01-01T00:00:08.000Z','r9','r9-00003','task','{"event": "claim", "from": "ready", "to": "starting"}');
INSERT INTO "events" VALUES(151,'2026-01-01T00:00:09.000Z','r9','r9-00003','attempt','{"number": 1, "to": "submitting"}');
INSERT INTO "events" VALUES(152,'2026-01-01T00:00:10.000Z','r9','r9-00003','attempt','{"number": 1, "to": "submitted", "from": "submitting", "event": "submit"}');
INSERT INTO "events" VALUES(153,'2026-01-01T00:00:11.000Z','r9','r9-00003','attempt','{"number": 1, "to": "running", "from": "submitted", "event": "begin"}');
INSERT INTO "events" VALUES(154,'2026-01-01T00:00:12.000Z','r9','r9-00003','task','{"event": "start", "from": "starting", "to": "running"}');
INSERT INTO "events" VALUES(155,'2026-01-01T00:00:13.000Z','r9','r9-00003','task','{"event": "exit_well", "from": "running", "to": "finalizing"}');
INSERT INTO "events" VALUES(156,'2026-01-01T00:00:14.000Z','r9','r9-00003','attempt','{"number": 1, "event": "exit", "from": "running", "to": "exited"}');
INSERT INTO "events" VALUES(157,'2026-01-01T00:00:15.000Z','r9','r9-00003','task','{"event": "keep_outputs", "from": "finalizing", "to": "succeeded"}');
CREATE TABLE files (
    sha256 TEXT PRIMARY KEY CHECK (length(sha256) = 64),
    file TEXT NOT NULL,
    name TEXT NOT NULL,
    kind TEXT NOT NULL,
    about TEXT NOT NULL,
    bytes INTEGER NOT NULL,
    created TEXT NOT NULL,
    used TEXT NOT NULL
) STRICT;
INSERT INTO "files" VALUES('70ce871f8a3d3fb449bc3c3ace6547cef02dfc74ffe48d912532a724bfdbe5b9','70ce871f8a3d3fb449bc3c3ace6547cef02dfc74ffe48d912532a724bfdbe5b9.csv','record.csv','motion','100 values',6,'2026-01-01T00:03:00.000Z','2026-01-01T00:03:00.000Z');
CREATE TABLE files_of_runs (
    run TEXT NOT NULL REFERENCES runs(id),
    sha256 TEXT NOT NULL REFERENCES files(sha256),
    PRIMARY KEY (run, sha256)
) STRICT;
INSERT INTO "files_of_runs" VALUES('r9','70ce871f8a3d3fb449bc3c3ace6547cef02dfc74ffe48d912532a724bfdbe5b9');
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
CREATE TABLE flags (
    task TEXT NOT NULL REFERENCES tasks(id),
    run TEXT NOT NULL REFERENCES runs(id),
    phase TEXT NOT NULL,
    code TEXT NOT NULL,
    severity TEXT NOT NULL,
    message TEXT NOT NULL,
    pointer TEXT NOT NULL
) STRICT;
INSERT INTO "flags" VALUES('r1-00004','r1','mpm_solver','still_moving','questionable','the soil was still moving when the MPM ended, so that the runout is a lower bound; lengthen /mpm/duration','/mpm/duration');
INSERT INTO "flags" VALUES('r6-00003','r6','mpm_solver','overlap','questionable','6 %','/mpm');
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
CREATE TABLE removals (
    run TEXT PRIMARY KEY,
    asked TEXT NOT NULL
) STRICT;
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
INSERT INTO "run_counts" VALUES('r5','2026-06-01T00:00:53.000Z','2026-06-01T00:00:52.000Z',1,1,0,1,0,0);
INSERT INTO "run_counts" VALUES('r6','2026-07-01T00:00:08.000Z','2026-07-01T00:00:48.000Z',4,4,4,0,0,2);
INSERT INTO "run_counts" VALUES('r7','2026-08-01T00:00:04.000Z','2026-08-01T00:00:09.000Z',2,2,1,0,0,0);
INSERT INTO "run_counts" VALUES('r8','2026-09-01T00:00:21.000Z','2026-09-01T00:00:20.000Z',1,1,1,0,0,0);
INSERT INTO "run_counts" VALUES('r9','2026-01-01T00:00:36.000Z','2026-01-01T00:00:49.000Z',4,4,4,0,0,2);
CREATE TABLE runs (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    title TEXT NOT NULL,
    created TEXT NOT NULL,
    study TEXT NOT NULL CHECK (json_valid(study)),
    scene TEXT NOT NULL CHECK (json_valid(scene))
, paused INTEGER NOT NULL DEFAULT 0 CHECK (paused IN (0, 1)), sweep INTEGER NOT NULL DEFAULT 0 CHECK (sweep IN (0, 1)), last_task INTEGER NOT NULL DEFAULT 0, pinned INTEGER NOT NULL DEFAULT 0 CHECK (pinned IN (0, 1))) STRICT;
INSERT INTO "runs" VALUES('r1','slope','kept of version 1','2026-02-01T00:00:01.000Z','{"transfer_times": [1, 2]}','{"name":"slope"}',0,0,5,0);
INSERT INTO "runs" VALUES('r1bad','slope','kept of version 1','2026-02-01T00:00:12.000Z','{"transfer_times": [1]}','{"name":"slope"}',0,0,3,0);
INSERT INTO "runs" VALUES('r1open','slope','kept of version 1','2026-02-01T00:00:30.000Z','{}','{"name":"slope"}',0,0,1,0);
INSERT INTO "runs" VALUES('r2again','slope','kept of version 2','2026-03-01T00:00:32.000Z','{"transfer_times": []}','{"name":"slope"}',0,0,0,0);
INSERT INTO "runs" VALUES('r2off','slope','kept of version 2','2026-03-01T00:00:37.000Z','{"transfer_times": []}','{"name":"slope"}',0,0,0,0);
INSERT INTO "runs" VALUES('r5','slope','kept of version 5','2026-06-01T00:00:43.000Z','{"transfer_times": []}','{"name":"slope"}',0,0,0,0);
INSERT INTO "runs" VALUES('r6','slope','kept of version 6','2026-07-01T00:00:57.000Z','{"variants": [{"name": "b"}, {"name": "a"}]}','{"name":"slope"}',0,0,0,0);
INSERT INTO "runs" VALUES('r7','slope','kept of version 7','2026-08-01T00:00:53.000Z','{"transfer_times": [9]}','{"name":"slope"}',0,0,0,0);
INSERT INTO "runs" VALUES('r8','slope','kept of version 8','2026-09-01T00:00:10.000Z','{"accuracy": {"quantity": "factor_of_safety", "ladders": []}}','{"name":"slope"}',0,0,0,0);
INSERT INTO "runs" VALUES('r9','slope','kept of version 9','2026-01-01T00:00:25.000Z','{"draws": 2, "variants": [{"name": "soft"}, {"name": "soft_d2", "made_by": "draws"}]}','{"name":"slope"}',0,0,0,1);
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
    fault_summary TEXT, variant TEXT NOT NULL DEFAULT '', priority INTEGER NOT NULL DEFAULT 0, cores INTEGER NOT NULL DEFAULT 1 CHECK (cores >= 1), memory_mb INTEGER NOT NULL DEFAULT 0 CHECK (memory_mb >= 0), recipe TEXT REFERENCES recipes(hash), input_sha256 TEXT, same_as TEXT REFERENCES tasks(id), cache_refusal TEXT, ready_at INTEGER, not_reached INTEGER NOT NULL DEFAULT 0
    CHECK (not_reached IN (0, 1) AND (not_reached = 0 OR state IN ('blocked', 'skipped'))),
    UNIQUE (run, label),
    CHECK ((state = 'retry_wait') = (retry_at IS NOT NULL)),
    CHECK ((state IN ('cached', 'succeeded', 'failed', 'cancelled', 'skipped')) = (finished IS NOT NULL)),
    CHECK (state <> 'succeeded' OR result IS NOT NULL)
) STRICT;
INSERT INTO "tasks" VALUES('r1-00000','r1','fem_solver','fem',NULL,NULL,'at_once','','[]','succeeded',1,NULL,'2026-02-01T00:00:12.000Z','2026-02-01T00:00:11.000Z','{"cpu_seconds": 12}',NULL,NULL,'',0,1,0,'000000000000000000000000000000000000000000000000000000000000004d','',NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r1-00001','r1','transfer_tool','transfer_1',1.0,'r1-00000','file_exists','snapshot_1.vtkhdf','[]','succeeded',1,NULL,'2026-02-01T00:00:26.000Z','2026-02-01T00:00:25.000Z','{}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r1-00002','r1','mpm_solver','mpm_1',1.0,'r1-00001','parent_succeeded','particles.vtkhdf','[]','succeeded',1,NULL,'2026-02-01T00:00:40.000Z','2026-02-01T00:00:39.000Z','{"runout": 10.5, "at_rest": true, "volume_ratio": 1.01, "cpu_seconds": 3}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r1-00003','r1','transfer_tool','transfer_2',2.0,'r1-00000','file_exists','snapshot_2.vtkhdf','[]','succeeded',1,NULL,'2026-02-01T00:00:54.000Z','2026-02-01T00:00:53.000Z','{}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r1-00004','r1','mpm_solver','mpm_2',2.0,'r1-00003','parent_succeeded','particles.vtkhdf','[]','succeeded',1,NULL,'2026-02-01T00:00:08.000Z','2026-02-01T00:00:07.000Z','{"runout": 12.25, "at_rest": false, "volume_ratio": 1.02, "cpu_seconds": 4}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r1bad-00000','r1bad','fem_solver','fem',NULL,NULL,'at_once','','[]','failed',1,NULL,'2026-02-01T00:00:22.000Z','2026-02-01T00:00:21.000Z',NULL,65,'/fem: no support','',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r1bad-00001','r1bad','transfer_tool','transfer_1',1.0,'r1bad-00000','file_exists','s.vtkhdf','[]','skipped',0,NULL,NULL,'2026-02-01T00:00:27.000Z',NULL,NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r1bad-00002','r1bad','mpm_solver','mpm_1',1.0,'r1bad-00001','parent_succeeded','p.vtkhdf','[]','skipped',0,NULL,NULL,'2026-02-01T00:00:29.000Z',NULL,NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r1open-00000','r1open','lem_tool','lem',NULL,NULL,'at_once','','[]','ready',0,NULL,NULL,NULL,NULL,NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r2again-00000','r2again','fem_solver','fem',NULL,NULL,'at_once','','[]','cached',0,NULL,NULL,'2026-03-01T00:00:35.000Z','{"cpu_seconds": 12}',NULL,NULL,'',0,1,0,'000000000000000000000000000000000000000000000000000000000000004d','','r1-00000',NULL,NULL,0);
INSERT INTO "tasks" VALUES('r2off-00000','r2off','fem_solver','fem',NULL,NULL,'at_once','','[]','cancelled',0,NULL,NULL,'2026-03-01T00:00:40.000Z',NULL,NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r5-00000','r5','fem_solver','fem',NULL,NULL,'at_once','','[]','failed',1,NULL,'2026-06-01T00:00:53.000Z','2026-06-01T00:00:52.000Z',NULL,70,'no equilibrium at 3.2 s','',0,1,0,'000000000000000000000000000000000000000000000000000000000000004d',NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r6-00000','r6','transfer_tool','t_b',1.0,NULL,'at_once','','[]','succeeded',1,NULL,'2026-07-01T00:00:08.000Z','2026-07-01T00:00:07.000Z','{}',NULL,NULL,'b',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r6-00001','r6','mpm_solver','m_b',1.0,'r6-00000','parent_succeeded','p.vtkhdf','[]','succeeded',1,NULL,'2026-07-01T00:00:22.000Z','2026-07-01T00:00:21.000Z','{"runout": 20, "at_rest": true, "flags": []}',NULL,NULL,'b',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r6-00002','r6','transfer_tool','t_a',1.0,NULL,'at_once','','[]','succeeded',1,NULL,'2026-07-01T00:00:35.000Z','2026-07-01T00:00:34.000Z','{}',NULL,NULL,'a',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r6-00003','r6','mpm_solver','m_a',1.0,'r6-00002','parent_succeeded','p.vtkhdf','[]','succeeded',1,NULL,'2026-07-01T00:00:49.000Z','2026-07-01T00:00:48.000Z','{"runout": 21, "at_rest": true, "flags": [{"code": "overlap", "severity": "questionable", "message": "6 %", "pointer": "/mpm"}]}',NULL,NULL,'a',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r7-00000','r7','fem_solver','fem',NULL,NULL,'at_once','','[]','succeeded',1,NULL,'2026-08-01T00:00:04.000Z','2026-08-01T00:00:03.000Z','{"ended": "entangled"}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r7-00001','r7','transfer_tool','transfer_9',9.0,'r7-00000','file_exists','s9.vtkhdf','[]','skipped',0,NULL,NULL,'2026-08-01T00:00:09.000Z',NULL,NULL,'the FEM ended entangled at 6.7 s','',0,1,0,NULL,NULL,NULL,NULL,NULL,1);
INSERT INTO "tasks" VALUES('r8-00000','r8','lem_tool','lem',NULL,NULL,'at_once','','[]','succeeded',1,NULL,'2026-09-01T00:00:21.000Z','2026-09-01T00:00:20.000Z','{"factor_of_safety": 1.2}',NULL,NULL,'',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r9-00000','r9','transfer_tool','t_soft',1.0,NULL,'at_once','','[]','succeeded',1,NULL,'2026-01-01T00:00:36.000Z','2026-01-01T00:00:35.000Z','{}',NULL,NULL,'soft',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r9-00001','r9','mpm_solver','m_soft',1.0,'r9-00000','parent_succeeded','p.vtkhdf','[]','succeeded',1,NULL,'2026-01-01T00:00:50.000Z','2026-01-01T00:00:49.000Z','{"runout": 30, "at_rest": true, "flags": []}',NULL,NULL,'soft',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r9-00002','r9','transfer_tool','t_soft_d2',1.0,NULL,'at_once','','[]','succeeded',1,NULL,'2026-01-01T00:00:03.000Z','2026-01-01T00:00:02.000Z','{}',NULL,NULL,'soft_d2',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
INSERT INTO "tasks" VALUES('r9-00003','r9','mpm_solver','m_soft_d2',1.0,'r9-00002','parent_succeeded','p.vtkhdf','[]','succeeded',1,NULL,'2026-01-01T00:00:17.000Z','2026-01-01T00:00:16.000Z','{"runout": 32, "at_rest": true, "flags": []}',NULL,NULL,'soft_d2',0,1,0,NULL,NULL,NULL,NULL,NULL,0);
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
CREATE TABLE variants (
    run TEXT NOT NULL REFERENCES runs(id),
    name TEXT NOT NULL,
    place INTEGER NOT NULL, draw_of TEXT,
    PRIMARY KEY (run, name)
) STRICT;
INSERT INTO "variants" VALUES('r6','b',0,NULL);
INSERT INTO "variants" VALUES('r6','a',1,NULL);
INSERT INTO "variants" VALUES('r9','soft',0,'soft');
INSERT INTO "variants" VALUES('r9','soft_d2',1,'soft');
CREATE INDEX tasks_by_state ON tasks(state, id);
CREATE INDEX tasks_by_run ON tasks(run, state, started, finished);
CREATE UNIQUE INDEX one_live_attempt ON attempts(task) WHERE state IN ('submitting', 'submitted', 'running');
CREATE INDEX artifacts_by_hash ON artifacts(sha256);
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
CREATE INDEX tasks_by_parent ON tasks(parent, state, id);
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
CREATE INDEX tasks_of_sweep ON tasks(run, phase, variant, transfer_time, id);
CREATE TRIGGER count_moved_task AFTER UPDATE OF state ON tasks WHEN OLD.state <> NEW.state BEGIN
    UPDATE run_counts SET
        started = coalesce(started, NEW.started),
        last_finished = max(coalesce(last_finished, ''), coalesce(NEW.finished, last_finished, '')),
        ended = ended + (NEW.finished IS NOT NULL) - (OLD.finished IS NOT NULL),
        reached = reached + (NEW.state IN ('succeeded', 'cached')) - (OLD.state IN ('succeeded', 'cached')),
        failed = failed + (NEW.state IN ('failed', 'skipped') AND NOT NEW.not_reached)
            - (OLD.state IN ('failed', 'skipped') AND NOT OLD.not_reached),
        cancelled = cancelled + (NEW.state = 'cancelled') - (OLD.state = 'cancelled'),
        runouts = runouts + (NEW.phase = 'mpm_solver') *
            ((NEW.state IN ('succeeded', 'cached')) - (OLD.state IN ('succeeded', 'cached')))
    WHERE run = NEW.run;
END;
CREATE INDEX runs_with_accuracy ON runs(id) WHERE json_type(study, '$.accuracy')='object';
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
CREATE INDEX events_of_run ON events(run, seq);
CREATE INDEX tasks_by_recipe ON tasks(recipe, input_sha256, id)
    WHERE state IN ('succeeded', 'cached') OR (state = 'failed' AND fault_exit = 70);
CREATE INDEX tasks_of_recipe ON tasks(recipe) WHERE recipe IS NOT NULL;
CREATE INDEX tasks_same_as ON tasks(same_as) WHERE same_as IS NOT NULL;
CREATE INDEX keys_of_run ON idempotency_keys(run);
CREATE INDEX runs_of_file ON files_of_runs(sha256);
DELETE FROM "sqlite_sequence";
INSERT INTO "sqlite_sequence" VALUES('events',157);
COMMIT;
PRAGMA user_version=10;
PRAGMA foreign_keys=ON;
