-- From version 2 of the catalogue to version 3, within one transaction and without foreign keys; the declarations of the
-- store are then read into it. A step is never changed after the version that it leads to has been used.

-- Older numerics whose results can stand for those of newer ones.
CREATE TABLE equivalence (
  kind            TEXT NOT NULL,
  numerics_before TEXT NOT NULL,
  numerics_now    TEXT NOT NULL,
  case_id         TEXT NOT NULL CHECK (length(case_id) = 64),
  number          INTEGER NOT NULL,
  state_before    TEXT NOT NULL,
  state_now       TEXT NOT NULL,
  likeness        TEXT NOT NULL,
  largest         REAL NOT NULL,
  largest_of      TEXT NOT NULL,
  tolerance       REAL NOT NULL,
  date            TEXT NOT NULL,
  version         TEXT NOT NULL,
  commit_sha      TEXT NOT NULL,
  dirty           INTEGER NOT NULL CHECK (dirty IN (0, 1)),
  file            TEXT NOT NULL,
  seal            TEXT NOT NULL,
  PRIMARY KEY (kind, numerics_before, numerics_now)
) STRICT, WITHOUT ROWID;

PRAGMA user_version = 3;
