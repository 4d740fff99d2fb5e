#include "runner/present/junit.h"

#include <fmt/format.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <cstddef>
#include <sstream>

#include "runner/store/label_text.h"

namespace seapile::present {
namespace {

using boost::property_tree::ptree;

enum class Result { passed, failed, skipped };

struct TestCase {
  std::string kind;  ///< "published", "bounds", "accepted" or "claim"
  std::string name;
  Result result = Result::passed;
  std::string words;    ///< the verdict
  std::string details;  ///< the numbers behind it
};

/// The control characters that XML 1.0 has no way to write.
std::string writable(const std::string& text) {
  std::string clean;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
    clean += control ? "\xEF\xBF\xBD" : std::string(1, c);
  }
  return clean;
}

std::string with_labels(std::string name, const Labels& labels) {
  for (const auto& [path, value] : labels) name += ", " + store::label_text(path, value);
  return name;
}

std::string in_unit(double value, const std::string& unit) {
  if (std::isnan(value)) return "none";
  return unit.empty() || unit == "-" ? fmt::format("{:.9g}", value) : fmt::format("{:.9g} {}", value, unit);
}

TestCase test_case(const Comparison& comparison) {
  const Judgement judgement = judge(comparison);
  TestCase one;
  one.kind = comparison.against == Against::published ? "published"
             : comparison.against == Against::bounds  ? "bounds"
                                                      : "accepted";
  one.name = with_labels(comparison.metric, comparison.labels);
  if (comparison.case_ids.size() == 1) one.name += ", case " + comparison.case_ids.front().substr(0, 10);
  one.result = judgement.finding == Finding::ok       ? Result::passed
               : judgement.finding == Finding::failed ? Result::failed
                                                      : Result::skipped;
  one.words = words(judgement.finding);
  one.details = fmt::format("value {} of {} of {} packings", in_unit(judgement.mean.mean, comparison.unit),
                            comparison.values.size(), comparison.case_ids.size());
  if (comparison.reference)
    one.details += fmt::format(", reference {}, tolerance {}", in_unit(*comparison.reference, comparison.unit),
                               in_unit(comparison.tolerance, comparison.unit));
  if (comparison.at_least) one.details += ", at least " + in_unit(*comparison.at_least, comparison.unit);
  if (comparison.at_most) one.details += ", at most " + in_unit(*comparison.at_most, comparison.unit);
  for (const std::string& text : {comparison.source, comparison.reason})
    if (!text.empty()) one.details += "; " + text;
  return one;
}

TestCase test_case(const Claimed& claim) {
  const ClaimVerdict verdict = judge(claim);
  const Standing stands = standing(claim, verdict);
  TestCase one;
  one.kind = "claim";
  one.name = with_labels(claim.number ? fmt::format("claim {}", *claim.number) : fmt::format("claim ({})", claim.place),
                         claim.common);
  one.name = with_labels(one.name, claim.of);
  if (!claim.over.empty()) one.name += " over" + with_labels("", claim.over).substr(1);
  one.name += ": " + claim.text;
  one.result = stands == Standing::fine       ? Result::passed
               : stands == Standing::contrary ? Result::failed
                                              : Result::skipped;
  one.words = words(verdict) + (claim.expect.empty() ? "" : ", expected " + claim.expect);
  one.details = fmt::format("{} of {}: {} ({} to {}), {} {}", words(claim.compared), claim.metric,
                            in_unit(verdict.estimate.mean, claim.unit), in_unit(verdict.estimate.low, claim.unit),
                            in_unit(verdict.estimate.high, claim.unit),
                            claim.side == Side::above ? "at least" : "at most", in_unit(claim.bound, claim.unit));
  if (!verdict.trouble.empty()) one.details += "; " + verdict.trouble;
  return one;
}

ptree node_of(const std::string& study, const TestCase& one) {
  ptree node;
  node.put("<xmlattr>.classname", writable(study + "." + one.kind));
  node.put("<xmlattr>.name", writable(one.name));
  if (one.result == Result::passed) {
    node.put("system-out", writable(one.words + ": " + one.details));
    return node;
  }
  ptree& said = node.add(one.result == Result::failed ? "failure" : "skipped", "");
  said.put("<xmlattr>.message", writable(one.words));
  said.put_value(writable(one.details));
  return node;
}

}  // namespace

std::string junit_text(const std::string& study, const std::vector<Comparison>& comparisons,
                       const std::vector<Claimed>& claims) {
  std::vector<TestCase> cases;
  for (const Comparison& comparison : comparisons) cases.push_back(test_case(comparison));
  for (const Claimed& claim : claims) cases.push_back(test_case(claim));

  std::size_t failed = 0, skipped = 0;
  for (const TestCase& one : cases) {
    failed += one.result == Result::failed ? 1 : 0;
    skipped += one.result == Result::skipped ? 1 : 0;
  }
  ptree document;
  ptree& suite = document.add("testsuites.testsuite", "");
  suite.put("<xmlattr>.name", writable(study));
  suite.put("<xmlattr>.tests", cases.size());
  suite.put("<xmlattr>.failures", failed);
  suite.put("<xmlattr>.errors", 0);
  suite.put("<xmlattr>.skipped", skipped);
  for (const TestCase& one : cases) suite.add_child("testcase", node_of(study, one));

  std::ostringstream text;
  boost::property_tree::write_xml(text, document, boost::property_tree::xml_writer_make_settings<std::string>(' ', 2));
  return text.str();
}

}  // namespace seapile::present
