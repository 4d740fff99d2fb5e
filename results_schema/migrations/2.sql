-- From version 1 of the catalogue to version 2, within one transaction and without foreign keys; the runs' manifests
-- then say what decided about their parts. A step is never changed after the version that it leads to has been used.

-- Cases are found by kind and by bed, parameters through indexes that hold each row once.
CREATE INDEX kase_by_kind ON kase (kind);
CREATE INDEX kase_by_bed ON kase (bed_id);
DROP INDEX param_by_num;
DROP INDEX param_by_txt;
CREATE INDEX param_by_num ON param (path, num) WHERE num IS NOT NULL;
CREATE INDEX param_by_txt ON param (path, txt) WHERE txt IS NOT NULL;
CREATE INDEX param_absent ON param (path) WHERE num IS NULL AND txt IS NULL;

-- A run says how large it is, and whether it is the newest of its case.
CREATE TABLE run_2 (
  run_id         INTEGER PRIMARY KEY,
  case_id        TEXT NOT NULL REFERENCES kase,
  number         INTEGER NOT NULL,
  folder         TEXT NOT NULL,
  seal           TEXT NOT NULL,
  bed_run        TEXT,
  outcome        TEXT NOT NULL,
  reason         TEXT NOT NULL,
  time           REAL,
  depth          REAL,
  state_hash     TEXT NOT NULL,
  records        INTEGER NOT NULL,
  frames         INTEGER NOT NULL,
  version        TEXT NOT NULL,
  commit_sha     TEXT NOT NULL,
  dirty          INTEGER NOT NULL CHECK (dirty IN (0, 1)),
  host_cpu       TEXT NOT NULL,
  threads        INTEGER NOT NULL,
  simd           TEXT NOT NULL,
  cpu_seconds    REAL,
  wall_seconds   REAL,
  peak_memory_mb REAL,
  attempts       INTEGER NOT NULL,
  bytes          INTEGER NOT NULL,
  newest         INTEGER NOT NULL CHECK (newest IN (0, 1)),
  UNIQUE (case_id, number)
) STRICT;
INSERT INTO run_2 SELECT run.*,
    (SELECT coalesce(sum(bytes), 0) FROM artifact WHERE artifact.run_id = run.run_id),
    number = (SELECT max(number) FROM run AS other WHERE other.case_id = run.case_id)
  FROM run;
DROP TABLE run;
ALTER TABLE run_2 RENAME TO run;
CREATE UNIQUE INDEX run_newest ON run (case_id) WHERE newest = 1;
CREATE INDEX run_by_outcome ON run (outcome, case_id) WHERE newest = 1;
CREATE TRIGGER run_added AFTER INSERT ON run BEGIN
  UPDATE run SET newest = 0 WHERE case_id = NEW.case_id AND newest = 1;
  UPDATE run SET newest = 1
    WHERE run_id = (SELECT run_id FROM run WHERE case_id = NEW.case_id ORDER BY number DESC LIMIT 1);
END;
CREATE TRIGGER run_removed AFTER DELETE ON run WHEN OLD.newest = 1 BEGIN
  UPDATE run SET newest = 1
    WHERE run_id = (SELECT run_id FROM run WHERE case_id = OLD.case_id ORDER BY number DESC LIMIT 1);
END;

-- A part says what decided about it.
CREATE TABLE part_2 (
  run_id    INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,
  name      TEXT NOT NULL,
  ordinal   INTEGER NOT NULL,
  built     INTEGER NOT NULL CHECK (built IN (0, 1)),
  reason    TEXT NOT NULL,
  decided   TEXT NOT NULL,
  quantity  TEXT,
  number    REAL,
  threshold REAL,
  bound     REAL,
  answer    TEXT,
  PRIMARY KEY (run_id, name)
) STRICT, WITHOUT ROWID;
INSERT INTO part_2 SELECT part.*, 'scene', NULL, NULL, NULL, NULL, NULL FROM part;
DROP TABLE part;
ALTER TABLE part_2 RENAME TO part;
CREATE INDEX part_by_name ON part (name, built);

-- For questions by hand.
CREATE VIEW newest AS SELECT
  run.run_id, run.case_id, run.number, kase.kind, run.outcome, run.reason, run.time, run.depth, run.cpu_seconds,
  run.wall_seconds, run.peak_memory_mb, run.bytes, run.folder, kase.bed_id, run.bed_run
FROM run JOIN kase ON kase.case_id = run.case_id WHERE run.newest = 1;
CREATE VIEW results AS SELECT
  study.name AS study, study_case.ordinal, study_case.case_id, study_case.labels, run.run_id, run.number, kase.kind,
  run.outcome, run.time, run.depth, run.cpu_seconds, run.folder
FROM study JOIN study_case ON study_case.study_id = study.study_id
LEFT JOIN run ON run.case_id = study_case.case_id AND run.newest = 1
LEFT JOIN kase ON kase.case_id = run.case_id;

PRAGMA user_version = 2;
