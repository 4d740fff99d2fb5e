#include "runner/study/study.h"

#include <fmt/format.h>

#include "runner/study/expand.h"
#include "runner/study/grammar.h"
#include "runner/study/json_value.h"
#include "runner/study/problem_text.h"
#include "runner/study/scene_tree.h"
#include "runner/study/sha256.h"
#include "runner/study/text_file.h"

namespace seapile::study {
namespace {

std::string all_sentences(const std::string& file, const base::Problems& problems) {
  std::string text;
  for (const auto& problem : problems) text += (text.empty() ? "" : "\n") + sentence(file, problem);
  return text;
}

}  // namespace

BadInput::BadInput(std::string named, base::Problems found)
    : std::runtime_error(all_sentences(named, found)), file(std::move(named)), problems(std::move(found)) {}

Study read(const std::filesystem::path& file, const Options& options) {
  base::Problems problems;
  const auto stop_if_bad = [&] {
    if (!problems.empty()) throw BadInput(file.string(), problems);
  };

  std::string trouble;
  const auto bytes = read_text(file, kMostBytes, trouble);
  if (!bytes) problems.push_back({"", trouble, "a study file of at most 16 MiB", ""});
  stop_if_bad();

  const Value document = read_json(*bytes, "", problems);
  if (document.kind == Value::Kind::unusable) stop_if_bad();
  if (document.kind != Value::Kind::object) {
    problems.push_back({"", fmt::format("is {}, not a study", kind_name(document)), "an object {\"study\": ...}", ""});
    stop_if_bad();
  }

  const Grammar grammar = read_grammar(document, options, problems);
  const double count = most_combinations(grammar);
  if (count > static_cast<double>(kMostCases)) {
    problems.push_back({"/axes", fmt::format("make {:.15g} cases", count), fmt::format("at most {}", kMostCases), ""});
    stop_if_bad();
  }

  Expansion expansion = expand(grammar, file.parent_path(), options.probes, problems);
  const bool whole = problems.empty() && options.set.empty() && !options.seeds;
  auto checks = find_checks(grammar.checks, file.parent_path(), expansion.cases, whole, problems);
  auto claims = find_claims(grammar.claims, expansion.cases, whole, problems);
  stop_if_bad();
  std::vector<VariantText> variants;
  for (const Variant& variant : grammar.variants) {
    VariantText& text = variants.emplace_back(VariantText{variant.name, {}, variant.level});
    for (const Assignment& assignment : variant.set)
      text.set.emplace_back(join_path(assignment.path), setting_text(assignment.value));
  }
  return {grammar.name,        grammar.question,  file,
          sha256(*bytes),      expansion.record,  std::move(expansion.cases),
          std::move(checks),   std::move(claims), grammar.packing_rule,
          std::move(variants), grammar.trade,     grammar.edge};
}

}  // namespace seapile::study
