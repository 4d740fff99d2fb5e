#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/provenance.h"
#include "runner/store/run_folder.h"
#include "runner/study/problem_text.h"
#include "runner/study/study.h"

namespace {

using namespace seapile;

constexpr const char* kExamples =
    "Examples:\n"
    "  runner studies/tip_shape.json                     run a study; what is fresh is not run again\n"
    "  runner studies/tip_shape.json --set pile.depth=0.3 --seeds 5\n"
    "  runner query tip_shape --where \"pile.driving.constant.speed > 0.1\" --format csv\n"
    "  runner curve tip_shape --out curves.csv\n"
    "  runner figure forces 1a2b3c4d5e --depth 0.6 -o forces.svg\n"
    "  runner trend density --of tip_resistance_mean --against bed:solid_fraction -o density.svg\n"
    "  runner check my_study.json                        compare with published and with accepted values\n"
    "  runner show 1a2b3c4d5e\n";

/// `runner STUDY` means `runner run STUDY`.
std::vector<std::string> with_default_command(int count, char** arguments, const CLI::App& app) {
  std::vector<std::string> words(arguments + 1, arguments + count);
  if (words.empty() || words[0].starts_with("-")) return words;
  const auto all = [](const CLI::App*) { return true; };
  for (const CLI::App* command : app.get_subcommands(all)) {
    if (command->get_name() == words[0]) return words;
  }
  const bool is_study = words[0].ends_with(".json") || std::filesystem::is_regular_file(words[0]);
  if (is_study) words.insert(words.begin(), "run");
  return words;
}

int run_program(int count, char** arguments) {
  CLI::App app("Seapile: driving piles into granular soil, study by study.", "runner");
  app.footer(kExamples);
  app.set_version_flag("--version", "seapile " + execute::version_line());
  app.require_subcommand(1);
  commands::Call call;
  commands::add_run(app, call);
  commands::add_query(app, call);
  commands::add_curve(app, call);
  commands::add_figure(app, call);
  commands::add_trade(app, call);
  commands::add_advise(app, call);
  commands::add_trend(app, call);
  commands::add_check(app, call);
  commands::add_show(app, call);
  commands::add_verify(app, call);
  commands::add_reindex(app, call);
  commands::add_ingest(app, call);
  commands::add_migrate(app, call);
  commands::add_exec(app, call);
  try {
    auto words = with_default_command(count, arguments, app);
    std::reverse(words.begin(), words.end());  // CLI11 takes them last first
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? execute::kDone : execute::kBadInput;
  }
  try {
    return call();
  } catch (const study::BadInput& error) {
    for (const base::Problem& problem : error.problems) {
      fmt::print(stderr, "{}\n", study::sentence(error.file, problem));
    }
    return execute::kBadInput;
  } catch (const commands::UsageError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return execute::kBadInput;
  } catch (const store::StoreError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return execute::kStoreUnusable;
  }
}

}  // namespace

int main(int count, char** arguments) { return run_program(count, arguments); }
