// Every exit code of the program; docs/exit_codes.md explains them to the user.
#pragma once

namespace seapile::execute {

// Of a command.
inline constexpr int kDone = 0;
inline constexpr int kSomeCasesFailed = 1;    ///< the other cases are fine
inline constexpr int kBadInput = 2;           ///< study or command line; nothing was written
inline constexpr int kCheckFailed = 3;        ///< a result differs from what it should be
inline constexpr int kNothingMatched = 4;     ///< no such run, case or study
inline constexpr int kStoreUnusable = 5;      ///< catalogue busy, damaged or newer than the program; store unwritable
inline constexpr int kSchedulerRefused = 6;   ///< batch system absent or refusing
inline constexpr int kStoppedResumable = 75;  ///< stopped early; the same command continues (EX_TEMPFAIL)
inline constexpr int kInterrupted = 130;      ///< told to stop twice: no checkpoint was waited for (128 + SIGINT)

// Of a worker, besides kDone and kStoppedResumable.
inline constexpr int kBadRequest = 40;     ///< the request cannot be read, or names something that is not there
inline constexpr int kIoFailed = 41;       ///< reading or writing failed: disk full, permission, ...
inline constexpr int kSyncFailed = 42;     ///< the system could not promise that a file is on disk
inline constexpr int kVerifyFailed = 43;   ///< a file differs from what was written or sealed
inline constexpr int kDiverged = 44;       ///< the numerics gave up; the run is sealed with the reason
inline constexpr int kInternalError = 45;  ///< an exception that nobody expected
inline constexpr int kClaimHeld = 46;      ///< another process runs this case
inline constexpr int kBedMissing = 47;     ///< the bed to build on has no run that can be used

}  // namespace seapile::execute
