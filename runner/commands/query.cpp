#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>

#include "runner/commands/command.h"
#include "runner/commands/matching.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/tint.h"
#include "runner/present/replicates.h"
#include "runner/present/table.h"
#include "runner/store/catalogue.h"
#include "runner/store/sql_question.h"

namespace seapile::commands {
namespace {

struct QueryArguments {
  std::string root = "results";
  std::vector<std::string> words, where, columns;
  present::Format format = present::Format::table;
  bool each = false;
  store::SqlQuestion sql;
};

/// What the words ask for: at most one of them is a study, the others are expressions.
struct Asked {
  std::string study;
  std::vector<std::string> expressions;
};

Asked asked(const QueryArguments& arguments, const store::Catalogue& catalogue) {
  Asked asked;
  asked.expressions = arguments.where;
  const auto studies = catalogue.studies();
  for (const std::string& word : arguments.words) {
    const bool is_name = std::ranges::find(studies, word) != studies.end();
    if (!is_name && !is_study_file(word) && store::has_operator(word)) {
      asked.expressions.push_back(word);
    } else if (asked.study.empty()) {
      asked.study = study_name(word);
    } else {
      throw UsageError(fmt::format("\"{}\" is no expression, and there is a study already, \"{}\"", word, asked.study));
    }
  }
  return asked;
}

int nothing_matched() {
  fmt::print(stderr, "nothing matched\n");
  return execute::kNothingMatched;
}

int ask_sql(const QueryArguments& arguments, bool limited) {
  if (!arguments.words.empty() || !arguments.where.empty() || !arguments.columns.empty() || arguments.each) {
    throw UsageError("--sql asks by itself: no study, expression, --where, --columns or --each goes with it");
  }
  store::SqlQuestion question = arguments.sql;
  if (question.text == "-") question.text = std::string(std::istreambuf_iterator<char>(std::cin), {});
  const store::SqlAnswer answer = usage_checked([&] { return store::ask(arguments.root, question); });
  if (answer.more && !limited) {
    throw UsageError(
        fmt::format("the answer has more than {} rows: narrow the question, or take more by --limit", question.limit));
  }
  if (answer.table.rows.empty()) return nothing_matched();
  fmt::print("{}", present::text(answer.table, arguments.format));
  if (answer.more) fmt::print(stderr, "the first {} rows; there are more\n", question.limit);
  return execute::kDone;
}

int query(const QueryArguments& arguments) {
  const auto catalogue = store::Catalogue::open_read_only(arguments.root);
  const auto [study, expressions] = asked(arguments, catalogue);
  if (!is_known(study, catalogue)) return execute::kNothingMatched;
  const store::Expression where = matching(catalogue, study, expressions);
  const store::Table table = usage_checked([&] { return catalogue.query_matching(study, where, arguments.columns); });
  if (table.rows.empty()) return nothing_matched();
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
  command
      ->add_option("STUDY|EXPRESSION", arguments.words,
                   "Name or file of a study, default: every run; and what the runs have to meet")
      ->type_name("");
  add_where_option(*command, arguments.where);
  command
      ->add_option("--columns", arguments.columns,
                   "Parameters or metrics (bed:NAME: of the bed) to list instead of the headline ones")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_format_option(*command, arguments.format);
  command->add_flag("--each", arguments.each, "One row per run, also where a study has replicates");
  CLI::Option* sql =
      command->add_option("--sql", arguments.sql.text, "Ask the catalogue in SQL; -: read it from standard input")
          ->type_name("SELECT");
  command->add_option("--bind", arguments.sql.bind, "Value of a parameter of the SELECT: of :NAME, or of the next ?")
      ->type_name("[NAME=]VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false)
      ->needs(sql);
  command->add_option("--time-limit", arguments.sql.time_limit, "Longest time for the SELECT [s]")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 1e6).description(""))
      ->type_name("S")
      ->needs(sql);
  const CLI::Option* limit = command->add_option("--limit", arguments.sql.limit, "Rows of the SELECT to list at most")
                                 ->type_name("ROWS")
                                 ->needs(sql);
  add_store_option(*command, arguments.root);
  command->footer(
      "An expression is made of conditions, and, or, not and brackets. A condition is NAME OP VALUE with one of = != < "
      "<=\n"
      "> >=. A name is a parameter (a path, or the end of one), a metric, outcome, kind or study; a value is a number, "
      "with\n"
      "its unit or in SI units, a text or null. A text that has one of the words in it stands between quotes.\n\n"
      "Where a study has replicates, a row is a case: n packings, and of each metric the mean with its 95 % interval\n"
      "(table: \"44.3 ± 1.2\"; csv and json: the columns x.mean, x.low, x.high).\n\n"
      "--sql reads the tables of results_schema/catalogue.sql and its views newest and results, and changes "
      "nothing.\n\n"
      "Examples:\n"
      "  runner query tip_shape\n"
      "  runner query 'tip = conical and speed > 0.1 m/s'\n"
      "  runner query tip_shape 'not (outcome = diverged or bed.seed > 3)' --format csv\n"
      "  runner query density --columns bed:solid_fraction,tip_resistance_mean --format csv\n"
      "  runner query density --each --format csv\n"
      "  runner query --where \"outcome = completed\" --where \"bed.seed <= 3\" --format csv\n"
      "  runner query velocity --columns pile.driving.constant.speed,tip_resistance_mean --format json\n"
      "  runner query --sql 'select study, count(*) from results group by study'\n"
      "  runner query --sql 'select case_id, value from newest join metric using (run_id)\n"
      "                      where name = :metric and value > :least' --bind metric=tip_resistance_mean --bind "
      "least=5e4");
  command->callback([&call, sql, limit] {
    call = [sql, limit] { return sql->count() > 0 ? ask_sql(arguments, limit->count() > 0) : query(arguments); };
  });
}

}  // namespace seapile::commands
