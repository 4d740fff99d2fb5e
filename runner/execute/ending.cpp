#include "runner/execute/ending.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>

#include "runner/execute/exit_codes.h"

namespace seapile::execute {
namespace {

/// "SIGSEGV (Segmentation fault)".
std::string signal_name(int signal) {
  const char* abbreviation = sigabbrev_np(signal);
  const char* description = sigdescr_np(signal);
  if (abbreviation == nullptr || description == nullptr) return fmt::format("signal {}", signal);
  return fmt::format("SIG{} ({})", abbreviation, description);
}

const char* meaning(int exit_code) {
  switch (exit_code) {
    case kDone:
      return "completed";
    case kStoppedResumable:
      return "stopped at a checkpoint";
    case kBadRequest:
      return "bad request";
    case kIoFailed:
      return "reading or writing failed";
    case kSyncFailed:
      return "a file could not be made durable";
    case kVerifyFailed:
      return "a file is not what was written";
    case kDiverged:
      return "diverged";
    case kInternalError:
      return "internal error";
    case kClaimHeld:
      return "another process runs this case";
    case kBedMissing:
      return "its bed is missing";
    default:
      return "ended unexpectedly";
  }
}

}  // namespace

Verdict classify(const Ending& ending) {
  if (ending.signal != 0) return Verdict::killed;
  switch (ending.exit_code) {
    case kDone:
      return Verdict::completed;
    case kStoppedResumable:
      return Verdict::stopped;
    case kDiverged:
      return Verdict::diverged;
    case kClaimHeld:
      return Verdict::claimed;
    case kIoFailed:
    case kSyncFailed:
      return Verdict::io;
    default:
      return Verdict::failed;
  }
}

bool worth_a_retry(Verdict verdict) { return verdict == Verdict::killed || verdict == Verdict::io; }

std::string in_words(const Ending& ending) {
  if (ending.signal != 0) return "killed by " + signal_name(ending.signal);
  std::string words = meaning(ending.exit_code);
  if (ending.exit_code != kDone && ending.exit_code != kStoppedResumable && ending.exit_code != kDiverged) {
    words += fmt::format(" (exit code {})", ending.exit_code);
  }
  if (!ending.trouble.empty()) words += ": " + ending.trouble;
  return words;
}

}  // namespace seapile::execute
