#include <fmt/format.h>

#include <algorithm>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/tint.h"
#include "runner/present/replicates.h"
#include "runner/present/table.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

struct QueryArguments {
  std::string study, root = "results";
  std::vector<std::string> where, columns;
  present::Format format = present::Format::table;
  bool each = false;
};

int query(const QueryArguments& arguments) {
  const std::string study = study_name(arguments.study);
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  if (!is_known(study, catalogue)) return execute::kNothingMatched;
  const store::Table table = usage_checked([&] { return catalogue.query(study, arguments.where, arguments.columns); });
  if (table.rows.empty()) {
    fmt::print(stderr, "nothing matched\n");
    return execute::kNothingMatched;
  }
  // A table is read by people, who are told how far it carries; a program gets the table alone.
  const bool for_people = arguments.format == present::Format::table;
  const auto print = [&](const std::string& text) {
    fmt::print("{}", for_people ? execute::tinted(text, stdout) : text);
  };
  if (!arguments.each && !study.empty() && present::has_replicates(table)) {
    const present::Grouped grouped = present::group_query(table);
    print(present::text(grouped.table, arguments.format, grouped.means));
    fmt::print(for_people ? stdout : stderr, "{}{}", for_people ? "\n" : "",
               present::remark(grouped, arguments.format));
    return execute::kDone;
  }
  print(present::text(table, arguments.format));
  const auto kind = std::ranges::find(table.columns, "kind") - table.columns.begin();
  const bool packings =
      std::ranges::any_of(table.rows, [&](const auto& row) { return row[kind] != store::Cell{"flow"}; });
  if (for_people && packings && !study.empty() && !present::has_replicates(table))
    fmt::print("\n{}\n", present::kOnePacking);
  return execute::kDone;
}

}  // namespace

void add_query(CLI::App& app, Call& call) {
  static QueryArguments arguments;
  CLI::App* command = app.add_subcommand("query", "List cases with their parameters and metrics");
  command->add_option("STUDY", arguments.study, "Name or file of a study; default: every run");
  add_where_option(*command, arguments.where);
  command
      ->add_option("--columns", arguments.columns,
                   "Parameters or metrics (bed:NAME: of the bed) to list instead of the headline ones")
      ->type_name("NAME,...")
      ->delimiter(',');
  add_format_option(*command, arguments.format);
  command->add_flag("--each", arguments.each, "One row per run, also where a study has replicates");
  add_store_option(*command, arguments.root);
  command->footer(
      "Where a study has replicates, a row is a case: n packings, and of each metric the mean with its 95 % interval\n"
      "(table: \"44.3 ± 1.2\"; csv and json: the columns x.mean, x.low, x.high).\n\n"
      "Examples:\n"
      "  runner query tip_shape\n"
      "  runner query density --columns bed:solid_fraction,tip_resistance_mean --format csv\n"
      "  runner query density --each --format csv\n"
      "  runner query --where \"outcome = completed\" --where \"bed.seed <= 3\" --format csv\n"
      "  runner query velocity --columns pile.driving.constant.speed,tip_resistance_mean --format json");
  command->callback([&call] { call = [] { return query(arguments); }; });
}

}  // namespace seapile::commands
