// A study file becomes cases: read, validated as a whole, expanded, named.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runner/study/check.h"
#include "runner/study/claim.h"
#include "runner/study/edge.h"
#include "runner/study/packing_rule.h"
#include "runner/study/trade.h"
#include "solver/base/problem.h"
#include "solver/scene/spec.h"
#include "solver/simulation/array.h"

namespace seapile::study {

/// Everything that is wrong with the user's input, each with its place. Thrown before anything is written.
struct BadInput : std::runtime_error {
  BadInput(std::string file, base::Problems problems);
  std::string file;         ///< as the user named it
  base::Problems problems;  ///< at least one
};

/// The label of a case's variant, beside those of its axes.
inline constexpr const char* kVariant = "variant";

/// One scene to be simulated.
struct Case {
  scene::SceneSpec scene;  ///< complete: defaults filled, fidelity applied, a grain file named by its real path
  std::string canonical;   ///< canonical text of the scene, in which the bed is its case id
  std::string id;          ///< SHA-256 of the canonical text, 64 hex digits
  std::string bed_canonical;
  std::string bed_id;  ///< of the bed that the scene is built on; equal to `id` when the scene is the bed alone, ""
                       ///< when it has none
  /// What distinguishes this case in its study: (dotted path, value as text with its unit), in the order of the axes.
  std::vector<std::pair<std::string, std::string>> labels;
  std::size_t combination = 0;  ///< of the axes and variants, in the order of the expansion
  std::optional<double> probe;  ///< its value at the path of the study's edge [SI]
};

/// A variant as its study writes it.
struct VariantText {
  std::string name;
  std::vector<std::pair<std::string, std::string>> set;  ///< (path, value as `--set` takes it)
  std::string fidelity;                                  ///< of its own; "": the study's
};

struct Study {
  std::string name;
  std::string question;
  std::filesystem::path file;
  std::string file_sha256;  ///< of the bytes that were parsed
  scene::RecordSpec record;
  std::vector<Case> cases;                  ///< in the order of the expansion, each id once
  std::vector<Check> checks;                ///< of those cases; no part of their identity
  std::vector<Claim> claims;                ///< likewise
  std::optional<PackingRule> packing_rule;  ///< by which the cases may become more (Options::packings)
  std::vector<VariantText> variants;        ///< in the study's order
  std::optional<Trade> trade;               ///< what its variants are compared for
  std::optional<Edge> edge;                 ///< which value of its cases is bisected (Options::probes)
};

/// What the command line adds to a study.
struct Options {
  /// "pile.depth=0.3 m": a dotted path into the scene (or "record.…") and a value, as in JSON or as bare text. It holds
  /// for every case: it wins over the base and over "when", and on the path of an axis it replaces the axis.
  std::vector<std::string> set;
  /// --seeds N: bed.seed = 1..N replaces the study's replicates.
  std::optional<std::int64_t> seeds;
  /// How many packings the study's rule has come to, where it has one; absent: the least that it begins with.
  std::optional<std::int64_t> packings = {};
  /// The values of the study's edge to have, by combination; empty: the two ends in each.
  std::vector<std::vector<double>> probes = {};
  /// --fidelity LEVEL, in place of the study's; variants with a level of their own keep it. "": the study's.
  std::string fidelity = {};
};

inline constexpr std::int64_t kMostCases = 10'000;

/// Reads, validates and expands. Throws BadInput with all problems at once.
Study read(const std::filesystem::path& file, const Options& options = {});

/// Canonical, default-filled, SI text: keys sorted, doubles in shortest round-trip form, -0 as 0.
std::string canonical_text(const scene::BedSpec& bed);
std::string canonical_text(const scene::SceneSpec& scene, const std::string& bed_id);
std::string canonical_text(const scene::RecordSpec& record);

/// The case of a complete scene, with its names but without labels.
Case case_of(const scene::SceneSpec& scene);

/// SHA-256 of a canonical text, 64 lower-case hex digits.
std::string case_id(const std::string& canonical);

/// Full JSON text of a scene (bed spelled out, file path kept) and back, for handing a case to a worker process.
std::string to_json(const scene::SceneSpec& scene);
scene::SceneSpec scene_from_json(const std::string& text);
std::string to_json(const scene::RecordSpec& record);
scene::RecordSpec record_from_json(const std::string& text);

/// What of a record the runs of a scene heed: as JSON, and with all the rest as by default.
std::string to_json(const scene::RecordSpec& record, const scene::SceneSpec& scene);
scene::RecordSpec record_of(const scene::RecordSpec& record, const scene::SceneSpec& scene);

/// The grains of a bed's CSV file, rows by rising id ("grains/id", "grains/position", "grains/radius").
/// Throws BadInput; also when the content is not the one that the bed's id was made from.
std::vector<simulation::Array> read_grain_file(const scene::BedSpec& bed);

}  // namespace seapile::study
