-- The catalogue: <root>/catalogue.sqlite, version 3.
--
-- An index of the sealed run folders below <root>/cases, of the studies below <root>/studies and of the declarations
-- below <root>/equivalents: everything in it is made again from those at any time. This text is compiled into the program. Numbers are SI. What older versions lacked
-- is said in migrations/, one file for each version, which brings a catalogue of the version before to it.

-- A study, as it was last planned.
CREATE TABLE study (
  study_id    INTEGER PRIMARY KEY,   -- of no meaning outside this file
  name        TEXT NOT NULL UNIQUE,  -- as its file says
  question    TEXT NOT NULL,         -- what it asks
  file_sha256 TEXT NOT NULL          -- SHA-256 of the study file that was read
) STRICT;

-- The cases of a study; they need not have been run.
CREATE TABLE study_case (
  study_id INTEGER NOT NULL REFERENCES study ON DELETE CASCADE,  -- the study
  ordinal  INTEGER NOT NULL,                                     -- place in the study, from 0
  case_id  TEXT NOT NULL CHECK (length(case_id) = 64),           -- the case
  labels   TEXT NOT NULL,                                        -- JSON [[path, value with unit], ...]: what sets it apart
  PRIMARY KEY (study_id, ordinal)
) STRICT;
CREATE INDEX study_case_by_case ON study_case (case_id);

-- What was asked, of every case that has a run ("case" is a word of SQL).
CREATE TABLE kase (
  case_id   TEXT PRIMARY KEY CHECK (length(case_id) = 64),  -- SHA-256 of the canonical text
  kind      TEXT NOT NULL,                                  -- "bed", "drive" or "flow"
  canonical TEXT NOT NULL,                                  -- canonical text, in which a bed is its case id
  bed_id    TEXT                                            -- case id of the bed; NULL: there is none
) STRICT;
CREATE INDEX kase_by_kind ON kase (kind);
CREATE INDEX kase_by_bed ON kase (bed_id);

-- The parameters of a case: its newest run's scene, flattened to dotted paths ("pile.driving.constant.speed").
-- The name of a choice stands under the path of the choice ("pile.tip" = 'flat'). Absent parts have two NULLs.
CREATE TABLE param (
  case_id TEXT NOT NULL REFERENCES kase ON DELETE CASCADE,  -- the case
  path    TEXT NOT NULL,                                    -- dotted path into the scene
  num     REAL,                                             -- value of a number
  txt     TEXT,                                             -- value of anything else; lists as JSON
  PRIMARY KEY (case_id, path)
) STRICT, WITHOUT ROWID;
-- Each row is in one of them.
CREATE INDEX param_by_num ON param (path, num) WHERE num IS NOT NULL;
CREATE INDEX param_by_txt ON param (path, txt) WHERE txt IS NOT NULL;
CREATE INDEX param_absent ON param (path) WHERE num IS NULL AND txt IS NULL;

-- A complete run of a case.
CREATE TABLE run (
  run_id         INTEGER PRIMARY KEY,                       -- of no meaning outside this file
  case_id        TEXT NOT NULL REFERENCES kase,             -- the case
  number         INTEGER NOT NULL,                          -- 1, 2, ...: the newest has the highest
  folder         TEXT NOT NULL,                             -- relative to the root
  seal           TEXT NOT NULL,                             -- SHA-256 of the manifest
  bed_run        TEXT,                                      -- run of the bed that was used; NULL: none
  outcome        TEXT NOT NULL,                             -- "completed" or "diverged"
  reason         TEXT NOT NULL,                             -- of the outcome; "" when completed
  time           REAL,                                      -- reached [s]
  depth          REAL,                                      -- reached [m]; NULL: no pile
  state_hash     TEXT NOT NULL,                             -- XXH3 of the final state, 16 hex digits
  records        INTEGER NOT NULL,                          -- rows of its series, of grains and of water
  frames         INTEGER NOT NULL,                          -- frames of the grains kept
  version        TEXT NOT NULL,                             -- of Seapile
  commit_sha     TEXT NOT NULL,                             -- of its source
  dirty          INTEGER NOT NULL CHECK (dirty IN (0, 1)),  -- 1: the source had changes
  host_cpu       TEXT NOT NULL,                             -- model of the processor
  threads        INTEGER NOT NULL,                          -- used
  simd           TEXT NOT NULL,                             -- instructions used
  cpu_seconds    REAL,                                      -- spent [s]
  wall_seconds   REAL,                                      -- spent [s]
  peak_memory_mb REAL,                                      -- largest resident memory [MB]
  attempts       INTEGER NOT NULL,                          -- times that it was started or resumed
  bytes          INTEGER NOT NULL,                          -- of its files, without the manifest
  newest         INTEGER NOT NULL CHECK (newest IN (0, 1)), -- 1: of its case's runs; the triggers see to it
  UNIQUE (case_id, number)
) STRICT;
CREATE UNIQUE INDEX run_newest ON run (case_id) WHERE newest = 1;
CREATE INDEX run_by_outcome ON run (outcome, case_id) WHERE newest = 1;

-- Whoever adds a run, with newest = 0, or removes one leaves exactly one newest run of the case.
CREATE TRIGGER run_added AFTER INSERT ON run BEGIN
  UPDATE run SET newest = 0 WHERE case_id = NEW.case_id AND newest = 1;
  UPDATE run SET newest = 1
    WHERE run_id = (SELECT run_id FROM run WHERE case_id = NEW.case_id ORDER BY number DESC LIMIT 1);
END;
CREATE TRIGGER run_removed AFTER DELETE ON run WHEN OLD.newest = 1 BEGIN
  UPDATE run SET newest = 1
    WHERE run_id = (SELECT run_id FROM run WHERE case_id = OLD.case_id ORDER BY number DESC LIMIT 1);
END;

-- The named numbers that a finished run is known by.
CREATE TABLE metric (
  run_id  INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,  -- the run
  name    TEXT NOT NULL,                                      -- such as "tip_resistance_mean"
  ordinal INTEGER NOT NULL,                                   -- place in the run's own list, from 0
  value   REAL,                                               -- NULL: not a number
  unit    TEXT NOT NULL,                                      -- SI; "-" for numbers without
  meaning TEXT NOT NULL,                                      -- one line
  PRIMARY KEY (run_id, name)
) STRICT, WITHOUT ROWID;
CREATE INDEX metric_by_value ON metric (name, value);

-- The files of a run.
CREATE TABLE artifact (
  run_id INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,  -- the run
  path   TEXT NOT NULL,                                      -- relative to the run's folder
  bytes  INTEGER NOT NULL,                                   -- size
  sha256 TEXT NOT NULL,                                      -- of its bytes
  PRIMARY KEY (run_id, path)
) STRICT, WITHOUT ROWID;

-- The parts of the solver, whether the run was built with them, and what decided it.
CREATE TABLE part (
  run_id    INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,  -- the run
  name      TEXT NOT NULL,                                      -- such as "fluid"
  ordinal   INTEGER NOT NULL,                                   -- place in the run's own list, from 0
  built     INTEGER NOT NULL CHECK (built IN (0, 1)),           -- 1: built
  reason    TEXT NOT NULL,                                      -- why it was built, or left out
  decided   TEXT NOT NULL,                                      -- by whom: "scene", or "asked" (the scene's model)
  quantity  TEXT,                                               -- number that was asked; NULL, as those below: none
  number    REAL,                                               -- its value
  threshold REAL,                                               -- from which on, or up to which, the part is needed
  bound     REAL,                                               -- relative change of the answer that leaving it out stays below
  answer    TEXT,                                               -- such as "frequency of a wave"
  PRIMARY KEY (run_id, name)
) STRICT, WITHOUT ROWID;
CREATE INDEX part_by_name ON part (name, built);

-- The versions of the numerics that a run was made with: they decide whether it is fresh.
CREATE TABLE numerics (
  run_id  INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,  -- the run
  module  TEXT NOT NULL,                                      -- such as "grains"
  version INTEGER NOT NULL,                                   -- raised when the module's numbers move
  PRIMARY KEY (run_id, module)
) STRICT, WITHOUT ROWID;

-- Older numerics whose results can stand for those of newer ones, as a probe has measured on one case of each kind: runs
-- of the kind that were made with exactly the versions before are fresh where exactly the versions now are asked for.
-- Two rows are not to be joined into one: distances add up.
CREATE TABLE equivalence (
  kind            TEXT NOT NULL,                                -- of the runs: "bed", "drive" or "flow"
  numerics_before TEXT NOT NULL,                                -- JSON {module: version}, all modules of such a run
  numerics_now    TEXT NOT NULL,                                -- JSON likewise, of the run that it was compared with
  case_id         TEXT NOT NULL CHECK (length(case_id) = 64),   -- the case that was computed again
  number          INTEGER NOT NULL,                             -- of its run with the numerics before
  state_before    TEXT NOT NULL,                                -- bits of that run's final state, 16 hex digits; "": none
  state_now       TEXT NOT NULL,                                -- bits of the other's
  likeness        TEXT NOT NULL,                                -- "identical", or within "rounding" or the "tolerance"
  largest         REAL NOT NULL,                                -- relative distance of metrics and curves [-]
  largest_of      TEXT NOT NULL,                                -- the metric or column; "" where nothing moved
  tolerance       REAL NOT NULL,                                -- that was allowed [-]
  date            TEXT NOT NULL,                                -- of the probe, ISO 8601 in UTC
  version         TEXT NOT NULL,                                -- of the Seapile that computed it again
  commit_sha      TEXT NOT NULL,                                -- of its source
  dirty           INTEGER NOT NULL CHECK (dirty IN (0, 1)),     -- 1: the source had changes
  file            TEXT NOT NULL,                                -- name of the declaration, below <root>/equivalents
  seal            TEXT NOT NULL,                                -- SHA-256 of the declaration
  PRIMARY KEY (kind, numerics_before, numerics_now)
) STRICT, WITHOUT ROWID;

-- What a run's time went into.
CREATE TABLE cost (
  run_id  INTEGER NOT NULL REFERENCES run ON DELETE CASCADE,  -- the run
  part    TEXT NOT NULL,                                      -- of the solver's work
  ordinal INTEGER NOT NULL,                                   -- place in the run's own list, from 0
  seconds REAL,                                               -- spent [s]
  calls   INTEGER NOT NULL,                                   -- how often
  PRIMARY KEY (run_id, ordinal)
) STRICT, WITHOUT ROWID;

-- For questions by hand (runner query --sql): the newest run of each case.
CREATE VIEW newest AS SELECT
  run.run_id,              -- joins metric, artifact, part, numerics and cost
  run.case_id,             -- joins param
  run.number,              -- of the run
  kase.kind,               -- "bed", "drive" or "flow"
  run.outcome,             -- "completed" or "diverged"
  run.reason,              -- of the outcome
  run.time,                -- reached [s]
  run.depth,               -- reached [m]
  run.cpu_seconds,         -- spent [s]
  run.wall_seconds,        -- spent [s]
  run.peak_memory_mb,      -- largest resident memory [MB]
  run.bytes,               -- of its files
  run.folder,              -- relative to the root
  kase.bed_id,             -- case id of its bed
  run.bed_run              -- run of the bed that was used
FROM run JOIN kase ON kase.case_id = run.case_id WHERE run.newest = 1;

-- For questions by hand: the same for each case of each study, in the study's order; cases that have not been run, too.
CREATE VIEW results AS SELECT
  study.name AS study,                    -- the study
  study_case.ordinal,                     -- place in the study, from 0
  study_case.case_id,                     -- joins param
  study_case.labels,                      -- JSON [[path, value with unit], ...]: what sets the case apart
  run.run_id,                             -- joins metric, artifact, part, numerics and cost; NULL: not run
  run.number,                             -- of the newest run
  kase.kind,                              -- "bed", "drive" or "flow"
  run.outcome,                            -- "completed" or "diverged"
  run.time,                               -- reached [s]
  run.depth,                              -- reached [m]
  run.cpu_seconds,                        -- spent [s]
  run.folder                              -- relative to the root
FROM study JOIN study_case ON study_case.study_id = study.study_id
LEFT JOIN run ON run.case_id = study_case.case_id AND run.newest = 1
LEFT JOIN kase ON kase.case_id = run.case_id;

PRAGMA user_version = 3;
