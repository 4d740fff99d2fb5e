// What the small worker writes, and what is to be found when it has died somewhere.
#pragma once

#include "runner/store/catalogue.h"
#include "tests/runner/store/sample_run.h"

namespace seapile::store::fault {

inline constexpr std::size_t kRecords = 30;
inline constexpr std::size_t kFrameEvery = 10;
inline constexpr std::size_t kCheckpointEvery = 8;  // Three checkpoints, and records behind the last.

/// Exit codes of the worker: a StoreError's kind is added to the first.
inline constexpr int kFirstError = 40;
inline constexpr int kLastError = kFirstError + static_cast<int>(StoreError::Kind::locked);
inline constexpr int kConfused = 70;

/// The second frame has no contacts.
inline simulation::Frame frame(std::size_t index) { return sample::frame(index, index == 1 ? 0 : 60 + 9 * index); }

inline StudyEntry study() {
  return {"faults", "what is left?", std::string(64, '0'), {{sample::drive_header().case_id, {{"pile.tip", "flat"}}}}};
}

/// Whether what can be resumed is what was sealed at its checkpoint.
inline bool is_expected(const Resumable& resumable) {
  const std::size_t records = resumable.records.size();
  if (records == 0) return resumable.state.empty() && resumable.frames == 0;
  return records % kCheckpointEvery == 0 && resumable.frames == (records - 1) / kFrameEvery + 1 &&
         sample::difference(resumable.records, sample::records(0, records)).empty() &&
         sample::difference(resumable.state, sample::state(records)).empty();
}

}  // namespace seapile::store::fault
