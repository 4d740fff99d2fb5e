#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "runner/cluster/scheduler.h"
#include "runner/commands/command.h"
#include "runner/commands/words.h"
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

int run_program(int count, char** arguments) {
  CLI::App app("Seapile: driving piles into granular soil, study by study.", "runner");
  app.footer(kExamples);
  app.set_version_flag("--version", "seapile " + execute::version_line());
  app.require_subcommand(1);
  commands::Call call;
  commands::add_run(app, call);
  commands::add_plan(app, call);
  commands::add_status(app, call);
  commands::add_submit(app, call);
  commands::add_jobs(app, call);
  commands::add_cancel(app, call);
  commands::add_query(app, call);
  commands::add_curve(app, call);
  commands::add_figure(app, call);
  commands::add_trade(app, call);
  commands::add_advise(app, call);
  commands::add_trend(app, call);
  commands::add_check(app, call);
  commands::add_compare(app, call);
  commands::add_probe(app, call);
  commands::add_export(app, call);
  commands::add_gc(app, call);
  commands::add_report(app, call);
  commands::add_show(app, call);
  commands::add_verify(app, call);
  commands::add_reindex(app, call);
  commands::add_new(app, call);
  commands::add_schema(app, call);
  commands::add_completion(app, call);
  commands::add_doctor(app, call);
  commands::add_ingest(app, call);
  commands::add_migrate(app, call);
  commands::add_exec(app, call);
  app.add_flag("--no-color")->description("No colours, on a terminal either; as the environment's NO_COLOR does");
  try {
    auto words = commands::words_of(count, arguments, app);
    if (const auto objection = commands::objection(words, app); !objection.empty())
      throw commands::UsageError(objection);
    std::reverse(words.begin(), words.end());  // CLI11 takes them last first
    app.parse(std::move(words));
    return call();
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? execute::kDone : execute::kBadInput;
  } catch (const study::BadInput& error) {
    for (const base::Problem& problem : error.problems) {
      fmt::print(stderr, "{}\n", study::sentence(error.file, problem));
    }
    return execute::kBadInput;
  } catch (const commands::UsageError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return execute::kBadInput;
  } catch (const cluster::SchedulerError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return execute::kSchedulerRefused;
  } catch (const store::StoreError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return execute::kStoreUnusable;
  }
}

}  // namespace

int main(int count, char** arguments) { return run_program(count, arguments); }
