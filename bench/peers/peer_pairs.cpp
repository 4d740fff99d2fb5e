// Whether two methods agree, by the tests of runner/present/statistics.h.
//
//   peer_pairs [--margin 0.05] < PAIRS
//
// A line of PAIRS is "a b", two positive numbers from one bed; what is judged is b / a. Prints one line of JSON: `n`
// pairs, geometric mean `ratio` with its 95 % interval `low`, `high`, `verdict`, `margin` as stated, `resolved_margin`,
// and `needed`: with so many pairs of this scatter, methods that do not differ are found equivalent with a chance of 80
// %. Margins are ratios less 1, and hold upwards and downwards in the logarithm. null: one pair tells nothing of it;
// `needed` also when it is more than a million. Bad input is one line and exit code 2.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "runner/present/statistics.h"

using namespace seapile::present;

namespace {

struct Pairs {
  std::vector<double> a, b;
};

Pairs read_pairs(std::istream& in) {
  Pairs pairs;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    double a = 0, b = 0;
    // std::isnormal: neither number nor their ratio may leave the range of the logarithm.
    if (!(words >> a >> b) || !(words >> std::ws).eof() || !(a > 0 && b > 0) || !std::isnormal(b / a))
      throw std::invalid_argument("line " + std::to_string(pairs.a.size() + 1) +
                                  " is not two positive numbers: " + line);
    pairs.a.push_back(a);
    pairs.b.push_back(b);
  }
  if (pairs.a.empty()) throw std::invalid_argument("there are no pairs");
  return pairs;
}

nlohmann::ordered_json judged(const Pairs& pairs, double margin) {
  const Estimate estimate = paired_log_ratio(pairs.a, pairs.b);
  const Equivalence found = equivalence(estimate, std::log1p(margin));
  nlohmann::ordered_json needed;
  if (estimate.n > 1) {
    try {
      needed = sample_needed(estimate.standard_error * std::sqrt(static_cast<double>(estimate.n)), std::log1p(margin));
    } catch (const std::invalid_argument&) {
      // More than a million.
    }
  }
  // Of one pair, what is not a number becomes null.
  return {{"n", estimate.n},
          {"ratio", std::exp(found.difference.mean)},
          {"low", std::exp(found.difference.low)},
          {"high", std::exp(found.difference.high)},
          {"verdict", words(found.verdict)},
          {"margin", margin},
          {"resolved_margin", std::expm1(found.resolved_margin)},
          {"needed", needed}};
}

}  // namespace

int main(int argc, char** argv) {
  double margin = 0.05;
  CLI::App app("Whether two methods agree: reads lines \"a b\", judges b / a, prints one line of JSON");
  app.add_option("--margin", margin, "of the ratio, less 1")->check(CLI::Range(1e-4, 1.0));
  app.failure_message(
      [](const CLI::App*, const CLI::Error& error) { return std::string("peer_pairs: ") + error.what() + "\n"; });
  try {
    app.parse(argc, argv);
    std::cout << judged(read_pairs(std::cin), margin) << '\n';
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "peer_pairs: %s\n", error.what());
    return 2;
  }
}
