#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/table.h"
#include "runner/store/catalogue.h"

namespace seapile::commands {
namespace {

struct QueryArguments {
  std::string study, root = "results";
  std::vector<std::string> where, columns;
  present::Format format = present::Format::table;
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
  fmt::print("{}", present::text(table, arguments.format));
  return execute::kDone;
}

}  // namespace

void add_query(CLI::App& app, Call& call) {
  static QueryArguments arguments;
  CLI::App* command = app.add_subcommand("query", "List runs with their parameters and metrics");
  command->add_option("STUDY", arguments.study, "Name or file of a study; default: every run");
  add_where_option(*command, arguments.where);
  command->add_option("--columns", arguments.columns, "Parameters or metrics to list instead of the headline ones")
      ->type_name("NAME,...")
      ->delimiter(',');
  const std::map<std::string, present::Format> formats = {
      {"table", present::Format::table}, {"csv", present::Format::csv}, {"json", present::Format::json}};
  command->add_option("--format", arguments.format, "table, csv or json")
      ->transform(CLI::CheckedTransformer(formats).description(""))
      ->type_name("FORMAT");
  add_store_option(*command, arguments.root);
  command->footer(
      "Examples:\n"
      "  runner query tip_shape\n"
      "  runner query --where \"outcome = completed\" --where \"bed.seed <= 3\" --format csv\n"
      "  runner query velocity --columns pile.driving.constant.speed,tip_resistance_mean --format json");
  command->callback([&call] { call = [] { return query(arguments); }; });
}

}  // namespace seapile::commands
