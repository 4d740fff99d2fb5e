#include "runner/study/claim.h"

#include <algorithm>
#include <map>

#include "runner/study/claim_grammar.h"
#include "runner/study/resolved.h"
#include "runner/study/study.h"

namespace seapile::study {
namespace {

using Labels = std::vector<std::pair<std::string, std::string>>;
constexpr const char* kSeedPath = "bed.seed";

/// Whether one path is the other or lies above it.
bool related(const std::string& a, const std::string& b) {
  const auto above = [](const std::string& upper, const std::string& lower) { return lower.starts_with(upper + "."); };
  return a == b || above(a, b) || above(b, a);
}

bool names(const std::optional<Match>& side, const std::string& axis) {
  return side && std::ranges::any_of(side->conditions, [&](const auto& one) { return related(one.first, axis); });
}

/// The labels of a case by what they are to a claim.
struct Parts {
  Labels common, named;
  std::string seed;  ///< "" where it is an axis like others, or none
};

Parts parts_of(const ClaimText& text, const Case& one) {
  Parts parts;
  for (const auto& label : one.labels) {
    if (label.first == kSeedPath && !text.claim.deterministic) {
      parts.seed = label.second;
    } else {
      const bool named = names(text.of, label.first) || names(text.over, label.first);
      (named ? parts.named : parts.common).push_back(label);
    }
  }
  return parts;
}

/// Packings of one case.
struct Group {
  Labels common, named;
  std::vector<std::pair<std::string, std::size_t>> packings;  ///< seed and case
};

/// The cases that match, packings of a case together, in the order of the study.
std::vector<Group> groups_of(const ClaimText& text, const std::vector<Case>& cases,
                             const std::vector<std::size_t>& those) {
  std::vector<Group> groups;
  std::map<std::pair<Labels, Labels>, std::size_t> known;
  for (const std::size_t i : those) {
    Parts parts = parts_of(text, cases[i]);
    const auto [at, first] = known.try_emplace({parts.common, parts.named}, groups.size());
    if (first) groups.push_back({std::move(parts.common), std::move(parts.named), {}});
    groups[at->second].packings.emplace_back(std::move(parts.seed), i);
  }
  return groups;
}

/// A row for each group, or for each two groups that agree in all that the claim does not name.
std::vector<ClaimRow> rows_of(const std::vector<Group>& of, const std::vector<Group>* over) {
  std::vector<ClaimRow> rows;
  for (const Group& group : of) {
    if (!over) {
      rows.push_back({group.common, group.named, {}, {}});
      for (const auto& [seed, i] : group.packings) rows.back().packings.push_back({i, {}});
      continue;
    }
    for (const Group& other : *over) {
      if (other.common != group.common) continue;
      ClaimRow row{group.common, group.named, other.named, {}};
      const std::map<std::string, std::size_t> partners(other.packings.begin(), other.packings.end());
      for (const auto& [seed, i] : group.packings) {
        if (const auto partner = partners.find(seed); partner != partners.end())
          row.packings.push_back({i, partner->second});
      }
      if (!row.packings.empty()) rows.push_back(std::move(row));
    }
  }
  return rows;
}

class Finder {
 public:
  Finder(const std::vector<Case>& cases, bool all_match, base::Problems& problems)
      : cases_(cases), all_match_(all_match), problems_(problems) {
    for (const Case& one : cases) scenes_.push_back(resolve_used(one.scene));
  }

  Claim find(const ClaimText& text) {
    Claim claim = text.claim;
    const auto of = matching(text, text.of), over = matching(text, text.over);
    const auto both = [&](std::size_t i) { return std::ranges::find(of, i) != of.end(); };
    if (of.empty() || (text.over && over.empty())) {
      if (all_match_) problems_.push_back(no_case(text, of.empty()));
    } else if (text.over && std::ranges::any_of(over, both)) {
      problems_.push_back(
          {pointer(text.over->place), R"(matches a case that "of" matches as well)", "cases of another side", ""});
    } else if (!claim.deterministic && without_packings(of)) {
      problems_.push_back({pointer(text.place), "is of cases without packings, in which nothing is drawn at random",
                           R"("deterministic": true)", ""});
    } else {
      const auto others = groups_of(text, cases_, over);
      claim.rows = rows_of(groups_of(text, cases_, of), text.over ? &others : nullptr);
      if (claim.rows.empty() && all_match_) {
        problems_.push_back({pointer(text.place), R"(has no case of "of" beside one of "over")",
                             "cases that agree in every axis that the claim does not name", ""});
      }
    }
    return claim;
  }

 private:
  std::vector<std::size_t> matching(const ClaimText& text, const std::optional<Match>& side) const {
    std::vector<std::size_t> those;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      if ((!side || holds(*side, scenes_[i])) && (!text.which || holds(*text.which, scenes_[i]))) those.push_back(i);
    }
    return those;
  }

  /// Blames "if" where it matches nothing by itself, else the side that does not.
  base::Problem no_case(const ClaimText& text, bool of) const {
    const std::optional<Match>& side = of ? text.of : text.over;
    const bool by_if = text.which && matching({text.place, {}, {}, {}, text.which}, {}).empty();
    const PlacePtr& place = by_if || !side ? (text.which ? text.which->place : text.place) : side->place;
    return {pointer(place), "matches no case", "values that a case has", ""};
  }

  bool without_packings(const std::vector<std::size_t>& those) const {
    return std::ranges::any_of(those, [&](std::size_t i) { return !water_of(cases_[i].scene).empty(); });
  }

  const std::vector<Case>& cases_;
  bool all_match_;
  base::Problems& problems_;
  std::vector<ResolvedScene> scenes_;
};

}  // namespace

std::vector<Claim> find_claims(const std::vector<ClaimText>& texts, const std::vector<Case>& cases, bool all_match,
                               base::Problems& problems) {
  std::vector<Claim> claims;
  if (texts.empty()) return claims;
  Finder finder(cases, all_match, problems);
  for (const ClaimText& text : texts) claims.push_back(finder.find(text));
  return claims;
}

}  // namespace seapile::study
