#include "runner/present/claim_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "runner/present/replicates.h"

namespace seapile::present {
namespace {

using store::Cell;
using store::Table;

constexpr int kMostDecimals = 9;

/// What a claim is called: its number, or "(2)" for the second of its study.
std::string name_of(const Claimed& claim) {
  return claim.number ? fmt::format("{}", *claim.number) : fmt::format("({})", claim.place);
}

std::string line_of(const Labels& labels) {
  std::string line;
  for (const auto& [path, value] : labels) line += fmt::format("{}{}={}", line.empty() ? "" : ", ", path, value);
  return line;
}

/// "claim 12, pile.tip=flat, pile.driving.constant.speed=0.4 m/s over pile.driving.constant.speed=0.06 m/s".
std::string place_of(const Claimed& claim) {
  std::string place = "claim " + name_of(claim);
  for (const std::string& part : {line_of(claim.common), line_of(claim.of)}) place += part.empty() ? "" : ", " + part;
  return claim.over.empty() ? place : place + " over " + line_of(claim.over);
}

/// The estimate with two digits of its interval's half-width, "44.3 ± 1.2" or "1.52 (1.41 to 1.65)"; in a unit with
/// its prefix.
class Shown {
 public:
  Shown(const Claimed& claim, const Interval& estimate) : unit_(claim.unit), estimate_(estimate) {
    const double value = std::isfinite(estimate.mean) ? std::abs(estimate.mean) : 0;
    scale_ = prefixed(unit_, std::max(value, std::abs(claim.bound)));
  }

  const std::string& unit() const { return unit_; }
  std::string number(double value) const { return fmt::format("{:.6g}", value * scale_); }

  std::string estimate() const {
    if (std::isnan(estimate_.mean)) return "-";
    const double mean = estimate_.mean * scale_, low = estimate_.low * scale_, high = estimate_.high * scale_;
    const double half = (high - low) / 2;
    if (!(half > 0)) return fmt::format("{:.6g}", mean);
    const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(half))));
    if (decimals > kMostDecimals) return fmt::format("{:.6g} ± {:.2g}", mean, half);
    const bool even = std::abs((high - mean) - (mean - low)) <= 1e-6 * (high - low);
    if (even) return fmt::format("{:.{}f} ± {:.{}f}", mean, decimals, half, decimals);
    return fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", mean, decimals, low, decimals, high, decimals);
  }

 private:
  std::string unit_;
  Interval estimate_;
  double scale_ = 1;
};

std::string count_text(const Claimed& claim, const ClaimVerdict& verdict) {
  const std::size_t n = verdict.estimate.n, all = claim.packings.size();
  return n == all ? fmt::format("{}", n) : fmt::format("{} of {}", n, all);
}

Cell words_or_nothing(const std::string& words) {
  Cell cell;
  if (!words.empty()) cell = words;
  return cell;
}

Cell number_or_nothing(double value) {
  Cell cell;
  if (!std::isnan(value)) cell = value;
  return cell;
}

/// The cells of a claim by the names of their columns.
std::map<std::string, Cell> cells_of(const Claimed& claim) {
  const ClaimVerdict verdict = judge(claim);
  std::map<std::string, Cell> cells;
  const auto put = [&](const char* name, const std::string& words) { cells[name] = words_or_nothing(words); };
  const auto put_number = [&](const char* name, double value) { cells[name] = number_or_nothing(value); };
  put("against", "claim");
  put("metric", claim.metric);
  put_number("n", static_cast<double>(verdict.estimate.n));
  put_number("value", verdict.estimate.mean);
  put_number("low", verdict.estimate.low);
  put_number("high", verdict.estimate.high);
  put("unit", claim.unit);
  put_number(claim.side == Side::above ? "at_least" : "at_most", claim.bound);
  put("verdict", words(verdict));
  put("reason", claim.text);
  if (claim.number) put_number("number", static_cast<double>(*claim.number));
  put("cases", line_of(claim.common));
  put("of", line_of(claim.of));
  put("over", line_of(claim.over));
  put("as", words(claim.compared));
  if (!claim.deterministic) put_number("margin", claim.margin);
  if (verdict.needed) put_number("needed", static_cast<double>(*verdict.needed));
  put("expect", claim.expect);
  return cells;
}

std::string needed_text(const ClaimVerdict& verdict) {
  if (verdict.estimate.n < 2) return "one packing says nothing of the scatter; `--seeds N` repeats every case";
  if (!verdict.needed) return "more than a million packings would be needed";
  return fmt::format("about {} packings decide, with a chance of {:g} %", *verdict.needed, 100 * kPower);
}

}  // namespace

Table with_claims(Table checks, const std::vector<Claimed>& claims) {
  if (claims.empty()) return checks;
  for (const char* name : {"number", "cases", "of", "over", "as", "margin", "needed", "expect"}) {
    checks.columns.emplace_back(name);
    checks.units.emplace_back();
  }
  for (auto& row : checks.rows) row.resize(checks.columns.size());
  for (const Claimed& claim : claims) {
    const auto cells = cells_of(claim);
    auto& row = checks.rows.emplace_back();
    for (const std::string& column : checks.columns) {
      const auto cell = cells.find(column);
      row.push_back(cell == cells.end() ? Cell{} : cell->second);
    }
  }
  return checks;
}

Table shown_claims(const std::vector<Claimed>& claims) {
  const bool expected = std::ranges::any_of(claims, [](const Claimed& claim) { return !claim.expect.empty(); });
  std::vector<Labels> labels;
  for (const Claimed& claim : claims) labels.push_back(claim.common);
  Table table = label_table(labels);
  const std::size_t first = table.columns.size();
  table.columns.insert(table.columns.begin(), "claim");
  for (const char* name : {"of", "over", "n", "estimate", "unit", "bound", "margin", "verdict"})
    table.columns.emplace_back(name);
  if (expected) table.columns.emplace_back("expected");
  table.units.insert(table.units.begin(), "");
  table.units.resize(table.columns.size());

  for (std::size_t i = 0; i < claims.size(); ++i) {
    const Claimed& claim = claims[i];
    const ClaimVerdict verdict = judge(claim);
    const Shown shown(claim, verdict.estimate);
    const bool relative = claim.compared == Compared::ratio;
    auto& row = table.rows[i];
    row.insert(row.begin(), words_or_nothing(name_of(claim)));
    for (const std::string& text :
         {legend_text(claim.of), legend_text(claim.over), count_text(claim, verdict), shown.estimate(), shown.unit(),
          fmt::format("{} {}", claim.side == Side::above ? "at least" : "at most", shown.number(claim.bound)),
          claim.deterministic ? ""
          : relative          ? fmt::format("{:.6g}", claim.margin)
                              : shown.number(claim.margin),
          words(verdict)})
      row.push_back(words_or_nothing(text));
    if (expected) row.push_back(words_or_nothing(claim.expect));
  }
  for (std::size_t column = first + 1; column < table.columns.size(); ++column) {
    if (table.columns[column] == "n" || table.columns[column] == "margin") align_right(table, column);
  }
  return table;
}

std::vector<std::string> claim_sentences(const std::vector<Claimed>& claims) {
  std::vector<std::string> sentences;
  std::size_t told = 0;
  for (const Claimed& claim : claims) {
    if (claim.place == told) continue;
    told = claim.place;
    const std::string what = claim.compared == Compared::value ? "" : words(claim.compared) + " of ";
    sentences.push_back(fmt::format("claim {}: {} ({}{})", name_of(claim), claim.text, what, claim.metric));
  }
  return sentences;
}

std::string claim_text(const std::vector<Claimed>& claims) {
  if (claims.empty()) return "";
  return fmt::format("claims\n\n{}\n{}\n", text(shown_claims(claims), Format::table),
                     fmt::join(claim_sentences(claims), "\n"));
}

std::string claim_remark(const std::vector<Claimed>& claims) {
  std::string lines;
  bool tested = false;
  for (const Claimed& claim : claims) {
    const ClaimVerdict verdict = judge(claim);
    if (standing(claim, verdict) == Standing::contrary) {
      lines +=
          fmt::format("FAILED  {}: {}, expected {} ({})\n", place_of(claim), words(verdict), claim.expect, claim.text);
    } else if (!verdict.decision) {
      lines += fmt::format("missing  {}: {}\n", place_of(claim), verdict.trouble);
    } else if (verdict.decision == Decision::underpowered) {
      lines += fmt::format("underpowered  {}: {}\n", place_of(claim), needed_text(verdict));
    }
    tested |= !claim.deterministic;
  }
  if (tested) {
    lines += fmt::format(
        "claims are tested one-sided at {:g} % over packings (Student's t); an estimate's interval is of {:g} %\n",
        100 * kAlpha, 100 * kLevel);
  }
  return lines;
}

}  // namespace seapile::present
