// Prints the laws' rows as Markdown, or puts them into the document where it marks their places.
//
//   verification_table [--law NAME] [--solver NAME] [--large] [--update docs/verification.md]
//
// Ends with 3 when a row does not hold, with 4 when there is no such law or solver.
#include <CLI/CLI.hpp>

#include <cstdio>
#include <ctime>
#include <exception>
#include <string>

#include "tests/verification/document.h"
#include "tests/verification/law.h"

using namespace seapile::verification;

int main(int argc, char** argv) {
  std::string law_name, solver_name, document;
  bool large = false;
  CLI::App app{"Value, closed form and difference of every law of the contact solvers, as Markdown"};
  app.add_option("--law", law_name, "only this law");
  auto* solver_option = app.add_option("--solver", solver_name, "only this solver");
  app.add_flag("--large", large, "larger scenes and more packings, where there is no closed form");
  app.add_option("--update", document, "put the tables into this document, between its markers")
      ->check(CLI::ExistingFile)
      ->excludes(solver_option);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }

  Tables tables;
  int broken = 0, rows = 0;
  for (const Law& law : laws()) {
    if (!law_name.empty() && law.name != law_name) continue;
    std::vector<SolverRow> of_law;
    for (const Solver& solver : solvers()) {
      if (!law.concerns(solver) || (!solver_name.empty() && solver.name != solver_name)) continue;
      const std::clock_t before = std::clock();
      for (Row& row : law.rows(solver, large ? Size::large : Size::small)) {
        ++rows;
        broken += !row.holds();
        of_law.push_back({solver.name, std::move(row)});
      }
      std::fprintf(stderr, "%s, %s: %.2f s\n", law.name.c_str(), solver.name.c_str(),
                   static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    }
    if (of_law.empty()) continue;
    tables[law.name] = table(of_law);
    if (document.empty()) std::printf("### %s\n\n%s\n", law.name.c_str(), tables[law.name].c_str());
  }
  std::fprintf(stderr, "%d rows, of which %d do not hold\n", rows, broken);
  try {
    if (!document.empty()) put_tables(document, tables);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
  return rows == 0 ? 4 : broken > 0 ? 3 : 0;
}
