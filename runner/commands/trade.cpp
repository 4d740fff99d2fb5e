#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "runner/commands/command.h"
#include "runner/commands/traded.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/trade_figure.h"
#include "runner/present/trade_table.h"

namespace seapile::commands {
namespace {

struct TradeArguments {
  std::string study, root = "results", out, of;
  study::Options options;
  present::Format format = present::Format::table;
  bool freeze = false;
};

/// Index of the metric that is drawn.
std::size_t drawn_metric(const TradeArguments& arguments, const study::Trade& trade) {
  if (arguments.of.empty()) return 0;
  const auto found = std::ranges::find(trade.metrics, arguments.of);
  if (found == trade.metrics.end())
    throw UsageError(fmt::format("--of: the study does not compare \"{}\"; it compares {}", arguments.of,
                                 fmt::join(trade.metrics, ", ")));
  return static_cast<std::size_t>(found - trade.metrics.begin());
}

int trade(const TradeArguments& arguments) {
  const study::Study study = study::read(arguments.study, arguments.options);
  if (!study.trade)
    throw UsageError(arguments.study + ": has neither \"frontier\" nor \"ablate\": there is nothing to compare");
  const std::size_t metric = drawn_metric(arguments, *study.trade);
  const bool ablation = study.trade->kind == study::TradeKind::ablation;
  if (arguments.freeze) {
    const study::Options& changed = arguments.options;
    if (!changed.set.empty() || changed.seeds || !changed.fidelity.empty())
      throw UsageError(
          "--freeze: keeps the reference of the study as it is written, without --set, --seeds and --fidelity");
    fmt::print("{}\n", freeze(study, arguments.root).string());
    return execute::kDone;
  }
  const Traded all = traded(study, arguments.root);
  const auto& groups = all.groups;
  for (const std::string& remark : all.remarks) fmt::print(stderr, "{}\n", remark);
  if (arguments.format == present::Format::table) {
    fmt::print("{}", present::trade_text(groups, ablation));
  } else {
    const present::Grouped grouped = present::trade_table(groups, ablation);
    fmt::print("{}", present::text(grouped.table, arguments.format, grouped.means));
  }
  if (!arguments.out.empty()) {
    if (groups.size() > 1)
      throw UsageError(
          fmt::format("--out: draws one scene, and the study has {}; choose one with --set", groups.size()));
    try {
      present::draw(study.question, groups.front(), metric, arguments.out);
    } catch (const store::StoreError& error) {
      throw UsageError(error.what());
    }
    fmt::print(arguments.format == present::Format::table ? stdout : stderr, "\n{}\n", arguments.out);
  }
  const bool missing = std::ranges::any_of(groups, [](const present::TradedGroup& group) {
    return std::ranges::any_of(group.variants, [](const present::TradedVariant& variant) {
      return std::ranges::any_of(variant.runs, [](const auto& run) { return run.failure == "never run"; });
    });
  });
  return missing ? execute::kNothingMatched : execute::kDone;
}

}  // namespace

void add_trade(CLI::App& app, Call& call) {
  static TradeArguments arguments;
  CLI::App* command = app.add_subcommand("trade", "Show what a study's variants cost, and how far they are from one");
  command->add_option("STUDY", arguments.study, "Study file with \"frontier\" or \"ablate\"")->required();
  add_study_options(*command, arguments.options);
  command->add_option("--of", arguments.of, "Metric that is drawn; default: the study's first")->type_name("METRIC");
  command->add_option("-o,--out", arguments.out, "Work-precision diagram to draw as well")->type_name("FILE.svg");
  command->add_flag("--freeze", arguments.freeze,
                    "Write the reference's runs to frozen/ beside the study; from then on they stand for it");
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->footer(
      "Examples:\n"
      "  runner trade studies/frontier_dry.json -o frontier_dry.svg\n"
      "  runner trade studies/frontier_dry.json --format csv > frontier_dry.csv");
  command->callback([&call] { call = [] { return trade(arguments); }; });
}

}  // namespace seapile::commands
