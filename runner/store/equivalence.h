// Declarations that runs of older numerics are as good as today's, because a probe measured it (`runner probe`). They
// are files of the store, <root>/equivalents/<name>.json, sealed like a manifest and never changed; the catalogue's
// table of them is made again from the files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "solver/simulation/run.h"

namespace seapile::store {

using NumericsList = std::vector<simulation::NumericsVersion>;

/// The same modules with the same versions, in whatever order.
bool same_numerics(const NumericsList& one, const NumericsList& other);

/// "grains 1 -> 2, mesh none -> 1": every module that moved; empty when none did.
std::string moved_text(const NumericsList& before, const NumericsList& now);

/// What is declared of all runs of a kind that were made with the whole list `before`, where `now` is asked for.
struct Equivalence {
  std::string kind;                     ///< "bed", "drive" or "flow"
  NumericsList before, now;             ///< all modules that computed the runs
  std::string case_id;                  ///< of the case that was computed again
  std::string run;                      ///< "0001": its run with the numerics before
  std::string state_before, state_now;  ///< bits of both final states (final_state.h)
  std::string likeness;                 ///< "identical" to the last bit, within "rounding", or within "tolerance"
  double largest = 0;                   ///< relative distance of their metrics and curves [-]
  std::string largest_of;               ///< the metric or column; "" where nothing moved
  double tolerance = 0;                 ///< that was allowed [-]
  std::string date;                     ///< of the probe, "2026-11-27T13:59:04Z"
  std::string version, commit;          ///< of the program that computed it again
  bool dirty = false;                   ///< its source had changes
  std::string file, seal;               ///< its name below the folder, and its seal, when read
};

/// Whether it is about runs of that kind and of those two lists. A chain is not joined: that 1 -> 2 and 2 -> 3 are
/// declared says nothing of 1 -> 3, for distances add up and a sum was never measured.
bool is_about(const Equivalence& equivalence, const std::string& kind, const NumericsList& before,
              const NumericsList& now);

/// "grains 1 -> 2, probe of case 1a2b3c4d5e within 3e-09 (tolerance 1e-06)".
std::string in_words(const Equivalence& equivalence);

struct Equivalences {
  std::vector<Equivalence> declared;  ///< by the names of their files; each kind and pair of lists once
  std::vector<std::string> left_out;  ///< a sentence for each file that does not hold and counts for nothing
};

/// Those of a store. Never throws because of a file that is damaged or cannot be read.
Equivalences read_equivalences(const std::filesystem::path& root);

/// Writes a declaration, under a name that kind and lists give it. False when there is a whole one of them already,
/// which stays as it is. Throws StoreError.
bool declare(const std::filesystem::path& root, const Equivalence& equivalence);

/// JSON of a list, by module: {"grains":1,"pile":1}.
std::string numerics_json(const NumericsList& numerics);

}  // namespace seapile::store
