#include "runner/commands/matching.h"

#include <fmt/format.h>

#include <filesystem>

#include "runner/commands/command.h"
#include "runner/study/unit.h"

namespace seapile::commands {
namespace {

/// A text that a number is compared with is one with a unit.
void read_quantities(const store::Catalogue& catalogue, const std::string& study, store::Expression& expression) {
  for (store::Expression& part : expression.parts) read_quantities(catalogue, study, part);
  if (expression.kind != store::Expression::Kind::condition) return;
  auto& value = expression.condition.value;
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) return;
  const store::Meaning meaning = catalogue.meaning(expression.condition.path, study);
  if (meaning.unit.empty()) return;
  const study::UnitResult read = study::read_quantity(*text, meaning.unit);
  if (!read.problem.empty()) {
    throw UsageError(fmt::format("{}: \"{}\" {}; allowed: a number, as {}{}", meaning.name, *text, read.problem,
                                 study::unit_example(meaning.unit),
                                 read.nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", read.nearest)));
  }
  value = read.value;
}

}  // namespace

store::Expression matching(const store::Catalogue& catalogue, const std::string& study,
                           const std::vector<std::string>& texts) {
  return usage_checked([&] {
    store::Expression expression = store::parse_all(texts);
    read_quantities(catalogue, study, expression);
    return expression;
  });
}

bool is_study_file(const std::string& word) {
  return word.ends_with(".json") || std::filesystem::is_regular_file(word);
}

}  // namespace seapile::commands
