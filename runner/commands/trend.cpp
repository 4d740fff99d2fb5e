#include "runner/present/trend.h"

#include <fmt/format.h>

#include <optional>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/crossing.h"
#include "runner/present/trend_figure.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

struct TrendArguments {
  std::string study, root = "results", out;
  std::vector<std::string> where;
  present::TrendQuestion question;
  std::optional<double> crossing;
  present::Format format = present::Format::table;
};

int trend(const TrendArguments& arguments) {
  const std::string study = study_name(arguments.study);
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  if (!is_known(study, catalogue)) return execute::kNothingMatched;
  const present::TrendQuestion& question = arguments.question;
  const store::Table each =
      usage_checked([&] { return catalogue.query(study, arguments.where, present::trend_columns(question)); });
  if (each.rows.empty()) {
    fmt::print(stderr, "nothing matched\n");
    return execute::kNothingMatched;
  }
  const present::Trend found = usage_checked([&] { return present::trend(each, question); });
  const bool for_people = arguments.format == present::Format::table;
  if (!arguments.out.empty()) {
    try {
      present::draw(fmt::format("{}: {} against {}", study, question.of, question.against), found, arguments.out);
    } catch (const store::StoreError& error) {
      throw UsageError(error.what());
    }
  }
  const present::Grouped grouped = present::trend_table(found);
  fmt::print("{}", present::text(grouped.table, arguments.format, grouped.means));
  std::FILE* const beside = for_people ? stdout : stderr;
  fmt::print(beside, "{}{}", for_people ? "\n" : "", present::trend_remark(found, arguments.format));
  if (arguments.crossing) fmt::print(beside, "{}", present::crossing_text(found, *arguments.crossing));
  if (!arguments.out.empty()) fmt::print(beside, "{}{}\n", for_people ? "\n" : "", arguments.out);
  return execute::kDone;
}

}  // namespace

void add_trend(CLI::App& app, Call& call) {
  static TrendArguments arguments;
  CLI::App* command =
      app.add_subcommand("trend", "Show how one number goes with another, with intervals over packings");
  command->add_option("STUDY", arguments.study, "Name or file of a study")->required();
  command->add_option("--of", arguments.question.of, "Metric, the ordinate")->type_name("METRIC")->required();
  command
      ->add_option("--against", arguments.question.against, "Metric (bed:NAME: of the bed) or parameter, the abscissa")
      ->type_name("NAME")
      ->required();
  command
      ->add_option("--effect", arguments.question.effect,
                   "Axis of the study: ratio of the metric to that at the axis' smallest value, on the same bed")
      ->type_name("PATH");
  command->add_option("--crossing", arguments.crossing, "Tell where the metric passes this value, line by line")
      ->type_name("VALUE");
  command->add_option("--level", arguments.question.level, "Of the intervals")
      ->capture_default_str()
      ->check(CLI::Range(0.5, 0.9999).description(""))
      ->type_name("0.5..0.9999");
  command->add_option("-o,--out", arguments.out, "Picture to draw as well")->type_name("FILE.svg");
  add_where_option(*command, arguments.where);
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->footer(
      "Examples:\n"
      "  runner trend density --of tip_resistance_mean --against bed:solid_fraction\n"
      "  runner trend density --of tip_resistance_mean --against bed:solid_fraction \\\n"
      "      --effect pile.driving.constant.speed -o density.svg\n"
      "  runner trend die_swell_reynolds --of swell_ratio --against jet.reynolds --crossing 1\n"
      "  runner trend velocity --of tip_resistance_mean --against pile.driving.constant.speed --format csv");
  command->callback([&call] { call = [] { return trend(arguments); }; });
}

}  // namespace seapile::commands
