// What a study claims of its cases: that a metric lies on one side of a bound, or that it does so in one case over
// another, packing by packing. No part of any case's identity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/problem.h"

namespace seapile::study {

struct Case;
struct ClaimText;

/// What is compared with the bound.
enum class Compared { value, ratio, difference };

/// Cases of one packing, by index into the study's: one, or the two that are compared.
struct ClaimPair {
  std::size_t of = 0;
  std::optional<std::size_t> over;
};

/// Cases that a claim is decided by. Labels are those of the study, the seed apart where it holds over packings.
struct ClaimRow {
  std::vector<std::pair<std::string, std::string>> common;    ///< in which both sides agree
  std::vector<std::pair<std::string, std::string>> of, over;  ///< the axes that the claim names
  std::vector<ClaimPair> packings;                            ///< in the order of the study; at least one
};

struct Claim {
  std::string pointer;  ///< its place in the study: "/checks/0"
  std::string text;
  std::optional<std::int64_t> number;  ///< that it is known by where it is from
  std::string metric;
  Compared compared = Compared::value;
  bool at_least = true;  ///< else at most
  double bound = 0;
  double margin = 0;           ///< in the bound's unit; of a ratio relative: 0.05 is a factor of 1.05 to either side
  std::string unit;            ///< of both; "": the metric's own
  bool deterministic = false;  ///< every packing is a row of its own, and its value decides
  std::string expect;          ///< "confirmed", "refuted", "not distinguishable"; "": any verdict is fine
  std::vector<ClaimRow> rows;
};

/// Finds the cases of each claim. Two cases are a pair where they agree in every axis that the claim does not name; an
/// axis is named by its own path, by one above it or by one below it. With `all_match` a claim that no case is of is a
/// problem.
std::vector<Claim> find_claims(const std::vector<ClaimText>& texts, const std::vector<Case>& cases, bool all_match,
                               base::Problems& problems);

}  // namespace seapile::study
