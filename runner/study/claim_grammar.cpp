#include "runner/study/claim_grammar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runner/study/any_quantity.h"
#include "runner/study/field_reader.h"

namespace seapile::study {
namespace {

using base::Problems;
using Kind = Value::Kind;

constexpr const char* kForms =
    R"({"claim": text, "metric": name, "of": {path: value}, "over": {path: value}, "at_least": 1, "margin": 0.05})";
constexpr const char* kSeedPath = "bed.seed";

class ClaimReader {
 public:
  ClaimReader(const Value& entry, Problems& problems) : entry_(entry), problems_(problems) {}

  ClaimText read() {
    text_.place = entry_.place;
    claim_.pointer = pointer(entry_.place);
    report_unknown_keys(entry_,
                        {"claim", "number", "metric", "of", "over", "as", "at_least", "at_most", "margin", "if",
                         "deterministic", "expect"},
                        problems_);
    if (const Value* words = required("claim")) read_words(*words, claim_.text, problems_);
    if (const Value* number = member("number")) {
      claim_.number = 0;
      read_integer(*number, {"number", "-", base::between(1, 1e6), "number of the claim"}, *claim_.number, problems_);
    }
    if (const Value* metric = required("metric")) read_words(*metric, claim_.metric, problems_);
    read_sides();
    if (const Value* truth = member("deterministic")) read_boolean(*truth, claim_.deterministic, problems_);
    read_bound();
    read_expectation();
    text_.claim = std::move(claim_);
    return std::move(text_);
  }

 private:
  void report(const PlacePtr& place, std::string what, std::string allowed) {
    problems_.push_back({pointer(place), std::move(what), std::move(allowed), ""});
  }

  const Value* member(const char* key) {
    const Value* value = entry_.find(key);
    return value && value->kind != Kind::unusable ? value : nullptr;
  }

  const Value* required(const char* key) {
    if (!entry_.find(key)) report(entry_.place, fmt::format("lacks \"{}\"", key), kForms);
    return member(key);
  }

  void read_sides() {
    const Value *of = entry_.find("of"), *over = entry_.find("over"), *as = entry_.find("as");
    text_.of = read_side("of");
    text_.over = read_side("over");
    if (const Value* which = member("if")) text_.which = read_match(*which, problems_);
    if (over && !of) report(over->place, "has no \"of\" to be compared", kForms);
    if (as && !over) report(as->place, "has no \"over\": one group of cases is compared with the bound", kForms);
    if (!over) return;
    claim_.compared = Compared::ratio;
    if (!member("as")) return;
    if (const auto index = read_choice(*as, {"ratio", "difference"}, problems_); index == 1u)
      claim_.compared = Compared::difference;
  }

  /// Packings are what pairs are made of, so that neither side may name one.
  std::optional<Match> read_side(const char* key) {
    const Value* side = member(key);
    if (!side) return {};
    Match match = read_match(*side, problems_);
    for (const auto& [path, value] : match.conditions) {
      if (path != kSeedPath) continue;
      report(side->place, "names bed.seed, by which cases are paired", R"(bed.seed in "if")");
      break;
    }
    return match;
  }

  void read_bound() {
    const Value *least = entry_.find("at_least"), *most = entry_.find("at_most");
    if ((least == nullptr) == (most == nullptr)) {
      report(entry_.place, least ? "has both at_least and at_most" : "has no bound",
             R"(one of "at_least" and "at_most"; two sides are two claims)");
      return;
    }
    claim_.at_least = least != nullptr;
    const Value* bound = least ? least : most;
    const Value* margin = entry_.find("margin");
    if (claim_.deterministic && margin) report(margin->place, "has no place where the value decides", "nothing here");
    if (!claim_.deterministic && !margin) report(entry_.place, R"(lacks "margin")", kForms);
    if (bound->kind == Kind::unusable || (margin && margin->kind == Kind::unusable)) return;
    claim_.compared == Compared::ratio ? read_ratio(*bound, margin) : read_quantities(*bound, margin);
  }

  void read_ratio(const Value& bound, const Value* margin) {
    read_number(bound, {"bound", "-", base::positive(1e6), "bound of the ratio"}, claim_.bound, problems_);
    if (margin && !claim_.deterministic)
      read_number(*margin, {"margin", "-", base::positive(10), "relative margin"}, claim_.margin, problems_);
  }

  void read_quantities(const Value& bound, const Value* margin) {
    if (!margin || claim_.deterministic) {
      Quantity quantity;
      read_any_quantity(bound, kAnyNumber, quantity, problems_);
      claim_.bound = quantity.value;
      claim_.unit = quantity.unit;
      return;
    }
    constexpr const char* kPositive = "a number, more than 0, with the unit that the bound has";
    const auto pair = read_pair(bound, "the bound", *margin, kPositive, problems_);
    if (!pair) return;
    claim_.bound = pair->first;
    claim_.margin = pair->second;
    claim_.unit = pair->unit;
    if (!(claim_.margin > 0)) report(margin->place, out_of_range(claim_.margin), kPositive);
  }

  void read_expectation() {
    const Value* expect = member("expect");
    if (!expect) return;
    std::vector<std::string> verdicts = {"confirmed", "refuted"};
    if (!claim_.deterministic) verdicts.emplace_back("not distinguishable");
    if (const auto index = read_choice(*expect, verdicts, problems_)) claim_.expect = verdicts[*index];
  }

  const Value& entry_;
  Problems& problems_;
  ClaimText text_;
  Claim claim_;
};

}  // namespace

bool is_claim(const Value& entry) {
  const auto has = [&](const char* key) { return entry.find(key) != nullptr; };
  return std::ranges::any_of(std::array{"claim", "number", "of", "over", "as", "margin", "deterministic", "expect"},
                             has);
}

std::vector<ClaimText> read_claims(const std::vector<Value>& list, Problems& problems) {
  std::vector<ClaimText> texts;
  for (const Value& entry : list) {
    if (!is_claim(entry)) continue;
    const std::size_t before = problems.size();
    ClaimText text = ClaimReader(entry, problems).read();
    if (problems.size() == before) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace seapile::study
